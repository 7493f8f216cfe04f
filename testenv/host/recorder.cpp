#include "testenv/host/recorder.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace fs = std::filesystem;

namespace hipr::test {

std::string rendererUnderTest() {
    const char* name = std::getenv("HIPR_TEST_RENDERER");
    return name ? name : "HiPR";
}

std::string colourAt(const ImageFile& image, Spot spot) {
    const float r = image.at("R", spot.x, spot.y), g = image.at("G", spot.x, spot.y),
                b = image.at("B", spot.x, spot.y);
    const float strongest = std::max({r, g, b}), others = r + g + b - strongest;
    if (strongest < 0.01f) return "none";
    if (others > 0.1f * strongest) return "mixed";
    return strongest == r ? "red" : strongest == g ? "green" : "blue";
}

RecorderTest::RecorderTest() {
    std::string pattern = (fs::temp_directory_path() / "hiprrecord_test_XXXXXX").string();
    _folder = mkdtemp(pattern.data());
}

RecorderTest::~RecorderTest() {
    std::error_code error;
    fs::remove_all(_folder, error);
}

std::string RecorderTest::scene() const {
    return HIPR_SOURCE_DIR "/testenv/host/scenes/squares.usda";
}

std::string RecorderTest::file(const std::string& name) const {
    return (_folder / name).string();
}

void RecorderTest::write(const std::string& name, const std::string& content) const {
    std::ofstream(file(name)) << content;
}

std::vector<std::string> RecorderTest::files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(_folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::vector<std::string> RecorderTest::command(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {HIPR_RECORD_PROGRAM, "--renderer", rendererUnderTest()});
    return arguments;
}

Outcome RecorderTest::record(std::vector<std::string> arguments) const {
    return recordStage(scene(), std::move(arguments));
}

Outcome RecorderTest::recordStage(const std::string& stage, std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {stage, "--size", "64x64", "--samples", "4"});
    return run(command(arguments));
}

} // namespace hipr::test
