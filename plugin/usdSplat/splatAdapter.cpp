#include "plugin/usdSplat/splatAdapter.h"

#include "plugin/usdSplat/splatAttributes.h"
#include "pxr/base/tf/registryManager.h"
#include "pxr/base/tf/type.h"

PXR_NAMESPACE_OPEN_SCOPE

using hdhipr::particleFieldType;

TF_REGISTRY_FUNCTION(TfType) {
    TfType type = TfType::Define<UsdSplatAdapter, TfType::Bases<UsdImagingGprimAdapter>>();
    type.SetFactory<UsdImagingPrimAdapterFactory<UsdSplatAdapter>>();
}

bool UsdSplatAdapter::IsSupported(UsdImagingIndexProxy const* index) const {
    return index->IsRprimTypeSupported(particleFieldType());
}

SdfPath UsdSplatAdapter::Populate(UsdPrim const& prim, UsdImagingIndexProxy* index,
                                  UsdImagingInstancerContext const* instancerContext) {
    return _AddRprim(particleFieldType(), prim, index, GetMaterialUsdPath(prim), instancerContext);
}

void UsdSplatAdapter::TrackVariability(UsdPrim const& prim, SdfPath const& cachePath,
                                       HdDirtyBits* timeVaryingBits,
                                       UsdImagingInstancerContext const* instancerContext) const {
    BaseAdapter::TrackVariability(prim, cachePath, timeVaryingBits, instancerContext);
    for (HdPrimvarDescriptor const& primvar : primvarsOfType()) {
        const UsdAttribute attribute = UsdSplatAttribute(prim, primvar.name);
        if (attribute && attribute.ValueMightBeTimeVarying()) {
            *timeVaryingBits |= HdChangeTracker::DirtyPrimvar;
        }
    }
}

HdDirtyBits UsdSplatAdapter::ProcessPropertyChange(UsdPrim const& prim, SdfPath const& cachePath,
                                                   TfToken const& propertyName) {
    return UsdSplatIsProperty(propertyName)
               ? HdDirtyBits(HdChangeTracker::DirtyPrimvar)
               : BaseAdapter::ProcessPropertyChange(prim, cachePath, propertyName);
}

HdPrimvarDescriptorVector const& UsdSplatAdapter::primvarsOfType() const {
    static const HdPrimvarDescriptorVector primvars = [] {
        HdPrimvarDescriptorVector all;
        for (UsdSplatProperty const& property : UsdSplatProperties()) {
            all.emplace_back(property.name,
                             property.constant ? HdInterpolationConstant : HdInterpolationVertex);
        }
        return all;
    }();
    return primvars;
}

bool UsdSplatAdapter::hasPrimvar(UsdPrim const& prim, TfToken const& name) const {
    return bool(UsdSplatAttribute(prim, name));
}

VtValue UsdSplatAdapter::readPrimvar(UsdPrim const& prim, TfToken const& name, UsdTimeCode time) const {
    VtValue value;
    if (const UsdAttribute attribute = UsdSplatAttribute(prim, name)) {
        attribute.Get(&value, time);
    }
    return value;
}

#if PXR_VERSION >= 2308

TfTokenVector UsdSplatAdapter::GetImagingSubprims(UsdPrim const&) {
    return {TfToken()};
}

TfToken UsdSplatAdapter::GetImagingSubprimType(UsdPrim const&, TfToken const& subprim) {
    return subprim.IsEmpty() ? particleFieldType() : TfToken();
}

HdContainerDataSourceHandle
UsdSplatAdapter::GetImagingSubprimData(UsdPrim const& prim, TfToken const& subprim,
                                       UsdImagingDataSourceStageGlobals const& stageGlobals) {
    return subprim.IsEmpty() ? UsdSplatDataSource::New(prim.GetPath(), prim, stageGlobals) : nullptr;
}

HdDataSourceLocatorSet
UsdSplatAdapter::InvalidateImagingSubprim(UsdPrim const& prim, TfToken const& subprim,
                                          TfTokenVector const& properties,
                                          UsdImagingPropertyInvalidationType invalidationType) {
    return subprim.IsEmpty() ? UsdSplatDataSource::Invalidate(prim, subprim, properties, invalidationType)
                             : HdDataSourceLocatorSet();
}

#endif

PXR_NAMESPACE_CLOSE_SCOPE
