/// Looks of MaterialX documents, on the geometry they are for.
#include "testenv/unit/mtlxFile/documents.h"

#include "pxr/usd/usd/stage.h"
#include "pxr/usd/usd/variantSets.h"
#include "pxr/usd/usdShade/materialBindingAPI.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

class MtlxLooks : public MtlxDocuments {
protected:
    MtlxLooks() {
        open(R"(
  <surfacematerial name="Red" type="material"/>
  <surfacematerial name="Blue" type="material"/>
  <collection name="Handles" includegeom="/top/handle, /side" excludegeom="/side/nut"/>
  <look name="Plain">
    <materialassign name="all" material="Red" geom="/"/>
  </look>
  <look name="Mixed" inherit="Plain">
    <materialassign name="all" material="Blue" collection="Handles"/>
  </look>
  <lookgroup name="Looks" looks="Plain, Mixed" default="Mixed"/>)");
        stage = UsdStage::Open(file("a.usda", R"(#usda 1.0
def Xform "Cup" (
    references = @a.mtlx@</ModelRoot>
)
{
    def Xform "top" {
        def Mesh "handle" {
        }
        def Mesh "lid" {
        }
    }
    def Mesh "side" {
        def Mesh "nut" {
        }
    }
}
)"));
    }

    std::string materialOf(char const* path) const {
        const UsdPrim prim = stage->GetPrimAtPath(SdfPath(path));
        return UsdShadeMaterialBindingAPI(prim).ComputeBoundMaterial().GetPath().GetName();
    }

    TestWarnings warnings;
    UsdStageRefPtr stage;
};

TEST_F(MtlxLooks, BindMaterialsToGeometry) {
    EXPECT_EQ(materialOf("/Cup/top/handle"), "Blue");
    EXPECT_EQ(materialOf("/Cup/top/lid"), "Red");
    EXPECT_EQ(materialOf("/Cup/side"), "Blue");
    EXPECT_EQ(materialOf("/Cup/side/nut"), "Red");
    EXPECT_THAT(warnings.texts(), testing::IsEmpty());
}

TEST_F(MtlxLooks, AreVariants) {
    stage->GetPrimAtPath(SdfPath("/Cup")).GetVariantSet("LookVariant").SetVariantSelection("Plain");
    EXPECT_EQ(materialOf("/Cup/top/handle"), "Red");
    EXPECT_EQ(materialOf("/Cup/side"), "Red");
}

} // namespace
