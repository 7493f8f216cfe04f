#include "testenv/bench/room.h"

#include <cmath>

namespace hipr::bench {

namespace {

constexpr int Balls = 8;

/// Appends a grid of n x n quads whose points are surface(s, t), s and t in 0..1.
template <class Surface> void addGrid(MeshDesc& mesh, uint32_t n, const Surface& surface) {
    const int first = int(mesh.points.size()), row = int(n) + 1;
    for (uint32_t i = 0; i <= n; ++i)
        for (uint32_t j = 0; j <= n; ++j)
            mesh.points.push_back(surface(float(i) / float(n), float(j) / float(n)));
    for (int i = 0; i < int(n); ++i)
        for (int j = 0; j < int(n); ++j) {
            const int a = first + i * row + j;
            mesh.faceVertexCounts.push_back(4);
            mesh.faceVertexIndices.insert(mesh.faceVertexIndices.end(), {a, a + 1, a + row + 1, a + row});
        }
}

glm::vec3 wallPoint(int wall, float s, float t) {
    const int axis = wall / 2;
    const float side = wall % 2 ? 1.f : -1.f;
    // No bump on the edges, where walls meet.
    const float inside = 16.f * s * (1.f - s) * t * (1.f - t);
    glm::vec3 p;
    p[axis] = side * (RoomHalf - 0.15f * inside * (1.f + std::sin(40.f * s) * std::cos(33.f * t)));
    p[(axis + 1) % 3] = RoomHalf * (2.f * s - 1.f);
    p[(axis + 2) % 3] = RoomHalf * (2.f * t - 1.f);
    return p;
}

glm::vec3 ballPoint(int ball, float s, float t) {
    const float pi = 3.14159265f, theta = pi * s, phi = 2.f * pi * t;
    const float bump = 0.08f * std::sin(theta) * std::sin(14.f * theta) * std::sin(13.f * phi);
    const float radius = (0.7f + 0.1f * float(ball % 3)) * (1.f + bump);
    const float around = 2.f * pi * float(ball) / Balls;
    const glm::vec3 centre{2.2f * std::cos(around), -2.f + 0.5f * float(ball % 4), 2.2f * std::sin(around)};
    return centre + radius * glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                       std::sin(theta) * std::sin(phi));
}

} // namespace

MeshDesc room(uint32_t triangles) {
    MeshDesc mesh;
    mesh.name = "room";
    mesh.doubleSided = true;
    mesh.flatNormals = true;
    // A fifth of the triangles for the walls.
    const uint32_t wallCells = uint32_t(std::sqrt(0.2f * float(triangles) / 12.f));
    const uint32_t ballCells = uint32_t(std::sqrt(0.8f * float(triangles) / (2.f * Balls)));
    for (int wall = 0; wall < 6; ++wall)
        addGrid(mesh, wallCells, [&](float s, float t) { return wallPoint(wall, s, t); });
    for (int ball = 0; ball < Balls; ++ball)
        addGrid(mesh, ballCells, [&](float s, float t) { return ballPoint(ball, s, t); });
    return mesh;
}

} // namespace hipr::bench
