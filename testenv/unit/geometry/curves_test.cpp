// Curves, tubes, ribbons and the shapes of points.
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <gmock/gmock.h>

#include "renderer/api/curves.h"
#include "renderer/geometry/curve_basis.h"

namespace hipr::test {
namespace {

using namespace geometry;

constexpr CurveBasis Cubics[] = {CurveBasis::Bezier, CurveBasis::BSpline, CurveBasis::CatmullRom};

std::vector<std::string> said;

std::shared_ptr<const TriangleMesh> build(const CurvesDesc& desc) {
    said.clear();
    return buildCurves(desc,
                       [](Severity, const std::string&, const std::string& text) { said.push_back(text); });
}

Primvar floats(const char* name, Interpolation interpolation, std::vector<float> values,
               uint32_t components = 1) {
    return {name, interpolation, components, std::move(values), {}};
}

Primvar varying(const char* name, std::vector<float> values) {
    Primvar primvar = floats(name, Interpolation::Vertex, std::move(values));
    primvar.linear = true;
    return primvar;
}

/// A straight line along x of three points, 2 wide.
CurvesDesc line() {
    CurvesDesc desc;
    desc.name = "/line";
    desc.vertexCounts = {3};
    desc.points = {{0, 0, 0}, {3, 0, 0}, {5, 0, 0}};
    desc.width = 2.f;
    return desc;
}

/// By the divergence theorem; positive where all triangles face outwards.
double volume(const TriangleMesh& mesh) {
    double sum = 0;
    for (const glm::uvec3& t : mesh.triangles)
        sum += glm::dot(glm::dvec3(mesh.positions[t.x]),
                        glm::cross(glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z]))) /
               6;
    return sum;
}

glm::vec2 pointOf(CurveBasis basis, CurveWrap wrap, const std::vector<glm::vec2>& points, uint32_t segment,
                  float t, bool tangent = false) {
    const CurveSample s = sampleCurve(basis, wrap, uint32_t(points.size()), segment, t);
    glm::vec2 sum(0.f);
    for (size_t i = 0; i < 4; ++i)
        sum += (tangent ? s.tangent : s.weight)[i] * points[s.point[i]];
    return sum;
}

const std::vector<glm::vec2> Seven = {{0, 0}, {1, 2}, {2, 1}, {4, 0}, {5, 3}, {3, 5}, {1, 4}};

} // namespace

// The table of UsdGeomBasisCurves' documentation.
TEST(CurveBasis, SegmentsAndVaryingValues) {
    struct Case {
        CurveBasis basis;
        CurveWrap wrap;
        uint32_t count, segments, varying;
    };
    for (const Case& c : {Case{CurveBasis::Linear, CurveWrap::Nonperiodic, 4, 3, 4},
                          {CurveBasis::Linear, CurveWrap::Periodic, 4, 4, 4},
                          {CurveBasis::Linear, CurveWrap::Segments, 6, 3, 6},
                          {CurveBasis::Bezier, CurveWrap::Nonperiodic, 7, 2, 3},
                          {CurveBasis::Bezier, CurveWrap::Periodic, 6, 2, 2},
                          {CurveBasis::BSpline, CurveWrap::Nonperiodic, 7, 4, 5},
                          {CurveBasis::BSpline, CurveWrap::Periodic, 7, 7, 7},
                          {CurveBasis::CatmullRom, CurveWrap::Nonperiodic, 4, 1, 2},
                          {CurveBasis::CatmullRom, CurveWrap::Pinned, 4, 3, 4},
                          {CurveBasis::BSpline, CurveWrap::Pinned, 2, 1, 2},
                          {CurveBasis::Bezier, CurveWrap::Nonperiodic, 3, 0, 0},
                          {CurveBasis::Linear, CurveWrap::Nonperiodic, 1, 0, 0},
                          {CurveBasis::CatmullRom, CurveWrap::Nonperiodic, 3, 0, 0}}) {
        EXPECT_EQ(segmentCount(c.basis, c.wrap, c.count), c.segments) << int(c.basis) << int(c.wrap);
        EXPECT_EQ(varyingCount(c.basis, c.wrap, c.count), c.varying) << int(c.basis) << int(c.wrap);
    }
}

