/// Every edit a scene can make must show in the picture, and an edit that changes nothing must not.
#include <cmath>

#include <gtest/gtest.h>

#include "testenv/unit/delegate/test_host.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

const SdfPath square("/square"), dome("/dome"), red("/red"), green("/green");

/// A white square under a dome of radiance 1, three units of view wide.
struct Edits : testing::Test {
    Edits() {
        host.setViewSize(3.0);
        host.scene().addDome(dome);
        host.scene().addSquare(square, GfVec3f(0.5f));
    }
    int idAt(double x, double y) { return host.readInt("primId", x, y); }
    void mark(HdDirtyBits bits) { host.scene().tracker().MarkRprimDirty(square, bits); }

    TestHost host;
};

TEST_F(Edits, firstPictureShowsTheSquare) {
    ASSERT_TRUE(host.render());
    EXPECT_GE(idAt(0, 0), 0);
    EXPECT_EQ(idAt(0.4, 0.4), -1);
    EXPECT_EQ(host.readInt("instanceId", 0, 0), 0);
    EXPECT_EQ(host.readInt("elementId", 0, 0), 0);
    EXPECT_NEAR(host.readColor(0, 0)[3], 1.f, 1e-3f);
}

TEST_F(Edits, transformMovesIt) {
    ASSERT_TRUE(host.render());
    host.scene().prim(square).transform.SetTranslate(GfVec3d(1, 1, 0));
    mark(HdChangeTracker::DirtyTransform);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(idAt(0, 0), -1);
    EXPECT_GE(idAt(0.34, 0.34), 0);
}

TEST_F(Edits, pointsDeformIt) {
    ASSERT_TRUE(host.render());
    VtVec3fArray points{{-1.5f, -0.5f, 0}, {-0.5f, -0.5f, 0}, {-0.5f, 0.5f, 0}, {-1.5f, 0.5f, 0}};
    host.scene().prim(square).primvars[HdTokens->points].value = VtValue(points);
    mark(HdChangeTracker::DirtyPoints);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(idAt(0, 0), -1);
    EXPECT_GE(idAt(-0.34, 0), 0);
}

TEST_F(Edits, topologyCutsIt) {
    ASSERT_TRUE(host.render());
    host.scene().prim(square).topology =
        HdMeshTopology(TfToken("none"), TfToken("rightHanded"), VtIntArray{3}, VtIntArray{0, 1, 2});
    mark(HdChangeTracker::DirtyTopology);
    ASSERT_TRUE(host.render());
    EXPECT_GE(idAt(0.1, -0.1), 0);
    EXPECT_EQ(idAt(-0.1, 0.1), -1);
}

TEST_F(Edits, visibilityHidesAndShowsIt) {
    host.scene().prim(square).visible = false;
    ASSERT_TRUE(host.render());
    EXPECT_EQ(idAt(0, 0), -1);
    host.scene().prim(square).visible = true;
    mark(HdChangeTracker::DirtyVisibility);
    ASSERT_TRUE(host.render());
    EXPECT_GE(idAt(0, 0), 0);
}

TEST_F(Edits, renderTagsFilterIt) {
    host.scene().prim(square).renderTag = HdRenderTagTokens->proxy;
    ASSERT_TRUE(host.render());
    EXPECT_EQ(idAt(0, 0), -1);
    host.setRenderTags({HdRenderTagTokens->geometry, HdRenderTagTokens->proxy});
    ASSERT_TRUE(host.render());
    EXPECT_GE(idAt(0, 0), 0);
    host.setRenderTags({HdRenderTagTokens->geometry});
    ASSERT_TRUE(host.render());
    EXPECT_EQ(idAt(0, 0), -1);
}

TEST_F(Edits, renderTagOfThePrimTakesItOutAndBack) {
    ASSERT_TRUE(host.render());
    host.scene().prim(square).renderTag = HdRenderTagTokens->guide;
    mark(HdChangeTracker::DirtyRenderTag);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(idAt(0, 0), -1);
    host.scene().prim(square).renderTag = HdRenderTagTokens->geometry;
    mark(HdChangeTracker::DirtyRenderTag);
    ASSERT_TRUE(host.render());
    EXPECT_GE(idAt(0, 0), 0);
}

