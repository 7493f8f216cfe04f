/// @file denoising.h
/// The AOV `denoised`: pictures are denoised by a thread of their own while the renderer goes on.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "plugin/hdHipr/compat.h"
#include "renderer/api/denoise.h"
#include "renderer/api/renderer.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// The AOVs that a film must have for it.
std::vector<hipr::AovRequest> const& denoisingAovs();

/// What the renderer shows now, to be denoised. A picture without pixels where it has none.
hipr::NoisyPicture noisyPicture(hipr::Renderer& renderer, uint32_t width, uint32_t height);

/// A thread that denoises one picture at a time, from the first one on. Where there is no library, or it
/// fails, that is told once, and pictures are given back as they came. All members are for one thread, the
/// render thread.
class Denoising {
public:
    Denoising() = default;
    ~Denoising();

    /// Hands a picture over; a running one is stopped and lost.
    void start(hipr::NoisyPicture picture, int threadLimit);
    /// Whether a picture is being denoised.
    bool busy() const { return _state.load() == State::Busy; }
    /// Takes the finished picture. False if there is none.
    bool take(hipr::NoisyPicture& picture);
    void wait(); ///< until none is being denoised
    void stop(); ///< the same, soon, and there is nothing to take

    /// Whether another picture may be started while rendering goes on: denoising may take a fifth of the
    /// time.
    bool due() const;
    /// Of the last picture, from its start to its end; may be called from any thread.
    double seconds() const { return _seconds.load(); }

private:
    enum class State { Idle, Busy, Done };
    void run();
    void denoise();

    std::thread _thread; ///< made with the first picture
    std::unique_ptr<hipr::Denoiser> _denoiser;
    int _threadLimit = 0; ///< of _denoiser
    std::mutex _mutex;
    std::condition_variable _changed;
    std::atomic<State> _state{State::Idle};
    std::atomic<bool> _stop{false}, _quit{false};
    hipr::NoisyPicture _picture; ///< of the thread while Busy
    int _wantedThreadLimit = 0;
    std::chrono::steady_clock::time_point _ended;
    std::atomic<double> _seconds{0};
};

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
