#include "renderer/shading/host_texture.h"

#include <cmath>

namespace hipr {

namespace {

constexpr uint32_t MostTiles = 100; ///< 1001 to 1100
const std::string Udim = "<UDIM>";

float folded(float s, WrapMode wrap) {
    if (wrap == WrapMode::Repeat) return s - std::floor(s);
    if (wrap == WrapMode::Mirror) return 1.f - std::abs(1.f - (s - 2.f * std::floor(0.5f * s)));
    return glm::clamp(s, -2.f, 3.f);
}

/// The texel that stands for texel i; -1 for one of a black border.
int wrapped(int i, int size, WrapMode wrap) {
    if (wrap == WrapMode::Repeat) i = i < 0 ? i + size : (i >= size ? i - size : i);
    if (wrap == WrapMode::Black && (i < 0 || i >= size)) return -1;
    return glm::clamp(i, 0, size - 1);
}

/// Bilinear: texel centres are at half-integer texel coordinates.
glm::vec4 bilinear(const Image& image, const TextureDesc& desc, glm::vec2 st) {
    const WrapMode s = desc.wrapS == WrapMode::UseMetadata ? image.wrapS : desc.wrapS;
    const WrapMode t = desc.wrapT == WrapMode::UseMetadata ? image.wrapT : desc.wrapT;
    const glm::vec2 p(folded(st.x, s) * float(image.width) - 0.5f,
                      folded(st.y, t) * float(image.height) - 0.5f);
    const glm::vec2 corner = glm::floor(p), f = p - corner;
    glm::vec4 sum(0.f);
    for (int k = 0; k < 4; ++k) {
        const int x = wrapped(int(corner.x) + (k & 1), int(image.width), s);
        const int y = wrapped(int(corner.y) + (k >> 1), int(image.height), t);
        const float weight = (k & 1 ? f.x : 1.f - f.x) * (k >> 1 ? f.y : 1.f - f.y);
        if (x >= 0 && y >= 0 && weight > 0.f) sum += weight * image.texel(uint32_t(x), uint32_t(y));
    }
    return sum;
}

} // namespace

HostTexture::HostTexture(const TextureDesc& desc, const AssetReader& assets, const ColorManager& color,
                         const MessageSink& messages, const std::string& subject) {
    const size_t at = desc.path.find(Udim);
    _udim = at != std::string::npos;
    std::string error = "cannot be read";
    for (uint32_t tile = 0; tile < (_udim ? MostTiles : 1u); ++tile) {
        std::string path = desc.path;
        if (_udim) path.replace(at, Udim.size(), std::to_string(1001 + tile));
        try {
            Image image;
            const auto file = ImageFile::open(path, assets, error);
            if (file && decodeImage(*file, desc.colorSpace, color, image, error))
                _tiles.emplace(tile, std::move(image));
        } catch (const std::exception& failure) { // the host's reader
            error = failure.what();
        }
    }
    if (_tiles.empty()) messages(Severity::Warning, subject, "texture " + desc.path + ": " + error);
}

glm::vec4 HostTexture::sample(const TextureDesc& desc, glm::vec2 st) const {
    st = desc.uvTransform * glm::vec3(st, 1.f);
    uint32_t number = 0;
    if (_udim) {
        const glm::vec2 tile = glm::floor(st);
        if (!(tile.x >= 0.f && tile.x < 10.f && tile.y >= 0.f && tile.y < 10.f)) return desc.fallback;
        number = uint32_t(tile.x + 10.f * tile.y);
        st -= tile;
    }
    const auto found = _tiles.find(number);
    const bool usable = found != _tiles.end() && std::isfinite(st.x) && std::isfinite(st.y);
    return usable ? bilinear(found->second, desc, st) * desc.scale + desc.bias : desc.fallback;
}

} // namespace hipr
