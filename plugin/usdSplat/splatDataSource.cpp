#include "plugin/usdSplat/splatDataSource.h"

#include "plugin/usdSplat/splatAttributes.h"
#include "pxr/imaging/hd/overlayContainerDataSource.h"
#include "pxr/imaging/hd/primvarSchema.h"
#include "pxr/imaging/hd/primvarsSchema.h"
#include "pxr/usdImaging/usdImaging/dataSourcePrimvars.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace {

UsdImagingDataSourceCustomPrimvars::Mappings mappings(UsdPrim const& prim) {
    UsdImagingDataSourceCustomPrimvars::Mappings result;
    for (UsdSplatProperty const& property : UsdSplatProperties()) {
        if (const UsdAttribute attribute = UsdSplatAttribute(prim, property.name)) {
            result.emplace_back(property.name, attribute.GetName(),
                                property.constant ? HdPrimvarSchemaTokens->constant
                                                  : HdPrimvarSchemaTokens->vertex);
        }
    }
    return result;
}

} // namespace

UsdSplatDataSource::UsdSplatDataSource(SdfPath const& sceneIndexPath, UsdPrim usdPrim,
                                       UsdImagingDataSourceStageGlobals const& stageGlobals)
    : UsdImagingDataSourceGprim(sceneIndexPath, usdPrim, stageGlobals) {}

HdDataSourceBaseHandle UsdSplatDataSource::Get(TfToken const& name) {
    HdDataSourceBaseHandle const result = UsdImagingDataSourceGprim::Get(name);
    if (name != HdPrimvarsSchemaTokens->primvars) {
        return result;
    }
    return HdOverlayContainerDataSource::New(
        HdContainerDataSource::Cast(result),
        UsdImagingDataSourceCustomPrimvars::New(_GetSceneIndexPath(), _GetUsdPrim(), mappings(_GetUsdPrim()),
                                                _GetStageGlobals()));
}

HdDataSourceLocatorSet UsdSplatDataSource::Invalidate(UsdPrim const& prim, TfToken const& subprim,
                                                      TfTokenVector const& properties,
                                                      UsdImagingPropertyInvalidationType invalidationType) {
    HdDataSourceLocatorSet locators =
        UsdImagingDataSourceGprim::Invalidate(prim, subprim, properties, invalidationType);
    for (TfToken const& property : properties) {
        if (UsdSplatIsProperty(property)) {
            locators.insert(HdPrimvarsSchema::GetDefaultLocator());
        }
    }
    return locators;
}

PXR_NAMESPACE_CLOSE_SCOPE
