// Displaced meshes against surfaces that are known.
#include "renderer/geometry/displace.h"
#include "testenv/unit/geometry/test_mesh.h"

namespace hipr::test {
namespace {

/// A grid of n x n quads on [0, 1]^2 with smooth normals and texture coordinates.
MeshDesc plane(int n, bool smooth = true) {
    MeshDesc desc = grid(n);
    for (glm::vec3& p : desc.points)
        p /= float(n);
    Primvar st{"st", Interpolation::Vertex, 2, {}, {}};
    Primvar normals{"normals", Interpolation::Vertex, 3, {}, {}};
    for (const glm::vec3& p : desc.points) {
        st.values.insert(st.values.end(), {p.x, p.y});
        normals.values.insert(normals.values.end(), {0.f, 0.f, 1.f});
    }
    desc.primvars = {st};
    if (smooth) desc.primvars.push_back(normals);
    return desc;
}

std::shared_ptr<const TriangleMesh> moved(const TriangleMesh& mesh,
                                          const std::function<glm::vec3(const glm::vec3&)>& by) {
    return displace(mesh, vertexFrames(mesh), [&](uint32_t triangle, int corner) {
        return by(mesh.positions[mesh.triangles[triangle][corner]]);
    });
}

glm::vec3 along(float height) {
    return glm::vec3(0.f, 0.f, height);
}

TEST(Displace, PlanesBecomeHeightFieldsWithTheirNormals) {
    const auto flat = buildQuietly(plane(96));
    const float k = 6.f, a = 0.1f;
    const auto waves = moved(*flat, [&](const glm::vec3& p) { return along(a * std::sin(k * p.x)); });
    ASSERT_EQ(waves->positions.size(), flat->positions.size());
    for (size_t v = 0; v < flat->positions.size(); ++v) {
        const glm::vec3 &p = flat->positions[v], &q = waves->positions[v];
        EXPECT_EQ(glm::vec2(q), glm::vec2(p));
        EXPECT_NEAR(q.z, a * std::sin(k * p.x), 1e-6);
        const glm::vec3 expected = glm::normalize(glm::vec3(-a * k * std::cos(k * p.x), 0.f, 1.f));
        const bool inside = p.x > 0.02f && p.x < 0.98f; // one-sided differences at the rim
        EXPECT_TRUE(!inside || glm::distance(waves->normals[v], expected) < 0.004f) << p.x;
        EXPECT_NEAR(glm::length(waves->normals[v]), 1.f, 1e-6);
    }
    EXPECT_NEAR(waves->boundsMax.z, a, 1e-4);
    EXPECT_EQ(waves->triangles, flat->triangles);
}

/// A closed surface at a distance from another one, which has the same normals.
TEST(Displace, RefinedSurfacesMoveAlongLimitNormals) {
    MeshDesc desc = cube();
    desc.scheme = SubdivisionScheme::CatmullClark;
    desc.refineLevel = 4;
    const auto before = buildQuietly(desc);
    const auto after = moved(*before, [](const glm::vec3&) { return along(0.25f); });
    for (size_t v = 0; v < before->positions.size(); ++v) {
        const glm::vec3 expected = before->positions[v] + 0.25f * before->normals[v];
        EXPECT_LT(glm::distance(after->positions[v], expected), 1e-6f);
        EXPECT_LT(glm::distance(after->normals[v], before->normals[v]), 0.002f);
    }
    EXPECT_NEAR(after->boundsMax.x, before->boundsMax.x + 0.25f, 1e-4);
}

TEST(Displace, WhatMovesNothingChangesNothing) {
    MeshDesc desc = cube();
    desc.scheme = SubdivisionScheme::CatmullClark;
    desc.refineLevel = 2;
    desc.creaseIndices = {0, 1, 3, 2, 0};
    desc.creaseLengths = {5};
    desc.creaseWeights = {10.f};
    for (const MeshDesc& each : {desc, plane(4), plane(4, false)}) {
        const auto before = buildQuietly(each);
        const auto after = moved(*before, [](const glm::vec3&) { return glm::vec3(0.f); });
        EXPECT_EQ(after->positions, before->positions);
        ASSERT_EQ(after->normals.size(), before->normals.size());
        for (size_t i = 0; i < before->normals.size(); ++i)
            EXPECT_LT(glm::distance(after->normals[i], before->normals[i]), 2e-7f);
        EXPECT_EQ(after->boundsMin, before->boundsMin);
    }
}

TEST(Displace, FacetsStayFacets) {
    const auto after = moved(*buildQuietly(cube()), [](const glm::vec3&) { return along(std::sqrt(3.f)); });
    EXPECT_TRUE(after->normals.empty());
    EXPECT_NEAR(after->boundsMax.x, 2.f, 1e-6) << "corners move along the mean of the facets around";
}

TEST(Displace, CornersThatDisagreeMeetInTheMean) {
    const auto flat = buildQuietly(plane(2));
    const auto after = displace(*flat, vertexFrames(*flat), [&](uint32_t triangle, int) {
        return along(flat->triangleFace[triangle] % 2 ? 1.f : 0.f); // columns of faces
    });
    for (size_t v = 0; v < after->positions.size(); ++v) {
        const float x = after->positions[v].x, z = after->positions[v].z;
        EXPECT_TRUE(x != 0.5f ? z == x : z > 0.2f && z < 0.8f) << x << " " << z;
    }
}

TEST(Displace, VectorsFollowTheTextureCoordinates) {
    MeshDesc desc = plane(3);
    for (size_t i = 0; i < desc.primvars[0].values.size(); i += 2) { // s along +y, t along -x
        const glm::vec3 p = desc.points[i / 2];
        desc.primvars[0].values[i] = p.y;
        desc.primvars[0].values[i + 1] = -p.x;
    }
    const auto flat = buildQuietly(desc);
    const auto after = moved(*flat, [](const glm::vec3&) { return glm::vec3(1.f, 2.f, 3.f); });
    for (size_t v = 0; v < flat->positions.size(); ++v)
        EXPECT_LT(glm::distance(after->positions[v] - flat->positions[v], glm::vec3(-2.f, 1.f, 3.f)), 1e-5f);
}

TEST(Displace, WhatIsNotFiniteMovesNothing) {
    const auto flat = buildQuietly(plane(2));
    const auto after = moved(*flat, [](const glm::vec3& p) {
        return along(p.x == 0.f ? std::nanf("") : p.x == 1.f ? INFINITY : 0.5f);
    });
    for (const glm::vec3& p : after->positions)
        EXPECT_EQ(p.z, p.x == 0.5f ? 0.5f : 0.f);
}

} // namespace
} // namespace hipr::test
