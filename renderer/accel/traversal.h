/// @file traversal.h
/// Ray traversal as a replaceable stage. All implementations report the same hits: the nearest one, equal
/// distances decided by the smaller (instance, primitive), so a hit never depends on a tree's shape, its
/// history or the backend.
#pragma once

#include <memory>
#include <vector>

#include "renderer/vulkan/device.h"
#include "shaders/shared/queue.h"
#include "shaders/shared/scene.h"

namespace hipr {

enum class TraversalKind { Host, Embree, Bvh, RayQuery };

/// A geometry handed to a traversal. Host pointers stay valid until the geometry is replaced or removed.
struct GeometryView {
    const glm::vec3* positions; ///< host copy; padded by at least 4 readable bytes behind the last vertex
    uint32_t vertexCount;
    const glm::uvec3* triangles; ///< null: segments
    uint32_t triangleCount;      ///< or of segments
    VkDeviceAddress positionsAddress, trianglesAddress;
    bool sameTopology; ///< only positions differ from the geometry that was in this slot: a refit will do
    uint32_t keys = 1; ///< of `positions`, one behind the other: GeometryRecord::keys
    const uint32_t* segments =
        nullptr;                  ///< first vertices of round segments (shaders/shared/segment.h), or null
    const float* radii = nullptr; ///< at the vertices of segments, at all times
};

/// All instances, in InstanceRecord order, and the keys of those that move.
struct InstanceView {
    const std::vector<gpu::InstanceRecord>& records;
    const std::vector<glm::mat4x3>& keys; ///< see InstanceRecord::firstKey
    VkDeviceAddress keysAddress = 0;
};

/// A queue of rays. Addresses for device traversals, pointers for host ones (null unless
/// Device::hostMemory()).
struct TraceQueue {
    const Buffer* header; ///< gpu::QueueHeader
    uint64_t headerOffset;
    const Buffer* rays;    ///< gpu::Ray[]
    const Buffer* results; ///< nearest: gpu::Hit[]; occlusion: uint32_t[]
    uint32_t mask;         ///< gpu::RAY_MASK_*
};

class Traversal {
public:
    virtual ~Traversal() = default;

    /// Puts a geometry into a slot (the index of its GeometryRecord), or frees the slot when `view` is null.
    virtual void setGeometry(uint32_t slot, const GeometryView* view) = 0;
    /// Whether it knows of the times of rays. One that does not must not be given keys.
    virtual bool knowsTime() const { return true; }

    /// All instances. Geometry slots that hold nothing are skipped.
    virtual void setInstances(const InstanceView& instances) = 0;
    /// Builds what changed since the last commit (blocking). Builds of several geometries run in parallel.
    virtual void commit() = 0;

    /// For SceneRecord::bvh; 0 when the traversal needs none.
    virtual VkDeviceAddress sceneAddress() const { return 0; }

    /// Finishes compiling kernels now (blocking) instead of in their first dispatch.
    virtual void warm() const {}

    /// Host traversals run between submissions on mapped queues; device ones record into a command buffer.
    virtual bool onHost() const = 0;
    virtual void nearest(const TraceQueue& queue) = 0;
    virtual void occluded(const TraceQueue& queue) = 0;
    /// `scene` is the address of the SceneRecord; groups come from the queue header (indirect dispatch).
    virtual void recordNearest(VkCommandBuffer cmd, VkDeviceAddress scene, const TraceQueue& queue) = 0;
    virtual void recordOccluded(VkCommandBuffer cmd, VkDeviceAddress scene, const TraceQueue& queue) = 0;

    /// Host bytes that Device::memory() does not see (Embree's trees), for the memory report.
    virtual uint64_t hostBytes() const = 0;
};

/// Throws std::runtime_error when the device cannot run `kind` (Embree needs Device::hostMemory()).
std::unique_ptr<Traversal> createTraversal(TraversalKind kind, Device& device);

/// The kind that measures best for the class of device: see docs/measurements.md.
TraversalKind defaultTraversal(const Device& device);

} // namespace hipr
