// Subdivision surfaces against closed forms of their limits.
#include <gmock/gmock.h>

#include "test_mesh.h"

namespace hipr::test {
namespace {

MeshDesc refined(MeshDesc desc, int level, SubdivisionScheme scheme = SubdivisionScheme::CatmullClark) {
    desc.scheme = scheme;
    desc.refineLevel = level;
    return desc;
}

MeshDesc octahedron() {
    MeshDesc desc;
    desc.name = "/octahedron";
    desc.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    desc.faceVertexCounts.assign(8, 3);
    desc.faceVertexIndices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    return desc;
}

void creaseAllEdges(MeshDesc& desc, float sharpness) {
    for (int i = 0; i < 8; ++i) {
        for (int bit = 1; bit < 8; bit *= 2) {
            if (i & bit) continue;
            desc.creaseIndices.insert(desc.creaseIndices.end(), {i, i | bit});
            desc.creaseLengths.push_back(2);
            desc.creaseWeights.push_back(sharpness);
        }
    }
}

/// Limit of the cube's corner (1, 1, 1). One Catmull-Clark step gives its vertex, edge and face points; then
/// M. Halstead, M. Kass and T. DeRose, "Efficient, fair interpolation using Catmull-Clark surfaces", 1993:
/// (n^2 v + 4 sum e + sum f) / (n (n + 5)).
glm::dvec3 cubeCornerLimit() {
    const double n = 3.0;
    const glm::dvec3 corner(1.0);
    glm::dvec3 faces(0.0), edges(0.0), middles(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 face(0.0), neighbour = corner, f1(0.0), f2(0.0);
        face[axis] = 1.0;
        neighbour[axis] = -1.0;
        f1[(axis + 1) % 3] = 1.0;
        f2[(axis + 2) % 3] = 1.0;
        faces += face;
        middles += 0.5 * (corner + neighbour);
        edges += 0.25 * (corner + neighbour + f1 + f2);
    }
    const glm::dvec3 vertex = (faces / n + 2.0 * middles / n + (n - 3.0) * corner) / n;
    return (n * n * vertex + 4.0 * edges + faces) / (n * (n + 5.0));
}

TEST(Subdivision, CubeCornersLieOnTheLimitAtEveryLevel) {
    const glm::vec3 expected(cubeCornerLimit());
    for (int level = 1; level <= 5; ++level) {
        const auto mesh = buildQuietly(refined(cube(), level));
        EXPECT_EQ(mesh->triangles.size(), size_t(12) << (2 * level));
        EXPECT_EQ(mesh->normalInterpolation, Interpolation::Vertex);
        for (int i = 0; i < 8; ++i) {
            const glm::vec3 sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
            const size_t v = nearestVertex(*mesh, sign * expected);
            EXPECT_NEAR(glm::distance(mesh->positions[v], sign * expected), 0.f, 1e-6f);
            EXPECT_NEAR(glm::distance(mesh->normals[v], glm::normalize(sign)), 0.f, 1e-5f);
        }
    }
}

TEST(Subdivision, LevelsShareTheirLimitPoints) {
    const auto coarse = buildQuietly(refined(cube(), 2)), fine = buildQuietly(refined(cube(), 4));
    for (size_t v = 0; v < coarse->positions.size(); ++v) {
        const size_t same = nearestVertex(*fine, coarse->positions[v]);
        EXPECT_NEAR(glm::distance(coarse->positions[v], fine->positions[same]), 0.f, 1e-6f);
        EXPECT_GT(glm::dot(coarse->normals[v], fine->normals[same]), 1.f - 1e-5f);
    }
    EXPECT_GT(volume(*coarse), 0.0);
    EXPECT_NEAR(volume(*coarse), volume(*fine), 0.1 * volume(*fine));
}

TEST(Subdivision, NormalsAreThoseOfTheTriangles) {
    MeshDesc twisted = cube();
    for (glm::vec3& p : twisted.points)
        p = glm::vec3(p.x + 0.3f * p.z, p.y * (1.f + 0.2f * p.x), p.z);
    for (const MeshDesc& desc : {refined(twisted, 4), refined(octahedron(), 4, SubdivisionScheme::Loop)}) {
        const auto mesh = buildQuietly(desc);
        for (size_t t = 0; t < mesh->triangles.size(); ++t) {
            const glm::vec3 facet = glm::normalize(glm::vec3(areaVector(*mesh, t)));
            for (int k = 0; k < 3; ++k)
                EXPECT_GT(glm::dot(facet, normalAt(*mesh, t, k)), 0.98f);
        }
    }
}

TEST(Subdivision, LoopLimitOfAnOctahedron) {
    // C. Loop, "Smooth subdivision surfaces based on triangles", 1987: the limit of a vertex of valence n is
    // (1 - n x) v + x sum(neighbours), x = 1 / (3 / (8 b) + n), b = (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n.
    const double n = 4.0,
                 b = (0.625 - std::pow(0.375 + 0.25 * std::cos(2.0 * 3.141592653589793 / n), 2.0)) / n;
    const double x = 1.0 / (3.0 / (8.0 * b) + n);
    const auto mesh = buildQuietly(refined(octahedron(), 3, SubdivisionScheme::Loop));
    EXPECT_EQ(mesh->triangles.size(), 8u * 64u);
    EXPECT_GT(volume(*mesh), 0.0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 expected(0.f); // the four neighbours cancel
        expected[axis] = float(1.0 - n * x);
        EXPECT_NEAR(glm::distance(mesh->positions[nearestVertex(*mesh, expected)], expected), 0.f, 1e-6f);
    }
}

TEST(Subdivision, LoopOfQuadsFallsBackWithAMessage) {
    Messages messages;
    const auto mesh = buildTriangleMesh(refined(cube(), 2, SubdivisionScheme::Loop), messages.sink());
    ASSERT_EQ(messages.texts.size(), 1u);
    EXPECT_THAT(messages.texts[0], testing::HasSubstr("loop subdivision needs triangles"));
    EXPECT_EQ(mesh->positions, buildQuietly(refined(cube(), 2))->positions);
}

TEST(Subdivision, BilinearKeepsTheShape) {
    const auto mesh = buildQuietly(refined(cube(), 3, SubdivisionScheme::Bilinear));
    EXPECT_EQ(mesh->triangles.size(), 12u * 64u);
    EXPECT_NEAR(area(*mesh), 24.0, 1e-5);
    EXPECT_NEAR(volume(*mesh), 8.0, 1e-5);
}

TEST(Subdivision, InfinitelySharpCubeStaysACube) {
    MeshDesc desc = refined(cube(), 3);
    creaseAllEdges(desc, 10.f);
    const auto mesh = buildQuietly(desc);
    EXPECT_NEAR(area(*mesh), 24.0, 1e-4);
    EXPECT_NEAR(volume(*mesh), 8.0, 1e-4);
    ASSERT_EQ(mesh->normalInterpolation, Interpolation::FaceVarying);
    for (size_t t = 0; t < mesh->triangles.size(); ++t) {
        const glm::vec3 facet = glm::normalize(glm::vec3(areaVector(*mesh, t)));
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(glm::distance(facet, normalAt(*mesh, t, k)), 0.f, 1e-5f);
    }
}

TEST(Subdivision, SemiSharpLiesBetweenSmoothAndSharp) {
    double before = volume(*buildQuietly(refined(cube(), 4)));
    for (const float sharpness : {0.5f, 1.f, 2.f, 3.f}) {
        MeshDesc desc = refined(cube(), 4);
        creaseAllEdges(desc, sharpness);
        const auto mesh = buildQuietly(desc);
        EXPECT_EQ(mesh->normalInterpolation, Interpolation::Vertex) << "used up before the last level";
        EXPECT_GT(volume(*mesh), before);
        before = volume(*mesh);
    }
    EXPECT_LT(before, 8.0);
}

TEST(Subdivision, SharpCornerStaysAPoint) {
    MeshDesc desc = refined(cube(), 3);
    desc.cornerIndices = {7};
    desc.cornerWeights = {10.f};
    const auto mesh = buildQuietly(desc);
    const size_t tip = nearestVertex(*mesh, {1, 1, 1});
    EXPECT_NEAR(glm::distance(mesh->positions[tip], glm::vec3(1)), 0.f, 1e-6f);
    for (size_t t = 0; t < mesh->triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            if (mesh->triangles[t][k] != tip) continue;
            EXPECT_NEAR(glm::distance(normalAt(*mesh, t, k), glm::normalize(glm::vec3(1))), 0.f, 1e-4f);
        }
    }
}

TEST(Subdivision, BoundaryRules) {
    MeshDesc desc = refined(grid(3), 3);
    desc.boundary = BoundaryInterpolation::EdgeAndCorner;
    EXPECT_NEAR(area(*buildQuietly(desc)), 9.0, 1e-5);

    // Without corners the boundary is a cubic B-spline: its control point's limit is (p- + 4 p + p+) / 6.
    desc.boundary = BoundaryInterpolation::EdgeOnly;
    const auto rounded = buildQuietly(desc);
    const glm::vec3 expected((1.f + 4.f * 0.f + 0.f) / 6.f, (0.f + 4.f * 0.f + 1.f) / 6.f, 0.f);
    EXPECT_NEAR(glm::distance(rounded->positions[nearestVertex(*rounded, expected)], expected), 0.f, 1e-6f);
    EXPECT_LT(area(*rounded), 8.99);

    // No interpolation: only the inner face has all its neighbours.
    desc.boundary = BoundaryInterpolation::None;
    const auto inner = buildQuietly(desc);
    EXPECT_NEAR(area(*inner), 1.0, 1e-5);
    EXPECT_THAT(inner->triangleFace, testing::Each(4u));
}

TEST(Subdivision, HolesShapeTheSurfaceWithoutBeingThere) {
    MeshDesc desc = refined(cube(), 3);
    const auto whole = buildQuietly(desc);
    desc.holeFaces = {5};
    const auto open = buildQuietly(desc);
    EXPECT_EQ(open->positions, whole->positions);
    EXPECT_EQ(open->triangles.size(), whole->triangles.size() * 5 / 6);
    EXPECT_THAT(open->triangleFace, testing::Not(testing::Contains(5u)));
}

TEST(Subdivision, LeftHandedSurfaceFacesOutward) {
    MeshDesc desc = refined(cube(), 3);
    desc.leftHanded = true;
    for (size_t face = 0; face < 6; ++face) {
        std::reverse(desc.faceVertexIndices.begin() + long(4 * face),
                     desc.faceVertexIndices.begin() + long(4 * face + 4));
    }
    const auto mesh = buildQuietly(desc);
    EXPECT_GT(volume(*mesh), 1.0);
    for (size_t v = 0; v < mesh->positions.size(); ++v) {
        EXPECT_GT(glm::dot(mesh->normals[v], glm::normalize(mesh->positions[v])), 0.8f);
    }
}

TEST(Subdivision, SubsetsFollowTheirFaces) {
    MeshDesc desc = refined(cube(), 2);
    desc.subsets = {{{5}}, {{0, 2}}};
    const auto mesh = buildQuietly(desc);
    for (size_t t = 0; t < mesh->triangles.size(); ++t) {
        const uint32_t face = mesh->triangleFace[t];
        EXPECT_EQ(mesh->triangleSlot[t], face == 5 ? 1 : face == 0 || face == 2 ? 2 : 0);
    }
}

TEST(Subdivision, PolygonsOfAnySizeAndNonManifoldEdges) {
    MeshDesc desc = refined(polygon({{0, 0, 0}, {2, 0, 0}, {3, 2, 0}, {1, 3, 0}, {-1, 2, 0}}), 2);
    EXPECT_NEAR(area(*buildQuietly(desc)), 8.0, 1e-5);
    desc.points.insert(desc.points.end(), {{1, 0, 2}, {1, 0, -2}});
    desc.faceVertexCounts = {5, 3, 3};
    desc.faceVertexIndices = {0, 1, 2, 3, 4, 0, 1, 5, 0, 1, 6};
    const auto fin = buildQuietly(desc);
    for (const glm::vec3& p : fin->positions)
        EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
    for (const glm::vec3& n : fin->normals)
        EXPECT_NEAR(glm::length(n), 1.f, 1e-5f);
}

TEST(Subdivision, SmoothTriangleRuleChangesTriangles) {
    MeshDesc desc = refined(octahedron(), 3);
    const auto standard = buildQuietly(desc);
    desc.triangleSubdivision = TriangleSubdivision::Smooth;
    EXPECT_NE(standard->positions, buildQuietly(desc)->positions);
}

} // namespace
} // namespace hipr::test
