/// @file bvh_geometry.h
/// Trees of the GLSL traversal: built on the host, kept in device memory.
#pragma once

#include <vector>

#include "renderer/accel/bvh_builder.h"
#include "renderer/accel/instance_table.h"
#include "renderer/accel/traversal.h"

namespace hipr {

/// A geometry's tree: nodes, then triangles or segments, those of the next key behind those of one, in one
/// buffer.
class BvhGeometry {
public:
    void setView(const GeometryView& view);
    bool changed() const { return _changed; }
    SlotShape shape() const { return {_bounds, _view.keys, _triangleCount, _view.segments != nullptr}; }

    /// Gets the tree back when it may be refitted.
    void fetch(Device& device);
    /// Builds or refits on the host; several geometries may do so at once.
    void prepare();
    /// Sends what prepare() made.
    void send(Device& device);

    /// 0 when there are no triangles.
    VkDeviceAddress nodes() const { return _buffer.address(); }
    VkDeviceAddress triangles() const {
        return _buffer ? _buffer.address() + _nodeCount * sizeof(gpu::BvhNode) : 0;
    }

private:
    GeometryView _view{};
    Buffer _buffer;
    Bounds _bounds;
    uint64_t _nodeCount = 0;
    uint32_t _triangleCount = 0; ///< in the buffer, of each key
    float _builtCost = 0.0f;     ///< when the tree was last built
    bool _changed = false;
    bool _sameTopology = false; ///< as what is in the buffer

    // Between fetch() and send().
    Bvh _bvh;
    std::vector<gpu::BvhTriangle> _triangles;
};

} // namespace hipr
