/// Instances: placement, nesting, ids as Hydra's picking decodes them, primvars.
#include <gtest/gtest.h>

#include "pxr/base/gf/quath.h"
#include "testenv/unit/delegate/test_host.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

const SdfPath inner("/inner"), outer("/outer"), square("/inner.square"), dome("/dome");

struct Instances : testing::Test {
    Instances() {
        host.setViewSize(8.0);
        host.scene().addDome(dome);
    }
    int instanceAt(double x, double y) { return host.readInt("instanceId", x / 8, y / 8); }
    TestHost host;
};

TEST_F(Instances, areWhereTheInstancerPutsThem) {
    host.scene().addInstancer(inner, square, {{-2, 0, 0}, {0, 1, 0}, {2, 0, 0}});
    host.scene().addSquare(square, GfVec3f(0.5f), inner);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(instanceAt(-2, 0), 0);
    EXPECT_EQ(instanceAt(0, 1), 1);
    EXPECT_EQ(instanceAt(2, 0), 2);
    EXPECT_EQ(instanceAt(0, 0), -1);
}

TEST_F(Instances, ofNestedInstancersAreNumberedOuterFirst) {
    host.scene().addInstancer(outer, inner, {{0, -2, 0}, {0, 2, 0}});
    host.scene().addInstancer(inner, square, {{-2, 0, 0}, {0, 0, 0}, {2, 0, 0}}, outer);
    host.scene().addSquare(square, GfVec3f(0.5f), inner);
    ASSERT_TRUE(host.render());
    for (int o = 0; o < 2; ++o) {
        for (int i = 0; i < 3; ++i) {
            EXPECT_EQ(instanceAt(2 * i - 2, 4 * o - 2), o * 3 + i);
        }
    }
}

TEST_F(Instances, followEveryTransformPrimvarInHydrasOrder) {
    auto& prim = host.scene().addInstancer(inner, square, {{2, 0, 0}, {-2, 0, 0}});
    const float s = std::sqrt(0.5f);
    // Scaled to 2 x 1/2, then turned a quarter, then moved: tall boxes. Both forms of quaternion.
    prim.primvars[TfToken("rotate")] = {HdInterpolationInstance,
                                        VtValue(VtVec4fArray{{s, 0, 0, s}, {s, 0, 0, s}})};
    prim.primvars[TfToken("scale")] = {HdInterpolationInstance,
                                       VtValue(VtVec3fArray{{2, 0.5f, 1}, {2, 0.5f, 1}})};
    host.scene().addSquare(square, GfVec3f(0.5f), inner);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(instanceAt(2, 0.8), 0);
    EXPECT_EQ(instanceAt(2.8, 0), -1);
    prim.primvars[TfToken("rotate")].value = VtValue(VtQuathArray{GfQuath(1), GfQuath(1)});
    host.scene().tracker().MarkInstancerDirty(inner, HdChangeTracker::DirtyPrimvar);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(instanceAt(2, 0.8), -1);
    EXPECT_EQ(instanceAt(2.8, 0), 0);
}

TEST_F(Instances, disappearWhenTheirIndicesDo) {
    auto& prim = host.scene().addInstancer(inner, square, {{-2, 0, 0}, {2, 0, 0}});
    host.scene().addSquare(square, GfVec3f(0.5f), inner);
    ASSERT_TRUE(host.render());
    prim.indices[square] = {1};
    host.scene().tracker().MarkInstancerDirty(inner, HdChangeTracker::DirtyInstanceIndex);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(instanceAt(-2, 0), -1);
    EXPECT_EQ(instanceAt(2, 0), 0);
    prim.indices[square] = {};
    host.scene().tracker().MarkInstancerDirty(inner, HdChangeTracker::DirtyInstanceIndex);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(instanceAt(2, 0), -1);
}

TEST_F(Instances, haveTheirOwnPrimvars) {
    auto& prim = host.scene().addInstancer(inner, square, {{-2, 0, 0}, {2, 0, 0}});
    prim.primvars[HdTokens->displayColor] = {HdInterpolationInstance,
                                             VtValue(VtVec3fArray{{0.8f, 0, 0}, {0, 0.8f, 0}})};
    host.scene().addSquare(square, GfVec3f(0.5f), inner);
    ASSERT_TRUE(host.render());
    const GfVec4f left = host.readColor(-0.25, 0), right = host.readColor(0.25, 0);
    EXPECT_GT(left[0], left[1] + 0.3f);
    EXPECT_GT(right[1], right[0] + 0.3f);
}

TEST_F(Instances, withTooShortPrimvarsStillRender) {
    auto& prim = host.scene().addInstancer(inner, square, {{-2, 0, 0}});
    prim.indices[square] = {0, 7, -1};
    host.scene().addSquare(square, GfVec3f(0.5f), inner);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(instanceAt(-2, 0), 0);
}

} // namespace
