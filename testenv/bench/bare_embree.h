/// @file bare_embree.h
/// Embree as one would use it without a renderer: the yardstick for rays per second.
#pragma once

#include <vector>

#include <embree3/rtcore.h>

#include "renderer/api/mesh.h"
#include "shaders/shared/scene.h"

namespace hipr::bench {

/// One flat scene of one mesh in Embree's default (fastest tracing, not robust) mode; single rays on all
/// cores.
class BareEmbree {
public:
    /// Keeps a reference to `mesh`.
    explicit BareEmbree(const TriangleMesh& mesh);
    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;
    ~BareEmbree();

    void nearest(const std::vector<gpu::Ray>& rays, std::vector<gpu::Hit>& hits) const;
    void occluded(const std::vector<gpu::Ray>& rays, std::vector<uint32_t>& blocked) const;
    double buildSeconds() const { return _buildSeconds; }

private:
    RTCDevice _device;
    RTCScene _scene;
    double _buildSeconds = 0;
};

} // namespace hipr::bench
