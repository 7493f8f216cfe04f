#include "renderer/shading/texels.h"

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include <glm/gtc/packing.hpp>

#include "shaders/shared/material.h"

namespace hipr {

namespace {

constexpr int SrgbSteps = 65535; ///< a step is 1 / 40 of that from code 0 to code 1, where codes are closest

std::array<float, 256> srgbValues() {
    std::array<float, 256> values{};
    for (size_t i = 0; i < values.size(); ++i)
        values[i] = decodeSrgb(float(i) / 255.f);
    return values;
}

uint8_t toByte(double v) {
    return uint8_t(std::min(std::max(v, 0.0), 1.0) * 255.0 + 0.5);
}

std::vector<uint8_t> srgbCodes() {
    std::vector<uint8_t> codes(SrgbSteps + 1);
    for (size_t i = 0; i < codes.size(); ++i) {
        const double linear = double(i) / SrgbSteps;
        codes[i] = toByte(linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
    }
    return codes;
}

uint8_t encodeSrgb(float c) {
    static const std::vector<uint8_t> codes = srgbCodes();
    return codes[size_t(glm::clamp(c, 0.f, 1.f) * float(SrgbSteps) + 0.5f)];
}

} // namespace

size_t bytesPerTexel(uint32_t format) {
    switch (format) {
    case gpu::TEXEL_RGBA16F:
        return 8;
    case gpu::TEXEL_RGBA32F:
        return 16;
    default:
        return 4;
    }
}

float decodeSrgb(float c) {
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

void decodeTexels(uint32_t format, const unsigned char* texels, size_t count, glm::vec4* values) {
    static const std::array<float, 256> srgb = srgbValues();
    if (format == gpu::TEXEL_RGBA32F) {
        std::memcpy(values, texels, count * sizeof(glm::vec4));
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        const unsigned char* p = texels + i * bytesPerTexel(format);
        if (format == gpu::TEXEL_RGBA16F) {
            uint64_t packed;
            std::memcpy(&packed, p, 8);
            values[i] = glm::unpackHalf4x16(packed);
        } else if (format == gpu::TEXEL_RGBA8_SRGB) {
            values[i] = glm::vec4(srgb[p[0]], srgb[p[1]], srgb[p[2]], float(p[3]) / 255.f);
        } else {
            values[i] = glm::vec4(p[0], p[1], p[2], p[3]) / 255.f;
        }
    }
}

void encodeTexels(uint32_t format, const glm::vec4* values, size_t count, unsigned char* texels) {
    if (format == gpu::TEXEL_RGBA32F) {
        std::memcpy(texels, values, count * sizeof(glm::vec4));
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        unsigned char* p = texels + i * bytesPerTexel(format);
        const glm::vec4& v = values[i];
        if (format == gpu::TEXEL_RGBA16F) {
            const uint64_t packed = glm::packHalf4x16(v);
            std::memcpy(p, &packed, 8);
            continue;
        }
        const bool srgb = format == gpu::TEXEL_RGBA8_SRGB;
        for (int c = 0; c < 3; ++c)
            p[c] = srgb ? encodeSrgb(v[c]) : toByte(double(v[c]));
        p[3] = toByte(double(v.w));
    }
}

} // namespace hipr
