#include <gtest/gtest.h>

#include <gmock/gmock.h>

#include <cstring>
#include <set>

#include "renderer/api/settings.h"

using hipr::assignSetting;
using hipr::Settings;
using hipr::SettingValue;

TEST(Settings, TableDescribesEveryMemberOnce) {
    std::set<std::string> names;
    const Settings settings;
    for (const hipr::SettingInfo& info : hipr::settingTable()) {
        EXPECT_TRUE(names.insert(info.name).second) << info.name;
        EXPECT_GT(std::strlen(info.help), 10u) << info.name;
        EXPECT_EQ(readSetting(settings, info.name), info.defaultValue) << info.name;
        Settings copy;
        std::string error;
        EXPECT_TRUE(assignSetting(copy, info.name, info.defaultValue, nullptr, &error)) << error;
        EXPECT_TRUE(copy == settings) << info.name;
    }
}

TEST(Settings, ConvertsBetweenTypes) {
    Settings s;
    bool changed = false;
    std::string error;
    EXPECT_TRUE(assignSetting(s, "convergedSamplesPerPixel", std::string("128"), &changed, &error));
    EXPECT_EQ(s.samples, 128);
    EXPECT_TRUE(changed);
    EXPECT_TRUE(assignSetting(s, "convergedSamplesPerPixel", 128.f, &changed, &error));
    EXPECT_FALSE(changed);
    EXPECT_TRUE(assignSetting(s, "hipr:fireflyClamp", 3, &changed, &error));
    EXPECT_EQ(s.fireflyClamp, 3.f);
    EXPECT_TRUE(assignSetting(s, "enableSceneLights", std::string("off"), &changed, &error));
    EXPECT_FALSE(s.enableSceneLights);
    EXPECT_TRUE(assignSetting(s, "enableSceneLights", 1, &changed, &error));
    EXPECT_TRUE(s.enableSceneLights);
    EXPECT_TRUE(assignSetting(s, "hipr:pixelFilter", std::string("box"), &changed, &error));
    EXPECT_EQ(s.pixelFilter, "box");
}

TEST(Settings, RejectsWithAReasonAndLeavesTheValue) {
    const std::pair<const char*, SettingValue> bad[] = {
        {"hipr:maxDepth", 0},
        {"hipr:maxDepth", 2000},
        {"hipr:maxDepth", 2.5f},
        {"hipr:maxDepth", std::string("deep")},
        {"hipr:maxDepth", std::string("")},
        {"hipr:fireflyClamp", -1.f},
        {"hipr:fireflyClamp", std::string("nan")},
        {"hipr:pixelFilter", std::string("sinc")},
        {"hipr:pixelFilter", 1},
        {"enableSceneLights", std::string("maybe")},
        {"hipr:unknown", 1},
    };
    for (const auto& [name, value] : bad) {
        Settings s;
        bool changed = true;
        std::string error;
        EXPECT_FALSE(assignSetting(s, name, value, &changed, &error)) << name;
        EXPECT_THAT(error, testing::HasSubstr(name));
        EXPECT_FALSE(changed);
        EXPECT_TRUE(s == Settings());
    }
}
