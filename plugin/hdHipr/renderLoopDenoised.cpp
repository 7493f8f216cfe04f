#include <algorithm>
#include <thread>

#include "plugin/hdHipr/renderBuffer.h"
#include "plugin/hdHipr/renderLoop.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

bool RenderLoop::wantsDenoised() {
    std::lock_guard<std::mutex> lock(_publishMutex);
    return std::any_of(_shownFrame.targets.begin(), _shownFrame.targets.end(),
                       [](AovTarget const& target) { return target.denoised; });
}

void RenderLoop::startDenoising() {
    PixelRect const& rect = _shownFrame.rect;
    _denoising.start(
        noisyPicture(*_renderer, uint32_t(std::max(rect.width, 0)), uint32_t(std::max(rect.height, 0))),
        _threadLimit);
}

/// While rendering goes on, as far as somebody looks and it takes little of the time. Called under
/// _publishMutex.
void RenderLoop::denoiseMeanwhile() {
    auto const& targets = _shownFrame.targets;
    const bool looksAt = std::any_of(targets.begin(), targets.end(), [](AovTarget const& target) {
        return target.denoised && target.buffer->taken();
    });
    if (looksAt && _denoising.due()) {
        startDenoising();
    }
}

/// Publishes a picture that has been denoised, if there is one.
bool RenderLoop::showDenoised() {
    hipr::NoisyPicture picture;
    if (!_denoising.take(picture)) {
        return false;
    }
    std::lock_guard<std::mutex> lock(_publishMutex);
    const bool fits = int64_t(picture.width) == _shownFrame.rect.width &&
                      int64_t(picture.height) == _shownFrame.rect.height;
    for (AovTarget const& target : _shownFrame.targets) {
        if (target.denoised && fits) {
            std::vector<float> pixels = picture.color; // other targets may have other clear colours
            writeColor(target, pixels);
            _denoisedShown = true;
        }
    }
    return true;
}

/// Shows the last picture without noise. False if something else is asked for meanwhile.
bool RenderLoop::finishDenoising() {
    if (!wantsDenoised()) {
        return true;
    }
    startDenoising();
    while (!showDenoised()) {
        if (_stopped.load() || _thread.IsStopRequested() || _pickedVersion != _version.load()) {
            _denoising.stop();
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

void RenderLoop::publishNow() {
    whenIdle([this](hipr::Renderer&) {
        publish(true);
        if (wantsDenoised()) {
            startDenoising();
            _denoising.wait();
            showDenoised();
        }
    });
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
