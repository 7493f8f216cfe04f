// Which normals a mesh gets, and that they point where they should.
#include <gmock/gmock.h>

#include "test_mesh.h"

namespace hipr::test {
namespace {

Primvar normalsPrimvar(Interpolation interpolation, const std::vector<glm::vec3>& normals) {
    Primvar primvar{"normals", interpolation, 3, {}, {}};
    for (const glm::vec3& n : normals)
        primvar.values.insert(primvar.values.end(), {n.x, n.y, n.z});
    return primvar;
}

/// A latitude-longitude sphere without poles merged: quads and triangles of very different sizes.
MeshDesc sphere(int rings, int segments) {
    MeshDesc desc;
    desc.name = "/sphere";
    for (int r = 0; r <= rings; ++r) {
        for (int s = 0; s < segments; ++s) {
            const double theta = 3.141592653589793 * r / rings, phi = 6.283185307179586 * s / segments;
            desc.points.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                     std::cos(theta));
        }
    }
    for (int r = 0; r < rings; ++r) {
        for (int s = 0; s < segments; ++s) {
            const int a = r * segments + s, b = r * segments + (s + 1) % segments;
            desc.faceVertexCounts.push_back(4);
            desc.faceVertexIndices.insert(desc.faceVertexIndices.end(), {a, a + segments, b + segments, b});
        }
    }
    return desc;
}

TEST(Normals, PolygonalAndBilinearMeshesAreFaceted) {
    MeshDesc desc = cube();
    EXPECT_TRUE(buildQuietly(desc)->normals.empty());
    desc.scheme = SubdivisionScheme::Bilinear;
    EXPECT_TRUE(buildQuietly(desc)->normals.empty());
    desc.refineLevel = 2;
    EXPECT_TRUE(buildQuietly(desc)->normals.empty());
}

TEST(Normals, UnrefinedSubdivisionCageIsSmooth) {
    MeshDesc desc = cube();
    desc.scheme = SubdivisionScheme::CatmullClark;
    const auto mesh = buildQuietly(desc);
    ASSERT_EQ(mesh->normalInterpolation, Interpolation::Vertex);
    ASSERT_EQ(mesh->normals.size(), 8u);
    // Angle weights make it the diagonal although the quads' diagonals cut the cube's corners unevenly.
    for (size_t v = 0; v < 8; ++v) {
        EXPECT_NEAR(glm::distance(mesh->normals[v], glm::normalize(mesh->positions[v])), 0.f, 1e-6f);
    }
    desc.flatNormals = true;
    EXPECT_TRUE(buildQuietly(desc)->normals.empty());
}

TEST(Normals, SmoothNormalsOfASphereArePositions) {
    MeshDesc desc = sphere(32, 48);
    desc.scheme = SubdivisionScheme::CatmullClark;
    const auto mesh = buildQuietly(desc);
    for (size_t v = 48; v < mesh->positions.size() - 48; ++v) {
        EXPECT_GT(glm::dot(mesh->normals[v], mesh->positions[v]), 0.9995f) << v;
    }
}

TEST(Normals, AuthoredNormalsOfEveryInterpolation) {
    const glm::vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    MeshDesc desc = grid(1);
    desc.primvars = {normalsPrimvar(Interpolation::Vertex, {x, y, 3.f * z, x})};
    auto mesh = buildQuietly(desc);
    EXPECT_EQ(mesh->normalInterpolation, Interpolation::Vertex);
    EXPECT_THAT(mesh->normals, testing::ElementsAre(x, y, z, x));
    EXPECT_EQ(findPrimvar(*mesh, "normals"), nullptr);

    desc.primvars = {normalsPrimvar(Interpolation::FaceVarying, {x, y, z, -x})};
    mesh = buildQuietly(desc);
    EXPECT_EQ(mesh->normalInterpolation, Interpolation::FaceVarying);
    EXPECT_THAT(mesh->normals, testing::ElementsAre(x, y, z, x, z, -x));

    for (const Interpolation interpolation : {Interpolation::Uniform, Interpolation::Constant}) {
        desc.primvars = {normalsPrimvar(interpolation, {y})};
        EXPECT_THAT(buildQuietly(desc)->normals, testing::Each(y));
    }
    desc.primvars[0].indices = {0};
    EXPECT_THAT(buildQuietly(desc)->normals, testing::Each(y));
}

TEST(Normals, SubdivisionAndFlatShadingIgnoreAuthoredNormals) {
    MeshDesc desc = grid(1);
    desc.primvars = {normalsPrimvar(Interpolation::Constant, {glm::vec3(1, 0, 0)})};
    desc.flatNormals = true;
    EXPECT_TRUE(buildQuietly(desc)->normals.empty());
    desc.flatNormals = false;
    desc.scheme = SubdivisionScheme::CatmullClark;
    EXPECT_THAT(buildQuietly(desc)->normals, testing::Each(glm::vec3(0, 0, 1)));
}

TEST(Normals, MissingDirectionsAreComputed) {
    MeshDesc desc = grid(1);
    for (const Interpolation interpolation : {Interpolation::Vertex, Interpolation::FaceVarying}) {
        desc.primvars = {normalsPrimvar(
            interpolation, {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0), glm::vec3(1, 0, 0)})};
        Messages messages;
        const auto mesh = buildTriangleMesh(desc, messages.sink());
        ASSERT_EQ(messages.texts.size(), 1u);
        EXPECT_THAT(messages.texts[0], testing::HasSubstr("authored normals have no length"));
        EXPECT_EQ(normalAt(*mesh, 0, 0), glm::vec3(0, 0, 1));
        EXPECT_EQ(normalAt(*mesh, 0, 1), glm::vec3(1, 0, 0));
    }
    desc.primvars = {normalsPrimvar(Interpolation::Constant, {glm::vec3(1e-30f, 0, 0)})};
    EXPECT_THAT(buildQuietly(desc)->normals, testing::Each(glm::vec3(1, 0, 0)));
}

TEST(Normals, ASheetFoldedOnItselfKeepsUnitNormals) {
    MeshDesc desc = grid(1);
    desc.faceVertexCounts = {4, 4};
    desc.faceVertexIndices = {0, 1, 3, 2, 2, 3, 1, 0};
    desc.scheme = SubdivisionScheme::CatmullClark;
    const auto mesh = buildQuietly(desc);
    for (const glm::vec3& normal : mesh->normals)
        EXPECT_NEAR(std::abs(normal.z), 1.f, 1e-6f);
}

TEST(Normals, UpdatedPointsGiveUpdatedNormals) {
    MeshDesc desc = cube();
    desc.scheme = SubdivisionScheme::CatmullClark;
    const auto old = buildQuietly(desc);
    for (glm::vec3& p : desc.points)
        p = glm::vec3(-p.y, p.x, p.z);
    const auto updated = updatePoints(*old, desc, {});
    for (size_t v = 0; v < 8; ++v) {
        EXPECT_NEAR(glm::distance(updated->normals[v], glm::normalize(desc.points[v])), 0.f, 1e-6f);
    }
}

} // namespace
} // namespace hipr::test
