/// @file splat_scenes.h
/// Clouds of splats to measure with, and the camera they are seen by.
#pragma once

#include <string>

#include "renderer/higs/splat_pass.h"

namespace hipr::bench {

struct SplatScene {
    std::string name; ///< "playbot_125k_sh2", "synthetic 500000"
    SplatCloud cloud;
    glm::mat4x3 objectToWorld{1.f};
    double loadSeconds = 0; ///< from a file; 0: made here
};

/// A capture from a file, turned half around z: .ply captures have Y down. Throws std::runtime_error.
SplatScene capturedSplats(const std::string& path);

/// About what captures look like, of any size and the same on every machine: flat splats on a floor and on
/// balls, most of them small, some nearly transparent; harmonics of degree 3. Stands where playbot stands.
SplatScene syntheticSplats(size_t count);

/// Splats in a ball, which covers about a tenth of the picture beside what the scenes show.
SplatCloud splatBall(size_t count);

/// At (0, 1.1, 2.6), looking at (0, 0.5, 0), Y up; 60 degrees from the lower to the upper edge, from 0.2 on.
/// `turn`: a few millionths of a unit aside for each, so that pictures of different turns have to be drawn
/// again.
SplatView splatView(uint32_t width, uint32_t height, int turn = 0);

} // namespace hipr::bench
