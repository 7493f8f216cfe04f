// hipr-bench-splats: measures the splat pass. See docs/measurements.md.
#include <cstdlib>
#include <iostream>
#include <thread>

#include <CLI/CLI.hpp>

#include "renderer/splats/splat_file.h"
#include "testenv/bench/splat_bench.h"

namespace {

using namespace hipr;
using namespace hipr::bench;

glm::uvec2 sizeOf(const std::string& text) {
    unsigned width = 0, height = 0;
    char x = 0;
    std::istringstream in(text);
    if (!(in >> width >> x >> height) || x != 'x' || !width || !height || width > 16384 || height > 16384)
        throw std::runtime_error("'" + text + "' is no size like 1280x720");
    return {width, height};
}

SplatMode modeOf(const std::string& text) {
    for (int m = int(SplatMode::Flat16Aabb); m <= int(SplatMode::Higs8Carry); ++m)
        if (text == splatModeName(SplatMode(m))) return SplatMode(m);
    throw std::runtime_error("there is no mode '" + text + "'");
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app{"Measures frames of Gaussian splats in all modes, in turns"};
    std::vector<std::string> captures,
        sizes = {"1280x720", "1920x1080", "3840x2160"},
        modes = {"flat16-aabb", "flat16-exact", "flat8-exact", "higs8", "higs8-carry"};
    std::vector<size_t> madeUp;
    SplatBenchOptions options;
    bool workgroups = false;
    app.add_option("captures", captures, "Files of splats, .ply or .spz, with y down");
    app.add_option("--made-up", madeUp, "Also clouds of so many splats, made up")->delimiter(',');
    app.add_option("--sizes", sizes, "Of the picture")->delimiter(',')->capture_default_str();
    app.add_option("--modes", modes, "Those to measure")->delimiter(',')->capture_default_str();
    app.add_option("--repetitions", options.repetitions, "Frames of each mode")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000));
    app.add_flag("--half", options.pass.halfRecords, "Projected splats in half precision");
    app.add_flag("--workgroups", workgroups, "The kernels for GPUs, on any device");
    CLI11_PARSE(app, argc, argv);
    try {
        for (const std::string& size : sizes)
            options.sizes.push_back(sizeOf(size));
        for (const std::string& mode : modes)
            options.modes.push_back(modeOf(mode));
        if (workgroups) options.pass.kernels = SplatKernels::Workgroups;
        std::string error;
        const auto device = Device::create({}, &error);
        if (!device) throw std::runtime_error(error);
        double load = 0;
        getloadavg(&load, 1);
        std::cout << device->info().name << ", " << std::thread::hardware_concurrency()
                  << " threads, load average before: " << load << "\n";
        SplatReport report;
        for (const std::string& file : captures) {
            SplatReadOptions read;
            read.name = file.substr(file.rfind('/') + 1);
            benchSplats(*device, readSplatFile(file, read), true, options, report);
        }
        for (const size_t count : madeUp)
            benchSplats(*device, madeUpCloud(count), false, options, report);
        printSplatTables(std::cout, report);
        return 0;
    } catch (const std::exception& e) {
        std::cerr << "hipr-bench-splats: " << e.what() << "\n";
        return 1;
    }
}
