// docs/settings.md is the settings table, in words a user reads.
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "renderer/api/settings.h"

namespace {

std::string number(double value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

std::string defaultOf(const hipr::SettingInfo& setting) {
    struct Text {
        std::string operator()(bool v) const { return v ? "true" : "false"; }
        std::string operator()(int v) const { return std::to_string(v); }
        std::string operator()(float v) const { return number(v); }
        std::string operator()(const std::string& v) const { return v; }
    };
    return std::visit(Text{}, setting.defaultValue);
}

std::string rangeOf(const hipr::SettingInfo& setting) {
    if (std::holds_alternative<bool>(setting.defaultValue)) return "true, false";
    if (setting.choices.empty()) return number(setting.minimum) + " to " + number(setting.maximum);
    std::string text;
    for (const std::string& choice : setting.choices) text += (text.empty() ? "" : ", ") + choice;
    return text;
}

std::string expectedPage() {
    std::ostringstream page;
    page << "# Settings\n\nFrom schemas/settings.def. `hiprrecord --set NAME=VALUE`, or a render setting of the delegate.\n\n"
         << "| Name | Default | Values | Meaning |\n|---|---|---|---|\n";
    for (const hipr::SettingInfo& s : hipr::settingTable())
        page << "| `" << s.name << "` | " << defaultOf(s) << " | " << rangeOf(s) << " | " << s.help << " |\n";
    return page.str();
}

TEST(SettingsPage, IsTheTable) {
    std::ifstream file(HIPR_SOURCE_DIR "/docs/settings.md");
    std::stringstream page;
    page << file.rdbuf();
    if (page.str() != expectedPage()) std::ofstream("settings.md") << expectedPage();
    EXPECT_EQ(page.str(), expectedPage()) << "Copy the settings.md that this test has written over docs/settings.md.";
}

} // namespace
