// Edits without end in one process: memory stays flat, Vulkan's validation has nothing to say, and the last
// picture is a fresh one's.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <unistd.h>

#include "testenv/edit/random_edits.h"
#include "testenv/edit/viewer.h"

namespace hipr::test {
namespace {

double residentMiB() {
    long pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return double(resident) * double(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

struct Options {
    int edits = 10000;
    unsigned seed = 1;
    bool running = false, verbose = false;
};

/// Every so many edits the scene starts over, or nothing would be left of it.
constexpr int editsBetweenResets = 25;

void report(const Viewer& viewer, int edits, double seconds) {
    std::printf("%6d edits, %7.1f s, resident %.1f MiB;", edits, seconds, residentMiB());
    for (const auto& [key, value] : viewer.stats())
        if (key.rfind("hipr:memory:", 0) == 0)
            std::printf(" %s %.2f", key.c_str() + 12, double(value.Get<uint64_t>()) / (1024.0 * 1024.0));
    std::printf("\n");
    std::fflush(stdout);
}

int soak(const Options& options) {
    Scene scene;
    Viewer viewer;
    RandomEdits edits(options.seed);
    const auto start = std::chrono::steady_clock::now();
    int nextReport = 100;
    for (int i = 1; i <= options.edits; ++i) {
        if (i % editsBetweenResets == 0) {
            scene.reset();
            scene.swapStage(); // what UsdImaging missed shall not add up
        } else {
            edits.applyOne(scene);
        }
        if (options.verbose) std::fprintf(stderr, "%d %s\n", i, edits.last().c_str());
        viewer.tick(scene.stage(), scene.view);
        if (!options.running) viewer.picture();
        if (i != nextReport && i != options.edits) continue;
        nextReport = i < 1000 ? (i < 500 ? 500 : 1000) : i + 1000;
        viewer.picture();
        report(viewer, i, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    const std::string difference = viewer.picture().differenceTo(freshPicture(scene));
    std::printf("last picture: %s\n", difference.empty() ? "equals fresh" : difference.c_str());
    return difference.empty() ? 0 : 1;
}

} // namespace
} // namespace hipr::test

int main(int argc, char** argv) {
    hipr::test::Options options;
    CLI::App app("Random edits of one scene in one process");
    app.add_option("--edits", options.edits, "how many");
    app.add_option("--seed", options.seed, "another seed, other edits");
    app.add_flag("--running", options.running, "edit while the render thread is at work");
    app.add_flag("--verbose", options.verbose, "name every edit");
    CLI11_PARSE(app, argc, argv);
    return hipr::test::soak(options);
}
