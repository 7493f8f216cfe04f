/// A host without a renderer: what of a stage's splats arrives in Hydra.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "plugin/hdHipr/compat.h"
#include "pxr/usd/usd/stage.h"
#include "renderer/api/splats.h"

PXR_NAMESPACE_OPEN_SCOPE

/// A particleField Rprim as it was synced last.
struct SyncedSplats {
    std::shared_ptr<const hipr::SplatCloud> cloud; ///< null: its values were never asked for
    std::vector<GfVec3d> places;                   ///< of its instances; one without an instancer
    GfVec3d up{0.0};                               ///< where the last one turns Y to
    bool visible = false;
    TfToken renderTag;
    int syncs = 0, valueSyncs = 0;
};

class SplatHost {
public:
    explicit SplatHost(UsdStageRefPtr const& stage);
    ~SplatHost();

    /// Brings Hydra up to date with the stage at a time; all particleField Rprims by their path.
    std::map<std::string, SyncedSplats> const& update(double time = 0.0);

private:
    struct Impl;
    std::unique_ptr<Impl> _impl;
};

/// Makes our plugins known to USD, once.
void registerSplatPlugins();

/// A stage of usda text. Throws when that is no usda.
UsdStageRefPtr splatStage(std::string const& text);

PXR_NAMESPACE_CLOSE_SCOPE
