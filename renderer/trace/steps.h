/// @file steps.h
/// A sequence of kernels and traversals, put into as few submissions as the traversal allows.
#pragma once

#include <chrono>
#include <ctime>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "renderer/accel/traversal.h"

namespace hipr {

/// Wall-clock and processor time of all threads (where a CPU device's kernels show too) by step name; printed
/// when destroyed. Only with HIPR_PROFILE=1 in the environment.
class Profile {
public:
    Profile();
    ~Profile();
    bool enabled() const { return _enabled; }
    /// Runs `work` and, if enabled, adds its time to `step`.
    template <class F> void measure(const char* step, F&& work) {
        if (!_enabled) return work();
        const auto start = std::chrono::steady_clock::now();
        const std::clock_t cpu = std::clock();
        work();
        add(step, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
            double(std::clock() - cpu) / CLOCKS_PER_SEC);
    }

private:
    struct Row {
        uint64_t calls = 0;
        double seconds = 0, cpuSeconds = 0;
    };
    void add(const char* step, double seconds, double cpuSeconds);
    bool _enabled;
    std::map<std::string, Row> _rows;
};

/// Device traversals are recorded between the kernels, so that everything becomes one submission. A host
/// traversal runs at once, after a submission of the kernels before it. With a profile each step is submitted
/// and timed by itself.
class Steps {
public:
    using Record = std::function<void(VkCommandBuffer)>;

    Steps(Device& device, Traversal& traversal, VkDeviceAddress scene, Profile& profile)
        : _device(device), _traversal(traversal), _scene(scene), _profile(profile) {}

    /// Whether a flush happens between traversals anyway, so that reading a queue's size costs nothing.
    bool onHost() const { return _traversal.onHost(); }

    /// Adds kernels; a barrier follows them.
    void run(const char* name, Record record);
    void nearest(const char* name, const TraceQueue& queue);
    void occluded(const char* name, const TraceQueue& queue);
    /// Submits what was added and waits.
    void flush();

private:
    Device& _device;
    Traversal& _traversal;
    VkDeviceAddress _scene;
    Profile& _profile;
    std::vector<Record> _pending;
};

} // namespace hipr