TEST(CurveBasis, WeightsSumToOneAndTangentsAreDerivatives) {
    for (CurveBasis basis : Cubics)
        for (CurveWrap wrap : {CurveWrap::Nonperiodic, CurveWrap::Periodic, CurveWrap::Pinned})
            for (uint32_t segment = 0; segment < segmentCount(basis, wrap, 7); ++segment)
                for (float t : {0.1f, 0.5f, 0.9f}) {
                    const CurveSample s = sampleCurve(basis, wrap, 7, segment, t);
                    EXPECT_NEAR(s.weight[0] + s.weight[1] + s.weight[2] + s.weight[3], 1.f, 1e-6f);
                    const float h = 1e-3f;
                    const glm::vec2 difference = (pointOf(basis, wrap, Seven, segment, t + h) -
                                                  pointOf(basis, wrap, Seven, segment, t - h)) /
                                                 (2 * h);
                    const glm::vec2 tangent = pointOf(basis, wrap, Seven, segment, t, true);
                    EXPECT_LT(glm::length(difference - tangent), 5e-3f) << int(basis) << int(wrap) << segment;
                }
}

// Segments join, closed curves close, pinned ones reach both ends, and Catmull-Rom splines pass through their
// points.
TEST(CurveBasis, CurvesAreContinuous) {
    const auto expectNear = [](glm::vec2 a, glm::vec2 b) { EXPECT_LT(glm::length(a - b), 1e-5f); };
    for (CurveBasis basis : Cubics)
        for (CurveWrap wrap : {CurveWrap::Nonperiodic, CurveWrap::Periodic, CurveWrap::Pinned}) {
            const std::vector<glm::vec2> points(Seven.begin(), Seven.end() - (wrap == CurveWrap::Periodic));
            const uint32_t n = segmentCount(basis, wrap, uint32_t(points.size()));
            for (uint32_t segment = 0; segment + 1 < n; ++segment)
                expectNear(pointOf(basis, wrap, points, segment, 1),
                           pointOf(basis, wrap, points, segment + 1, 0));
            if (wrap == CurveWrap::Periodic)
                expectNear(pointOf(basis, wrap, points, n - 1, 1), pointOf(basis, wrap, points, 0, 0));
        }
    for (CurveBasis basis : Cubics) {
        const uint32_t n = segmentCount(basis, CurveWrap::Pinned, 7);
        expectNear(pointOf(basis, CurveWrap::Pinned, Seven, 0, 0), Seven.front());
        expectNear(pointOf(basis, CurveWrap::Pinned, Seven, n - 1, 1), Seven.back());
    }
    for (uint32_t segment = 0; segment < 4; ++segment)
        expectNear(pointOf(CurveBasis::CatmullRom, CurveWrap::Nonperiodic, Seven, segment, 0),
                   Seven[segment + 1]);
}

TEST(Curves, ATubeIsAClosedPrism) {
    const auto mesh = build(line());
    EXPECT_TRUE(said.empty());
    const double sides = 16, area = 0.5 * sides * std::sin(2 * glm::pi<double>() / sides);
    EXPECT_NEAR(volume(*mesh), 5 * area, 1e-4);
    ASSERT_EQ(mesh->normals.size(), mesh->positions.size());
    for (size_t i = 0; i < mesh->positions.size(); ++i) {
        EXPECT_NEAR(glm::length(mesh->normals[i]), 1.f, 1e-5f);
        EXPECT_NEAR(glm::length(glm::vec2(mesh->positions[i].y, mesh->positions[i].z)), 1.f, 1e-5f);
    }
    EXPECT_EQ(mesh->boundsMin.x, 0.f);
    EXPECT_EQ(mesh->boundsMax.x, 5.f);
}

