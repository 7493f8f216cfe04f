#include "renderer/color/view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/color/config.h"

namespace hipr {

struct ViewTransform::Impl {
    std::shared_ptr<const ColorManager> color; ///< owns the configuration that the processors read
    ColorChain chain;
    float scale = 1.f;
};

ViewTransform::ViewTransform() : _impl(std::make_unique<Impl>()) {}
ViewTransform::~ViewTransform() = default;

std::vector<std::string> ViewTransform::names(const ColorManager& color) {
    const auto& config = color._impl->config;
    std::vector<std::string> all;
    for (int d = 0; d < config->getNumDisplays(); ++d) {
        const char* display = config->getDisplay(d);
        for (int v = 0; v < config->getNumViews(display); ++v)
            all.push_back(std::string(display) + "/" + config->getView(display, v));
    }
    return all;
}

std::shared_ptr<const ViewTransform> ViewTransform::create(std::shared_ptr<const ColorManager> color,
                                                           const ViewTransformDesc& desc,
                                                           std::string* error) {
    const ColorManager::Impl& manager = *color->_impl;
    const std::string display = desc.display.empty() ? manager.config->getDefaultDisplay() : desc.display;
    const std::string view = desc.view.empty() ? manager.config->getDefaultView(display.c_str()) : desc.view;
    const std::vector<std::string> all = names(*color);
    if (std::find(all.begin(), all.end(), display + "/" + view) == all.end()) {
        std::string text = "unknown view \"" + display + "/" + view + "\"; there are";
        for (const std::string& name : all)
            text += " \"" + name + "\"";
        if (error) *error = text;
        return nullptr;
    }
    std::shared_ptr<ViewTransform> result(new ViewTransform);
    try {
        std::string source;
        result->_impl->chain = manager.chainInto(source);
        const auto processor = manager.config->getProcessor(source.c_str(), display.c_str(), view.c_str(),
                                                            ocio::TRANSFORM_DIR_FORWARD);
        result->_impl->chain.push_back(processor->getDefaultCPUProcessor());
    } catch (const std::exception& e) {
        if (error) *error = "view \"" + display + "/" + view + "\": " + e.what();
        return nullptr;
    }
    result->_impl->scale = std::exp2(desc.exposure);
    result->_impl->color = std::move(color);
    return result;
}

namespace {

uint8_t quantise(float v) {
    return uint8_t(std::lround(std::clamp(std::isnan(v) ? 0.f : v, 0.f, 1.f) * 255.f));
}

} // namespace

void ViewTransform::apply(const float* rgba, uint8_t* rgba8, size_t pixels) const {
    constexpr size_t Chunk = 1024; // fits the stack and the cache
    std::array<float, Chunk * 4> buffer;
    for (size_t first = 0; first < pixels; first += Chunk) {
        const size_t count = std::min(Chunk, pixels - first);
        for (size_t i = 0; i < count; ++i) {
            const float* in = rgba + (first + i) * 4;
            const float alpha = in[3];
            // A pixel without coverage may still carry light (a dome hidden from the camera, a glow): it
            // stays as it is.
            const float unassociate = alpha > 0.f ? _impl->scale / alpha : _impl->scale;
            for (int c = 0; c < 3; ++c) {
                const float v = in[c] * unassociate;
                buffer[i * 4 + c] = std::isfinite(v) ? v : (v > 0.f ? 65504.f : 0.f);
            }
            buffer[i * 4 + 3] = alpha;
        }
        applyChain(_impl->chain, buffer.data(), count);
        for (size_t i = 0; i < count * 4; ++i)
            rgba8[first * 4 + i] = quantise(buffer[i]);
    }
}

} // namespace hipr
