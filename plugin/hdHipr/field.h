/// @file field.h
/// HdHiprField: one grid of an OpenVDB file.
#pragma once

#include "plugin/hdHipr/compat.h"
#include "pxr/imaging/hd/field.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// The one kind of fields that can be read: UsdVol's OpenVDBAsset.
TfToken const& vdbFieldType();

} // namespace hdhipr

/// The file is read while the field syncs, and once for all fields that show the same grid of it. A field's
/// own transform has no effect: a volume places its fields, as in Storm.
class HdHiprField final : public HdField {
public:
    using HdField::HdField;

    HdDirtyBits GetInitialDirtyBitsMask() const override { return AllDirty; }
    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits) override;
    void Finalize(HdRenderParam* renderParam) override;
};

PXR_NAMESPACE_CLOSE_SCOPE
