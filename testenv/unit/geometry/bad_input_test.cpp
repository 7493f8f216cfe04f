// Every kind of broken mesh: one message that names it, and the rest is built.
#include <gmock/gmock.h>

#include "renderer/geometry/cage.h"
#include "test_mesh.h"

namespace hipr::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const float NaN = std::nanf("");

/// Builds, expects exactly one message with `text`, and that `triangles` are left.
std::shared_ptr<const TriangleMesh> expectOneMessage(const MeshDesc& desc, const std::string& text,
                                                     size_t triangles) {
    Messages messages;
    const auto mesh = buildTriangleMesh(desc, messages.sink());
    EXPECT_EQ(messages.texts.size(), 1u) << testing::PrintToString(messages.texts);
    if (!messages.texts.empty()) {
        EXPECT_THAT(messages.texts[0], AllOf(HasSubstr(desc.name + ": "), HasSubstr(text)));
    }
    EXPECT_EQ(mesh->triangles.size(), triangles);
    return mesh;
}

TEST(BadInput, EmptyMesh) {
    MeshDesc desc;
    desc.name = "/empty";
    expectOneMessage(desc, "mesh is empty (0 points, 0 faces)", 0);
    desc.points = {{0, 0, 0}};
    expectOneMessage(desc, "mesh is empty (1 points, 0 faces)", 0);
    desc = grid(1);
    desc.points.clear();
    expectOneMessage(desc, "mesh is empty (0 points, 1 faces)", 0);
}

TEST(BadInput, NaNAndInfinitePoints) {
    MeshDesc desc = grid(3);
    desc.points[0].x = NaN;
    const auto mesh = expectOneMessage(desc, "1 of 9 faces dropped: points that are NaN or infinite", 16);
    EXPECT_EQ(mesh->positions[0], glm::vec3(0.f));
    desc.points[5].z = std::numeric_limits<float>::infinity();
    expectOneMessage(desc, "4 of 9 faces dropped: points that are NaN or infinite", 10);
    desc.scheme = SubdivisionScheme::CatmullClark;
    desc.refineLevel = 2;
    const auto smooth =
        expectOneMessage(desc, "4 of 9 faces dropped: points that are NaN or infinite", 5 * 32);
    for (const glm::vec3& p : smooth->positions)
        EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
}

TEST(BadInput, WrongFaceVertexCounts) {
    MeshDesc desc = grid(2);
    desc.faceVertexCounts.push_back(4);
    expectOneMessage(
        desc, "faceVertexCounts add up to 20 but there are 16 faceVertexIndices; 1 of 5 faces dropped", 8);
    desc.faceVertexCounts.resize(3);
    expectOneMessage(
        desc, "faceVertexCounts add up to 12 but there are 16 faceVertexIndices; the surplus is ignored", 6);
    desc = grid(2);
    desc.faceVertexCounts[1] = 2147483647;
    expectOneMessage(desc, "faces dropped", 2);
    desc = grid(2);
    desc.faceVertexCounts = {4, 4, 2, 2, 4};
    expectOneMessage(desc, "2 of 5 faces dropped: fewer than 3 vertices", 6);
    desc = grid(2);
    desc.faceVertexCounts.insert(desc.faceVertexCounts.begin(), -5);
    expectOneMessage(desc, "1 of 5 faces dropped: negative faceVertexCounts", 8);
}

TEST(BadInput, OutOfRangeIndices) {
    for (const int index : {-1, 9, 2147483647, -2147483647 - 1}) {
        MeshDesc desc = grid(2);
        desc.faceVertexIndices[5] = index;
        const auto mesh =
            expectOneMessage(desc, "1 of 4 faces dropped: faceVertexIndices outside the points array", 6);
        EXPECT_THAT(mesh->triangleFace, testing::ElementsAre(0, 0, 2, 2, 3, 3));
    }
}

TEST(BadInput, RepeatedVertices) {
    MeshDesc desc = grid(2);
    desc.faceVertexIndices[1] = desc.faceVertexIndices[0]; // a quad that is really a triangle
    EXPECT_EQ(buildQuietly(desc)->triangles.size(), 7u);
    desc.faceVertexIndices[2] = desc.faceVertexIndices[0];
    expectOneMessage(desc, "1 of 4 faces dropped: fewer than 3 different vertices", 6);
    desc.scheme = SubdivisionScheme::CatmullClark;
    desc.refineLevel = 1;
    expectOneMessage(desc, "1 of 4 faces dropped: fewer than 3 different vertices", 3 * 8);
}

TEST(BadInput, HolesAndSubsets) {
    MeshDesc desc = grid(2);
    desc.holeFaces = {1, -1, 4};
    expectOneMessage(desc, "2 hole indices ignored: no such face", 6);
    desc.holeFaces = {1, 1};
    expectOneMessage(desc, "1 hole indices ignored: face already listed", 6);
    desc.holeFaces = {};
    desc.subsets = {{{0, 99}}, {{1}}};
    auto mesh = expectOneMessage(desc, "1 subset face indices ignored: no such face", 8);
    EXPECT_THAT(mesh->triangleSlot, testing::ElementsAre(1, 1, 2, 2, 0, 0, 0, 0));
    desc.subsets = {{{0}}, {{0, 1}}};
    mesh = expectOneMessage(desc, "1 subset face indices ignored: face already listed", 8);
    EXPECT_THAT(mesh->triangleSlot, testing::ElementsAre(1, 1, 2, 2, 0, 0, 0, 0));
}

