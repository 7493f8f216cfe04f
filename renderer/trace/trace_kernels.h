/// @file trace_kernels.h
/// The wavefront kernels by name.
#pragma once

#include <vector>

#include "renderer/vulkan/background_kernels.h"

namespace hipr {

/// Those that are the same for all scenes, in the order in which they compile, the longest first.
enum class KernelId { Raygen, Resolve, Shadow, VisibilityRays, Prepare, Scout };

/// The sources of all of them, indexed by KernelId.
std::vector<KernelSource> traceKernelSources();

/// Those that evaluate materials.
enum class ShadingKernelId { Shade, Visibility, Transmit, Emission };
/// Their sources for scenes with `features` of gpu::SCENE_SHADING_FEATURES; `emission` only with
/// SCENE_HAS_MESH_LIGHTS.
std::vector<KernelSource> shadingKernelSources(uint32_t features);

/// Those that only films with such AOVs need, in the same way.
enum class FilmKernelId { Cryptomatte, LightPaths };
std::vector<KernelSource> filmKernelSources();

/// Those that only scenes with volumes need, in the same way.
enum class VolumeKernelId { Flight, Shadow };
std::vector<KernelSource> volumeKernelSources();

} // namespace hipr
