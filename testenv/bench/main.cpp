// hipr-bench: measures the renderer. `hipr-bench trace` writes what docs/measurements.md quotes.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <thread>

#include <CLI/CLI.hpp>

#include "testenv/bench/report.h"

namespace {

using namespace hipr;
using namespace hipr::bench;

Report emptyReport(int repetitions) {
    Report report;
    report.repetitions = repetitions;
    report.threads = std::thread::hardware_concurrency();
    getloadavg(&report.loadBefore, 1);
    std::string error;
    const auto renderer = Renderer::create({}, &error);
    if (!renderer) throw std::runtime_error(error);
    report.device = renderer->device().name;
    report.driver = renderer->device().driver;
    return report;
}

int trace(const std::vector<uint32_t>& sizes, int repetitions, const std::string& only,
          const std::vector<std::string>& traversals, const std::string& jsonFile) {
    Report report = emptyReport(repetitions);
    const auto wanted = [&](const char* part) { return only.empty() || only == part; };
    for (const uint32_t triangles : sizes) {
        if (wanted("rays")) report.traversals.push_back(benchTraversals(triangles, repetitions, traversals));
        if (wanted("frames"))
            for (FrameRow& row : benchFrames(triangles, repetitions))
                report.frames.push_back(std::move(row));
    }
    if (wanted("start"))
        report.start = benchStart(std::filesystem::canonical("/proc/self/exe").string(), sizes[0],
                                  std::max(1, repetitions / 2));
    printTables(std::cout, report);
    if (jsonFile.empty()) return 0;
    std::ofstream file(jsonFile);
    file << toJson(report).dump(2) << "\n";
    if (file.flush()) return 0;
    std::cerr << "hipr-bench: cannot write " << jsonFile << "\n";
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app{"Measures the renderer"};
    app.require_subcommand(1);
    std::vector<uint32_t> sizes = {20000, 1000000};
    int repetitions = 5;
    std::string jsonFile, only;
    CLI::App* traceCommand =
        app.add_subcommand("trace", "Rays and samples per second, builds, start-up, memory");
    traceCommand->add_option("--triangles", sizes, "About how many triangles the scenes have")
        ->capture_default_str();
    traceCommand->add_option("--repetitions", repetitions, "How often each pair is timed")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000));
    traceCommand->add_option("--only", only, "One part: rays, frames or start")
        ->check(CLI::IsMember({"rays", "frames", "start"}));
    std::vector<std::string> traversals;
    traceCommand
        ->add_option("--traversals", traversals,
                     "Those to time rays with: host, embree, bvh, rayquery; all if absent")
        ->delimiter(',');
    traceCommand->add_option("--json", jsonFile, "Also write the results here");
    uint32_t triangles = 20000;
    CLI::App* firstPixelCommand = app.add_subcommand(
        "first-pixel", "Prints the seconds to the first samples, and the peak memory in MiB");
    firstPixelCommand->add_option("triangles", triangles, "About how many triangles the scene has");
    CLI11_PARSE(app, argc, argv);
    try {
        return traceCommand->parsed() ? trace(sizes, repetitions, only, traversals, jsonFile)
                                      : firstPixel(triangles);
    } catch (const std::exception& e) {
        std::cerr << "hipr-bench: " << e.what() << "\n";
        return 1;
    }
}
