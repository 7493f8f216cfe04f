#include "renderer/trace/steps.h"

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
        std::fprintf(stderr, "profile: %-16s %8llu calls %10.1f ms %10.1f ms of processors\n", name.c_str(),
                     static_cast<unsigned long long>(row.calls), 1e3 * row.seconds, 1e3 * row.cpuSeconds);
}

void Profile::add(const char* step, double seconds, double cpuSeconds) {
    Row& row = _rows[step];
    ++row.calls;
    row.seconds += seconds;
    row.cpuSeconds += cpuSeconds;
}

void Steps::run(const char* name, Record record) {
    _pending.push_back(std::move(record));
    if (_profile.enabled()) _profile.measure(name, [this] { flush(); });
}

void Steps::nearest(const char* name, const TraceQueue& queue) {
    if (!onHost())
        return run(name,
                   [this, queue](VkCommandBuffer cmd) { _traversal.recordNearest(cmd, _scene, queue); });
    flush();
    _profile.measure(name, [&] { _traversal.nearest(queue); });
}

void Steps::occluded(const char* name, const TraceQueue& queue) {
    if (!onHost())
        return run(name,
                   [this, queue](VkCommandBuffer cmd) { _traversal.recordOccluded(cmd, _scene, queue); });
    flush();
    _profile.measure(name, [&] { _traversal.occluded(queue); });
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
