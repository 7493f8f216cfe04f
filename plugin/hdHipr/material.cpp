#include "plugin/hdHipr/material.h"

#include "plugin/hdHipr/materialNetwork.h"
#include "plugin/hdHipr/renderParam.h"
#include "plugin/hdHipr/volumeMaterial.h"

PXR_NAMESPACE_OPEN_SCOPE

void HdHiprMaterial::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits) {
    auto& param = static_cast<HdHiprRenderParam&>(*renderParam);
    if (*dirtyBits & (DirtyResource | DirtyParams)) {
        const HdMaterialNetworkMap networks = hdhipr::materialNetworks(*delegate, GetId());
        _surface = hdhipr::materialDesc(GetId(), networks);
        param.setMaterial(GetId(), _surface);
        if (const auto look = hdhipr::volumeLook(GetId(), networks)) {
            param.edit().setVolumeLook(param.materialId(GetId()), *look);
        } else {
            param.edit().removeVolumeLook(param.materialId(GetId()));
        }
    }
    *dirtyBits = Clean;
}

void HdHiprMaterial::Finalize(HdRenderParam* renderParam) {
    auto& param = static_cast<HdHiprRenderParam&>(*renderParam);
    if (!GetId().IsEmpty()) {
        param.setMaterial(GetId(), std::nullopt);
        param.edit().removeVolumeLook(param.materialId(GetId()));
    }
}

std::optional<hipr::MaterialDesc> hdhipr::surfaceOf(HdRenderIndex& index, SdfPath const& path) {
    auto const* material =
        static_cast<HdHiprMaterial const*>(index.GetSprim(HdPrimTypeTokens->material, path));
    return material ? material->surface() : std::nullopt;
}

PXR_NAMESPACE_CLOSE_SCOPE