TEST(BadInput, PrimvarsThatDoNotFit) {
    const std::pair<Interpolation, size_t> domains[] = {{Interpolation::Constant, 1},
                                                        {Interpolation::Uniform, 4},
                                                        {Interpolation::Vertex, 9},
                                                        {Interpolation::FaceVarying, 16}};
    for (const auto& [interpolation, elements] : domains) {
        MeshDesc desc = grid(2);
        desc.primvars = {{"st", interpolation, 2, std::vector<float>(elements * 2 - 1, 1.f), {}}};
        auto mesh =
            expectOneMessage(desc, "primvar 'st' dropped: " + std::to_string(elements - 1) + " values", 8);
        EXPECT_EQ(findPrimvar(*mesh, "st"), nullptr);
        desc.primvars[0].values.resize(elements * 2 + 2);
        mesh = expectOneMessage(desc, "primvar 'st' truncated", 8);
        ASSERT_NE(findPrimvar(*mesh, "st"), nullptr);
        desc.primvars[0].values.resize(elements * 2);
        desc.primvars[0].indices.assign(elements, 0);
        desc.primvars[0].indices[elements - 1] = int(elements);
        expectOneMessage(desc, "primvar 'st' dropped: 1 of " + std::to_string(elements) + " indices outside",
                         8);
        desc.primvars[0].indices.assign(elements, 0);
        desc.primvars[0].indices[0] = -1;
        expectOneMessage(desc, "indices outside", 8);
    }
}

TEST(BadInput, PrimvarsWithBrokenNumbersOrNames) {
    MeshDesc desc = grid(1);
    desc.primvars = {{"c", Interpolation::Vertex, 1, {1, NaN, 3, 4}, {}}};
    const auto mesh = expectOneMessage(desc, "primvar 'c' has 1 NaN or infinite numbers", 2);
    EXPECT_THAT(findPrimvar(*mesh, "c")->values, testing::ElementsAre(1, 0, 3, 4));
    desc.primvars = {{"c", Interpolation::Constant, 5, {1, 2, 3, 4, 5}, {}}};
    expectOneMessage(desc, "primvar 'c' dropped: 5 components", 2);
    desc.primvars = {{"c", Interpolation::Constant, 1, {1}, {}}, {"c", Interpolation::Constant, 1, {2}, {}}};
    EXPECT_EQ(expectOneMessage(desc, "primvar 'c' is given twice", 2)->primvars.size(), 1u);
    desc.primvars = {{"normals", Interpolation::Constant, 2, {1, 2}, {}}};
    expectOneMessage(desc, "normals dropped", 2);
}

TEST(BadInput, CreasesAndCorners) {
    MeshDesc desc = grid(2);
    desc.scheme = SubdivisionScheme::CatmullClark;
    desc.refineLevel = 1;
    const auto crease = [&](std::vector<int> indices, std::vector<int> lengths, std::vector<float> weights) {
        MeshDesc creased = desc;
        creased.creaseIndices = std::move(indices);
        creased.creaseLengths = std::move(lengths);
        creased.creaseWeights = std::move(weights);
        return creased;
    };
    for (const MeshDesc& bad :
         {crease({1, 4, 7}, {2}, {1}), crease({1, 4, 7}, {3}, {}), crease({1, 4}, {1, 1}, {1, 1}),
          crease({1, 4}, {-2}, {1}), crease({1, 4}, {}, {})}) {
        expectOneMessage(bad, "creases ignored", 32);
    }
    EXPECT_EQ(buildQuietly(crease({1, 4, 7}, {3}, {1, 2}))->triangles.size(), 32u);
    EXPECT_EQ(buildQuietly(crease({1, 4, 7}, {3}, {1}))->triangles.size(), 32u);
    expectOneMessage(crease({1, 99}, {2}, {1}), "1 crease edges ignored: vertices outside", 32);
    expectOneMessage(crease({1, 4}, {2}, {NaN}), "1 crease edges ignored", 32);
    expectOneMessage(crease({0, 8}, {2}, {1}), "1 crease edges ignored: the mesh has no such edges", 32);
    desc.cornerIndices = {0, 77};
    desc.cornerWeights = {1, 1};
    expectOneMessage(desc, "1 corners ignored", 32);
    desc.cornerWeights = {1};
    expectOneMessage(desc, "corners ignored: 2 indices but 1 sharpnesses", 32);
}

TEST(BadInput, RefineLevels) {
    MeshDesc desc = grid(1);
    desc.scheme = SubdivisionScheme::CatmullClark;
    desc.refineLevel = -3;
    expectOneMessage(desc, "refine level -3 changed to 0", 2);
    desc.refineLevel = 2147483647;
    expectOneMessage(desc, "changed to 8", 2u << 16);
}

TEST(BadInput, RefinementThatWouldFillTheMemory) {
    // Only the decision: the largest mesh that is still allowed takes gigabytes.
    MeshDesc desc = grid(100);
    desc.scheme = SubdivisionScheme::CatmullClark;
    desc.refineLevel = 8;
    Messages messages;
    geometry::Cage cage = geometry::validateFaces(desc, messages.sink());
    geometry::validateSubdivision(desc, messages.sink(), cage);
    EXPECT_EQ(cage.refineLevel, 5);
    ASSERT_EQ(messages.texts.size(), 1u);
    EXPECT_THAT(messages.texts[0], HasSubstr("refine level 8 changed to 5"));
}

} // namespace
} // namespace hipr::test
