/// @file viewer.h
/// A small Hydra host that keeps one delegate and one render index through every edit, as usdview does.
#pragma once

#include <memory>

#include "testenv/edit/picture.h"
#include "testenv/edit/scene.h"

namespace hipr::test {

/// Use from one thread.
class Viewer {
public:
    Viewer();
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    /// Brings Hydra up to date with the stage and the view, and wakes the renderer. Does not wait for
    /// pictures.
    void tick(const PXR_NS::UsdStageRefPtr& stage, const View& view);
    bool converged() const;
    /// Waits for the picture of the last tick(). Throws std::runtime_error when that takes a minute.
    Picture picture();

    PXR_NS::VtDictionary stats() const;

private:
    struct Impl;
    std::unique_ptr<Impl> _impl;
};

/// The picture of a delegate that has never seen an edit.
Picture freshPicture(const Scene& scene);

} // namespace hipr::test
