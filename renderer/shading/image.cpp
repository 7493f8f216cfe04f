#include "renderer/shading/image.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/gtc/packing.hpp>

#include "renderer/shading/image_file.h"
#include "renderer/vulkan/result.h"
#include "shaders/shared/material.h"

namespace hipr {

namespace {

constexpr float LargestHalf = 65504.f;

/// IEC 61966-2-1.
float decodeSrgb(float c) {
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

/// Spreads `channels` values to four as image.h says.
template <class T> void spread(const T* in, int channels, T one, T* out) {
    out[0] = in[0];
    out[1] = channels >= 3 ? in[1] : in[0];
    out[2] = channels >= 3 ? in[2] : in[0];
    out[3] = channels == 2 ? in[1] : (channels >= 4 ? in[3] : one);
}

/// Spreads all pixels and turns the rows over: files start at the top.
template <class T> std::vector<T> spreadImage(const ImageFile& file, T one) {
    std::vector<T> out(size_t(file.width) * file.height * 4);
    const T* in = reinterpret_cast<const T*>(file.pixels.data());
    for (uint32_t y = 0; y < file.height; ++y) {
        const T* row = in + size_t(file.height - 1 - y) * file.width * size_t(file.channels);
        for (uint32_t x = 0; x < file.width; ++x)
            spread(row + size_t(x) * size_t(file.channels), file.channels, one,
                   out.data() + (size_t(y) * file.width + x) * 4);
    }
    return out;
}

/// Whether every pixel's alpha is at least `one`.
template <class T> bool alphaIs(const std::vector<T>& values, T one) {
    for (size_t i = 3; i < values.size(); i += 4)
        if (!(values[i] >= one)) return false;
    return true;
}

std::vector<float> toFloat(const std::vector<uint8_t>& values) {
    std::vector<float> out(values.size());
    std::transform(values.begin(), values.end(), out.begin(), [](uint8_t v) { return float(v) / 255.f; });
    return out;
}

/// Stores linear floats as halves, or as floats when a value is too large for a half.
void storeFloats(std::vector<float>& values, Image& image) {
    bool fits = true;
    for (float& v : values) {
        if (std::isnan(v)) v = 0.f;
        if (std::isinf(v)) v = std::copysign(LargestHalf, v);
        fits = fits && std::abs(v) <= LargestHalf;
    }
    if (!fits) {
        image.format = gpu::TEXEL_RGBA32F;
        image.texels.resize(values.size() * sizeof(float));
        std::memcpy(image.texels.data(), values.data(), image.texels.size());
        return;
    }
    image.format = gpu::TEXEL_RGBA16F;
    image.texels.resize(values.size() * 2);
    for (size_t i = 0; i < values.size(); ++i) {
        const uint16_t half = glm::packHalf1x16(values[i]);
        std::memcpy(image.texels.data() + i * 2, &half, 2);
    }
}

} // namespace

size_t Image::bytesPerTexel() const {
    switch (format) {
    case gpu::TEXEL_RGBA16F:
        return 8;
    case gpu::TEXEL_RGBA32F:
        return 16;
    default:
        return 4;
    }
}

glm::vec4 Image::texel(uint32_t x, uint32_t y) const {
    const unsigned char* p = texels.data() + (size_t(y) * width + x) * bytesPerTexel();
    glm::vec4 v;
    if (format == gpu::TEXEL_RGBA32F) {
        std::memcpy(&v, p, 16);
    } else if (format == gpu::TEXEL_RGBA16F) {
        uint64_t packed;
        std::memcpy(&packed, p, 8);
        v = glm::unpackHalf4x16(packed);
    } else {
        v = glm::vec4(p[0], p[1], p[2], p[3]) / 255.f;
        if (format == gpu::TEXEL_RGBA8_SRGB)
            v = glm::vec4(decodeSrgb(v.x), decodeSrgb(v.y), decodeSrgb(v.z), v.w);
    }
    return v;
}

bool decodeImage(const std::vector<unsigned char>& bytes, const std::string& path,
                 const std::string& colorSpace, const ColorManager& color, Image& image, std::string& error) {
    try {
        ImageFile file;
        if (!readImageFile(bytes, path, file, error)) return false;
        image.width = file.width;
        image.height = file.height;
        image.wrapS = file.wrapS;
        image.wrapT = file.wrapT;
        const TexelTransfer transfer = color.transfer(colorSpace, file.eightBit, file.channels);
        std::vector<uint8_t> small;
        if (file.eightBit) small = spreadImage<uint8_t>(file, 255);
        if (file.eightBit) image.opaque = alphaIs(small, uint8_t(255));
        if (file.eightBit && transfer != TexelTransfer::Convert) {
            image.format = transfer == TexelTransfer::Srgb ? gpu::TEXEL_RGBA8_SRGB : gpu::TEXEL_RGBA8;
            image.texels = std::move(small);
        } else {
            std::vector<float> values = file.eightBit ? toFloat(small) : spreadImage<float>(file, 1.f);
            if (transfer == TexelTransfer::Convert)
                color.convert(colorSpace, values.data(), values.size() / 4);
            if (transfer == TexelTransfer::Srgb)
                for (size_t i = 0; i < values.size(); ++i)
                    if (i % 4 != 3) values[i] = decodeSrgb(values[i]);
            storeFloats(values, image);
        }
    } catch (const std::exception& e) { // out of memory on a broken or huge file
        error = reasonOf(e);
        return false;
    }
    return true;
}

} // namespace hipr