// A ring: Pappus' theorem gives its volume.
TEST(Curves, ARingHasTheVolumeOfARing) {
    CurvesDesc desc = line();
    desc.basis = CurveBasis::CatmullRom;
    desc.wrap = CurveWrap::Periodic;
    desc.width = 0.2f;
    desc.points.clear();
    for (int i = 0; i < 24; ++i)
        desc.points.push_back({std::cos(glm::two_pi<float>() * float(i) / 24),
                               std::sin(glm::two_pi<float>() * float(i) / 24), 0});
    desc.vertexCounts = {24};
    const double area = 0.5 * 16 * std::sin(glm::pi<double>() / 8) * 0.01;
    EXPECT_NEAR(volume(*build(desc)), 2 * glm::pi<double>() * area, 0.01 * 2 * glm::pi<double>() * area);
}

TEST(Curves, WidthsOfEveryRate) {
    const auto radiusAt = [](const TriangleMesh& mesh, float x) {
        float radius = -1;
        for (const glm::vec3& p : mesh.positions)
            if (std::abs(p.x - x) < 1e-4f) radius = std::max(radius, glm::length(glm::vec2(p.y, p.z)));
        return radius;
    };
    CurvesDesc desc = line();
    desc.primvars = {floats("widths", Interpolation::Vertex, {1, 2, 4})};
    EXPECT_NEAR(radiusAt(*build(desc), 3), 1.f, 1e-5f);
    EXPECT_NEAR(radiusAt(*build(desc), 5), 2.f, 1e-5f);
    desc.primvars = {varying("widths", {4, 6, 8})};
    EXPECT_NEAR(radiusAt(*build(desc), 0), 2.f, 1e-5f);
    desc.primvars = {floats("widths", Interpolation::Uniform, {3})};
    EXPECT_NEAR(radiusAt(*build(desc), 0), 1.5f, 1e-5f);
    desc.primvars = {floats("widths", Interpolation::Vertex, {1, 2})}; // one is missing
    EXPECT_NEAR(radiusAt(*build(desc), 0), 1.f, 1e-5f) << "the default";
    EXPECT_THAT(said, testing::ElementsAre(testing::HasSubstr("widths")));
    desc.primvars = {floats("widths", Interpolation::Constant, {-4})};
    EXPECT_NEAR(radiusAt(*build(desc), 0), 0.f, 1e-5f);
}

TEST(Curves, NormalsMakeRibbonsThatFaceThem) {
    CurvesDesc desc = line();
    desc.primvars = {floats("normals", Interpolation::Constant, {0, 0, 2}, 3)};
    const auto mesh = build(desc);
    EXPECT_TRUE(mesh->doubleSided);
    EXPECT_EQ(mesh->triangles.size(), 4u);
    EXPECT_EQ(mesh->boundsMin, glm::vec3(0, -1, 0));
    EXPECT_EQ(mesh->boundsMax, glm::vec3(5, 1, 0));
    for (const glm::vec3& n : mesh->normals)
        EXPECT_EQ(n, glm::vec3(0, 0, 1));
}

TEST(Curves, PrimvarsFollowTheirRate) {
    CurvesDesc desc = line();
    desc.vertexCounts = {3, 2};
    desc.points.insert(desc.points.end(), {{0, 4, 0}, {5, 4, 0}});
    desc.primvars = {floats("c", Interpolation::Constant, {7}), floats("u", Interpolation::Uniform, {1, 2}),
                     floats("p", Interpolation::Vertex, {0, 3, 5, 10, 20}), varying("v", {1, 2, 3, 4, 5})};
    const auto mesh = build(desc);
    ASSERT_EQ(mesh->primvars.size(), 4u);
    EXPECT_THAT(mesh->primvars[0].values, testing::ElementsAre(7));
    ASSERT_EQ(mesh->primvars[1].values.size(), mesh->triangles.size());
    for (size_t t = 0; t < mesh->triangles.size(); ++t)
        EXPECT_EQ(mesh->primvars[1].values[t], float(mesh->triangleFace[t] + 1));
    for (size_t i = 0; i < mesh->positions.size(); ++i) {
        const glm::vec3& at = mesh->positions[i];
        const bool second = at.y > 2;
        EXPECT_NEAR(mesh->primvars[2].values[i], second ? 10 + 2 * at.x : at.x, 1e-4f);
        EXPECT_NEAR(mesh->primvars[3].values[i],
                    second ? 4 + at.x / 5 : (at.x < 3 ? 1 + at.x / 3 : 2 + (at.x - 3) / 2), 1e-4f);
    }
}

