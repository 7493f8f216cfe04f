/// @file machine.h
/// The part of a renderer that no scene leaves a trace in: the device, the kernels, the path queues.
#pragma once

#include <memory>
#include <string>

#include "renderer/higs/splat_pass.h"
#include "renderer/trace/path_tracer.h"
#include "renderer/trace/reprojection.h"
#include "renderer/vulkan/device.h"

namespace hipr {

struct Machine {
    std::string key; ///< what it was made for
    std::unique_ptr<Device> device;
    PathTracer tracer;
    std::unique_ptr<SplatPass> splats = {};          ///< once there were some
    std::unique_ptr<Reprojection> reprojection = {}; ///< once a mode needed it
};

/// Puts a machine where the next renderer finds it, while a MachineReuse lives.
struct MachineReturn {
    void operator()(Machine* machine) const;
};
using MachinePtr = std::unique_ptr<Machine, MachineReturn>;

/// `paths`: what a batch holds at least. Returns null with the reason in `error` when no device is usable.
MachinePtr makeMachine(const RendererOptions& options, uint32_t paths, std::string* error);

/// For tests that make hundreds of renderers: while one of these lives, a renderer that goes leaves its
/// machine to the next one with equal options, which is then there in a millisecond instead of half a second.
/// The messages of the device still go to the sink of the first.
class MachineReuse {
public:
    MachineReuse();
    ~MachineReuse();
    MachineReuse(const MachineReuse&) = delete;
    MachineReuse& operator=(const MachineReuse&) = delete;
};

} // namespace hipr
