/// What users may have the delegate do besides rendering.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "plugin/hdHipr/commands.h"
#include "testenv/unit/delegate/test_host.h"
#include "testenv/unit/delegate/test_warnings.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

void addScene(TestHost& host) {
    host.scene().addDome(SdfPath("/dome"));
    host.scene().addSquare(SdfPath("/square"), GfVec3f(0.5f));
}

TEST(Commands, dumpSceneWritesWhatTheRendererHolds) {
    TestHost host({"color"});
    addScene(host);
    host.tick();
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("hipr-dump-" + std::to_string(getpid()) + ".txt");
    VtDictionary arguments;
    arguments["file"] = VtValue(path.string());
    EXPECT_TRUE(hdhipr::invokeCommand(host.loop(), TfToken("dumpScene"), arguments));
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    EXPECT_NE(text.find("/square"), std::string::npos);
    EXPECT_EQ(VtValue(text), host.delegate().GetRenderSetting(TfToken("hipr:sceneDump")));
    std::filesystem::remove(path);
}

TEST(Commands, thatFailSaySo) {
    TestHost host({"color"});
    TestWarnings warnings;
    VtDictionary arguments;
    arguments["file"] = VtValue(std::string("/no/such/folder/scene.txt"));
    EXPECT_FALSE(hdhipr::invokeCommand(host.loop(), TfToken("dumpScene"), arguments));
    EXPECT_FALSE(hdhipr::invokeCommand(host.loop(), TfToken("makeCoffee"), {}));
    EXPECT_EQ(warnings.texts().size(), 2u);
}

TEST(Commands, runByASettingToo) {
    TestHost host({"color"}, 2);
    addScene(host);
    ASSERT_TRUE(host.render());
    host.delegate().SetRenderSetting(TfToken("hipr:command"), VtValue(std::string("reloadTextures")));
    EXPECT_FALSE(host.loop().converged()); // until it is known that there are no textures
    EXPECT_TRUE(host.render());
}

} // namespace
