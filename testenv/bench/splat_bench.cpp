#include "testenv/bench/splat_bench.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numeric>
#include <ostream>
#include <random>
#include <sstream>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/scene/camera.h"

namespace hipr::bench {
namespace {

/// The view of `frame`: each a little further around, so that no frame is like the one before.
SplatView viewOf(glm::uvec2 size, int frame) {
    CameraDesc camera;
    const double angle = 1e-4 * frame;
    const glm::dvec3 eye(2.6 * std::sin(angle), 1.1, 2.6 * std::cos(angle));
    camera.worldToView = glm::lookAt(eye, glm::dvec3(0, 0.5, 0), glm::dvec3(0, 1, 0));
    camera.projection = glm::perspective(glm::radians(60.0), double(size.x) / size.y, 0.01, 1000.0);
    SplatView view;
    view.camera = *cameraRecord(camera);
    view.width = size.x;
    view.height = size.y;
    return view;
}

glm::mat4x3 placement(bool capture) {
    return capture ? glm::mat4x3(glm::scale(glm::mat4(1.f), glm::vec3(1, -1, -1))) : glm::mat4x3(1.f);
}

void benchModes(Device& device, const SplatInstance& instance, const std::string& name, glm::uvec2 size,
                const SplatBenchOptions& options, SplatReport& report) {
    SplatPass pass(device, options.pass);
    pass.setInstances({instance});
    std::vector<std::vector<double>> clock(options.modes.size()), processor(options.modes.size());
    int frame = 0;
    for (int i = -1; i < options.repetitions; ++i) // the first round compiles kernels and makes lists grow
        for (size_t m = 0; m < options.modes.size(); ++m) {
            pass.setMode(options.modes[m]);
            pass.setView(viewOf(size, frame++));
            const Timing time = timed([&] { pass.render(); });
            if (i < 0) continue;
            clock[m].push_back(1e3 * time.clock);
            processor[m].push_back(1e3 * time.processor);
        }
    pass.setProfiling(true);
    for (size_t m = 0; m < options.modes.size(); ++m) {
        pass.setMode(options.modes[m]);
        for (int i = 0; i < 2; ++i) { // the first compiles what counts blends
            pass.setView(viewOf(size, frame++));
            pass.render();
        }
        report.frames.push_back(
            {name, size, options.modes[m], pass.statistics(), spread(clock[m]), spread(processor[m])});
    }
}

/// Every tenth splat of a cloud.
SplatCloud tenthOf(const SplatCloud& cloud) {
    SplatCloud part;
    part.shDegree = cloud.shDegree;
    const size_t each = shCoefficients(cloud.shDegree);
    for (size_t i = 0; i < cloud.size(); i += 10) {
        part.positions.push_back(cloud.positions[i]);
        part.orientations.push_back(cloud.orientations[i]);
        part.scales.push_back(cloud.scales[i]);
        part.opacities.push_back(cloud.opacities[i]);
        part.coefficients.insert(part.coefficients.end(), cloud.coefficients.begin() + long(i * each),
                                 cloud.coefficients.begin() + long((i + 1) * each));
    }
    return part;
}

/// A second, smaller instance in front moves: of a tenth of the splats, covering about a tenth of the
/// picture.
void benchEdit(Device& device, const SplatCloud& cloud, const SplatInstance& instance,
               const std::string& name, glm::uvec2 size, const SplatBenchOptions& options,
               SplatReport& report) {
    SplatPass pass(device, options.pass);
    SplatInstance small = instance;
    small.store = std::make_shared<SplatStore>(device, tenthOf(cloud));
    const glm::mat4 smaller =
        glm::scale(glm::translate(glm::mat4(1.f), glm::vec3(0.4f, 0.6f, 0.8f)), glm::vec3(0.5f));
    small.objectToWorld = glm::mat4x3(smaller * glm::mat4(instance.objectToWorld));
    SplatEditRow row{name, size, 0, {}, {}};
    std::vector<double> whole, edit;
    for (int i = -1; i < options.repetitions; ++i) {
        pass.setView(viewOf(size, i));
        pass.setInstances({instance, small});
        const Timing first = timed([&] { pass.render(); });
        small.objectToWorld[3].x += 0.01f;
        pass.setInstances({instance, small});
        const Timing second = timed([&] { pass.render(); });
        if (i < 0) continue;
        whole.push_back(1e3 * first.processor);
        edit.push_back(1e3 * second.processor);
        const auto& drawn = pass.drawnTiles();
        row.drawnShare =
            double(std::accumulate(drawn.begin(), drawn.end(), size_t(0))) / double(drawn.size());
    }
    row.whole = spread(whole);
    row.edit = spread(edit);
    report.edits.push_back(row);
}

std::string text(double value, int digits) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(digits) << value;
    return out.str();
}

} // namespace

