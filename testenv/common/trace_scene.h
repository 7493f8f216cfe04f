/// @file trace_scene.h
/// A scene behind a Traversal, and the oracle it is judged by.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "renderer/accel/traversal.h"
#include "testenv/common/ray_scenes.h"

namespace hipr::test {

/// One device for all tests of the program.
Device& device();

constexpr TraversalKind ALL_TRAVERSALS[] = {TraversalKind::Host, TraversalKind::Embree, TraversalKind::Bvh,
                                            TraversalKind::RayQuery};
std::string kindName(TraversalKind kind);

/// A mesh as the host has it; addresses are left out.
GeometryView viewOf(const TriangleMesh& mesh);

class TraceScene {
public:
    explicit TraceScene(TraversalKind kind, Device& device = test::device());
    TraceScene(TraversalKind kind, const RayScene& scene, Device& device = test::device());

    void setMesh(uint32_t slot, const TriangleMesh& mesh);
    /// Same triangles, other positions.
    void movePoints(uint32_t slot, const std::vector<glm::vec3>& positions);
    void removeMesh(uint32_t slot);
    void setInstances(const std::vector<gpu::InstanceRecord>& instances,
                      const std::vector<glm::mat4x3>& keys = {});
    void commit();

    std::vector<gpu::Hit> nearest(const std::vector<gpu::Ray>& rays, uint32_t mask = gpu::RAY_MASK_ALL);
    std::vector<uint32_t> occluded(const std::vector<gpu::Ray>& rays, uint32_t mask = gpu::RAY_MASK_ALL);
    Traversal& traversal() { return *_traversal; }
    /// Seconds the last nearest() or occluded() spent tracing, transfers not counted.
    double seconds() const { return _seconds; }

private:
    struct Slot {
        TriangleMesh mesh;
        Buffer positions, triangles, radii;
    };
    void send(uint32_t slot, bool sameTopology);
    void trace(const std::vector<gpu::Ray>& rays, uint32_t mask, bool nearest, const Buffer& results);

    Device& _device;
    std::unique_ptr<Traversal> _traversal;
    std::map<uint32_t, Slot> _slots;
    double _seconds = 0.0;
    std::vector<gpu::InstanceRecord> _instances;
    Buffer _geometryBuffer, _instanceBuffer, _keyBuffer, _scene;
};

/// The definition: the best canonical hit among all triangles and segments of all instances, one by one.
std::vector<gpu::Hit> bruteForce(const RayScene& scene, const std::vector<gpu::Ray>& rays,
                                 uint32_t mask = gpu::RAY_MASK_ALL);

struct Difference {
    uint32_t hits = 0;      ///< other instance, primitive, or hit against miss
    uint32_t distances = 0; ///< same triangle, another bit in t, u or v
    uint32_t first = ~0u;   ///< first ray that differs
};
Difference compare(const std::vector<gpu::Hit>& a, const std::vector<gpu::Hit>& b);

} // namespace hipr::test
