#include "testenv/common/ray_scenes.h"

#include <array>
#include <cmath>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>

namespace hipr::test {
namespace {

constexpr float PI = 3.14159265358979f;

gpu::Ray rayFrom(const glm::vec3& origin, const glm::vec3& direction) {
    return {origin, 0.0f, direction, std::numeric_limits<float>::infinity(), 0.0f, 0u};
}

glm::vec3 toWorld(const gpu::InstanceRecord& i, const glm::vec3& p) {
    return i.objectToWorld * glm::vec4(p, 1.0f);
}

/// A corner, a point of an edge and an inner one of some triangle; of a segment a vertex, a point of the axis
/// and one next to it.
std::array<glm::vec3, 3> aims(const TriangleMesh& mesh, Random& random) {
    if (!mesh.segments.empty()) {
        const uint32_t i = mesh.segments[random.below(uint32_t(mesh.segments.size()))];
        const glm::vec3 a = mesh.positions[i], b = mesh.positions[i + 1];
        const glm::vec3 on = glm::mix(a, b, random.between(0.0f, 1.0f));
        return {a, on, on + 1.1f * mesh.radii[i] * random.direction()};
    }
    const glm::uvec3 triangle = mesh.triangles[random.below(uint32_t(mesh.triangles.size()))];
    const uint32_t first = random.below(3);
    const glm::vec3 a = mesh.positions[triangle[first]], b = mesh.positions[triangle[(first + 1) % 3]],
                    c = mesh.positions[triangle[(first + 2) % 3]];
    const float s = random.between(0.0f, 1.0f), t = random.between(0.0f, 1.0f - s);
    return {a, a + s * (b - a), a + s * (b - a) + t * (c - a)};
}

} // namespace

glm::vec3 Random::direction() {
    const float z = between(-1.0f, 1.0f), phi = between(0.0f, 2.0f * PI);
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    return {r * std::cos(phi), r * std::sin(phi), z};
}

TriangleMesh soup(uint32_t count, float half, float size, uint32_t seed) {
    Random random(seed);
    TriangleMesh m;
    for (uint32_t i = 0; i < count; ++i) {
        const glm::vec3 centre = random.point(half);
        for (int k = 0; k < 3; ++k)
            m.positions.push_back(centre + random.point(size));
        m.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return m;
}

TriangleMesh bumpySphere(uint32_t rings, float radius) {
    TriangleMesh m;
    for (uint32_t i = 0; i <= rings; ++i)
        for (uint32_t j = 0; j < rings; ++j) {
            const float theta = PI * float(i) / float(rings), phi = 2.0f * PI * float(j) / float(rings);
            const float bump =
                i == 0 || i == rings ? 0.0f : 0.1f * std::sin(10.0f * theta) * std::sin(9.0f * phi);
            const float s = i == rings ? 0.0f : std::sin(theta);
            m.positions.push_back(radius * (1.0f + bump) *
                                  glm::vec3(s * std::cos(phi), s * std::sin(phi), std::cos(theta)));
        }
    for (uint32_t i = 0; i < rings; ++i)
        for (uint32_t j = 0; j < rings; ++j) {
            const uint32_t a = i * rings + j, b = i * rings + (j + 1) % rings;
            m.triangles.push_back({a, b, a + rings});
            m.triangles.push_back({b, b + rings, a + rings});
        }
    return m;
}

TriangleMesh strands(uint32_t count, float half, float length, float radius, uint32_t seed) {
    Random random(seed);
    TriangleMesh m;
    for (uint32_t strand = 0; strand < count; ++strand) {
        glm::vec3 at = random.point(half), way = random.direction();
        const uint32_t joints = 1 + random.below(6);
        for (uint32_t i = 0; i <= joints; ++i) {
            const uint32_t kind = random.below(12);
            m.radii.push_back(kind == 0   ? 0.0f
                              : kind == 1 ? 2.0f * length
                                          : radius * random.between(0.2f, 1.0f));
            m.positions.push_back(at);
            if (i < joints) m.segments.push_back(uint32_t(m.positions.size() - 1));
            way = glm::normalize(way + 0.7f * random.direction());
            if (kind != 2) at += length * way;
        }
    }
    return m;
}

TriangleMesh grid(uint32_t cells, float half, int axis) {
    TriangleMesh m;
    for (uint32_t i = 0; i <= cells; ++i)
        for (uint32_t j = 0; j <= cells; ++j) {
            glm::vec3 p(0.0f);
            p[(axis + 1) % 3] = half * (2.0f * float(i) / float(cells) - 1.0f);
            p[(axis + 2) % 3] = half * (2.0f * float(j) / float(cells) - 1.0f);
            m.positions.push_back(p);
        }
    for (uint32_t i = 0; i < cells; ++i)
        for (uint32_t j = 0; j < cells; ++j) {
            const uint32_t a = i * (cells + 1) + j, b = a + cells + 1;
            m.triangles.push_back({a, a + 1, b});
            m.triangles.push_back({a + 1, b + 1, b});
        }
    return m;
}

gpu::InstanceRecord placed(uint32_t geometry, const glm::dmat4& objectToWorld, uint32_t flags) {
    gpu::InstanceRecord r{};
    r.objectToWorld = glm::mat4x3(glm::mat4(objectToWorld));
    r.worldToObject = glm::mat4x3(glm::mat4(glm::inverse(objectToWorld)));
    r.geometry = geometry;
    r.flags = flags;
    return r;
}

glm::dmat4 randomPlacement(Random& random, float half, bool distorted) {
    glm::dmat4 m = glm::translate(glm::dmat4(1.0), glm::dvec3(random.point(half)));
    m = glm::rotate(m, double(random.between(0.0f, 2.0f * PI)), glm::dvec3(random.direction()));
    if (!distorted) return m;
    m = glm::scale(
        m, glm::dvec3(random.between(0.2f, 2.0f), random.between(0.2f, 2.0f), random.between(0.2f, 2.0f)));
    m = glm::rotate(m, double(random.between(0.0f, 2.0f * PI)), glm::dvec3(random.direction()));
    return random.below(2) ? glm::scale(m, glm::dvec3(-1.0, 1.0, 1.0)) : m;
}

void deform(TriangleMesh& mesh, uint32_t keys, float size, uint32_t seed) {
    Random random(seed);
    const size_t vertices = mesh.positions.size();
    for (mesh.keys = 1; mesh.keys < keys; ++mesh.keys)
        for (size_t i = 0; i < vertices; ++i)
            mesh.positions.push_back(mesh.positions[i] + random.point(size));
}

void setMoving(RayScene& scene, uint32_t keys, Random& random, float half) {
    gpu::InstanceRecord& instance = scene.instances.back();
    instance.firstKey = uint32_t(scene.keys.size());
    instance.keyCount = keys;
    glm::dmat4 place = glm::dmat4(glm::mat4(instance.objectToWorld));
    for (uint32_t k = 0; k < keys; ++k) {
        scene.keys.push_back(glm::mat4x3(glm::mat4(place)));
        place = glm::translate(glm::dmat4(1.0), glm::dvec3(random.point(half))) *
                glm::rotate(place, double(random.between(0.0f, 0.5f)), glm::dvec3(random.direction()));
    }
}

void spreadOverTime(std::vector<gpu::Ray>& rays, uint32_t seed) {
    Random random(seed);
    for (gpu::Ray& ray : rays)
        ray.time = random.between(0.0f, 1.0f);
    rays[0].time = 0.0f;
    rays[1].time = 1.0f;
}

void makeCull(RayScene& scene, std::vector<gpu::Ray>& rays) {
    constexpr uint32_t Culls[] = {0, gpu::INSTANCE_CULL_BACK, gpu::INSTANCE_CULL_FRONT,
                                  gpu::INSTANCE_CULL_BACK | gpu::INSTANCE_CULL_FOR_LIGHT,
                                  gpu::INSTANCE_CULL_FRONT | gpu::INSTANCE_CULL_FOR_LIGHT};
    for (size_t i = 0; i < scene.instances.size(); ++i)
        scene.instances[i].flags |= Culls[(i + 1) % 5];
    for (size_t i = 0; i < rays.size(); i += 2)
        rays[i].flags = gpu::RAY_OF_CAMERA;
}

std::vector<gpu::Ray> randomRays(uint32_t count, float half, uint32_t seed) {
    Random random(seed);
    std::vector<gpu::Ray> rays;
    for (uint32_t i = 0; i < count; ++i)
        rays.push_back(rayFrom(random.point(half), random.direction()));
    return rays;
}

std::vector<gpu::Ray> aimedRays(const RayScene& scene, uint32_t count, float half, uint32_t seed) {
    Random random(seed);
    std::vector<gpu::Ray> rays;
    for (uint32_t i = 0; i < count; ++i) {
        const gpu::InstanceRecord& instance = scene.instances[random.below(uint32_t(scene.instances.size()))];
        const TriangleMesh& mesh = scene.meshes[instance.geometry];
        const std::array<glm::vec3, 3> targets = aims(mesh, random);
        const glm::vec3 origin = random.point(half);
        const glm::vec3 way = toWorld(instance, targets[i % 3]) - origin;
        rays.push_back(rayFrom(origin, glm::dot(way, way) > 0.0f ? glm::normalize(way) : glm::vec3(0, 0, 1)));
    }
    return rays;
}

std::vector<gpu::Ray> axisRays(uint32_t count, float half, uint32_t steps, uint32_t seed) {
    Random random(seed);
    std::vector<gpu::Ray> rays;
    for (uint32_t i = 0; i < count; ++i) {
        glm::vec3 origin, direction(0.0f);
        for (int a = 0; a < 3; ++a)
            origin[a] = half * (2.0f * float(random.below(steps + 1)) / float(steps) - 1.0f);
        const int axis = int(random.below(3));
        direction[axis] = random.below(2) ? 1.0f : -1.0f;
        origin[axis] = -1.5f * half * direction[axis];
        rays.push_back(rayFrom(origin, direction));
    }
    return rays;
}

} // namespace hipr::test
