#include "testenv/bench/splat_bench.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include <sys/resource.h>

namespace hipr::bench {

namespace {

double peakMiB() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024;
}

/// What is timed repeatedly, on the clock and in processor time, in milliseconds.
struct Times {
    std::vector<double> clock, processor;
    void add(const Timing& t) {
        clock.push_back(1e3 * t.clock);
        processor.push_back(1e3 * t.processor);
    }
};

void writePicture(const std::string& path, Device& device, const SplatPass& pass, glm::uvec2 size) {
    std::vector<gpu::SplatPixel> pixels(size_t(size.x) * size.y);
    device.download(pass.pixels(), pixels.data(), pixels.size() * sizeof(pixels[0]));
    std::ofstream out(path, std::ios::binary);
    out << "P6\n" << size.x << " " << size.y << "\n255\n";
    for (uint32_t row = size.y; row-- > 0;)
        for (uint32_t x = 0; x < size.x; ++x)
            for (int c = 0; c < 3; ++c)
                out.put(char(
                    uint8_t(glm::clamp(pixels[size_t(row) * size.x + x].color[c], 0.f, 1.f) * 255.f + 0.5f)));
    if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

std::string fileName(const SplatScene& scene, const SplatRow& row) {
    std::string name =
        scene.name + "_" + row.mode + "_" + std::to_string(row.size.x) + "x" + std::to_string(row.size.y);
    std::replace(name.begin(), name.end(), ' ', '_');
    return name + ".ppm";
}

class Bench {
public:
    Bench(Device& device, const SplatScene& scene, const SplatBenchOptions& options)
        : _device(device), _scene(scene), _options(options), _pass(device, options.pass) {}

    SplatReport run() {
        SplatReport report;
        report.scene = _scene.name;
        report.splats = _scene.cloud.size();
        report.degree = _scene.cloud.shDegree;
        report.loadSeconds = _scene.loadSeconds;
        report.storeSeconds =
            timed([&] { _store = std::make_shared<SplatStore>(_device, _scene.cloud); }).clock;
        report.storeBytes = _store->bytes();
        _pass.setInstances({{_store, _scene.objectToWorld, 1, 0}});
        for (const glm::uvec2 size : _options.sizes)
            for (SplatRow& row : rowsAt(size))
                report.rows.push_back(std::move(row));
        if (_options.move) report.moved = move(_options.sizes[0]);
        report.deviceBytes = _device.memory().total();
        report.peakMiB = peakMiB();
        return report;
    }

private:
    /// A whole frame; another view each time, since what has not changed is not drawn again.
    Timing frame(SplatMode mode, glm::uvec2 size) {
        _pass.setMode(mode);
        _pass.setView(splatView(size.x, size.y, ++_turn));
        return timed([&] { _pass.render(); });
    }

    /// The same view for all modes, so that their counts are comparable.
    SplatStatistics profile(SplatMode mode, glm::uvec2 size) {
        _pass.setProfiling(true);
        if (!_options.countOnly) frame(mode, size); // compiles what counts blends
        _pass.setMode(mode);
        _pass.setView(splatView(size.x, size.y));
        _pass.render();
        _pass.setProfiling(false);
        return _pass.statistics();
    }

    std::vector<SplatRow> rowsAt(glm::uvec2 size) {
        std::cerr << _scene.name << ", " << size.x << " x " << size.y << "\n";
        std::vector<SplatRow> rows;
        for (const SplatMode mode : _options.modes) {
            if (!_options.countOnly) frame(mode, size); // compiles, and makes buffers grow
            SplatRow row;
            row.mode = splatModeName(mode);
            row.size = size;
            row.statistics = profile(mode, size);
            if (!_options.pictures.empty())
                writePicture(_options.pictures + "/" + fileName(_scene, row), _device, _pass, size);
            rows.push_back(std::move(row));
        }
        if (!_options.countOnly) timeRows(rows, size);
        return rows;
    }

    void timeRows(std::vector<SplatRow>& rows, glm::uvec2 size) {
        std::vector<Times> times(rows.size());
        double spent = 0;
        for (int turn = 0; turn < _options.repetitions; ++turn) {
            if (turn > 0 && _options.budget > 0 && spent > _options.budget) break;
            for (size_t i = 0; i < rows.size(); ++i) {
                times[i].add(frame(_options.modes[i], size));
                spent += times[i].clock.back() / 1e3;
            }
        }
        for (size_t i = 0; i < rows.size(); ++i) {
            rows[i].frameMs = spread(times[i].clock);
            rows[i].processorMs = spread(times[i].processor);
        }
    }

    double drawnShare() const {
        const std::vector<uint32_t>& tiles = _pass.drawnTiles();
        return double(std::count_if(tiles.begin(), tiles.end(), [](uint32_t t) { return t != 0; })) /
               double(std::max<size_t>(tiles.size(), 1));
    }

    SplatMoveRow move(glm::uvec2 size) {
        const auto ball = std::make_shared<SplatStore>(_device, splatBall(_scene.cloud.size() / 10));
        const auto place = [&](float x, bool visible = true) {
            glm::mat4x3 moved(1.f);
            moved[3].x = x;
            _pass.setInstances({{_store, _scene.objectToWorld, 1, 0}, {ball, moved, 2, 0, visible}});
        };
        SplatMoveRow row;
        row.size = size;
        _pass.setMode(SplatMode::Automatic);
        row.mode = splatModeName(_pass.mode());
        place(0.f);
        frame(SplatMode::Automatic, size);
        place(0.f, false);
        _pass.render();
        row.covered = drawnShare();
        place(0.f);
        _pass.render();
        Times whole, moved;
        for (int turn = 0; turn < _options.repetitions; ++turn) {
            whole.add(frame(SplatMode::Automatic, size));
            place(turn % 2 ? 0.f : 0.01f);
            moved.add(timed([&] { _pass.render(); }));
            row.drawn = drawnShare();
        }
        row.wholeMs = spread(whole.clock);
        row.movedMs = spread(moved.clock);
        row.wholeProcessorMs = spread(whole.processor);
        row.movedProcessorMs = spread(moved.processor);
        return row;
    }

    Device& _device;
    const SplatScene& _scene;
    const SplatBenchOptions& _options;
    SplatPass _pass;
    std::shared_ptr<const SplatStore> _store;
    int _turn = 0;
};

} // namespace

SplatReport benchSplats(Device& device, const SplatScene& scene, const SplatBenchOptions& options) {
    return Bench(device, scene, options).run();
}

} // namespace hipr::bench
