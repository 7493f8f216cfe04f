// The canonical hit itself, without any tree: against double precision, and its promises to trees.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "renderer/accel/bounds.h"
#include "shaders/shared/intersect.h"
#include "testenv/common/trace_scene.h"

namespace hipr::test {
namespace {

struct DoubleHit {
    bool hit = false, front = false;
    double t = 0, margin = 0; ///< smallest barycentric weight, negative outside
    double slant = 0;         ///< |cosine| between ray and normal
};

/// Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", JGT 2(1), 1997, in double
/// precision.
DoubleHit doubleHit(const gpu::Ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 o(ray.origin), d(ray.direction), e1 = b - a, e2 = c - a, p = glm::cross(d, e2);
    const double det = glm::dot(e1, p);
    DoubleHit h;
    if (det == 0.0) return h;
    const glm::dvec3 s = o - a, q = glm::cross(s, e1);
    const double u = glm::dot(s, p) / det, v = glm::dot(d, q) / det;
    h.t = glm::dot(e2, q) / det;
    h.margin = std::min(u, std::min(v, 1.0 - u - v));
    h.hit = h.margin >= 0.0;
    h.front = det > 0.0;
    h.slant = std::abs(det) / (glm::length(glm::cross(e1, e2)) * glm::length(d));
    return h;
}

void expectLikeDouble(float scale) {
    const TriangleMesh mesh = soup(2000, scale, 0.4f * scale, 5);
    const auto rays = randomRays(2000, 1.5f * scale, 6);
    uint32_t compared = 0;
    for (uint32_t i = 0; i < rays.size(); ++i) {
        const glm::uvec3 k = mesh.triangles[i];
        const glm::vec3 &a = mesh.positions[k.x], &b = mesh.positions[k.y], &c = mesh.positions[k.z];
        gpu::Ray ray = rays[i]; // aim it roughly at the triangle, so that about half of them hit
        ray.direction = glm::normalize((a + b + c) / 3.0f + 0.15f * scale * ray.direction - ray.origin);
        const DoubleHit expected = doubleHit(ray, a, b, c);
        if (std::abs(expected.margin) < 1e-4 || expected.slant < 1e-2) continue;
        float t, u, v;
        bool front;
        const bool hit =
            gpu::intersectTriangle(gpu::triangleRay(ray.origin, ray.direction), a, b, c, t, u, v, front);
        ASSERT_EQ(hit, expected.hit) << "ray " << i;
        ++compared;
        if (!hit) continue;
        EXPECT_EQ(front, expected.front) << "ray " << i;
        EXPECT_NEAR(t, expected.t, 1e-4 * std::abs(expected.t) + 1e-5 * scale) << "ray " << i;
    }
    EXPECT_GT(compared, 1500u);
}

TEST(Definition, AgreesWithDoublePrecision) {
    for (float scale : {1e-4f, 1.0f, 1e6f})
        expectLikeDouble(scale);
}

/// Rays from inside a closed mesh never leave it, not even through vertices and edges.
TEST(Definition, IsWatertight) {
    for (float scale : {1e-4f, 1.0f, 1e6f}) {
        const RayScene scene{{bumpySphere(10, scale)}, {placed(0, glm::dmat4(1.0))}};
        for (const auto& rays :
             {aimedRays(scene, 60000, 0.3f * scale, 1), randomRays(30000, 0.3f * scale, 2)}) {
            uint32_t leaks = 0;
            for (const gpu::Hit& h : bruteForce(scene, rays))
                leaks += h.instance == gpu::NO_INDEX;
            EXPECT_EQ(leaks, 0u) << "scale " << scale;
        }
    }
}

/// Every box around a triangle's box, and every interval that holds the hit, passes the box test: the promise
/// that makes hits independent of trees.
TEST(Definition, BoxesAroundAHitAreMet) {
    Random random(3);
    uint32_t hits = 0;
    for (uint32_t i = 0; i < 200000; ++i) {
        const float size = std::pow(10.0f, random.between(-6.0f, 0.0f));
        const glm::vec3 a = random.point(1.0f), b = a + random.point(size), c = a + random.point(size);
        const glm::vec3 flat = i % 3 == 0 ? glm::vec3(1, 1, 0) : glm::vec3(1); // a third lies in axis planes
        const glm::vec3 corners[3] = {a * flat, b * flat, c * flat};
        const float s = random.between(0.0f, 1.0f);
        const glm::vec3 origin =
            random.point(3.0f) * (i % 2 ? flat : glm::vec3(1)); // some rays run in the plane
        const glm::vec3 direction = corners[0] + s * (corners[i % 2 + 1] - corners[0]) - origin;
        const gpu::BoxRay box = gpu::boxRay(origin, direction, 3.0f);
        float t, u, v, entry, exit;
        bool front;
        if (!gpu::canonicalHit(gpu::triangleRay(origin, direction), box, corners[0], corners[1], corners[2],
                               -1e30f, 1e30f, t, u, v, front))
            continue;
        ++hits;
        Bounds around;
        for (const glm::vec3& p : corners)
            around.add(p);
        around.add(corners[0] + random.point(random.between(0.0f, size)));
        gpu::boxInterval(box, around.lo, around.hi, entry, exit);
        ASSERT_LE(entry, t);
        ASSERT_LE(t, exit);
    }
    EXPECT_GT(hits, 50000u);
}

TEST(Definition, RaysThatCannotHit) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const glm::vec3 o(0.0f), z(0.0f, 0.0f, 1.0f);
    EXPECT_TRUE(gpu::traceable(o, z, 0.0f, inf));
    EXPECT_FALSE(gpu::traceable({nan, 0, 0}, z, 0.0f, inf));
    EXPECT_FALSE(gpu::traceable(o, {0, nan, 1}, 0.0f, inf));
    EXPECT_FALSE(gpu::traceable(o, {0, inf, 1}, 0.0f, inf));
    EXPECT_FALSE(gpu::traceable(o, {0, 0, 0}, 0.0f, inf));
    EXPECT_FALSE(gpu::traceable(o, z, 1.0f, 0.5f));
    EXPECT_FALSE(gpu::traceable(o, z, nan, inf));
}

} // namespace
} // namespace hipr::test
