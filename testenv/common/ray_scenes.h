/// @file ray_scenes.h
/// Meshes, placements and rays for traversal tests. Everything is a function of its seed.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include <glm/glm.hpp>

#include "shaders/shared/queue.h"
#include "shaders/shared/scene.h"

namespace hipr::test {

struct TriangleMesh {
    std::vector<glm::vec3> positions; ///< of all keys, one behind the other
    std::vector<glm::uvec3> triangles;
    std::vector<uint32_t> segments; ///< or first vertices of round segments
    std::vector<float> radii;       ///< at the vertices of segments
    uint32_t keys = 1;

    uint32_t vertexCount() const { return uint32_t(positions.size()) / keys; }
    uint32_t size() const { return uint32_t(triangles.size() + segments.size()); }
};

struct RayScene {
    std::vector<TriangleMesh> meshes;
    std::vector<gpu::InstanceRecord> instances;
    std::vector<glm::mat4x3> keys{}; ///< of moving instances
};

class Random {
public:
    explicit Random(uint32_t seed) : _engine(seed) {}
    uint32_t below(uint32_t n) { return std::uniform_int_distribution<uint32_t>(0, n - 1)(_engine); }
    float between(float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(_engine); }
    glm::vec3 point(float half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
    glm::vec3 direction();

private:
    std::mt19937 _engine;
};

/// Disconnected triangles with corners within `size` of centres in a cube of half width `half`.
TriangleMesh soup(uint32_t count, float half, float size, uint32_t seed);
/// A closed sphere with bumps: 2 * rings * rings triangles, poles included.
TriangleMesh bumpySphere(uint32_t rings, float radius);
/// Bent chains of round segments, each `length` and up to `radius` thick, that start in a cube of half width
/// `half`; some end in a point, some grow so fast that one end holds the other, and some have no length.
TriangleMesh strands(uint32_t count, float half, float length, float radius, uint32_t seed);
/// A square in an axis plane, `cells` x `cells` x 2 triangles; axis-parallel rays in its plane meet it
/// edge-on.
TriangleMesh grid(uint32_t cells, float half, int axis);

gpu::InstanceRecord placed(uint32_t geometry, const glm::dmat4& objectToWorld, uint32_t flags = 0);
/// Random rotation, translation and, when asked, non-uniform scale and mirroring.
glm::dmat4 randomPlacement(Random& random, float half, bool distorted);

/// Adds `keys` - 1 further keys, in which every vertex lies up to `size` away on each axis.
void deform(TriangleMesh& mesh, uint32_t keys, float size, uint32_t seed);
/// Gives the last instance that many random keys.
void setMoving(RayScene& scene, uint32_t keys, Random& random, float half);
/// Gives every ray a random time, the first ones the ends of the shutter.
void spreadOverTime(std::vector<gpu::Ray>& rays, uint32_t seed);

/// Has instances cull, each in another way but every fifth, and makes every second ray one of the camera.
void makeCull(RayScene& scene, std::vector<gpu::Ray>& rays);

/// Random rays around a scene of half width `half`.
std::vector<gpu::Ray> randomRays(uint32_t count, float half, uint32_t seed);
/// Rays from random points aimed at vertices, edge points and interior points of the scene's triangles, in
/// turn; of segments at vertices, at axes and around them.
std::vector<gpu::Ray> aimedRays(const RayScene& scene, uint32_t count, float half, uint32_t seed);
/// Axis-parallel rays with origins on a lattice of `steps` a side, so that they run in planes and along edges
/// of grids.
std::vector<gpu::Ray> axisRays(uint32_t count, float half, uint32_t steps, uint32_t seed);

} // namespace hipr::test
