/// @file recorder.h
/// Fixture of the hiprrecord tests: a scratch folder, the program, the scene of flat squares.
#pragma once

#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "testenv/host/image_file.h"
#include "testenv/host/process.h"

namespace hipr::test {

/// Places of scenes/squares.usda in its picture of 4 x 4 units, and a place where nothing is.
struct Spot {
    double x, y;
};
constexpr Spot redSpot{0.25, 0.5}, greenSpot{0.75, 0.5}, blueSpot{0.5, 0.125}, emptySpot{0.05, 0.05},
    guideSpot{0.5, 0.94};

/// "red", "green", "blue", "none" for black, "mixed" for anything else.
std::string colourAt(const ImageFile& image, Spot spot);

class RecorderTest : public testing::Test {
protected:
    RecorderTest();
    ~RecorderTest() override;

    std::string scene() const;                       ///< path of scenes/squares.usda
    std::string file(const std::string& name) const; ///< path in the scratch folder
    void write(const std::string& name, const std::string& content) const;
    std::vector<std::string> files() const; ///< names in the scratch folder, sorted

    /// The command line of hiprrecord with the renderer under test and `arguments`.
    std::vector<std::string> command(std::vector<std::string> arguments) const;
    /// Records `scene()` with small defaults: 64 x 64 pixels, 4 samples.
    Outcome record(std::vector<std::string> arguments) const;
    Outcome recordStage(const std::string& stage, std::vector<std::string> arguments) const;

private:
    std::filesystem::path _folder;
};

/// The renderer under test: HiPR, or what the environment variable HIPR_TEST_RENDERER names.
std::string rendererUnderTest();

} // namespace hipr::test
