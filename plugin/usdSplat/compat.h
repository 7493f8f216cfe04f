/// @file compat.h
/// How UsdImaging 20.08 .. 25.11 differ, and the only place of this folder that knows. From 26.03 on
/// UsdImaging draws splats itself and none of this is compiled.
#pragma once

#include "plugin/hdHipr/compat.h"
#include "pxr/usd/usd/prim.h"
#include "pxr/usdImaging/usdImaging/gprimAdapter.h"
#include "pxr/usdImaging/usdImaging/indexProxy.h"

#if PXR_VERSION < 2102
#include "pxr/usdImaging/usdImaging/valueCache.h"
#else
#include "pxr/usdImaging/usdImaging/primvarDescCache.h"
#endif

PXR_NAMESPACE_OPEN_SCOPE

/// UsdImagingGprimAdapter with primvars that are no `primvars:` of USD: 20.08 wants their values put
/// into a cache, later ones ask for one at a time.
class UsdSplatAdapterBase : public UsdImagingGprimAdapter {
public:
    void UpdateForTime(UsdPrim const& prim, SdfPath const& cachePath, UsdTimeCode time,
                       HdDirtyBits requestedBits,
                       UsdImagingInstancerContext const* instancerContext = nullptr) const final {
        // There are no `points`, which the base class would look for and miss.
        requestedBits &= ~HdDirtyBits(HdChangeTracker::DirtyPoints);
        UsdImagingGprimAdapter::UpdateForTime(prim, cachePath, time, requestedBits, instancerContext);
        if (!(requestedBits & HdChangeTracker::DirtyPrimvar)) {
            return;
        }
#if PXR_VERSION < 2102
        HdPrimvarDescriptorVector& descriptors = _GetValueCache()->GetPrimvars(cachePath);
#else
        HdPrimvarDescriptorVector& descriptors = _GetPrimvarDescCache()->GetPrimvars(cachePath);
#endif
        for (HdPrimvarDescriptor const& primvar : primvarsOfType()) {
            if (!hasPrimvar(prim, primvar.name)) {
                _RemovePrimvar(&descriptors, primvar.name);
                continue;
            }
            _MergePrimvar(&descriptors, primvar.name, primvar.interpolation, primvar.role);
#if PXR_VERSION < 2011
            _GetValueCache()->GetPrimvar(cachePath, primvar.name) = readPrimvar(prim, primvar.name, time);
#endif
        }
    }

#if PXR_VERSION >= 2105
    VtValue Get(UsdPrim const& prim, SdfPath const& cachePath, TfToken const& key, UsdTimeCode time,
                VtIntArray* indices) const final {
        return isPrimvar(key) ? readPrimvar(prim, key, time)
                              : UsdImagingGprimAdapter::Get(prim, cachePath, key, time, indices);
    }
#elif PXR_VERSION >= 2011
    VtValue Get(UsdPrim const& prim, SdfPath const& cachePath, TfToken const& key,
                UsdTimeCode time) const final {
        return isPrimvar(key) ? readPrimvar(prim, key, time)
                              : UsdImagingGprimAdapter::Get(prim, cachePath, key, time);
    }
#endif

protected:
    /// All primvars that a prim may have besides `primvars:`.
    virtual HdPrimvarDescriptorVector const& primvarsOfType() const = 0;
    virtual bool hasPrimvar(UsdPrim const& prim, TfToken const& name) const = 0;
    virtual VtValue readPrimvar(UsdPrim const& prim, TfToken const& name, UsdTimeCode time) const = 0;

    bool isPrimvar(TfToken const& name) const {
        for (HdPrimvarDescriptor const& primvar : primvarsOfType()) {
            if (primvar.name == name) {
                return true;
            }
        }
        return false;
    }
};

PXR_NAMESPACE_CLOSE_SCOPE