SplatCloud madeUpCloud(size_t count) {
    std::mt19937 random(1);
    const auto uniform = [&](float lo, float hi) {
        return lo + (hi - lo) * float(random() >> 8) / float(1 << 24);
    };
    const auto box = [&](glm::vec3 lo, glm::vec3 hi) {
        return glm::vec3(uniform(lo.x, hi.x), uniform(lo.y, hi.y), uniform(lo.z, hi.z));
    };
    SplatCloud cloud;
    cloud.name = "made up, " + std::to_string(count);
    cloud.shDegree = 1;
    // Scales shrink as on surfaces, which are what captures are made of.
    const float scale = 1.2f / std::sqrt(float(count));
    for (size_t i = 0; i < count; ++i) {
        glm::vec3 p = box({-2, -1, -2}, {2, 2, 2});
        const int wall = int(random() % 3); // onto the floor, the back or the left
        p[wall] = wall == 0 ? -2.f : wall == 1 ? -1.f : -2.f;
        if (i % 4 == 0) p = box({-0.8f, -0.5f, -0.8f}, {0.8f, 1.f, 0.8f});
        cloud.positions.push_back(p);
        cloud.orientations.push_back(
            glm::normalize(glm::quat(uniform(0.1f, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))));
        cloud.scales.push_back(scale * glm::exp(box(glm::vec3(-1.5f), glm::vec3(1.5f))));
        cloud.opacities.push_back(uniform(0.02f, 1.f));
        cloud.coefficients.push_back(box(glm::vec3(-1.5f), glm::vec3(1.5f)));
        for (int k = 0; k < 3; ++k)
            cloud.coefficients.push_back(box(glm::vec3(-0.3f), glm::vec3(0.3f)));
    }
    return cloud;
}

void benchSplats(Device& device, const SplatCloud& cloud, bool capture, const SplatBenchOptions& options,
                 SplatReport& report) {
    SplatInstance instance;
    instance.store = std::make_shared<SplatStore>(device, cloud);
    instance.objectToWorld = placement(capture);
    for (const glm::uvec2 size : options.sizes) {
        benchModes(device, instance, cloud.name, size, options, report);
        benchEdit(device, cloud, instance, cloud.name, size, options, report);
    }
}

void printSplatTables(std::ostream& out, const SplatReport& report) {
    const auto size = [](glm::uvec2 s) { return std::to_string(s.x) + " x " + std::to_string(s.y); };
    out << "\n| cloud | size | mode | visible | pairs | longest list | sorted MB | blends tried M | done M | "
           "frame ms, "
           "processor | frame ms, clock | stages, processor ms "
           "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const SplatRow& r : report.frames) {
        const SplatStatistics& s = r.statistics;
        out << "| " << r.cloud << " | " << size(r.size) << " | " << splatModeName(r.mode) << " | "
            << s.visible << " | " << s.pairs << " | " << s.largestList << " | "
            << text(double(s.sortBytes) / 1e6, 1) << " | " << text(double(s.blendsTried) / 1e6, 1) << " | "
            << text(double(s.blendsDone) / 1e6, 1) << " | " << text(r.processor.median, 1) << " ("
            << text(r.processor.minimum, 1) << "-" << text(r.processor.maximum, 1) << ") | "
            << text(r.clock.median, 1) << " (" << text(r.clock.minimum, 1) << "-" << text(r.clock.maximum, 1)
            << ") |";
        for (const auto& stage : s.stages)
            out << " " << stage.name << " " << text(stage.processorMs, 1);
        out << " |\n";
    }
    out << "\n| cloud | size | tiles drawn again | whole frame, processor ms | after the move | ratio |\n"
           "|---|---|---|---|---|---|\n";
    for (const SplatEditRow& r : report.edits)
        out << "| " << r.cloud << " | " << size(r.size) << " | " << text(100 * r.drawnShare, 1) << " % | "
            << text(r.whole.median, 1) << " | " << text(r.edit.median, 1) << " | "
            << text(r.edit.median / r.whole.median, 2) << " |\n";
}

} // namespace hipr::bench
