#include "testenv/bench/ray_sets.h"

#include <cmath>
#include <random>

#include "testenv/bench/room.h"

namespace hipr::bench {

namespace {

std::vector<gpu::Ray> primaryRays(uint32_t size) {
    std::vector<gpu::Ray> rays;
    for (uint32_t tile = 0; tile < (size / 8) * (size / 8); ++tile)
        for (uint32_t pixel = 0; pixel < 64; ++pixel) {
            const uint32_t x = tile % (size / 8) * 8 + pixel % 8, y = tile / (size / 8) * 8 + pixel / 8;
            const glm::vec3 direction{2.f * (float(x) + 0.5f) / float(size) - 1.f,
                                      2.f * (float(y) + 0.5f) / float(size) - 1.f, -1.2f};
            rays.push_back({Eye, 0.f, glm::normalize(direction), INFINITY, 0.f, 0u});
        }
    return rays;
}

/// A unit vector around `n`, density proportional to the cosine: a point on the unit sphere, moved by `n`.
glm::vec3 cosineDirection(const glm::vec3& n, float a, float b) {
    const float z = 1.f - 2.f * a, r = std::sqrt(std::max(0.f, 1.f - z * z)), phi = 6.2831853f * b;
    return glm::normalize(n + 0.999f * glm::vec3(r * std::cos(phi), r * std::sin(phi), z));
}

} // namespace

std::vector<RaySet> raySets(const BareEmbree& embree, const TriangleMesh& mesh, uint32_t size) {
    RaySet primary{"primary", false, primaryRays(size)}, bounce{"incoherent", false, {}},
        shadow{"shadow", true, {}};
    std::vector<gpu::Hit> hits(primary.rays.size());
    embree.nearest(primary.rays, hits);
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> random(0.f, 1.f);
    for (size_t i = 0; i < hits.size(); ++i) {
        if (hits[i].instance == gpu::NO_INDEX) continue;
        const gpu::Ray& ray = primary.rays[i];
        const glm::uvec3 t = mesh.triangles[hits[i].primitive];
        const glm::vec3& a = mesh.positions[t.x];
        glm::vec3 n = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
        if (glm::dot(n, n) == 0.f) continue;
        n = glm::normalize(glm::dot(n, ray.direction) < 0.f ? n : -n);
        const glm::vec3 p = ray.origin + hits[i].t * ray.direction + 1e-4f * n;
        bounce.rays.push_back(
            {p, 0.f, cosineDirection(n, random(engine), random(engine)), INFINITY, 0.f, 0u});
        const float radius = LightRadius * std::sqrt(random(engine)), phi = 6.2831853f * random(engine);
        const glm::vec3 way = LightCentre + radius * glm::vec3(std::cos(phi), 0.f, std::sin(phi)) - p;
        const float distance = glm::length(way);
        shadow.rays.push_back({p, 0.f, way / distance, distance, 0.f, 0u});
    }
    return {std::move(primary), std::move(bounce), std::move(shadow)};
}

} // namespace hipr::bench
