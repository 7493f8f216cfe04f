#include "renderer/vulkan/background_kernels.h"

#include <algorithm>
#include <cstdlib>

#include "renderer/vulkan/device.h"

namespace hipr {

namespace {

/// Each assistant holds a device and a compiler's working memory.
constexpr size_t MaxAssistants = 7;

/// Whether what one device compiles reaches another one through Mesa's disk cache.
bool sharesThroughDisk(const Device& device) {
    const char* disabled = std::getenv("MESA_SHADER_CACHE_DISABLE");
    return device.info().cpu && std::getenv("MESA_SHADER_CACHE_DIR") && !disabled;
}

std::unique_ptr<Device> scratchDevice(const Device& device) {
    try {
        RendererOptions options;
        options.device = std::to_string(device.info().index);
        options.messages = [](Severity, const std::string&, const std::string&) {}; // the main device said it
        std::string error;
        return Device::create(options, &error);
    } catch (const std::exception&) {
        return nullptr;
    }
}

} // namespace

BackgroundKernels::BackgroundKernels(Device& device, std::vector<KernelSource> sources,
                                     std::chrono::milliseconds patience)
    : _device(device), _patience(patience), _entries(sources.size()) {
    for (size_t i = 0; i < sources.size(); ++i)
        _entries[i].source = sources[i];
    if (sources.empty()) return;
    _threads.reserve(1 + MaxAssistants);
    _threads.emplace_back(&BackgroundKernels::buildInOrder, this);
    // Drivers of real devices compile in the calling thread; they can be assisted without a detour.
    if (device.info().cpu && !sharesThroughDisk(device)) return;
    // The validation layer (1.3.239) crashed in a look-up once, most likely because assistants' devices came
    // and went meanwhile.
    if (device.validation()) return;
    const size_t cores = std::max(1u, std::thread::hardware_concurrency());
    const size_t assistants = std::min({cores - 1, sources.size() - 1, MaxAssistants});
    try {
        for (size_t i = 0; i < assistants; ++i)
            _threads.emplace_back(&BackgroundKernels::assist, this);
    } catch (const std::exception&) { // the system gives no more threads: fewer will do
    }
}

BackgroundKernels::~BackgroundKernels() {
    {
        std::lock_guard lock(_mutex);
        _stop = true;
    }
    _changed.notify_all();
    for (std::thread& t : _threads)
        t.join();
}

bool BackgroundKernels::take(size_t* index) {
    std::lock_guard lock(_mutex);
    if (_stop || _next == _entries.size()) return false;
    *index = _next++;
    return true;
}

void BackgroundKernels::buildInOrder() {
    for (size_t i; take(&i);)
        build(_entries[i], nullptr);
}

void BackgroundKernels::assist() {
    for (bool progress = true; progress;) { // nothing came for a while: there is work to share
        std::unique_lock lock(_mutex);
        const size_t seen = _doneCount;
        progress = _changed.wait_for(lock, _patience, [&] { return _stop || _doneCount != seen; });
        if (_stop || _next == _entries.size()) return;
    }
    const std::unique_ptr<Device> scratch = _device.info().cpu ? scratchDevice(_device) : nullptr;
    if (_device.info().cpu && !scratch) return;
    for (size_t i; take(&i);)
        build(_entries[i], scratch.get());
}

Kernel BackgroundKernels::make(Device& device, const KernelSource& s) {
    Kernel kernel(device, s.spirv, s.spirvBytes, s.pushBytes, s.name, s.tlas, s.features);
    kernel.warm();
    return kernel;
}

void BackgroundKernels::build(Entry& entry, Device* scratch) {
    try {
        if (scratch) make(*scratch, entry.source);
        entry.kernel = make(_device, entry.source);
    } catch (...) {
        entry.failure = std::current_exception();
    }
    {
        std::lock_guard lock(_mutex);
        entry.done = true;
        ++_doneCount;
        if (!_failure) _failure = entry.failure;
    }
    _changed.notify_all();
}

Kernel& BackgroundKernels::get(size_t index) {
    Entry& entry = _entries.at(index);
    std::unique_lock lock(_mutex);
    _changed.wait(lock, [&] { return entry.done; });
    if (entry.failure) std::rethrow_exception(entry.failure);
    return entry.kernel;
}

bool BackgroundKernels::ready(std::chrono::milliseconds patience) {
    std::unique_lock lock(_mutex);
    _changed.wait_for(lock, patience, [&] { return _failure || _doneCount == _entries.size(); });
    if (_failure) std::rethrow_exception(_failure);
    return _doneCount == _entries.size();
}

void BackgroundKernels::wait() {
    while (!ready(std::chrono::hours(1))) {
    }
}

} // namespace hipr
