#include "plugin/usdSplat/splatAdapter.h"

#include <mutex>
#include <set>

#include "plugin/usdSplat/splatAttributes.h"
#include "pxr/base/tf/diagnostic.h"
#include "pxr/base/tf/registryManager.h"
#include "pxr/base/tf/type.h"

PXR_NAMESPACE_OPEN_SCOPE

using hdhipr::particleFieldType;

TF_REGISTRY_FUNCTION(TfType) {
    TfType type = TfType::Define<UsdSplatAdapter, TfType::Bases<UsdImagingGprimAdapter>>();
    type.SetFactory<UsdImagingPrimAdapterFactory<UsdSplatAdapter>>();
    TfType field = TfType::Define<UsdSplatFieldAdapter, TfType::Bases<UsdSplatAdapter>>();
    field.SetFactory<UsdImagingPrimAdapterFactory<UsdSplatFieldAdapter>>();
}

namespace {

/// Whether a ParticleField is drawn; tells once if not.
bool drawn(UsdPrim const& field) {
    const std::string fault = UsdSplatFieldFault(field);
    if (fault.empty()) {
        return true;
    }
    static std::mutex mutex;
    static std::set<std::string> told;
    const std::string text = field.GetPath().GetString() + ": " + fault + "; it is not drawn";
    const std::lock_guard<std::mutex> lock(mutex);
    if (told.insert(text).second) {
        TF_WARN("%s", text.c_str());
    }
    return false;
}

} // namespace

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

SdfPath UsdSplatFieldAdapter::Populate(UsdPrim const& prim, UsdImagingIndexProxy* index,
                                       UsdImagingInstancerContext const* instancerContext) {
    return drawn(prim) ? BaseAdapter::Populate(prim, index, instancerContext) : SdfPath();
}

#if PXR_VERSION >= 2308

TfToken UsdSplatFieldAdapter::GetImagingSubprimType(UsdPrim const& prim, TfToken const& subprim) {
    return drawn(prim) ? BaseAdapter::GetImagingSubprimType(prim, subprim) : TfToken();
}

#endif

PXR_NAMESPACE_CLOSE_SCOPE
