/// What users may have the delegate do besides rendering.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

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
    EXPECT_TRUE(hdhipr::invokeCommand(host.param(), TfToken("dumpScene"), arguments));
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    EXPECT_NE(text.find("/square"), std::string::npos);
    EXPECT_EQ(VtValue(text), host.delegate().GetRenderSetting(TfToken("hipr:sceneDump")));
    std::filesystem::remove(path);
}

TEST(Commands, clearCachesDeletesKernelsAlone) {
    TestHost host({"color"}, 2);
    addScene(host);
    ASSERT_TRUE(host.render());
    const std::filesystem::path caches =
        std::filesystem::temp_directory_path() / ("hipr-caches-" + std::to_string(getpid()));
    const char* before = std::getenv("XDG_CACHE_HOME");
    const std::string kept = before ? before : "";
    setenv("XDG_CACHE_HOME", caches.c_str(), 1);
    std::filesystem::create_directories(caches / "hipr" / "pipelines" / "some");
    EXPECT_TRUE(hdhipr::invokeCommand(host.param(), TfToken("clearCaches"), {}));
    EXPECT_FALSE(std::filesystem::exists(caches / "hipr" / "pipelines" / "some"));
    before ? setenv("XDG_CACHE_HOME", kept.c_str(), 1) : unsetenv("XDG_CACHE_HOME");
    std::filesystem::remove_all(caches);
    EXPECT_TRUE(host.render());
}

TEST(Commands, reloadTexturesFromAnotherThreadWhileItRenders) {
    TestHost host({"color"}, 64);
    addScene(host);
    ASSERT_TRUE(host.render());
    const GfVec4f before = host.readColor(0, 0);
    std::atomic<bool> stop{false};
    std::thread other([&] {
        while (!stop.load()) {
            hdhipr::invokeCommand(host.param(), TfToken("reloadTextures"), {});
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    });
    for (int i = 0; i < 20; ++i) {
        auto& square = host.scene().prim(SdfPath("/square"));
        square.transform.SetTranslate(GfVec3d(0.001 * i, 0, 0));
        host.scene().tracker().MarkRprimDirty(SdfPath("/square"), HdChangeTracker::DirtyTransform);
        host.tick();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    stop.store(true);
    other.join();
    EXPECT_TRUE(host.render());
    EXPECT_EQ(host.readColor(0, 0), before);
}

TEST(Commands, thatFailSaySo) {
    TestHost host({"color"});
    TestWarnings warnings;
    VtDictionary arguments;
    arguments["file"] = VtValue(std::string("/no/such/folder/scene.txt"));
    EXPECT_FALSE(hdhipr::invokeCommand(host.param(), TfToken("dumpScene"), arguments));
    EXPECT_FALSE(hdhipr::invokeCommand(host.param(), TfToken("makeCoffee"), {}));
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
