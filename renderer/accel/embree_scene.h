/// @file embree_scene.h
/// The scene as Embree holds it: one RTCScene per geometry, and a top level whose primitives are the
/// instances.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include <embree3/rtcore.h>

#include "renderer/accel/instance_table.h"
#include "renderer/accel/traversal.h"

namespace hipr {

/// A geometry slot and its tree. Buffers are shared with the view, not copied.
struct EmbreeGeometry {
    GeometryView view{};
    RTCScene scene = nullptr;
    Bounds bounds;
    bool changed = false;
};

/// Callbacks of the instance geometry; their geometryUserPtr is the EmbreeScene.
struct EmbreeCallbacks {
    RTCIntersectFunctionN intersect;
    RTCOccludedFunctionN occluded;
    RTCFilterFunctionN intersectFilter, occludedFilter; ///< of triangles; geometryUserPtr: the EmbreeGeometry
    RTCIntersectFunctionN intersectSegment;             ///< likewise
    RTCOccludedFunctionN occludedSegment;
};

class EmbreeScene {
public:
    /// Throws std::runtime_error when Embree cannot start.
    explicit EmbreeScene(const EmbreeCallbacks& callbacks);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    void setGeometry(uint32_t slot, const GeometryView* view);
    void setInstances(const InstanceView& instances);
    /// Throws std::runtime_error with Embree's words when it runs out of memory.
    void commit();

    RTCScene top() const { return _top; }
    const InstanceTable& table() const { return _table; }
    /// The geometry behind an instance with a mask.
    const EmbreeGeometry& geometryOf(uint32_t instance) const { return *_geometryOf[instance]; }
    uint64_t bytes() const { return _bytes.load(std::memory_order_relaxed); }

private:
    void buildGeometry(EmbreeGeometry& geometry);
    RTCGeometry makeTriangles(EmbreeGeometry& geometry) const;
    RTCGeometry makeSegments(EmbreeGeometry& geometry) const;
    void buildTop();
    void check(const char* doing) const;

    EmbreeCallbacks _callbacks;
    RTCDevice _device = nullptr;
    RTCScene _top = nullptr;
    RTCGeometry _instanceGeometry = nullptr;
    std::vector<std::unique_ptr<EmbreeGeometry>> _geometries; ///< by slot; null: free
    std::vector<gpu::InstanceRecord> _instances;
    std::vector<glm::mat4x3> _keys; ///< of moving instances
    InstanceTable _table;
    std::vector<const EmbreeGeometry*> _geometryOf; ///< by instance
    bool _instancesChanged = true;
    std::atomic<int64_t> _bytes{0};
};

} // namespace hipr
