/// Cull styles: the camera does not see some sides of faces.
#include <gtest/gtest.h>

#include "testenv/unit/delegate/test_host.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

/// One square that faces the camera.
struct Culling : testing::Test {
    Culling() : host({"color", "primId"}, 1) {
        host.setViewSize(3.0);
        host.scene().addDome(SdfPath("/dome"));
        square = &host.scene().addSquare(SdfPath("/square"), GfVec3f(0.5f));
    }
    bool seen() {
        EXPECT_TRUE(host.render());
        return host.readInt("primId", 0, 0) >= 0;
    }
    bool seenWith(HdCullStyle style) {
        square->cullStyle = style;
        host.scene().tracker().MarkRprimDirty(SdfPath("/square"), HdChangeTracker::DirtyCullStyle);
        return seen();
    }
    bool seenInViewOf(HdCullStyle style) {
        host.state().SetCullStyle(style);
        return seen();
    }
    void setDoubleSided(bool doubleSided) {
        square->doubleSided = doubleSided;
        host.scene().tracker().MarkRprimDirty(SdfPath("/square"), HdChangeTracker::DirtyDoubleSided);
    }
    TestHost host;
    TestScene::Prim* square;
};

TEST_F(Culling, ofPrims) {
    EXPECT_TRUE(seen());
    EXPECT_TRUE(seenWith(HdCullStyleBack));
    EXPECT_FALSE(seenWith(HdCullStyleFront));
    setDoubleSided(true);
    EXPECT_FALSE(seen());
    EXPECT_TRUE(seenWith(HdCullStyleFrontUnlessDoubleSided));
    setDoubleSided(false);
    EXPECT_FALSE(seen());
    EXPECT_TRUE(seenWith(HdCullStyleNothing));
}

TEST_F(Culling, ofViewsIsForPrimsWithoutAStyle) {
    EXPECT_FALSE(seenInViewOf(HdCullStyleFront));
    EXPECT_TRUE(seenWith(HdCullStyleNothing));
    EXPECT_FALSE(seenWith(HdCullStyleDontCare));
    EXPECT_TRUE(seenInViewOf(HdCullStyleBackUnlessDoubleSided));
    EXPECT_TRUE(seenInViewOf(HdCullStyleNothing));
}

} // namespace
