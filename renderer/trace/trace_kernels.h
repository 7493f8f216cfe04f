/// @file trace_kernels.h
/// The wavefront kernels by name.
#pragma once

#include <vector>

#include "renderer/vulkan/background_kernels.h"

namespace hipr {

/// In the order in which they compile, the longest first.
enum class KernelId { Shade, Visibility, Transmit, Raygen, Resolve, Shadow, VisibilityRays, Prepare, Scout };

/// The sources of all of them, indexed by KernelId.
std::vector<KernelSource> traceKernelSources();
/// The kernel that only scenes with SCENE_HAS_MESH_LIGHTS need.
std::vector<KernelSource> emissionKernelSource();

/// Those that only scenes with volumes need, in the same way.
enum class VolumeKernelId { Flight, Shadow };
std::vector<KernelSource> volumeKernelSources();

} // namespace hipr
