#include "renderer/trace/steps.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace hipr {

Profile::Profile() {
    const char* value = std::getenv("HIPR_PROFILE");
    _enabled = value && std::strcmp(value, "1") == 0;
}

Profile::~Profile() {
    for (const auto& [name, row] : _rows)
        std::fprintf(stderr, "profile: %-16s %8llu calls %10.1f ms\n", name.c_str(),
                     static_cast<unsigned long long>(row.calls), 1e3 * row.seconds);
}

void Profile::add(const char* step, double seconds) {
    Row& row = _rows[step];
    ++row.calls;
    row.seconds += seconds;
}

template <class F> void Steps::timed(const char* name, F&& work) {
    if (!_profile.enabled()) return work();
    const auto start = std::chrono::steady_clock::now();
    work();
    _profile.add(name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

void Steps::run(const char* name, Record record) {
    _pending.push_back(std::move(record));
    if (_profile.enabled()) timed(name, [this] { flush(); });
}

void Steps::nearest(const char* name, const TraceQueue& queue) {
    if (!onHost())
        return run(name,
                   [this, queue](VkCommandBuffer cmd) { _traversal.recordNearest(cmd, _scene, queue); });
    flush();
    timed(name, [&] { _traversal.nearest(queue); });
}

void Steps::occluded(const char* name, const TraceQueue& queue) {
    if (!onHost())
        return run(name,
                   [this, queue](VkCommandBuffer cmd) { _traversal.recordOccluded(cmd, _scene, queue); });
    flush();
    timed(name, [&] { _traversal.occluded(queue); });
}

void Steps::flush() {
    if (_pending.empty()) return;
    _device.run([this](VkCommandBuffer cmd) {
        for (const Record& record : _pending) {
            record(cmd);
            computeBarrier(cmd);
        }
    });
    _pending.clear();
}

} // namespace hipr
