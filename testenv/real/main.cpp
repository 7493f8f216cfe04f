// Without the real scenes there is nothing to test: exit code 77 makes ctest report the suite as skipped.
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>

#include "testenv/real/assets.h"

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    const std::string folder = hipr::test::assetsFolder();
    if (!std::filesystem::is_directory(folder + "/usd-wg")) {
        std::printf("skipped: no real scenes at '%s' (set HIPR_ASSETS)\n", folder.c_str());
        return 77;
    }
    return RUN_ALL_TESTS();
}
