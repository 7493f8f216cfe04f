#include "testenv/bench/start_bench.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include <sys/resource.h>

#include "testenv/bench/frame_bench.h"

namespace hipr::bench {

namespace {

namespace fs = std::filesystem;

struct Start {
    double seconds, peakMiB;
};

/// Runs one child whose caches live below `caches`.
Start start(const std::string& program, uint32_t triangles, const fs::path& caches) {
    const std::string command = "env -u MESA_SHADER_CACHE_DIR XDG_CACHE_HOME='" + caches.string() + "' '" +
                                program + "' first-pixel " + std::to_string(triangles);
    FILE* pipe = popen(command.c_str(), "r");
    Start s{};
    const bool read = pipe && std::fscanf(pipe, "%lf %lf", &s.seconds, &s.peakMiB) == 2;
    if (!pipe || pclose(pipe) != 0 || !read) throw std::runtime_error("failed: " + command);
    return s;
}

} // namespace

StartReport benchStart(const std::string& program, uint32_t triangles, int repetitions) {
    std::string pattern = (fs::temp_directory_path() / "hipr-bench-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot create a folder in " + pattern);
    const fs::path folder = pattern;
    std::vector<double> cold, warm;
    StartReport report;
    for (int i = 0; i < repetitions; ++i) {
        std::cerr << "timing starts, " << i + 1 << " of " << repetitions << "\n";
        const fs::path caches = folder / std::to_string(i);
        cold.push_back(start(program, triangles, caches).seconds);
        const Start second = start(program, triangles, caches);
        warm.push_back(second.seconds);
        report.peakMiB = std::max(report.peakMiB, second.peakMiB);
    }
    fs::remove_all(folder);
    report.coldSeconds = spread(cold);
    report.warmSeconds = spread(warm);
    return report;
}

int firstPixel(uint32_t triangles) {
    constexpr uint32_t Width = 480, Height = 270;
    const Timing time = timed([&] {
        std::string error;
        const auto renderer = Renderer::create({}, &error);
        if (!renderer) throw std::runtime_error(error);
        FilmDesc film;
        film.width = Width;
        film.height = Height;
        renderer->setFilm(film);
        SceneEdit edit;
        fillRoom(*renderer, edit, triangles, double(Width) / Height);
        renderer->commit(edit);
        while (renderer->progress().pathsTraced == 0)
            if (!renderer->renderBatch()) throw std::runtime_error("nothing was rendered");
    });
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::cout << time.clock << " " << double(usage.ru_maxrss) / 1024 << "\n"; // kibibytes on Linux
    return 0;
}

} // namespace hipr::bench
