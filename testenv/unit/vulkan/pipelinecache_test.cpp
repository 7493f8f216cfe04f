#include <filesystem>
#include <fstream>

#include "renderer/vulkan/cachefolder.h"
#include "renderer/vulkan/pipelinecache.h"
#include "testenv/unit/vulkan/fixture.h"

namespace hipr::test {
namespace {

namespace fs = std::filesystem;

TEST(PipelineCacheFile, OnlyWholeFilesAreUsed) {
    const std::string data = "thirty-two bytes and some more of them", file = packCache(data);
    EXPECT_EQ(unpackCache(file), data);
    EXPECT_EQ(unpackCache(""), "");
    EXPECT_EQ(unpackCache(file.substr(0, 8)), "");
    EXPECT_EQ(unpackCache(file.substr(0, file.size() - 1)), "");
    for (size_t i = 0; i < file.size(); ++i) {
        std::string altered = file;
        altered[i] ^= 0x10;
        EXPECT_EQ(unpackCache(altered), "") << "byte " << i;
    }
}

class CacheFolder : public ::testing::Test {
protected:
    void SetUp() override { fs::remove_all(folder); }
    void TearDown() override { fs::remove_all(folder); }
    fs::path folder = fs::path(::testing::TempDir()) / "hipr_cache_test";
};

TEST_F(CacheFolder, FollowsTheEnvironment) {
    {
        const Environment xdg("XDG_CACHE_HOME", folder.c_str());
        EXPECT_EQ(cacheFolder("x"), folder / "hipr" / "x");
        EXPECT_TRUE(fs::is_directory(folder / "hipr" / "x"));
    }
    const Environment xdg("XDG_CACHE_HOME", ""), home("HOME", folder.c_str());
    EXPECT_EQ(cacheFolder("x"), folder / ".cache" / "hipr" / "x");
    const Environment homeless("HOME", "");
    EXPECT_TRUE(cacheFolder("x").empty());
    const Environment unwritable("HOME", "/proc/nowhere");
    EXPECT_TRUE(cacheFolder("x").empty());
}

TEST_F(CacheFolder, ADamagedCacheIsReplaced) {
    const Environment xdg("XDG_CACHE_HOME", folder.c_str());
    std::string error;
    ASSERT_TRUE(Device::create({}, &error)) << error;
    const fs::path pipelines = folder / "hipr" / "pipelines";
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(pipelines))
        files.push_back(entry.path());
    ASSERT_EQ(files.size(), 1u);
    std::ofstream(files[0], std::ios::binary) << "not a cache";
    ASSERT_TRUE(Device::create({}, &error)) << error;
    std::ifstream in(files[0], std::ios::binary);
    EXPECT_NE(unpackCache(std::string(std::istreambuf_iterator<char>(in), {})), "");
}

TEST_F(CacheFolder, IsClearedOnDemand) {
    const Environment xdg("XDG_CACHE_HOME", folder.c_str());
    std::string error;
    ASSERT_TRUE(Device::create({}, &error)) << error;
    EXPECT_FALSE(fs::is_empty(cacheFolder("pipelines")));
    std::ofstream(folder / "hipr" / "other") << "of somebody else";
    EXPECT_TRUE(clearKernelCaches());
    EXPECT_TRUE(fs::is_empty(cacheFolder("pipelines")));
    EXPECT_TRUE(fs::exists(folder / "hipr" / "other"));
    EXPECT_TRUE(Device::create({}, &error)) << error;
}

TEST_F(CacheFolder, NoCacheFolderIsNoProblem) {
    const Environment xdg("XDG_CACHE_HOME", "/proc/nowhere");
    std::string error;
    EXPECT_TRUE(Device::create({}, &error)) << error;
}

} // namespace
} // namespace hipr::test