TEST_F(Edits, reprSwitchesBetweenHullAndRefined) {
    auto& prim = host.scene().prim(square);
    prim.topology = HdMeshTopology(TfToken("catmullClark"), TfToken("rightHanded"), VtIntArray{4},
                                   VtIntArray{0, 1, 2, 3});
    prim.tags.SetVertexInterpolationRule(TfToken("edgeOnly")); // the limit surface loses its corners
    prim.refineLevel = 3;
    const auto use = [this](TfToken const& repr) {
        host.setCollection(HdRprimCollection(HdTokens->geometry, HdReprSelector(repr)));
        return host.render();
    };
    const double corner = 0.45 / 3;
    for (int round = 0; round < 2; ++round) { // a repr that is not new any more must sync again
        ASSERT_TRUE(use(HdReprTokens->refined));
        EXPECT_EQ(idAt(corner, corner), -1);
        EXPECT_GE(idAt(0, 0), 0);
        ASSERT_TRUE(use(HdReprTokens->smoothHull));
        EXPECT_GE(idAt(corner, corner), 0);
    }
    prim.refineLevel = 0;
    mark(HdChangeTracker::DirtyDisplayStyle);
    ASSERT_TRUE(use(HdReprTokens->refined));
    EXPECT_GE(idAt(corner, corner), 0);
}

TEST_F(Edits, collectionExcludesIt) {
    HdRprimCollection without(HdTokens->geometry, HdReprSelector(HdReprTokens->refined));
    without.SetExcludePaths({square});
    ASSERT_TRUE(host.render());
    host.setCollection(without);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(idAt(0, 0), -1);
}

TEST_F(Edits, materialBindingAndContentChangeItsColour) {
    host.scene().addMaterial(red, GfVec3f(0.8f, 0.f, 0.f));
    host.scene().addMaterial(green, GfVec3f(0.f, 0.8f, 0.f));
    host.scene().prim(square).material = red;
    ASSERT_TRUE(host.render());
    EXPECT_GT(host.readColor(0, 0)[0], host.readColor(0, 0)[1] + 0.3f);

    host.scene().prim(square).material = green;
    mark(HdChangeTracker::DirtyMaterialId);
    ASSERT_TRUE(host.render());
    EXPECT_GT(host.readColor(0, 0)[1], host.readColor(0, 0)[0] + 0.3f);

    auto networks = host.scene().prim(green).resource.UncheckedGet<HdMaterialNetworkMap>();
    auto& surface = networks.map[HdMaterialTerminalTokens->surface].nodes[0];
    surface.parameters[TfToken("diffuseColor")] = VtValue(GfVec3f(0.f, 0.f, 0.8f));
    host.scene().prim(green).resource = VtValue(networks);
    host.scene().tracker().MarkSprimDirty(green, HdMaterial::DirtyResource);
    ASSERT_TRUE(host.render());
    EXPECT_GT(host.readColor(0, 0)[2], host.readColor(0, 0)[1] + 0.3f);
}

TEST_F(Edits, removedMaterialAndLightLeaveThePicture) {
    host.scene().addMaterial(red, GfVec3f(0.8f, 0.f, 0.f));
    host.scene().prim(square).material = red;
    ASSERT_TRUE(host.render());
    EXPECT_LT(host.readColor(0, 0)[1], 0.2f);
    host.scene().remove(red);
    ASSERT_TRUE(host.render());
    EXPECT_GT(host.readColor(0, 0)[1], 0.3f); // the square's own grey
    host.scene().remove(dome);
    host.scene().addSphereLightFarAway(SdfPath("/lamp"));
    ASSERT_TRUE(host.render());
    EXPECT_LT(host.readColor(0, 0)[1], 0.01f);
}

