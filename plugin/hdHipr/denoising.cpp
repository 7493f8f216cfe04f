#include "plugin/hdHipr/denoising.h"

#include "plugin/hdHipr/messages.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

/// Times as long as a picture took to be denoised, rendering is left alone.
constexpr double restShare = 4.0;

std::vector<float> readFloats(hipr::Renderer& renderer, hipr::AovRequest const& aov, size_t pixels) {
    std::vector<float> values(pixels * hipr::aovFormat(aov.kind).components);
    if (!renderer.readAov(aov, values.data(), values.size())) {
        values.clear();
    }
    return values;
}

} // namespace

std::vector<hipr::AovRequest> const& denoisingAovs() {
    static const std::vector<hipr::AovRequest> aovs = {
        {hipr::AovKind::Color, {}}, {hipr::AovKind::Albedo, {}}, {hipr::AovKind::Normal, {}}};
    return aovs;
}

hipr::NoisyPicture noisyPicture(hipr::Renderer& renderer, uint32_t width, uint32_t height) {
    hipr::NoisyPicture picture;
    if (renderer.readAov(denoisingAovs().front(), nullptr, 0)) {
        return picture; // a film without pixels
    }
    const size_t pixels = size_t(width) * height;
    picture.color = readFloats(renderer, denoisingAovs()[0], pixels);
    picture.albedo = readFloats(renderer, denoisingAovs()[1], pixels);
    picture.normal = readFloats(renderer, denoisingAovs()[2], pixels);
    if (!picture.color.empty()) {
        picture.width = width;
        picture.height = height;
    }
    return picture;
}

Denoising::~Denoising() {
    if (!_thread.joinable()) {
        return;
    }
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _stop.store(true);
        _quit.store(true);
    }
    _changed.notify_all();
    _thread.join();
}

void Denoising::start(hipr::NoisyPicture picture, int threadLimit) {
    stop();
    if (!_thread.joinable()) {
        _thread = std::thread([this] { run(); });
    }
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _picture = std::move(picture);
        _wantedThreadLimit = threadLimit;
        _stop.store(false);
        _state.store(State::Busy);
    }
    _changed.notify_all();
}

void Denoising::wait() {
    std::unique_lock<std::mutex> lock(_mutex);
    _changed.wait(lock, [this] { return _state.load() != State::Busy; });
}

bool Denoising::take(hipr::NoisyPicture& picture) {
    if (_state.load() != State::Done) {
        return false;
    }
    picture = std::move(_picture);
    _state.store(State::Idle);
    return true;
}

void Denoising::stop() {
    std::unique_lock<std::mutex> lock(_mutex);
    _stop.store(true);
    _changed.wait(lock, [this] { return _state.load() != State::Busy; });
    _state.store(State::Idle);
}

bool Denoising::due() const {
    const auto now = std::chrono::steady_clock::now();
    return _state.load() == State::Idle &&
           now - _ended >= std::chrono::duration<double>(restShare * _seconds.load());
}

void Denoising::run() {
    std::unique_lock<std::mutex> lock(_mutex);
    while (true) {
        _changed.wait(lock, [this] { return _quit.load() || _state.load() == State::Busy; });
        if (_quit.load()) {
            return;
        }
        lock.unlock();
        const auto start = std::chrono::steady_clock::now();
        try {
            denoise();
        } catch (std::exception const& error) { // no memory: nothing may leave the thread
            report(hipr::Severity::Error, "", std::string("denoising failed: ") + error.what());
        }
        lock.lock();
        _ended = std::chrono::steady_clock::now();
        _seconds.store(std::chrono::duration<double>(_ended - start).count());
        _state.store(_stop.load() ? State::Idle : State::Done);
        _changed.notify_all();
    }
}

void Denoising::denoise() {
    std::string error;
    if (!_denoiser || _threadLimit != _wantedThreadLimit) {
        _threadLimit = _wantedThreadLimit;
        _denoiser.reset(); // the device's memory, before another one takes some
        _denoiser = hipr::Denoiser::create(_threadLimit, &error);
    }
    if (_denoiser) {
        const std::vector<float> raw = _picture.color;
        const auto stopped = [this] { return _stop.load(); };
        if (_denoiser->denoise(_picture, stopped, &error) == hipr::Denoiser::Outcome::Failed) {
            _picture.color = raw;
        }
    }
    if (!error.empty()) {
        warnOnce("", "the AOV 'denoised' shows the noisy colour: " + error);
    }
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
