/// @file background_kernels.h
/// Kernels that compile in the background, so that a scene can load meanwhile.
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "renderer/vulkan/kernel.h"

namespace hipr {

/// What the constructor of Kernel takes.
struct KernelSource {
    const uint32_t* spirv = nullptr;
    size_t spirvBytes = 0;
    uint32_t pushBytes = 0;
    const char* name = "";
    bool tlas = false;
    uint32_t features = ~0u; ///< specialisation constant 0, if it has one
};

/// Makes and warms kernels on threads of its own, in the order given: put the ones that compile longest
/// first.
///
/// A CPU device compiles inside its one queue, so that a second core would idle. When a kernel is not there
/// after `patience` (Mesa's disk cache does not have it), further threads compile the next ones on devices of
/// their own; the device that needs them then finds them in that cache.
class BackgroundKernels {
public:
    BackgroundKernels(Device& device, std::vector<KernelSource> sources,
                      std::chrono::milliseconds patience = std::chrono::milliseconds(250));
    /// Waits for compilations that have begun; the others are dropped.
    ~BackgroundKernels();
    BackgroundKernels(const BackgroundKernels&) = delete;
    BackgroundKernels& operator=(const BackgroundKernels&) = delete;

    /// The kernel, once it is compiled. Throws what its compilation threw. Thread-safe.
    Kernel& get(size_t index);
    /// Whether all are compiled; waits up to `patience` for it. Throws the first failure, as soon as there is
    /// one.
    bool ready(std::chrono::milliseconds patience);
    /// Waits for all; throws the first failure.
    void wait();

private:
    struct Entry {
        KernelSource source;
        Kernel kernel;
        bool done = false;
        std::exception_ptr failure;
    };

    void buildInOrder();
    void assist();
    bool take(size_t* index);
    void build(Entry& entry, Device* scratch);
    Kernel make(Device& device, const KernelSource& source);

    Device& _device;
    const std::chrono::milliseconds _patience;
    std::vector<Entry> _entries;
    std::mutex _mutex;
    std::condition_variable _changed;
    size_t _next = 0, _doneCount = 0; ///< guarded by _mutex, like Entry::done
    std::exception_ptr _failure;      ///< the first one
    bool _stop = false;
    std::vector<std::thread> _threads;
};

} // namespace hipr