TEST_F(Edits, subsetsHaveTheirOwnMaterials) {
    host.scene().addMaterial(red, GfVec3f(0.8f, 0.f, 0.f));
    host.scene().addMaterial(green, GfVec3f(0.f, 0.8f, 0.f));
    auto& prim = host.scene().prim(square);
    prim.material = red;
    prim.topology = HdMeshTopology(TfToken("none"), TfToken("rightHanded"), VtIntArray{3, 3},
                                   VtIntArray{0, 1, 2, 0, 2, 3});
    HdGeomSubset subset;
    subset.type = HdGeomSubset::TypeFaceSet;
    subset.id = SdfPath("/square/subset");
    subset.materialId = green;
    subset.indices = VtIntArray{1};
    prim.topology.SetGeomSubsets({subset});
    ASSERT_TRUE(host.render());
    const GfVec4f lower = host.readColor(0.1, -0.1), upper = host.readColor(-0.1, 0.1);
    EXPECT_GT(lower[0], lower[1] + 0.3f);
    EXPECT_GT(upper[1], upper[0] + 0.3f);
    EXPECT_EQ(host.readInt("elementId", 0.1, -0.1), 0);
    EXPECT_EQ(host.readInt("elementId", -0.1, 0.1), 1);
}

TEST_F(Edits, impossibleTransformsHideOnlyTheirPrim) {
    const SdfPath other("/other");
    host.scene().addSquare(other, GfVec3f(0.5f)).transform.SetTranslate(GfVec3d(1, 1, 0));
    for (double bad : {std::nan(""), 0.0, 1e308}) {
        host.scene().prim(square).transform = GfMatrix4d(bad);
        mark(HdChangeTracker::DirtyTransform);
        ASSERT_TRUE(host.render());
        EXPECT_EQ(idAt(0.05, 0.05), -1) << bad;
        EXPECT_GE(idAt(0.34, 0.34), 0) << bad;
    }
    host.scene().prim(square).transform = GfMatrix4d(1);
    mark(HdChangeTracker::DirtyTransform);
    ASSERT_TRUE(host.render());
    EXPECT_GE(idAt(0, 0), 0);
}

TEST_F(Edits, displayColorPrimvarChangesItsColour) {
    ASSERT_TRUE(host.render());
    const float before = host.readColor(0, 0)[0];
    host.scene().prim(square).primvars[HdTokens->displayColor].value = VtValue(VtVec3fArray{GfVec3f(0.1f)});
    mark(HdChangeTracker::DirtyPrimvar);
    ASSERT_TRUE(host.render());
    EXPECT_LT(host.readColor(0, 0)[0], before - 0.2f);
}

TEST_F(Edits, lightIntensityScalesThePicture) {
    ASSERT_TRUE(host.render());
    const float before = host.readColor(0, 0)[0];
    host.scene().prim(dome).params[TfToken("intensity")] = VtValue(2.f);
    host.scene().tracker().MarkSprimDirty(dome, HdLight::DirtyParams);
    ASSERT_TRUE(host.render());
    EXPECT_NEAR(host.readColor(0, 0)[0], 2 * before, 0.02f * before);
}

TEST_F(Edits, removedPrimIsGoneAndAddedOneAppears) {
    ASSERT_TRUE(host.render());
    host.scene().remove(square);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(idAt(0, 0), -1);
    host.scene().addSquare(square, GfVec3f(0.5f));
    ASSERT_TRUE(host.render());
    EXPECT_GE(idAt(0, 0), 0);
}

TEST_F(Edits, anEditWhileRenderingIsNotLost) {
    host.delegate().SetRenderSetting(TfToken("convergedSamplesPerPixel"), VtValue(4096));
    for (int i = 0; i < 20; ++i) {
        host.scene().prim(square).transform.SetTranslate(GfVec3d(i % 2, 0, 0));
        mark(HdChangeTracker::DirtyTransform);
        host.tick();
    }
    host.delegate().SetRenderSetting(TfToken("convergedSamplesPerPixel"), VtValue(4));
    ASSERT_TRUE(host.render());
    EXPECT_EQ(idAt(-0.1, 0), -1);
    EXPECT_GE(idAt(0.34, 0), 0);
}

TEST_F(Edits, nothingChangesWithoutAnEdit) {
    ASSERT_TRUE(host.render());
    host.tick();
    EXPECT_TRUE(host.pass().IsConverged());
}

} // namespace
