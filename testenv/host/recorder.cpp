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
