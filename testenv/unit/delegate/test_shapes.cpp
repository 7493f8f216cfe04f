/// Curves and points through Hydra: where they are seen, how wide, in which colour.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testenv/unit/delegate/test_host.h"
#include "testenv/unit/delegate/test_warnings.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

const GfVec3f red(0.8f, 0.f, 0.f), green(0.f, 0.8f, 0.f);

/// A picture of 2 x 2 units in a white sky.
struct Shapes : testing::Test {
    Shapes() : host({"color", "primId", "instanceId", "elementId"}, 4) {
        host.setViewSize(2.0);
        host.scene().addDome(SdfPath("/dome"));
    }
    bool seenAt(double x, double y) { return host.readInt("primId", x / 2, y / 2) >= 0; }
    bool redAt(double x, double y) {
        const GfVec4f color = host.readColor(x / 2, y / 2);
        return color[0] > 2 * color[1];
    }
    void setTopology(TestScene::Prim& prim, TfToken const& type, TfToken const& wrap,
                     VtIntArray const& counts, VtIntArray const& indices = VtIntArray()) {
        prim.curves = HdBasisCurvesTopology(type, HdTokens->bezier, wrap, counts, indices);
    }
    template <class T>
    void set(TestScene::Prim& prim, TfToken const& name, HdInterpolation rate, T const& value) {
        prim.primvars[name] = {rate, VtValue(value)};
    }

    TestHost host;
    TestWarnings warnings;
};

// A level line, 0.2 wide: seen 0.09 beside its middle, not 0.13.
TEST_F(Shapes, aLineIsAsWideAsItSays) {
    auto& line = host.scene().addCurve(SdfPath("/line"), red);
    set(line, HdTokens->points, HdInterpolationVertex, VtVec3fArray{{-0.5f, 0, 0}, {0, 0, 0}, {0.5f, 0, 0}});
    ASSERT_TRUE(host.render());
    EXPECT_TRUE(seenAt(0.2, 0.05) && seenAt(0.2, -0.05) && redAt(0.2, 0));
    EXPECT_FALSE(seenAt(0.2, 0.16) || seenAt(0.2, -0.16) || seenAt(0.6, 0));
    // Twice as wide at its end.
    set(line, HdTokens->widths, HdInterpolationVertex, VtFloatArray{0.2f, 0.2f, 1.f});
    host.scene().tracker().MarkRprimDirty(SdfPath("/line"), HdChangeTracker::DirtyWidths);
    ASSERT_TRUE(host.render());
    EXPECT_TRUE(seenAt(0.45, 0.35));
    EXPECT_FALSE(seenAt(-0.2, 0.16));
}

TEST_F(Shapes, cubicCurvesBend) {
    auto& curve = host.scene().addCurve(SdfPath("/arch"), red);
    setTopology(curve, HdTokens->cubic, HdTokens->nonperiodic, {4});
    set(curve, HdTokens->points, HdInterpolationVertex,
        VtVec3fArray{{-0.6f, -0.5f, 0}, {-0.6f, 0.7f, 0}, {0.6f, 0.7f, 0}, {0.6f, -0.5f, 0}});
    ASSERT_TRUE(host.render());
    EXPECT_TRUE(seenAt(0, 0.4)) << "the middle of a Bezier curve is 3/4 of the way to its handles";
    EXPECT_FALSE(seenAt(0, 0.7) || seenAt(0, -0.5));
}

// Two curves that share points through indices; the second is green.
TEST_F(Shapes, indicesAndUniformColours) {
    auto& lines = host.scene().addCurve(SdfPath("/lines"), red);
    setTopology(lines, HdTokens->linear, HdTokens->nonperiodic, {2, 2}, {0, 1, 0, 2});
    set(lines, HdTokens->points, HdInterpolationVertex, VtVec3fArray{{0, 0, 0}, {0.8f, 0, 0}, {0, 0.8f, 0}});
    set(lines, HdTokens->displayColor, HdInterpolationUniform, VtVec3fArray{red, green});
    ASSERT_TRUE(host.render());
    EXPECT_TRUE(redAt(0.6, 0));
    EXPECT_TRUE(seenAt(0, 0.6));
    EXPECT_FALSE(redAt(0, 0.6));
    EXPECT_EQ(host.readInt("elementId", 0.3, 0), 0);
    EXPECT_EQ(host.readInt("elementId", 0, 0.3), 1);
}

