/// @file splatDataSource.h
/// ParticleField3DGaussianSplat for hosts that feed Hydra from scene indices (OpenUSD 23.08 to 25.11).
#pragma once

#include "pxr/usdImaging/usdImaging/dataSourceGprim.h"

PXR_NAMESPACE_OPEN_SCOPE

/// A gprim's data with the primvars of UsdSplatAdapter.
class UsdSplatDataSource : public UsdImagingDataSourceGprim {
public:
    HD_DECLARE_DATASOURCE(UsdSplatDataSource);

    HdDataSourceBaseHandle Get(TfToken const& name) override;
    static HdDataSourceLocatorSet Invalidate(UsdPrim const& prim, TfToken const& subprim,
                                             TfTokenVector const& properties,
                                             UsdImagingPropertyInvalidationType invalidationType);

private:
    UsdSplatDataSource(SdfPath const& sceneIndexPath, UsdPrim usdPrim,
                       UsdImagingDataSourceStageGlobals const& stageGlobals);
};

PXR_NAMESPACE_CLOSE_SCOPE
