/// @file frame_bench.h
/// Whole pictures: samples per second and memory.
#pragma once

#include <string>
#include <vector>

#include "renderer/api/renderer.h"
#include "testenv/bench/statistics.h"

namespace hipr::bench {

struct FrameRow {
    std::string traversal;
    uint64_t triangles = 0;
    Spread msamplesPerSecond, mraysPerSecond;
    double raysPerSample = 0;
    MemoryReport memory;
};

/// A picture of the room by each traversal the device can run: 480 x 270, 8 bounces, a textureless diffuse
/// and glossy look, one rect light. The traversals take turns, `repetitions` times.
std::vector<FrameRow> benchFrames(uint32_t triangles, int repetitions);

/// Fills `edit` with the room, its look, its light and a camera for a film of that aspect (width / height).
void fillRoom(Renderer& renderer, SceneEdit& edit, uint32_t triangles, double aspect);

} // namespace hipr::bench
