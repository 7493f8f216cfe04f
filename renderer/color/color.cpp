#include "renderer/color/color.h"

#include <array>
#include <cstdlib>
#include <sstream>

#include "renderer/color/config.h"

namespace hipr {

namespace {

/// Names under which common configurations hold linear Rec.709.
constexpr std::array LinearRec709Names = {"lin_rec709",
                                          "lin_rec709_srgb",
                                          "Linear Rec.709 (sRGB)",
                                          "Utility - Linear - sRGB",
                                          "Utility - Linear - Rec.709",
                                          "lin_srgb"};
constexpr const char* AcesInterchange = "aces_interchange";

bool isSrgbTextureName(const std::string& name) {
    return name == "sRGB" || name == "srgb_texture" || name == "srgb_tx" || name == "sRGB - Texture" ||
           name == "Utility - sRGB - Texture" || name == "sRGB Encoded Rec.709 (sRGB)";
}

ocio::ConstConfigRcPtr loadBuiltin() {
    std::istringstream text(builtinColorConfig());
    return ocio::Config::CreateFromStream(text);
}

/// The rendering space in a configuration; empty when only aces_interchange leads to it. Throws when neither
/// exists.
std::string findRendering(const ocio::ConstConfigRcPtr& config) {
    for (const char* name : LinearRec709Names)
        if (config->getColorSpace(name)) return name;
    if (config->getColorSpace(AcesInterchange)) return {};
    throw ocio::Exception("it has neither linear Rec.709 nor the role aces_interchange");
}

ocio::ConstCPUProcessorRcPtr cpu(const ocio::ConstProcessorRcPtr& processor) {
    return processor->getOptimizedCPUProcessor(ocio::BIT_DEPTH_F32, ocio::BIT_DEPTH_F32,
                                               ocio::OPTIMIZATION_DEFAULT);
}

} // namespace

void applyChain(const ColorChain& chain, float* rgba, size_t pixels) {
    // OpenColorIO counts pixels with long; one row keeps the image description simple.
    for (const auto& processor : chain) {
        ocio::PackedImageDesc image(rgba, long(pixels), 1, 4);
        processor->apply(image);
    }
}

ColorChain ColorManager::Impl::chainFrom(const std::string& space) const {
    if (!rendering.empty()) return {cpu(config->getProcessor(space.c_str(), rendering.c_str()))};
    return {cpu(config->getProcessor(space.c_str(), AcesInterchange)),
            cpu(builtin->getProcessor(AcesInterchange, "lin_rec709"))};
}

ColorChain ColorManager::Impl::chainInto(std::string& reached) const {
    reached = rendering.empty() ? AcesInterchange : rendering;
    if (!rendering.empty()) return {};
    return {cpu(builtin->getProcessor("lin_rec709", AcesInterchange))};
}

ColorManager::ColorManager() : _impl(std::make_unique<Impl>()) {}
ColorManager::~ColorManager() = default;

std::shared_ptr<const ColorManager> ColorManager::create(const MessageSink& messages) {
    std::shared_ptr<ColorManager> manager(new ColorManager);
    Impl& impl = *manager->_impl;
    impl.messages = messages;
    impl.builtin = impl.config = loadBuiltin();
    impl.rendering = "lin_rec709";
    const char* file = std::getenv("OCIO");
    if (!file || !*file) return manager;
    try {
        const ocio::ConstConfigRcPtr config = ocio::Config::CreateFromFile(file);
        config->validate();
        impl.rendering = findRendering(config);
        impl.config = config;
    } catch (const std::exception& e) {
        impl.config = impl.builtin;
        impl.rendering = "lin_rec709";
        if (messages)
            messages(Severity::Warning, "",
                     std::string("cannot use the OpenColorIO configuration $OCIO=") + file + ": " + e.what() +
                         "; using the built-in one");
    }
    return manager;
}

TexelTransfer ColorManager::transfer(const std::string& colorSpace, bool eightBit, int channels) const {
    const TexelTransfer automatic = eightBit && channels >= 3 ? TexelTransfer::Srgb : TexelTransfer::Linear;
    if (colorSpace.empty() || colorSpace == "auto") return automatic;
    if (colorSpace == "raw") return TexelTransfer::Linear;
    if (isSrgbTextureName(colorSpace)) return TexelTransfer::Srgb;

    std::lock_guard lock(_impl->mutex);
    auto known = _impl->toRendering.find(colorSpace);
    if (known == _impl->toRendering.end() && !_impl->reported.count(colorSpace)) {
        try {
            const auto space = _impl->config->getColorSpace(colorSpace.c_str());
            if (!space) throw ocio::Exception("the configuration has no such space");
            ColorChain chain = space->isData() ? ColorChain{} : _impl->chainFrom(colorSpace);
            if (chain.size() == 1 && chain[0]->isNoOp()) chain.clear();
            known = _impl->toRendering.emplace(colorSpace, std::move(chain)).first;
        } catch (const std::exception& e) {
            _impl->reported.insert(colorSpace);
            if (_impl->messages)
                _impl->messages(Severity::Warning, "",
                                "texture colour space \"" + colorSpace + "\": " + e.what() +
                                    "; using \"auto\"");
        }
    }
    if (known == _impl->toRendering.end()) return automatic;
    return known->second.empty() ? TexelTransfer::Linear : TexelTransfer::Convert;
}

void ColorManager::convert(const std::string& colorSpace, float* rgba, size_t pixels) const {
    ColorChain chain;
    {
        std::lock_guard lock(_impl->mutex);
        const auto known = _impl->toRendering.find(colorSpace);
        if (known != _impl->toRendering.end()) chain = known->second;
    }
    applyChain(chain, rgba, pixels);
}

} // namespace hipr
