/// @file engine.h
/// A small Hydra application: stage in, AOV pixels out, through any render delegate. No GL and no display.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plugin/record/dataWindow.h"
#include "plugin/record/images.h"
#include "plugin/record/stage.h"
#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/vt/dictionary.h"
#include "pxr/imaging/hd/renderDelegate.h"

namespace hipr::record {

/// Parts of the scene to show, and how.
struct EngineOptions {
    int width = 0, height = 0;
    std::vector<std::string> aovs;     ///< Hydra AOV names; each must pass Engine::hasAov()
    std::vector<std::string> purposes; ///< "default", "render", "proxy", "guide"
    std::string conformPolicy = {};    ///< UsdRender's aspectRatioConformPolicy; empty: adjustApertureWidth
    float pixelAspect = 1;             ///< width over height of a pixel
    std::optional<DataWindow> window = {}; ///< what to render of width x height pixels; all of it without one
    int refineLevel = 0;                   ///< 0 is the control mesh; Hydra allows up to 8
};

/// Owns the render delegate, render index, scene delegate and AOV buffers. Use from one thread.
class Engine {
public:
    /// Creates the renderer called `renderer` (plugin id or display name), on a device when one is named:
    /// HiPR takes it as the setting "hipr:device". Throws Failure with ExitRender, which lists the renderers
    /// that exist.
    Engine(const std::string& renderer, const std::string& device);
    ~Engine();
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    PXR_NS::HdRenderDelegate& delegate() const;
    std::string rendererName() const;
    /// Whether the renderer fills the AOV. Some accept any name and leave those they do not know empty.
    bool hasAov(const std::string& aov) const;

    /// Fills the render index from the stage and allocates the AOV buffers. Call once. Throws Failure with
    /// ExitRender.
    void populate(const PXR_NS::UsdStageRefPtr& stage, const PXR_NS::SdfPath& camera,
                  const EngineOptions& options);

    /// The frame the next step() renders. Also tells the renderer what was edited on the stage.
    void setFrame(double frame);
    void setCamera(const PXR_NS::SdfPath& camera);
    /// Sends changes to the renderer, lets it work, and says whether every AOV has converged. Returns quickly
    /// when the renderer works in the background.
    bool step();
    /// Reads back all AOVs as they are now; the matrices are those of the camera at the current frame. Throws
    /// Failure with ExitRender when a buffer cannot be read.
    Picture read();
    /// Has read() get all samples of a picture that has not converged, denoised if that is asked for.
    void publishNow();
    /// Why the renderer cannot fill an AOV on this machine; empty where it can.
    std::string whyMissing(const std::string& aov) const;
    PXR_NS::VtDictionary stats() const;

    /// HiPR waits after every batch until read() has taken its picture; stats() counts them as
    /// "hipr:pictures".
    void publishEveryBatch();
    /// The text of hipr::Renderer::dumpScene(). Throws Failure with ExitUsage when the renderer is another.
    std::string sceneDump() const;

    /// The names that the manifest of a Cryptomatte AOV lists; none where the renderer is another.
    std::vector<std::string> cryptomatteNames(const std::string& aov) const;

private:
    struct Impl;
    std::unique_ptr<Impl> _impl;
};

/// Names of all installed renderers, best first.
std::vector<std::string> listRenderers();

/// Names of the AOVs of Hydra and of HiPR that `engine` fills. Those with a free part, "primvars:st", are not
/// among them.
std::vector<std::string> listAovs(const Engine& engine);

} // namespace hipr::record
