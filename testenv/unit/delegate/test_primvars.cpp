/// Primvars of every type and rate, seen through a primvars: AOV.
#include <gtest/gtest.h>

#include "plugin/hdHipr/primvars.h"
#include "pxr/base/gf/half.h"
#include "pxr/base/gf/vec2d.h"
#include "pxr/base/gf/vec3h.h"
#include "pxr/base/gf/vec4i.h"
#include "testenv/unit/delegate/test_host.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

const SdfPath square("/square");
const TfToken name("value");

TEST(Primvars, ofEveryTypeBecomeFloats) {
    struct Case {
        VtValue value;
        uint32_t components;
        std::vector<float> floats;
    };
    const Case cases[] = {
        {VtValue(2.5f), 1, {2.5f}},
        {VtValue(VtDoubleArray{1, 2}), 1, {1, 2}},
        {VtValue(VtHalfArray{GfHalf(0.5f)}), 1, {0.5f}},
        {VtValue(VtIntArray{-3}), 1, {-3}},
        {VtValue(VtBoolArray{true, false}), 1, {1, 0}},
        {VtValue(VtUCharArray{200}), 1, {200}},
        {VtValue(VtVec2dArray{GfVec2d(1, 2)}), 2, {1, 2}},
        {VtValue(GfVec3h(1, 2, 3)), 3, {1, 2, 3}},
        {VtValue(VtVec4iArray{GfVec4i(1, 2, 3, 4)}), 4, {1, 2, 3, 4}},
    };
    for (Case const& c : cases) {
        const auto primvar = hdhipr::toPrimvar(name, c.value);
        ASSERT_TRUE(primvar) << c.value.GetTypeName();
        EXPECT_EQ(primvar->components, c.components) << c.value.GetTypeName();
        EXPECT_EQ(primvar->values, c.floats) << c.value.GetTypeName();
    }
    EXPECT_FALSE(hdhipr::toPrimvar(name, VtValue(std::string("text"))));
    EXPECT_FALSE(hdhipr::toPrimvar(name, VtValue(VtFloatArray())));
    EXPECT_FALSE(hdhipr::toPrimvar(name, VtValue()));
}

/// The square is one quad; pixel centres near its corners read the corner values.
struct PrimvarAov : testing::Test {
    PrimvarAov() : host({"primvars:value"}, 1) { host.scene().addSquare(square, GfVec3f(1.f)); }
    GfVec3f at(double x, double y) {
        auto& buffer = host.buffer("primvars:value");
        const size_t column = size_t((x + 0.5) * TestHost::width), row = size_t((y + 0.5) * TestHost::height);
        const GfVec3f value = static_cast<const GfVec3f*>(buffer.Map())[row * TestHost::width + column];
        buffer.Unmap();
        return value;
    }
    void set(HdInterpolation interpolation, VtValue const& value) {
        host.scene().prim(square).primvars[name] = {interpolation, value};
        host.scene().tracker().MarkRprimDirty(square, HdChangeTracker::DirtyPrimvar);
    }
    TestHost host;
};

TEST_F(PrimvarAov, atEveryRate) {
    const VtFloatArray corners{0, 1, 2, 3}; // bottom left, bottom right, top right, top left
    set(HdInterpolationConstant, VtValue(VtFloatArray{7}));
    ASSERT_TRUE(host.render());
    EXPECT_NEAR(at(0.2, 0.2)[0], 7.f, 1e-4f);
    set(HdInterpolationUniform, VtValue(VtFloatArray{5}));
    ASSERT_TRUE(host.render());
    EXPECT_NEAR(at(0.2, 0.2)[0], 5.f, 1e-4f);
    for (HdInterpolation rate : {HdInterpolationVertex, HdInterpolationVarying, HdInterpolationFaceVarying}) {
        set(rate, VtValue(corners));
        ASSERT_TRUE(host.render());
        EXPECT_NEAR(at(-0.49, -0.49)[0], 0.f, 0.2f) << rate;
        EXPECT_NEAR(at(0.49, -0.49)[0], 1.f, 0.2f) << rate;
        EXPECT_NEAR(at(0.49, 0.49)[0], 2.f, 0.2f) << rate;
        EXPECT_NEAR(at(-0.49, 0.49)[0], 3.f, 0.2f) << rate;
    }
}

TEST_F(PrimvarAov, removedOnesReadZero) {
    set(HdInterpolationConstant, VtValue(VtFloatArray{7}));
    ASSERT_TRUE(host.render());
    host.scene().prim(square).primvars.erase(name);
    host.scene().tracker().MarkRprimDirty(square, HdChangeTracker::DirtyPrimvar);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(at(0.2, 0.2)[0], 0.f);
}

TEST_F(PrimvarAov, ofTheWrongLengthAreDroppedAndTheMeshStays) {
    set(HdInterpolationVertex, VtValue(VtFloatArray{1, 2}));
    ASSERT_TRUE(host.render());
    EXPECT_EQ(at(0.2, 0.2)[0], 0.f);
}

} // namespace
