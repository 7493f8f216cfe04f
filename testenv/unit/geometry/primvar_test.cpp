// Primvars through triangulation and refinement, and updatePoints.
#include <gmock/gmock.h>

#include "test_mesh.h"

namespace hipr::test {
namespace {

using testing::ElementsAre;

/// A linear function of the position: refinement must reproduce it wherever it uses the position's weights.
float linear(const glm::vec3& p) {
    return 2.f * p.x - 3.f * p.y + 0.5f * p.z + 1.f;
}

Primvar linearPrimvar(const MeshDesc& desc, Interpolation interpolation) {
    Primvar primvar{"f", interpolation, 1, {}, {}};
    if (interpolation == Interpolation::Vertex) {
        for (const glm::vec3& p : desc.points)
            primvar.values.push_back(linear(p));
    } else {
        for (const int v : desc.faceVertexIndices)
            primvar.values.push_back(linear(desc.points[size_t(v)]));
    }
    return primvar;
}

void expectLinearEverywhere(const TriangleMesh& mesh, float tolerance) {
    const TrianglePrimvar* f = findPrimvar(mesh, "f");
    ASSERT_NE(f, nullptr);
    const bool perCorner = f->interpolation == Interpolation::FaceVarying;
    ASSERT_EQ(f->values.size(), perCorner ? mesh.triangles.size() * 3 : mesh.positions.size());
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const uint32_t v = mesh.triangles[t][k];
            EXPECT_NEAR(f->values[perCorner ? 3 * t + size_t(k) : v], linear(mesh.positions[v]), tolerance);
        }
    }
}

TEST(Primvar, EveryInterpolationThroughTriangulation) {
    MeshDesc desc = grid(1);
    desc.points.emplace_back(0.5f, 2, 0);
    desc.faceVertexCounts = {4, 3};
    desc.faceVertexIndices = {0, 1, 3, 2, 2, 3, 4};
    desc.primvars = {{"constant", Interpolation::Constant, 2, {7, 8}, {}},
                     {"uniform", Interpolation::Uniform, 1, {5, 6}, {}},
                     {"vertex", Interpolation::Vertex, 1, {0, 1, 2, 3, 4}, {}},
                     {"corner", Interpolation::FaceVarying, 1, {10, 11, 12, 13, 14, 15, 16}, {}}};
    const auto mesh = buildQuietly(desc);
    EXPECT_THAT(findPrimvar(*mesh, "constant")->values, ElementsAre(7, 8));
    EXPECT_THAT(findPrimvar(*mesh, "uniform")->values, ElementsAre(5, 5, 6));
    EXPECT_THAT(findPrimvar(*mesh, "vertex")->values, ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(findPrimvar(*mesh, "corner")->values, ElementsAre(10, 11, 12, 10, 12, 13, 14, 15, 16));
}

TEST(Primvar, IndexedValuesAreFollowed) {
    MeshDesc desc = grid(1);
    desc.primvars = {{"constant", Interpolation::Constant, 1, {7, 8}, {1}},
                     {"uniform", Interpolation::Uniform, 1, {5, 6}, {1}},
                     {"vertex", Interpolation::Vertex, 2, {1, 2, 3, 4}, {1, 0, 0, 1}},
                     {"corner", Interpolation::FaceVarying, 1, {10, 20}, {0, 1, 1, 0}}};
    const auto mesh = buildQuietly(desc);
    EXPECT_THAT(findPrimvar(*mesh, "constant")->values, ElementsAre(8));
    EXPECT_THAT(findPrimvar(*mesh, "uniform")->values, ElementsAre(6, 6));
    EXPECT_THAT(findPrimvar(*mesh, "vertex")->values, ElementsAre(3, 4, 1, 2, 1, 2, 3, 4));
    EXPECT_THAT(findPrimvar(*mesh, "corner")->values, ElementsAre(10, 20, 20, 10, 20, 10));
}

TEST(Primvar, LeftHandedFacesKeepValuesAtTheirCorners) {
    MeshDesc desc = cube();
    desc.leftHanded = true;
    desc.primvars = {linearPrimvar(desc, Interpolation::FaceVarying)};
    expectLinearEverywhere(*buildQuietly(desc), 0.f);
}

TEST(Primvar, ConcavePolygonKeepsValuesAtItsCorners) {
    MeshDesc desc = polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {1, 4, 0}, {1.5f, 1, 0}});
    desc.primvars = {linearPrimvar(desc, Interpolation::FaceVarying)};
    expectLinearEverywhere(*buildQuietly(desc), 0.f);
}

TEST(Primvar, RefinementReproducesLinearFunctions) {
    for (const SubdivisionScheme scheme : {SubdivisionScheme::Bilinear, SubdivisionScheme::CatmullClark}) {
        for (const Interpolation interpolation : {Interpolation::Vertex, Interpolation::FaceVarying}) {
            for (MeshDesc desc : {grid(4), cube()}) {
                desc.scheme = scheme;
                desc.refineLevel = 3;
                // Values smooth everywhere, so that they follow the positions up to the boundary and its
                // corners.
                desc.boundary = BoundaryInterpolation::EdgeOnly;
                desc.faceVaryingLinear = FaceVaryingInterpolation::None;
                desc.primvars = {linearPrimvar(desc, interpolation)};
                expectLinearEverywhere(*buildQuietly(desc), 2e-5f);
            }
        }
    }
}

