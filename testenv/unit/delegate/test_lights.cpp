/// Lights that hosts add to a scene.
#include <gtest/gtest.h>

#include "testenv/unit/delegate/test_host.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace {

/// By its name what OpenUSD tells of a viewer's light.
struct GlfSimpleLight {
    bool operator==(GlfSimpleLight const&) const { return true; }
    bool operator!=(GlfSimpleLight const&) const { return false; }
};
std::ostream& operator<<(std::ostream& out, GlfSimpleLight const&) {
    return out << "light";
}

struct Lights : testing::Test {
    Lights() : host({"color"}, 4) { host.scene().addSquare(SdfPath("/square"), GfVec3f(0.5f)); }
    /// What the square shows.
    float shown() {
        EXPECT_TRUE(host.render());
        return host.readColor(0, 0)[1];
    }
    /// A light of a viewer as newer OpenUSD makes it: intensity 1, radius and all else by default.
    void addCameraLight() {
        host.scene().addSphereLightFarAway(SdfPath("/light0")).params = {
            {TfToken("intensity"), VtValue(1.f)}, {HdLightTokens->params, VtValue(GlfSimpleLight())}};
    }

    TestHost host;
};

TEST_F(Lights, theCameraLightOfAViewerLightsAsOursDoes) {
    const float ours = shown();
    EXPECT_GT(ours, 0.4f);
    addCameraLight();
    EXPECT_EQ(shown(), ours);
}

TEST_F(Lights, theCameraLightOfAViewerLeavesLitScenesAlone) {
    host.scene().addDome(SdfPath("/dome"));
    const float lit = shown();
    addCameraLight();
    EXPECT_EQ(shown(), lit);
}

TEST_F(Lights, otherLightsOfAViewerLight) {
    host.scene().addDome(SdfPath("/light0")).params = {{TfToken("intensity"), VtValue(0.25f)},
                                                       {HdLightTokens->params, VtValue(GlfSimpleLight())}};
    EXPECT_NEAR(shown(), 0.125f, 0.01f);
}

} // namespace

PXR_NAMESPACE_CLOSE_SCOPE
