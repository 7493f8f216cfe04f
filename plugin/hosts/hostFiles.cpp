/// @file hostFiles.cpp
/// Writes the files of hosts that follow from the table of settings (schemas/settings.def).
#include <fstream>
#include <iostream>

#include <nlohmann/json.hpp>

#include "renderer/api/settings.h"

namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const hipr::SettingValue& value) {
    return std::visit([](const auto& v) { return Json(v); }, value);
}

/// The table: name, label, help, default and, as far as there are, range and choices.
Json settings() {
    Json rows = Json::array();
    for (const hipr::SettingInfo& setting : hipr::settingTable()) {
        Json row{{"name", setting.name}, {"label", setting.label}, {"help", setting.help}};
        row["default"] = jsonOf(setting.defaultValue);
        if (!setting.choices.empty()) row["choices"] = setting.choices;
        const bool number = std::holds_alternative<int>(setting.defaultValue) ||
                            std::holds_alternative<float>(setting.defaultValue);
        if (number) row["range"] = {setting.minimum, setting.maximum};
        rows.push_back(std::move(row));
    }
    return rows;
}

/// What Houdini wants to know of a render delegate before it offers it.
Json houdiniRenderer() {
    return {{"HdHiprRendererPlugin",
             {{"valid", true},
              {"menulabel", "HiPR"},
              {"menupriority", 20},
              {"aovsupport", true},
              {"drawmodesupport", false},
              {"depthstyle", "normalized"},
              {"needsdepth", true},
              {"needsselection", false},
              {"defaultpurposes", {"geometry", "render"}}}}};
}

bool write(const char* path, const Json& json) {
    std::ofstream file(path);
    file << json.dump(4) << '\n';
    if (!file) std::cerr << "cannot write '" << path << "'\n";
    return bool(file);
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "usage: hipr_host_files SETTINGS_JSON HOUDINI_JSON\n";
        return 1;
    }
    return write(argv[1], settings()) && write(argv[2], houdiniRenderer()) ? 0 : 1;
}