TEST(Curves, PairsOfPointsAreLines) {
    CurvesDesc desc = line();
    desc.wrap = CurveWrap::Segments;
    desc.vertexCounts = {6};
    desc.pointIndices = {0, 1, 0, 2, 1, 2};
    desc.hiddenCurves = {3};
    const auto one = build(line());
    EXPECT_EQ(build(desc)->triangles.size(), 3 * (16 * 2 + 2 * 14)) << "three tubes with two caps each";
    desc.hiddenCurves = {0};
    EXPECT_TRUE(build(desc)->triangles.empty());
}

TEST(Curves, BadDataIsDroppedAndNamed) {
    CurvesDesc desc = line();
    desc.vertexCounts = {1, 2, -3, 2, 9};
    desc.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {NAN, 0, 0}, {1, 1, 1}};
    const auto mesh = build(desc);
    EXPECT_FALSE(mesh->triangles.empty());
    EXPECT_THAT(said,
                testing::UnorderedElementsAre(testing::HasSubstr("2 curves dropped: too few"),
                                              testing::HasSubstr("1 curve dropped: control points"),
                                              testing::HasSubstr("1 curve dropped: their control points")));
    desc = line();
    desc.points = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    EXPECT_TRUE(build(desc)->triangles.empty()) << "no direction";
    desc = line();
    desc.pointIndices = {0, 1, 77};
    EXPECT_TRUE(build(desc)->triangles.empty());
    desc = line();
    desc.primvars = {floats("widths", Interpolation::Constant, {NAN}),
                     floats("nine", Interpolation::Constant, {}, 9)};
    EXPECT_FALSE(build(desc)->triangles.empty());
    EXPECT_EQ(said.size(), 2u);
}

// Hair must not eat the machine: what is straight is one segment.
TEST(Curves, HairIsMadeOfRoundSegments) {
    CurvesDesc desc;
    desc.basis = CurveBasis::BSpline;
    desc.vertexCounts.assign(300000, 4);
    for (int i = 0; i < 300000; ++i)
        for (int k = 0; k < 4; ++k)
            desc.points.push_back({float(i), float(k), 0});
    desc.primvars = {floats("widths", Interpolation::Constant, {0.5f}),
                     floats("u", Interpolation::Uniform, std::vector<float>(300000, 3.f))};
    const auto mesh = build(desc);
    EXPECT_TRUE(mesh->triangles.empty());
    ASSERT_EQ(mesh->segments.size(), 300000u);
    EXPECT_EQ(mesh->positions.size(), 300000u * 4) << "two vertices, and one beyond each";
    EXPECT_EQ(mesh->primvars[0].values.size(), 300000u) << "one a curve";
    const uint32_t first = mesh->segments[77];
    EXPECT_EQ(mesh->triangleFace[77], 77u);
    EXPECT_LT(glm::length(mesh->positions[first] - glm::vec3(77, 1, 0)), 1e-5f);
    EXPECT_LT(glm::length(mesh->positions[first + 1] - glm::vec3(77, 2, 0)), 1e-5f);
    EXPECT_EQ(mesh->radii[first], 0.25f);
    EXPECT_NEAR(mesh->boundsMin.y, 0.75f, 1e-5f);
    EXPECT_NEAR(mesh->boundsMax.x, 299999.25f, 1e-1f);
}

namespace {

/// Two arcs, a third of a circle of radius 1 each, that are `width` wide.
CurvesDesc arcs(float width, CurveWrap wrap = CurveWrap::Nonperiodic) {
    CurvesDesc desc;
    desc.basis = CurveBasis::CatmullRom;
    desc.wrap = wrap;
    for (int curve = 0; curve < 2; ++curve) {
        desc.vertexCounts.push_back(7);
        for (int k = 0; k < 7; ++k) {
            const float angle = glm::two_pi<float>() * float(k) / 7;
            desc.points.push_back({std::cos(angle), std::sin(angle), float(curve)});
        }
    }
    desc.width = width;
    return desc;
}

} // namespace