TEST(Primvar, FlattenedAndIndexedFaceVaryingRefineAlike) {
    // A seam along x = 2 of a 4 x 4 grid: the right half's values are shifted by 10.
    MeshDesc flat = grid(4);
    flat.scheme = SubdivisionScheme::CatmullClark;
    flat.refineLevel = 2;
    MeshDesc indexed = flat;
    Primvar values{"f", Interpolation::FaceVarying, 1, {}, {}}, indices = values;
    for (size_t v = 0; v < 50; ++v)
        indices.values.push_back(float(v % 25) + (v < 25 ? 0.f : 10.f));
    for (size_t corner = 0; corner < flat.faceVertexIndices.size(); ++corner) {
        const int index = flat.faceVertexIndices[corner] + ((corner / 4) % 4 < 2 ? 0 : 25);
        indices.indices.push_back(index);
        values.values.push_back(indices.values[size_t(index)]);
    }
    flat.primvars = {values};
    indexed.primvars = {indices};
    const auto a = buildQuietly(flat), b = buildQuietly(indexed);
    EXPECT_EQ(findPrimvar(*a, "f")->values, findPrimvar(*b, "f")->values);
    // Inner rows keep the seam: at x = 2 both v + 2 and v + 12 occur.
    const size_t middle = nearestVertex(*a, {2, 2, 0});
    std::vector<float> seen;
    for (size_t t = 0; t < a->triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            if (a->triangles[t][k] == middle) seen.push_back(findPrimvar(*a, "f")->values[3 * t + size_t(k)]);
        }
    }
    EXPECT_THAT(seen, testing::Contains(testing::FloatNear(12.f, 1e-4f)));
    EXPECT_THAT(seen, testing::Contains(testing::FloatNear(22.f, 1e-4f)));
}

TEST(Primvar, VaryingIsRefinedLinearly) {
    MeshDesc desc = cube();
    desc.scheme = SubdivisionScheme::CatmullClark;
    desc.refineLevel = 1;
    desc.primvars = {linearPrimvar(desc, Interpolation::Vertex)};
    desc.primvars[0].linear = true;
    const auto mesh = buildQuietly(desc);
    const TrianglePrimvar* f = findPrimvar(*mesh, "f");
    ASSERT_NE(f, nullptr);
    // The cube's corner moves to half its size on the limit surface but keeps its varying value; the middle
    // of a face has the mean of its four.
    EXPECT_NEAR(f->values[nearestVertex(*mesh, {0.5f, 0.5f, 0.5f})], linear({1, 1, 1}), 1e-6f);
    EXPECT_NEAR(f->values[nearestVertex(*mesh, {0, 0, 1})], linear({0, 0, 1}), 1e-6f);
}

TEST(Primvar, UniformAndConstantFollowTheAuthoredFaceThroughRefinement) {
    MeshDesc desc = cube();
    desc.scheme = SubdivisionScheme::CatmullClark;
    desc.refineLevel = 2;
    desc.primvars = {{"uniform", Interpolation::Uniform, 1, {0, 1, 2, 3, 4, 5}, {}},
                     {"constant", Interpolation::Constant, 1, {9}, {}}};
    const auto mesh = buildQuietly(desc);
    ASSERT_EQ(mesh->triangles.size(), 6u * 16u * 2u);
    EXPECT_THAT(findPrimvar(*mesh, "constant")->values, ElementsAre(9));
    for (size_t t = 0; t < mesh->triangles.size(); ++t) {
        EXPECT_EQ(findPrimvar(*mesh, "uniform")->values[t], float(mesh->triangleFace[t]));
        // Faces 0, 1 look along x, 2, 3 along y, 4, 5 along z; a refined face stays on its side of the cube.
        const glm::dvec3 centre =
            (cornerOf(*mesh, t, 0) + cornerOf(*mesh, t, 1) + cornerOf(*mesh, t, 2)) / 3.0;
        const int axis = int(mesh->triangleFace[t] / 2);
        EXPECT_GE(std::abs(centre[axis]),
                  std::max(std::abs(centre[(axis + 1) % 3]), std::abs(centre[(axis + 2) % 3])));
        EXPECT_EQ(centre[axis] > 0, mesh->triangleFace[t] % 2 == 1);
    }
}

TEST(Primvar, UpdatePointsEqualsABuildAndKeepsThePrimvars) {
    MeshDesc desc = grid(3);
    desc.primvars = {linearPrimvar(desc, Interpolation::FaceVarying)};
    desc.subsets = {{{1, 2}}};
    const auto old = buildQuietly(desc);
    for (glm::vec3& p : desc.points)
        p = glm::vec3(2.f * p.x, p.y + p.x, p.x * p.y);
    const auto updated = updatePoints(*old, desc, {}), built = buildQuietly(desc);
    EXPECT_EQ(updated->positions, built->positions);
    EXPECT_EQ(updated->triangles, built->triangles);
    EXPECT_EQ(updated->triangleSlot, built->triangleSlot);
    EXPECT_EQ(updated->boundsMax, built->boundsMax);
    EXPECT_EQ(findPrimvar(*updated, "f")->values, findPrimvar(*built, "f")->values);
}

TEST(Primvar, UpdatePointsDropsAndRestoresFacesWithBrokenPoints) {
    MeshDesc desc = grid(2);
    const auto whole = buildQuietly(desc);
    desc.points[0].x = std::nanf("");
    Messages messages;
    const auto broken = updatePoints(*whole, desc, messages.sink());
    EXPECT_EQ(broken->triangles.size(), 6u);
    EXPECT_EQ(messages.texts.size(), 1u);
    desc.points[0].x = 0.f;
    EXPECT_EQ(updatePoints(*broken, desc, {})->triangles.size(), 8u);
}

} // namespace
} // namespace hipr::test
