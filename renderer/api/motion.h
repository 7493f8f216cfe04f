/// @file motion.h
/// What moves while a picture is taken. All times are in frames from the frame that the picture is of, as a
/// camera's shutter has them; what is at other times than its samples lies between the nearest two, and before
/// the first or behind the last it stands still.
#pragma once

#include <algorithm>
#include <vector>

#include <glm/glm.hpp>

namespace hipr {

/// When light reaches the film. Closed, and nothing is blurred, unless `close` is above `open`.
struct Shutter {
    double open = 0.0, close = 0.0; ///< frames
    bool blurs() const { return close > open; }
    /// Where the frame lies between opening (0) and closing (1), or the nearer of them.
    double frame() const { return blurs() ? std::clamp(-open / (close - open), 0.0, 1.0) : 0.0; }
    bool operator==(const Shutter& o) const { return open == o.open && close == o.close; }
};

/// Places of instances over time: rotations turn evenly the shorter way, everything else goes straight.
struct InstanceMotion {
    std::vector<float> times; ///< rising; below two there is no motion
    /// By time, each list as long as InstancesDesc::transforms.
    std::vector<std::vector<glm::mat4x3>> transforms;
    bool operator==(const InstanceMotion& o) const { return times == o.times && transforms == o.transforms; }
};

/// A mesh at one time. Vertices move straight from one key to the next.
struct MeshKey {
    float time = 0.f;
    std::vector<glm::vec3> positions, normals; ///< as many as the mesh has of each
    bool operator==(const MeshKey& o) const {
        return time == o.time && positions == o.positions && normals == o.normals;
    }
};

/// A camera at one time: moves as instances do. Its lens and its angle of view stay.
struct CameraKey {
    float time = 0.f;
    glm::dmat4 worldToView{1.0};
    bool operator==(const CameraKey& o) const { return time == o.time && worldToView == o.worldToView; }
};

} // namespace hipr
