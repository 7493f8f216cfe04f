// Triangulation against area and edge oracles, orientation, holes and material slots.
#include <map>
#include <random>

#include <gmock/gmock.h>

#include "test_mesh.h"

namespace hipr::test {
namespace {

/// Area vector of a polygon by Newell's formula, independent of any triangulation.
glm::dvec3 newellArea(const std::vector<glm::vec3>& points) {
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < points.size(); ++i) {
        sum += glm::cross(glm::dvec3(points[i]), glm::dvec3(points[(i + 1) % points.size()]));
    }
    return 0.5 * sum;
}

/// Every polygon edge once in its own direction, every cut once each way: no crack, no overlap, no
/// T-junction.
void expectEdgesMatch(const TriangleMesh& mesh, const std::vector<int>& outline) {
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (const glm::uvec3& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k)
            ++edges[{t[k], t[(k + 1) % 3]}];
    }
    for (size_t i = 0; i < outline.size(); ++i) {
        --edges[{uint32_t(outline[i]), uint32_t(outline[(i + 1) % outline.size()])}];
    }
    for (const auto& [edge, count] : edges) {
        if (count == 0) continue;
        const auto opposite = edges.find({edge.second, edge.first});
        EXPECT_TRUE(opposite != edges.end() && opposite->second == count)
            << "edge " << edge.first << " - " << edge.second;
    }
}

/// The triangles face the polygon's way and their areas add up to its area, so that none overlap or stick
/// out.
void expectCovers(const MeshDesc& desc) {
    const auto mesh = buildQuietly(desc);
    const glm::dvec3 expected = newellArea(desc.points);
    const double size = glm::length(expected);
    EXPECT_EQ(mesh->triangles.size(), desc.points.size() - 2);
    EXPECT_NEAR(area(*mesh), size, 1e-5 * size);
    for (size_t t = 0; t < mesh->triangles.size(); ++t) {
        EXPECT_GT(glm::dot(areaVector(*mesh, t), expected), -1e-7 * size * size);
    }
    expectEdgesMatch(*mesh, desc.faceVertexIndices);
}

/// Points in the plane, turned and moved in space.
std::vector<glm::vec3> inSpace(const std::vector<glm::dvec2>& points, std::mt19937& random) {
    std::normal_distribution<double> gauss;
    const glm::dvec3 u = glm::normalize(glm::dvec3(gauss(random), gauss(random), gauss(random)));
    const glm::dvec3 v =
        glm::normalize(glm::cross(u, glm::dvec3(gauss(random), gauss(random), gauss(random))));
    const glm::dvec3 origin(gauss(random), gauss(random), gauss(random));
    std::vector<glm::vec3> result;
    for (const glm::dvec2& p : points)
        result.emplace_back(origin + p.x * u + p.y * v);
    return result;
}

TEST(Polygon, RandomStarShapedPolygonsOfAnySize) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> radius(0.2, 2.0);
    for (int n = 4; n < 60; ++n) {
        for (int repeat = 0; repeat < 20; ++repeat) {
            std::vector<glm::dvec2> points;
            for (int i = 0; i < n; ++i) {
                const double angle = 6.283185307179586 * i / n;
                points.push_back(radius(random) * glm::dvec2(std::cos(angle), std::sin(angle)));
            }
            expectCovers(polygon(inSpace(points, random)));
        }
    }
}

TEST(Polygon, CombsAndSpirals) {
    std::mt19937 random(2);
    for (int teeth = 2; teeth < 20; ++teeth) {
        std::vector<glm::dvec2> comb{{2.0 * teeth, -1.0}};
        for (int i = teeth - 1; i >= 0; --i) {
            comb.insert(comb.end(), {{2.0 * i + 1.5, 3.0}, {2.0 * i + 1.0, 0.0}, {2.0 * i + 0.5, 3.0}});
            comb.push_back({2.0 * i, 0.0});
        }
        comb.push_back({0.0, -1.0});
        std::reverse(comb.begin(), comb.end());
        expectCovers(polygon(inSpace(comb, random)));

        std::vector<glm::dvec2> spiral;
        for (int i = 0; i <= 6 * teeth; ++i) {
            const double angle = 0.5 * i;
            spiral.push_back((1.0 + angle) * glm::dvec2(std::cos(angle), std::sin(angle)));
        }
        for (int i = 6 * teeth; i >= 0; --i) {
            const double angle = 0.5 * i;
            spiral.push_back((0.5 + angle) * glm::dvec2(std::cos(angle), std::sin(angle)));
        }
        std::reverse(spiral.begin(), spiral.end());
        expectCovers(polygon(inSpace(spiral, random)));
    }
}

