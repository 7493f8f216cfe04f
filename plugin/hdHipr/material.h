/// @file material.h
/// HdHiprMaterial: a material network as the renderer's description.
#pragma once

#include <optional>

#include "plugin/hdHipr/compat.h"
#include "renderer/api/material.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprMaterial final : public hdhipr::MaterialBase {
public:
    using MaterialBase::MaterialBase;

    HdDirtyBits GetInitialDirtyBitsMask() const override { return AllDirty; }
    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits) override;
    void Finalize(HdRenderParam* renderParam) override;

    /// As synced last; none without a surface.
    std::optional<hipr::MaterialDesc> const& surface() const { return _surface; }

private:
    std::optional<hipr::MaterialDesc> _surface;
};

namespace hdhipr {

/// The surface of the material prim at a path; none without one. While rprims sync: materials have, by then.
std::optional<hipr::MaterialDesc> surfaceOf(HdRenderIndex& index, SdfPath const& path);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