TEST(Curves, RoundSegmentsStayCloseToTheCurve) {
    for (const CurveWrap wrap : {CurveWrap::Nonperiodic, CurveWrap::Pinned, CurveWrap::Periodic}) {
        size_t coarser = 0;
        for (const int level : {0, 1, 2}) {
            CurvesDesc desc = arcs(0.01f, wrap);
            desc.refineLevel = level;
            desc.primvars = {floats("x", Interpolation::Vertex, {})};
            for (const glm::vec3& p : desc.points)
                desc.primvars[0].values.push_back(p.x);
            const auto mesh = build(desc);
            ASSERT_GT(mesh->segments.size(), coarser);
            coarser = mesh->segments.size();
            const float chord = 2 * std::sin(glm::pi<float>() / 7);
            const float allowed = 0.01f * chord / float(1 << (2 * level));
            std::vector<glm::vec2> controls, curve; // the latter in small steps
            for (int k = 0; k < 7; ++k)
                controls.push_back(glm::vec2(desc.points[size_t(k)]));
            for (uint32_t segment = 0; segment < segmentCount(desc.basis, wrap, 7); ++segment)
                for (int step = 0; step < 500; ++step)
                    curve.push_back(pointOf(desc.basis, wrap, controls, segment, float(step) / 499));
            for (const uint32_t i : mesh->segments) {
                const glm::vec3 a = mesh->positions[i], b = mesh->positions[i + 1], middle = 0.5f * (a + b);
                float away = 1;
                for (const glm::vec2& p : curve)
                    away = std::min(away, glm::length(p - glm::vec2(middle)));
                EXPECT_LT(away, 1.05f * allowed + 1e-3f) << level; // and half a small step
                EXPECT_NEAR(mesh->primvars[0].values[i], a.x, 1e-5f);
                // On either side is the neighbour, or the end once more.
                const glm::vec3 before = mesh->positions[i - 1], after = mesh->positions[i + 2];
                EXPECT_TRUE(before == a || glm::dot(a - before, b - a) > 0);
                EXPECT_TRUE(after == b || glm::dot(after - b, b - a) > 0);
                EXPECT_TRUE(wrap != CurveWrap::Periodic || (before != a && after != b));
            }
        }
    }
}

TEST(Curves, FormFollowsWidthAndIsKept) {
    EXPECT_FALSE(curveForm(arcs(0.1f)).round) << "some 50 widths long";
    const CurveForm thin = curveForm(arcs(0.01f));
    EXPECT_TRUE(thin.round);
    EXPECT_EQ(thin.steps.size(), 2u * 4) << "one for each cubic";
    CurvesDesc ribbon = arcs(0.01f);
    ribbon.primvars = {floats("normals", Interpolation::Constant, {0, 0, 1}, 3)};
    EXPECT_FALSE(curveForm(ribbon).round);
    const auto mesh = build(arcs(0.01f));
    CurvesDesc straight = arcs(0.01f);
    for (size_t i = 0; i < straight.points.size(); ++i)
        straight.points[i] = glm::vec3(float(i % 7), 0, float(i / 7));
    EXPECT_NE(build(straight)->segments, mesh->segments) << "needs no steps";
    straight.form = thin;
    const auto moved = build(straight);
    EXPECT_EQ(moved->segments, mesh->segments);
    EXPECT_TRUE(withMotion(*mesh, {{0.f, mesh}, {1.f, moved}}));
}

TEST(Curves, UnitShapes) {
    const auto sphere = unitSphere("/s", 3);
    EXPECT_EQ(sphere->triangles.size(), 20u * 64);
    EXPECT_NEAR(volume(*sphere), 4 * glm::pi<double>() / 3, 0.02 * 4);
    for (const glm::vec3& p : sphere->positions)
        EXPECT_NEAR(glm::length(p), 1.f, 1e-6f);
    const auto disk = unitDisk("/d", 24);
    EXPECT_EQ(disk->triangles.size(), 24u);
    EXPECT_TRUE(disk->doubleSided);
}

} // namespace hipr::test