TEST(Polygon, CollinearCornersLeaveNoTJunction) {
    expectCovers(polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 2, 0}, {0.5f, 1, 0}}));
    expectCovers(polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}, {0, 2, 0}, {0, 1, 0}}));
}

TEST(Polygon, ConcaveQuadIsCutThroughItsConcaveCornerWhateverComesFirst) {
    const std::vector<glm::vec3> arrow{{0, 0, 0}, {2, -1, 0}, {1, 0, 0}, {2, 1, 0}};
    for (size_t start = 0; start < 4; ++start) {
        std::vector<glm::vec3> points;
        for (size_t i = 0; i < 4; ++i)
            points.push_back(arrow[(start + i) % 4]);
        expectCovers(polygon(points));
    }
}

TEST(Polygon, RingWithABridgeKeepsItsHoleOpen) {
    MeshDesc desc =
        polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}});
    desc.faceVertexCounts = {10};
    desc.faceVertexIndices = {0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
    const auto mesh = buildQuietly(desc);
    EXPECT_NEAR(area(*mesh), 12.0, 1e-6);
    for (size_t t = 0; t < mesh->triangles.size(); ++t)
        EXPECT_GE(areaVector(*mesh, t).z, 0.0);
}

TEST(Polygon, NonPlanarAndSelfCrossingPolygonsKeepTheirCorners) {
    expectEdgesMatch(
        *buildQuietly(polygon({{0, 0, 0}, {1, 0, 1}, {2, 0, 0}, {2, 2, 1}, {1, 1, -1}, {0, 2, 1}})),
        {0, 1, 2, 3, 4, 5});
    std::vector<glm::vec3> pentagram;
    for (int i = 0; i < 5; ++i)
        pentagram.emplace_back(std::cos(i * 2.51327), std::sin(i * 2.51327), 0);
    EXPECT_EQ(buildQuietly(polygon(pentagram))->triangles.size(), 3u);
    EXPECT_EQ(buildQuietly(polygon(std::vector<glm::vec3>(6, glm::vec3(1))))->triangles.size(), 4u);
}

TEST(Polygon, CubeFacesOutwardInBothOrientations) {
    MeshDesc desc = cube();
    auto mesh = buildQuietly(desc);
    EXPECT_EQ(mesh->triangles.size(), 12u);
    EXPECT_NEAR(area(*mesh), 24.0, 1e-9);
    EXPECT_NEAR(volume(*mesh), 8.0, 1e-9);
    EXPECT_EQ(mesh->boundsMin, glm::vec3(-1));
    EXPECT_EQ(mesh->boundsMax, glm::vec3(1));

    desc.leftHanded = true; // the same indices now mean the other side
    EXPECT_NEAR(volume(*buildQuietly(desc)), -8.0, 1e-9);
    for (size_t face = 0; face < 6; ++face) {
        std::reverse(desc.faceVertexIndices.begin() + long(4 * face),
                     desc.faceVertexIndices.begin() + long(4 * face + 4));
    }
    EXPECT_NEAR(volume(*buildQuietly(desc)), 8.0, 1e-9);
}

TEST(Polygon, HolesAreLeftOutAndFacesKeepTheirNumbers) {
    MeshDesc desc = grid(3);
    desc.holeFaces = {4};
    const auto mesh = buildQuietly(desc);
    EXPECT_NEAR(area(*mesh), 8.0, 1e-9);
    EXPECT_THAT(mesh->triangleFace, testing::ElementsAre(0, 0, 1, 1, 2, 2, 3, 3, 5, 5, 6, 6, 7, 7, 8, 8));
}

TEST(Polygon, SubsetsBecomeSlots) {
    MeshDesc desc = grid(2);
    EXPECT_TRUE(buildQuietly(desc)->triangleSlot.empty());
    desc.subsets = {{{3}}, {{0, 1}}};
    EXPECT_THAT(buildQuietly(desc)->triangleSlot, testing::ElementsAre(2, 2, 2, 2, 0, 0, 1, 1));
}

TEST(Polygon, UnusedPointsDoNotWidenTheBounds) {
    MeshDesc desc = cube();
    desc.points.emplace_back(100, 100, 100);
    const auto mesh = buildQuietly(desc);
    EXPECT_EQ(mesh->boundsMax, glm::vec3(1));
    EXPECT_EQ(mesh->positions.size(), 9u);
}

} // namespace
} // namespace hipr::test
