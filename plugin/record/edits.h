/// @file edits.h
/// Scripts of edits for a live stage: what an edit is, reading it from JSON, and applying it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pxr/pxr.h"
#include "pxr/usd/sdf/layer.h"
#include "pxr/usd/sdf/path.h"
#include "pxr/usd/usd/stage.h"

namespace hipr::record {

/// One edit. What it asks of the stage is applied in the order of the members, from `mute` to `activate`.
struct Edit {
    int index = 0;    ///< place in the script, from 1
    std::string name; ///< for people: shown, and part of file names; may be empty

    /// When to apply it, counted from the edit before (or from the start): after so many samples per pixel,
    /// or so many seconds, or, when neither is set, when the picture has converged.
    std::optional<int> afterSamples;
    std::optional<double> afterSeconds;

    std::vector<std::string> mute, unmute; ///< layer identifiers, or the ends of their paths
    std::vector<std::pair<PXR_NS::SdfPath, PXR_NS::SdfPath>> rename; ///< from, to; may also change the parent
    std::vector<PXR_NS::SdfPath> remove;
    std::string usda; ///< opinions to add; the header may be left out
    struct Variant {
        PXR_NS::SdfPath prim;
        std::string set, selection;
    };
    std::vector<Variant> variants;
    std::vector<PXR_NS::SdfPath> deactivate, activate;

    /// What it asks of the recorder; applyEdit() leaves these to its caller.
    std::optional<double> time;
    std::string camera;                                        ///< name or path; empty: the one before
    std::vector<std::pair<std::string, std::string>> settings; ///< render settings as key and text

    /// "edit 2 'move the ball'".
    std::string title() const;
};

/// Parses `{"edits": [...]}`; docs/guide.md describes the fields. Throws Failure with ExitUsage for anything
/// that is no such script; the message names the edit.
std::vector<Edit> parseEdits(const std::string& json);
/// parseEdits() of a file. Throws Failure with ExitUsage.
std::vector<Edit> readEdits(const std::string& path);

/// Applies an edit to the stage and returns whether any scene description changed. Nothing is ever saved.
/// Opinions and prims are authored into editLayer(); prims are removed and renamed in all layers of the
/// stage's own layer stack, so that they are truly gone, and relationship targets and connections there
/// follow a renamed prim. Relative asset paths in `usda` are those of the stage's root layer. Throws Failure
/// with ExitUsage for what cannot be done; the message names the edit.
bool applyEdit(const PXR_NS::UsdStageRefPtr& stage, const Edit& edit);

/// The layer that edits are authored into: an anonymous sublayer of the session layer, made when first asked
/// for.
PXR_NS::SdfLayerRefPtr editLayer(const PXR_NS::UsdStageRefPtr& stage);

} // namespace hipr::record
