// hipr-bench-splats: measures the splat pass. See docs/measurements.md.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <thread>

#include <CLI/CLI.hpp>

#include "renderer/splats/splat_file.h"
#include "testenv/bench/splat_bench.h"

namespace {

using namespace hipr;
using namespace hipr::bench;

constexpr SplatMode Modes[] = {SplatMode::Flat16Aabb, SplatMode::Flat16Exact, SplatMode::Flat8Exact,
                               SplatMode::Higs8, SplatMode::Higs8Carry};

struct Options {
    std::vector<std::string> files;
    std::vector<size_t> synthetic = {500000, 2000000, 6000000};
    std::vector<std::string> sizes = {"1280x720", "1920x1080", "3840x2160"}, syntheticSizes = {"1280x720"},
                             modes;
    std::string saveFolder, jsonFile;
    bool workgroups = false, noCaptures = false;
    SplatBenchOptions bench;
};

std::vector<SplatMode> parseModes(const std::vector<std::string>& names) {
    std::vector<SplatMode> modes;
    for (const SplatMode mode : Modes)
        if (names.empty() || std::find(names.begin(), names.end(), splatModeName(mode)) != names.end())
            modes.push_back(mode);
    return modes;
}

std::vector<std::string> modeNames() {
    std::vector<std::string> names;
    for (const SplatMode mode : Modes)
        names.emplace_back(splatModeName(mode));
    return names;
}

glm::uvec2 parseSize(const std::string& text) {
    glm::uvec2 size(0);
    char rest = 0;
    if (std::sscanf(text.c_str(), "%ux%u%c", &size.x, &size.y, &rest) != 2 || size.x == 0 || size.y == 0 ||
        std::max(size.x, size.y) > 16384)
        throw std::runtime_error("'" + text + "' is no size such as 1280x720");
    return size;
}

/// The capture that lies beside the checkout, if it does.
std::vector<std::string> sharedCapture() {
    const char* folder = std::getenv("HIPR_ASSETS");
    const std::string file =
        std::string(folder ? folder : HIPR_ASSETS) + "/splats/playbot/playbot_125k_sh2.ply";
    if (std::filesystem::exists(file)) return {file};
    std::cerr << "hipr-bench-splats: " << file << " is not there and left out\n";
    return {};
}

void save(const SplatCloud& cloud, std::string name, const std::string& folder) {
    std::replace(name.begin(), name.end(), ' ', '_');
    const std::string path = folder + "/" + name + ".ply";
    std::ofstream out(path, std::ios::binary);
    writePly(cloud, out);
    if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

std::vector<glm::uvec2> parseSizes(const std::vector<std::string>& texts) {
    std::vector<glm::uvec2> sizes;
    for (const std::string& text : texts)
        sizes.push_back(parseSize(text));
    return sizes;
}

/// What is measured on: scenes one after the other, so that only one is in memory.
template <class Measure> void eachScene(const Options& o, const Measure& measure) {
    if (!o.noCaptures)
        for (const std::string& file : o.files.empty() ? sharedCapture() : o.files)
            measure(capturedSplats(file), parseSizes(o.sizes));
    for (const size_t count : o.synthetic) {
        if (count == 0) continue;
        const SplatScene scene = syntheticSplats(count);
        if (!o.saveFolder.empty()) save(scene.cloud, scene.name, o.saveFolder);
        measure(scene, parseSizes(o.syntheticSizes));
    }
}

int run(Options o) {
    parseSizes(o.syntheticSizes); // complains early
    o.bench.modes = parseModes(o.modes);
    if (o.workgroups) o.bench.pass.kernels = SplatKernels::Workgroups;
    std::string error;
    const std::unique_ptr<Device> device = Device::create({}, &error);
    if (!device) throw std::runtime_error(error);
    double load = 0;
    getloadavg(&load, 1);
    std::cout << device->info().name << ", " << device->info().driver << ", "
              << std::thread::hardware_concurrency() << " threads, load before " << load
              << "; median (least-most) of up to " << o.bench.repetitions << "\n";
    nlohmann::json scenes = nlohmann::json::array();
    eachScene(o, [&](const SplatScene& scene, std::vector<glm::uvec2> sizes) {
        o.bench.sizes = std::move(sizes);
        const SplatReport report = benchSplats(*device, scene, o.bench);
        printSplats(std::cout, report);
        scenes.push_back(toJson(report));
    });
    if (o.jsonFile.empty()) return 0;
    std::ofstream file(o.jsonFile);
    file << nlohmann::json{{"device", device->info().name}, {"load", load}, {"scenes", scenes}}.dump(2)
         << "\n";
    if (!file.flush()) throw std::runtime_error("cannot write " + o.jsonFile);
    return 0;
}

void addOptions(CLI::App& app, Options& o) {
    app.add_option("captures", o.files,
                   "Files of splats, .ply or .spz, with Y down; playbot of the shared assets if absent");
    app.add_flag("--no-captures", o.noCaptures, "Only scenes made here");
    app.add_option("--synthetic", o.synthetic, "Splats of the scenes made here; 0: none")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--sizes", o.sizes, "Of the captures' pictures")->delimiter(',')->capture_default_str();
    app.add_option("--synthetic-sizes", o.syntheticSizes, "Of the pictures of scenes made here")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--modes", o.modes, "How splats are binned and blended; all if absent")
        ->delimiter(',')
        ->check(CLI::IsMember(modeNames()));
    app.add_option("--repetitions", o.bench.repetitions, "How often each mode is timed, in turns")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000));
    app.add_option("--budget", o.bench.budget,
                   "Seconds for a scene and size: once spent, no further turn begins; 0: no limit")
        ->capture_default_str();
    app.add_flag("--half", o.bench.pass.halfRecords, "Projected splats in half precision");
    app.add_flag("--workgroups", o.workgroups, "The kernels for GPUs, on any device");
    app.add_flag("--count", o.bench.countOnly, "Count only: one frame each");
    app.add_flag("--move", o.bench.move, "Also time a prim that moves, at the first size");
    app.add_option("--pictures", o.bench.pictures,
                   "Write a .ppm of every scene, size and mode to this folder");
    app.add_option("--save", o.saveFolder, "Write the scenes made here to this folder as .ply");
    app.add_option("--json", o.jsonFile, "Also write the results here");
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app{"Measures frames of Gaussian splats in all modes, in turns"};
    Options options;
    addOptions(app, options);
    CLI11_PARSE(app, argc, argv);
    try {
        return run(options);
    } catch (const std::exception& e) {
        std::cerr << "hipr-bench-splats: " << e.what() << "\n";
        return 1;
    }
}
