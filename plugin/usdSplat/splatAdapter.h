/// @file splatAdapter.h
/// UsdImaging's way from ParticleField3DGaussianSplat prims to `particleField` Rprims, for OpenUSD
/// before 26.03.
#pragma once

#include "plugin/usdSplat/compat.h"
#if PXR_VERSION >= 2308
#include "plugin/usdSplat/splatDataSource.h"
#endif

PXR_NAMESPACE_OPEN_SCOPE

/// Primvars have the names of the attributes in single precision; those in half precision stand in for what
/// is not there. The two hints are passed on as constant primvars.
class UsdSplatAdapter : public UsdSplatAdapterBase {
public:
    using BaseAdapter = UsdSplatAdapterBase;

    bool IsSupported(UsdImagingIndexProxy const* index) const override;
    SdfPath Populate(UsdPrim const& prim, UsdImagingIndexProxy* index,
                     UsdImagingInstancerContext const* instancerContext = nullptr) override;
    void TrackVariability(UsdPrim const& prim, SdfPath const& cachePath, HdDirtyBits* timeVaryingBits,
                          UsdImagingInstancerContext const* instancerContext = nullptr) const override;
    HdDirtyBits ProcessPropertyChange(UsdPrim const& prim, SdfPath const& cachePath,
                                      TfToken const& propertyName) override;
#if PXR_VERSION >= 2308
    TfTokenVector GetImagingSubprims(UsdPrim const& prim) override;
    TfToken GetImagingSubprimType(UsdPrim const& prim, TfToken const& subprim) override;
    HdContainerDataSourceHandle
    GetImagingSubprimData(UsdPrim const& prim, TfToken const& subprim,
                          UsdImagingDataSourceStageGlobals const& stageGlobals) override;
    HdDataSourceLocatorSet
    InvalidateImagingSubprim(UsdPrim const& prim, TfToken const& subprim, TfTokenVector const& properties,
                             UsdImagingPropertyInvalidationType invalidationType) override;
#endif

protected:
    HdPrimvarDescriptorVector const& primvarsOfType() const override;
    bool hasPrimvar(UsdPrim const& prim, TfToken const& name) const override;
    VtValue readPrimvar(UsdPrim const& prim, TfToken const& name, UsdTimeCode time) const override;
};

/// The same for bare ParticleField prims whose applied API schemas make them clouds of Gaussian splats.
/// Others are not drawn, which one warning tells.
class UsdSplatFieldAdapter final : public UsdSplatAdapter {
public:
    using BaseAdapter = UsdSplatAdapter;

    SdfPath Populate(UsdPrim const& prim, UsdImagingIndexProxy* index,
                     UsdImagingInstancerContext const* instancerContext = nullptr) override;
#if PXR_VERSION >= 2308
    TfToken GetImagingSubprimType(UsdPrim const& prim, TfToken const& subprim) override;
#endif
};

PXR_NAMESPACE_CLOSE_SCOPE
