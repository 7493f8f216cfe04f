#include "plugin/hdHipr/field.h"

#include "plugin/hdHipr/assets.h"
#include "plugin/hdHipr/renderParam.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

std::string textOf(VtValue const& value) {
    if (value.IsHolding<TfToken>()) {
        return value.UncheckedGet<TfToken>().GetString();
    }
    return value.IsHolding<std::string>() ? value.UncheckedGet<std::string>() : std::string();
}

} // namespace

TfToken const& hdhipr::vdbFieldType() {
    static const TfToken type("openvdbAsset");
    return type;
}

void HdHiprField::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits) {
    auto& param = static_cast<HdHiprRenderParam&>(*renderParam);
    if (*dirtyBits & DirtyParams) {
        const std::string path = assetPath(delegate->Get(GetId(), HdFieldTokens->filePath));
        const hipr::FieldChoice choice{textOf(delegate->Get(GetId(), TfToken("fieldName"))),
                                       fieldIndex(delegate, GetId())};
        param.shownFields().set(param.fieldId(GetId()), GetId(), path, choice, param.edit());
    }
    *dirtyBits = Clean;
}

void HdHiprField::Finalize(HdRenderParam* renderParam) {
    if (!GetId().IsEmpty()) {
        auto& param = static_cast<HdHiprRenderParam&>(*renderParam);
        param.shownFields().remove(param.fieldId(GetId()), param.edit());
    }
}

PXR_NAMESPACE_CLOSE_SCOPE
