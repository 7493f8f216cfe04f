#include "plugin/hdHipr/renderSettingsPrim.h"

#if PXR_VERSION >= 2311

#include "pxr/imaging/hd/renderDelegate.h"
#include "pxr/imaging/hd/renderIndex.h"
#include "pxr/imaging/hd/sceneDelegate.h"

PXR_NAMESPACE_OPEN_SCOPE

void HdHiprRenderSettings::_Sync(HdSceneDelegate* delegate, HdRenderParam*, const HdDirtyBits* dirtyBits) {
    constexpr HdDirtyBits followed = DirtyActive | DirtyNamespacedSettings | DirtyRenderProducts;
    if (!IsActive() || !(*dirtyBits & followed)) {
        return;
    }
    HdRenderDelegate* const renderer = delegate->GetRenderIndex().GetRenderDelegate();
    for (auto const& [name, value] : GetNamespacedSettings()) {
        renderer->SetRenderSetting(TfToken(name), value);
    }
    if (GetRenderProducts().empty()) {
        return;
    }
    RenderProduct const& product = GetRenderProducts().front();
    renderer->SetRenderSetting(TfToken("enableMotionBlur"), VtValue(!product.disableMotionBlur));
#if PXR_VERSION >= 2403
    renderer->SetRenderSetting(TfToken("enableDepthOfField"), VtValue(!product.disableDepthOfField));
#endif
}

PXR_NAMESPACE_CLOSE_SCOPE

#endif
