// The definition of a hit of a round segment, without any tree: against distances in double precision.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/accel/bounds.h"
#include "shaders/shared/segment.h"
#include "testenv/common/trace_scene.h"

namespace hipr::test {
namespace {

struct Segment {
    glm::vec3 a, b;
    float radiusA, radiusB;
};

/// How far a point is from the segment, negative inside: the least distance from any of its spheres.
double distanceTo(const Segment& s, const glm::dvec3& p) {
    const glm::dvec3 a(s.a), along = glm::dvec3(s.b) - a, from = p - a;
    const double length = glm::length(along), first = s.radiusA, last = s.radiusB;
    const auto ofSphere = [&](double share) {
        return glm::length(from - share * along) - (first + share * (last - first));
    };
    const double slope = length > 0.0 ? (first - last) / length : 2.0;
    if (std::abs(slope) >= 1.0) return std::min(ofSphere(0.0), ofSphere(1.0));
    const double height = glm::dot(from, along) / length;
    const double away = std::sqrt(std::max(glm::dot(from, from) - height * height, 0.0));
    const double nearest = (height - away * slope / std::sqrt(1.0 - slope * slope)) / length;
    return ofSphere(glm::clamp(nearest, 0.0, 1.0));
}

/// The least distance from the segment along a ray, and where: it has one, since a segment is convex.
double closest(const Segment& s, const glm::dvec3& o, const glm::dvec3& d, double lo, double hi, double& at) {
    for (int i = 0; i < 140; ++i) {
        const double x = lo + (hi - lo) / 3.0, y = hi - (hi - lo) / 3.0;
        (distanceTo(s, o + x * d) < distanceTo(s, o + y * d) ? hi : lo) =
            distanceTo(s, o + x * d) < distanceTo(s, o + y * d) ? y : x;
    }
    at = 0.5 * (lo + hi);
    return distanceTo(s, o + at * d);
}

Segment randomSegment(Random& random, float size) {
    Segment s;
    const float thickness = std::pow(10.0f, random.between(-4.0f, 0.5f));
    s.a = random.point(size);
    s.b = s.a + size * random.direction();
    s.radiusA = size * thickness * random.between(0.0f, 1.0f);
    s.radiusB = random.below(3) ? s.radiusA * random.between(0.9f, 1.1f)
                                : size * thickness * random.between(0.0f, 1.0f);
    if (random.below(20) == 0) s.b = s.a;
    if (random.below(20) == 0) s.radiusB = s.radiusA + 1.5f * size; // one end holds the other
    return s;
}

/// A ray towards a place in or next to a segment, from `away` sizes of it.
gpu::Ray rayTowards(Random& random, const Segment& s, float size, float away) {
    const float share = random.between(-0.1f, 1.1f);
    const glm::vec3 on = s.a + share * (s.b - s.a);
    const glm::vec3 target = on + 1.3f * glm::mix(s.radiusA, s.radiusB, share) * random.direction();
    gpu::Ray ray{target + away * size * random.direction(), 0.0f, glm::vec3(0.0f), 1e30f, 0.0f, 0u};
    if (random.below(10) == 0 && s.a != s.b) // along the axis
        ray.origin = target + away * size * glm::normalize(s.b - s.a) * (random.below(2) ? 1.0f : -1.0f);
    ray.direction = glm::normalize(target - ray.origin);
    return ray;
}

/// Compares with the oracle; `tolerance` in units of rounding of the largest coordinate involved.
void expectLikeDouble(float size, float away) {
    Random random(uint32_t(away) + 7);
    uint32_t hits = 0, misses = 0;
    for (uint32_t i = 0; i < 20000; ++i) {
        const Segment s = randomSegment(random, size);
        gpu::Ray ray = rayTowards(random, s, size, away);
        const double error = 8.0 * 1.2e-7 * double(gpu::largest(ray.origin) + 3.0f * size);
        if (i % 3 == 0) ray.direction *= random.between(0.1f, 10.0f); // as in stretched instances
        float t, u, v;
        const bool hit = gpu::intersectSegment(gpu::segmentRay(ray.origin, ray.direction), s.a, s.b,
                                               s.radiusA, s.radiusB, t, u, v);
        const glm::dvec3 o(ray.origin), d = glm::normalize(glm::dvec3(ray.direction));
        const double reach = double(away + 10.0f) * size;
        double middle;
        const double least = closest(s, o, d, -reach, 2.0 * reach, middle);
        if (std::abs(least) < error) continue; // grazes
        ASSERT_EQ(hit, least < 0.0) << "segment " << i << ", by " << least;
        ++(hit ? hits : misses);
        if (!hit) continue;
        const double found = double(t) * double(glm::length(ray.direction));
        EXPECT_LT(std::abs(distanceTo(s, o + found * d)), error) << "segment " << i;
        EXPECT_LT(found, middle + error) << "segment " << i; // the way in, not the way out
        const gpu::SegmentPoint point = gpu::segmentPoint(s.a, s.b, s.radiusA, s.radiusB, u, v);
        EXPECT_LT(std::abs(distanceTo(s, glm::dvec3(point.position))), error) << "segment " << i;
        const glm::dvec3 off =
            glm::dvec3(point.position) - o; // from the ray; poles of the ends are the hardest
        EXPECT_LT(glm::length(off - glm::dot(off, d) * d),
                  4.0 * error + (u < 0.0f || u > 1.0f ? 1e-3 : 1e-6) * std::max(s.radiusA, s.radiusB))
            << "segment " << i;
        const double outside =
            distanceTo(s, glm::dvec3(point.position) + 1e-2 * size * glm::dvec3(point.normal));
        EXPECT_NEAR(outside, 1e-2 * size, 1e-4 * size + error) << "segment " << i;
        EXPECT_TRUE(u >= -2.0f && u <= 3.0f && v >= 0.0f && v <= 1.0f);
    }
    EXPECT_GT(hits, 5000u);
    EXPECT_GT(misses, 1000u);
}

TEST(Segment, AgreesWithDoublePrecision) {
    for (const float size : {1e-4f, 1.0f, 1e5f})
        for (const float away : {3.0f, 1000.0f})
            expectLikeDouble(size, away);
}

/// Whatever aims at a place inside of a chain meets it at or before that place: there are no holes at joints.
TEST(Segment, ChainsHaveNoHoles) {
    Random random(4);
    for (const float radius : {0.2f, 1e-2f, 1e-4f}) {
        TriangleMesh chain;
        glm::vec3 at(0.0f), way(1.0f, 0.0f, 0.0f);
        for (uint32_t i = 0; i < 60; ++i) {
            chain.positions.push_back(at);
            chain.radii.push_back(radius * random.between(0.8f, 1.2f));
            if (i < 59) chain.segments.push_back(i);
            way = glm::normalize(way + 0.8f * random.direction());
            at += 0.2f * way;
        }
        const RayScene scene{{chain}, {placed(0, glm::dmat4(1.0))}};
        std::vector<gpu::Ray> rays;
        for (uint32_t i = 0; i < 20000; ++i) {
            const uint32_t k = random.below(59);
            const float share = i % 2 ? random.between(0.0f, 1.0f) : 0.0f; // every other one at a joint
            const glm::vec3 on = glm::mix(chain.positions[k], chain.positions[k + 1], share);
            const float inside = 0.9f * glm::mix(chain.radii[k], chain.radii[k + 1], share);
            const glm::vec3 target = on + inside * random.between(0.0f, 1.0f) * random.direction();
            const glm::vec3 origin = target + 20.0f * random.direction();
            rays.push_back({origin, 0.0f, glm::normalize(target - origin),
                            glm::length(target - origin) + 1e-5f, 0.0f, 0u});
        }
        uint32_t holes = 0;
        for (const gpu::Hit& hit : bruteForce(scene, rays))
            holes += hit.instance == gpu::NO_INDEX;
        EXPECT_EQ(holes, 0u) << "radius " << radius;
    }
}

/// Every box around a segment's box, and every interval that holds the hit, passes the box test; and boxes
/// take nothing away: a hit within them is a hit of the segment alone, at its distance but for the allowance.
TEST(Segment, BoxesAroundAHitAreMet) {
    Random random(3);
    uint32_t hits = 0, alone = 0;
    for (uint32_t i = 0; i < 100000; ++i) {
        const float size = std::pow(10.0f, random.between(-3.0f, 0.0f));
        Segment s = randomSegment(random, size);
        if (i % 3 == 0) s.b = s.a + glm::vec3(0.0f, size, 0.0f); // along an axis
        const gpu::Ray ray = rayTowards(random, s, size, 3.0f);
        const gpu::BoxRay box = gpu::boxRay(ray.origin, ray.direction, 8.0f);
        const gpu::SegmentRay segmentRay = gpu::segmentRay(ray.origin, ray.direction);
        float t, u, v, entry, exit, unboxed;
        alone += gpu::intersectSegment(segmentRay, s.a, s.b, s.radiusA, s.radiusB, unboxed, u, v);
        if (!gpu::canonicalSegmentHit(segmentRay, box, s.a, s.b, s.radiusA, s.radiusB, -1e30f, 1e30f, t, u,
                                      v))
            continue;
        ++hits;
        EXPECT_EQ(t, unboxed) << i;
        Bounds around{gpu::segmentLo(s.a, s.b, s.radiusA, s.radiusB),
                      gpu::segmentHi(s.a, s.b, s.radiusA, s.radiusB)};
        around.add(s.a + random.point(random.between(0.0f, size)));
        gpu::boxInterval(box, around.lo, around.hi, entry, exit);
        ASSERT_LE(entry, t);
        ASSERT_LE(t, exit);
    }
    EXPECT_EQ(hits, alone);
    EXPECT_GT(hits, 30000u);
}

/// Rays that start on the surface, and go away from it, do not meet their own segment again; nor do those
/// that go in.
TEST(Segment, IsNotMetFromItsSurface) {
    Random random(8);
    uint32_t again = 0, rays = 0;
    for (uint32_t i = 0; i < 50000; ++i) {
        const Segment s = randomSegment(random, 1.0f);
        const gpu::Ray ray = rayTowards(random, s, 1.0f, 5.0f);
        float t, u, v;
        if (!gpu::intersectSegment(gpu::segmentRay(ray.origin, ray.direction), s.a, s.b, s.radiusA, s.radiusB,
                                   t, u, v))
            continue;
        const gpu::SegmentPoint point = gpu::segmentPoint(s.a, s.b, s.radiusA, s.radiusB, u, v);
        glm::vec3 direction = random.direction();
        const float side = glm::dot(direction, point.normal);
        if (std::abs(side) < 0.05f) continue; // grazing rays are a matter of the step below
        const glm::vec3 from =
            point.position + (side > 0.0f ? 3e-5f : -3e-5f) * point.normal; // as offsetOrigin()
        ++rays;
        again += gpu::intersectSegment(gpu::segmentRay(from, direction), s.a, s.b, s.radiusA, s.radiusB, t, u,
                                       v) &&
                 t > 0.0f;
    }
    EXPECT_GT(rays, 10000u);
    EXPECT_EQ(again, 0u);
}

} // namespace
} // namespace hipr::test
