/// @file skinnedScene.h
/// UsdImaging's scene delegate, which before OpenUSD 21.05 does not tell how skinned points move.
#pragma once

#include "pxr/pxr.h"
#include "pxr/usdImaging/usdImaging/delegate.h"

namespace hipr::record {

#if PXR_VERSION < 2105
/// Answers when it is asked for samples of "hipr:computed:points": skinned points (blend shapes, then joints)
/// over the shutter, at the samples of the animation and at least four more times evenly spread, for between
/// two points go straight. None for instances of skinned prims, which UsdImaging does not skin either.
class SkinnedScene final : public PXR_NS::UsdImagingDelegate {
public:
    using UsdImagingDelegate::UsdImagingDelegate;
    void Populate(const PXR_NS::UsdPrim& root) {
        _stage = root.GetStage();
        UsdImagingDelegate::Populate(root);
    }
    size_t SamplePrimvar(const PXR_NS::SdfPath& id, const PXR_NS::TfToken& key, size_t most, float* times,
                         PXR_NS::VtValue* values) override;

private:
    PXR_NS::UsdStageWeakPtr _stage;
};
#else
using SkinnedScene = PXR_NS::UsdImagingDelegate;
#endif

} // namespace hipr::record
