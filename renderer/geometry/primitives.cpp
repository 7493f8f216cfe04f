// Shapes that stand for points.
#include <array>
#include <map>

#include <glm/gtc/constants.hpp>

#include "renderer/api/curves.h"
#include "renderer/geometry/finish.h"

namespace hipr {
namespace {

/// Vertex halfway between two others, on the sphere; made once.
uint32_t midpoint(TriangleMesh& mesh, std::map<std::pair<uint32_t, uint32_t>, uint32_t>& made, uint32_t a,
                  uint32_t b) {
    const auto [entry, fresh] = made.try_emplace(std::minmax(a, b), uint32_t(mesh.positions.size()));
    if (fresh) mesh.positions.push_back(glm::normalize(mesh.positions[a] + mesh.positions[b]));
    return entry->second;
}

void quarter(TriangleMesh& mesh) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> made;
    std::vector<glm::uvec3> finer;
    for (const glm::uvec3& t : mesh.triangles) {
        const uint32_t ab = midpoint(mesh, made, t.x, t.y), bc = midpoint(mesh, made, t.y, t.z),
                       ca = midpoint(mesh, made, t.z, t.x);
        finer.insert(finer.end(), {{t.x, ab, ca}, {t.y, bc, ab}, {t.z, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
}

std::shared_ptr<TriangleMesh> finished(std::shared_ptr<TriangleMesh> mesh) {
    mesh->triangleFace.assign(mesh->triangles.size(), 0);
    geometry::setBounds(*mesh);
    return mesh;
}

} // namespace

std::shared_ptr<TriangleMesh> unitSphere(const std::string& name, int level) {
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->name = name;
    const float g = glm::golden_ratio<float>();
    for (const glm::vec3& p : std::array<glm::vec3, 12>{{{-1, g, 0},
                                                         {1, g, 0},
                                                         {-1, -g, 0},
                                                         {1, -g, 0},
                                                         {0, -1, g},
                                                         {0, 1, g},
                                                         {0, -1, -g},
                                                         {0, 1, -g},
                                                         {g, 0, -1},
                                                         {g, 0, 1},
                                                         {-g, 0, -1},
                                                         {-g, 0, 1}}})
        mesh->positions.push_back(glm::normalize(p));
    mesh->triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int i = 0; i < std::min(level, 6); ++i)
        quarter(*mesh);
    mesh->normals = mesh->positions;
    return finished(std::move(mesh));
}

std::shared_ptr<TriangleMesh> unitDisk(const std::string& name, int corners) {
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->name = name;
    mesh->doubleSided = true;
    const uint32_t count = uint32_t(std::max(corners, 3));
    mesh->positions.push_back(glm::vec3(0.f));
    for (uint32_t i = 0; i < count; ++i) {
        const float angle = glm::two_pi<float>() * float(i) / float(count);
        mesh->positions.push_back({std::cos(angle), std::sin(angle), 0.f});
        mesh->triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
    }
    return finished(std::move(mesh));
}

} // namespace hipr
