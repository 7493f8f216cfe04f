/// @file splat_motion.h
/// Where splats and the camera are while the shutter is open, and the mean of the pictures of that time.
#pragma once

#include <optional>
#include <vector>

#include "renderer/api/scene.h"
#include "renderer/scene/world_box.h"
#include "shaders/shared/higs.h"
#include "shaders/shared/trace.h"

namespace hipr {

/// Times are those of the shutter: 0 when it opens, 1 when it closes.
class SplatMotion {
public:
    struct Placed {
        glm::mat4x3 still{1.f};
        std::vector<glm::mat4x3> keys; ///< at equal distances over the shutter; none: it stands still
        WorldBox box;                  ///< of the cloud in its own space
        bool operator==(const Placed& o) const {
            return still == o.still && keys == o.keys && box.min == o.box.min && box.max == o.box.max;
        }
    };
    /// Returns whether they are others than before.
    bool setInstances(std::vector<Placed> instances);
    /// Returns whether the camera moves otherwise than before. `camera` can be rendered.
    bool setCamera(const CameraDesc& camera, const gpu::CameraRecord& record, const Shutter& shutter);

    bool cameraMoves() const { return !_cameraKeys.empty(); }
    gpu::CameraRecord camera(float time) const;
    glm::mat4x3 placement(size_t instance, float time) const;
    /// How many moments show the motion in a picture of this size: so many that no corner of a cloud's box
    /// goes further than 2 pixels from one to the next, 32 at most; 0 when nothing moves.
    uint32_t moments(uint32_t width, uint32_t height) const;
    /// The middle of one of `count` equal parts of the shutter.
    static float timeOf(uint32_t moment, uint32_t count) { return (float(moment) + 0.5f) / float(count); }

private:
    double longestWay(glm::vec2 film) const;

    std::vector<Placed> _instances;
    CameraDesc _camera;
    gpu::CameraRecord _record{};
    std::vector<glm::mat4x3> _cameraKeys;
};

/// The mean of several pictures of splats: colour and transmittance.
class SplatMean {
public:
    void clear() { _count = 0; }
    void add(const gpu::SplatPixel* pixels, size_t count);
    /// Premultiplied colour, then transmittance. After add().
    glm::vec4 at(size_t pixel) const { return _sums[pixel] / float(_count); }

private:
    std::vector<glm::vec4> _sums;
    uint32_t _count = 0;
};

} // namespace hipr
