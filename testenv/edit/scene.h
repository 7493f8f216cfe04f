/// @file scene.h
/// The edited scene: a stage whose layers are never saved, and how it is looked at.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "pxr/base/vt/value.h"
#include "pxr/usd/sdf/layer.h"
#include "pxr/usd/usd/stage.h"

namespace hipr::test {

/// What a host decides, as opposed to the stage.
struct View {
    int width = 64, height = 32;
    double time = 1;
    int refineLevel = 1;
    std::string camera = "/Camera";
    bool render = true, proxy = false, guide = false;
    std::map<std::string, PXR_NS::VtValue> settings = {{"convergedSamplesPerPixel", PXR_NS::VtValue(1)},
                                                       {"hipr:maxDepth", PXR_NS::VtValue(3)}};
};

/// Opens one of testenv/edit/scenes. Edits change its layers in memory; reset() takes them all back.
class Scene {
public:
    explicit Scene(const std::string& name = "world.usda");
    ~Scene(); ///< takes all edits back: layers are shared by everyone in the process who opens the same file
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    const PXR_NS::UsdStageRefPtr& stage() const { return _stage; }
    View view;

    /// Composes the layers anew, as they are now, into a stage that has never seen an edit.
    PXR_NS::UsdStageRefPtr reopened() const;
    /// Replaces the stage by a reopened one: what a host does when it loads another scene.
    void swapStage();
    void reset();

private:
    PXR_NS::UsdStageRefPtr _stage;
    std::vector<std::pair<PXR_NS::SdfLayerRefPtr, PXR_NS::SdfLayerRefPtr>>
        _saved; ///< layer, its first content
};

} // namespace hipr::test
