/// @file renderLoop.h
/// The render thread: picks up edits, settings and frames between batches and publishes pictures to render
/// buffers.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "plugin/hdHipr/compat.h"
#include "plugin/hdHipr/denoising.h"
#include "pxr/imaging/hd/renderThread.h"
#include "renderer/api/renderer.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprRenderBuffer;

namespace hdhipr {

/// An AOV binding of a render pass.
struct AovTarget {
    std::optional<hipr::AovRequest> aov; ///< nothing: HiPR does not know the AOV; the buffer stays cleared
    HdHiprRenderBuffer* buffer = nullptr;
    unsigned int allocation = 0; ///< the buffer's content is new when this changes
    VtValue clearValue;
    bool denoised = false; ///< color without noise
    bool operator==(AovTarget const& o) const {
        return aov == o.aov && buffer == o.buffer && allocation == o.allocation &&
               clearValue == o.clearValue && denoised == o.denoised;
    }
};

/// What a render pass asks for: a view of the scene in some buffers.
struct Frame {
    hipr::CameraDesc camera;
    PixelRect rect;
    std::vector<AovTarget> targets;
    bool skyVisible = false; ///< a dome light fills the background, so the host's clear colour does not show
};

struct LoopStats {
    hipr::Progress progress;
    hipr::MemoryReport memory;
    uint64_t changes = 0;       ///< requests so far that changed something
    size_t changedElements = 0; ///< elements that the last of them changed, and how
    hipr::Change lastChange = hipr::Change::None;
    double denoiseSeconds = 0; ///< that the last denoised picture took
};

/// Owns the renderer. Hydra's threads hand over requests and never wait for rendering; the render thread
/// takes the newest of them between two batches. A batch is cut short for a newer request only when the
/// current one has been shown, so that a stream of edits (a drag) always shows pictures.
class RenderLoop {
public:
    explicit RenderLoop(std::unique_ptr<hipr::Renderer> renderer);
    ~RenderLoop();

    hipr::Renderer& renderer() { return *_renderer; }

    /// Requests, for the main thread. Each restarts the picture only when it changes something.
    void submitEdit(hipr::SceneEdit& edit); ///< moves the content out of `edit`
    void submitSettings(hipr::Settings const& settings);
    void submitTextureReload(); ///< see Renderer::reloadTextures()
    void submitFrame(Frame const& frame);

    /// The buffer will not be written any more when this returns.
    void releaseBuffer(HdHiprRenderBuffer* buffer);

    /// For recorders: every batch publishes its picture and waits until the host has resolved all buffers, so
    /// that it misses none. pictures() counts them.
    void setPublishEveryBatch(bool on) { _everyBatch.store(on); }
    uint64_t pictures() const { return _pictures.load(); }

    /// Lets `look` see the renderer with all edits so far. Rendering stops meanwhile.
    void whenIdle(std::function<void(hipr::Renderer&)> const& look);

    /// Brings all buffers up to date, the denoised one too, although more samples are to come.
    void publishNow();

    /// Wakes the render thread when there is something to render.
    void kick();

    /// True when everything asked for so far has been rendered to the last sample and written to the buffers.
    bool converged() const { return _convergedVersion.load() == _version.load(); }

    void pause();
    void resume();
    void stop(); ///< returns when the render thread is idle
    void restart();
    bool paused() const { return _paused.load(); }
    bool stopped() const { return _stopped.load(); }

    LoopStats stats() const;

    /// What the last request that changed something changed. A request may hold several edits, a new film
    /// and settings.
    hipr::ChangedSet lastChanged() const;

private:
    void run();
    void renderRequests();
    void pickUp();
    bool publish(bool last);
    void waitUntilTaken();
    void publishTarget(AovTarget const& target);
    void writeColor(AovTarget const& target, std::vector<float>& pixels);
    bool wantsDenoised();
    void startDenoising();
    void denoiseMeanwhile();
    bool showDenoised();
    bool finishDenoising();
    bool finish();
    void converge();
    void changed();

    std::unique_ptr<hipr::Renderer> _renderer;
    HdRenderThread _thread;

    mutable std::mutex _requestMutex; ///< guards the request; held briefly
    hipr::SceneEdit _edit;
    hipr::Settings _settings;
    bool _reloadTextures = false;
    Frame _frame;
    hipr::MemoryReport _memory;
    hipr::ChangedSet _lastChanged;
    uint64_t _changes = 0;
    uint64_t _committedVersion = 0;             ///< the request that the renderer has got
    std::atomic<uint64_t> _version{0};          ///< number of the newest request
    std::atomic<uint64_t> _convergedVersion{0}; ///< the request that was rendered to the end last

    std::mutex _publishMutex; ///< guards _shownFrame while buffers are written; taken before _requestMutex
    Frame _shownFrame;
    std::vector<float> _scratch;
    bool _firstHitsShown = false;
    Denoising _denoising;        ///< render thread only
    bool _denoisedShown = false; ///< the buffers hold a denoised picture, of this scene or an earlier one
    int _threadLimit = 0;
    std::chrono::steady_clock::time_point _lastPublish;
    uint64_t _publishedPaths = 0; ///< traced when the last picture was published

    uint64_t _pickedVersion = 0;     ///< render thread only
    bool _broken = false;            ///< render thread only; it gave up, and requests go unrendered
    std::atomic<bool> _shown{false}; ///< the picked-up request has been published at least once
    std::atomic<bool> _paused{false}, _stopped{false}, _everyBatch{false};
    std::atomic<uint64_t> _pictures{0}; ///< published so far
};

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