TEST_F(Shapes, linesOfDrawModesAreThin) {
    auto& lines = host.scene().addCurve(SdfPath("/axes"), red);
    setTopology(lines, HdTokens->linear, HdTokens->segmented, {4});
    set(lines, HdTokens->points, HdInterpolationVertex,
        VtVec3fArray{{-0.8f, 0, 0}, {0.8f, 0, 0}, {0, -0.8f, 0}, {0, 0.8f, 0}});
    set(lines, HdTokens->widths, HdInterpolationConstant, VtFloatArray{1.f}); // as UsdImaging says
    ASSERT_TRUE(host.render());
    EXPECT_FALSE(seenAt(0.4, 0.1) || seenAt(0.1, 0.4));
}

TEST_F(Shapes, pointsAreSpheresOfTheirWidthAndColour) {
    host.scene().addPoints(SdfPath("/dots"), {red, green});
    ASSERT_TRUE(host.render());
    EXPECT_TRUE(redAt(-0.25, 0));
    EXPECT_TRUE(seenAt(0.25, 0.15));
    EXPECT_FALSE(redAt(0.25, 0) || seenAt(0.25, 0.27) || seenAt(0, 0.1));
    EXPECT_EQ(host.readInt("instanceId", 0.125, 0), 0) << "not the point: picking asks for instances";
}

TEST_F(Shapes, pointsOfAnInstancer) {
    host.scene().addInstancer(SdfPath("/many"), SdfPath("/many.dots"), {{0, 0.5f, 0}, {0, -0.5f, 0}});
    host.scene().addPoints(SdfPath("/many.dots"), {red, green}, SdfPath("/many"));
    ASSERT_TRUE(host.render());
    EXPECT_TRUE(redAt(-0.25, 0.5) && redAt(-0.25, -0.5) && seenAt(0.25, 0.5) && seenAt(0.25, -0.5));
    EXPECT_FALSE(redAt(0.25, 0.5) || redAt(0.25, -0.5) || seenAt(0.25, 0));
    EXPECT_EQ(host.readInt("instanceId", 0.125, 0.25), 0);
    EXPECT_EQ(host.readInt("instanceId", 0.125, -0.25), 1);
}

TEST_F(Shapes, brokenOnesAreNamedOnce) {
    const float nan = std::nanf("");
    auto& curve = host.scene().addCurve(SdfPath("/broken_curve"), red);
    setTopology(curve, HdTokens->linear, HdTokens->nonperiodic, {1, 2, 2, 7});
    set(curve, HdTokens->points, HdInterpolationVertex,
        VtVec3fArray{{0, 0, 0}, {-0.8f, 0.5f, 0}, {0.8f, 0.5f, 0}, {nan, 0, 0}, {0, 0, 0}, {1, 1, 1}});
    auto& points = host.scene().addPoints(SdfPath("/broken_points"), {red, green});
    set(points, HdTokens->points, HdInterpolationVertex, VtVec3fArray{{nan, 0, 0}, {0.25f, 0, 0}});
    ASSERT_TRUE(host.render());
    EXPECT_TRUE(seenAt(0, 0.5)) << "the second curve";
    EXPECT_TRUE(seenAt(0.25, 0)) << "the second point";
    EXPECT_THAT(warnings.texts(), testing::UnorderedElementsAre(
                                      testing::HasSubstr("too few"), testing::HasSubstr("beyond the end"),
                                      testing::HasSubstr("NaN"), testing::HasSubstr("1 point dropped")));
}

} // namespace
