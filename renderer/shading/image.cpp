#include "renderer/shading/image.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "renderer/shading/texels.h"
#include "renderer/vulkan/result.h"
#include "shaders/shared/material.h"

namespace hipr {

namespace {

constexpr float LargestHalf = 65504.f;
constexpr uint32_t BandRows = 64; ///< read and decoded at a time

/// Spreads `channels` values to four as image.h says.
template <class T> void spread(const T* in, int channels, T one, T* out) {
    out[0] = in[0];
    out[1] = channels >= 3 ? in[1] : in[0];
    out[2] = channels >= 3 ? in[2] : in[0];
    out[3] = channels == 2 ? in[1] : (channels >= 4 ? in[3] : one);
}

/// Turns the pixels of a file into texels, band by band.
class Decoder {
public:
    Decoder(ImageFile& file, const std::string& colorSpace, const ColorManager& color)
        : format(texelFormat(file.header(), colorSpace, color)), _file(file), _colorSpace(colorSpace),
          _color(color),
          _transfer(color.transfer(colorSpace, file.header().eightBit, file.header().channels)) {}

    const uint32_t format;
    bool opaque = true;   ///< so far
    bool halvesDo = true; ///< no value so far needs more

    bool weighted() const { return _file.header().channels % 2 == 0 && _transfer != TexelTransfer::Linear; }

    /// Hands all rows of a level to `take`, as texels, from the top.
    template <class Take> bool rows(size_t level, std::string& error, Take take) {
        const LevelSize size = _file.header().levels[level];
        const size_t channels = size_t(_file.header().channels),
                     rowBytes = size.width * bytesPerTexel(format);
        _pixels.resize(size_t(BandRows) * size.width * channels *
                       (_file.header().eightBit ? 1 : sizeof(float)));
        _texels.resize(BandRows * rowBytes);
        for (uint32_t y = 0; y < size.height; y += BandRows) {
            const uint32_t count = std::min(BandRows, size.height - y);
            if (!_file.read(level, y, count, _pixels.data(), error)) return false;
            decode(size_t(count) * size.width);
            for (uint32_t row = 0; row < count; ++row)
                take(_texels.data() + row * rowBytes);
        }
        return true;
    }

private:
    void decode(size_t pixels);
    void decodeBytes(size_t pixels);
    void makeFinite(float& value);

    ImageFile& _file;
    const std::string& _colorSpace;
    const ColorManager& _color;
    TexelTransfer _transfer;
    std::vector<unsigned char> _pixels, _texels;
    std::vector<uint8_t> _bytes;
    std::vector<glm::vec4> _values;
};

/// To four channels of 8 bits.
void Decoder::decodeBytes(size_t pixels) {
    const int channels = _file.header().channels;
    _bytes.resize(pixels * 4);
    for (size_t i = 0; i < pixels; ++i) {
        spread<uint8_t>(_pixels.data() + i * size_t(channels), channels, 255, _bytes.data() + i * 4);
        opaque = opaque && _bytes[i * 4 + 3] == 255;
    }
}

void Decoder::makeFinite(float& value) {
    if (std::isnan(value)) value = 0.f;
    if (std::isinf(value)) value = std::copysign(LargestHalf, value);
    halvesDo = halvesDo && std::abs(value) <= LargestHalf;
    if (format == gpu::TEXEL_RGBA16F) value = glm::clamp(value, -LargestHalf, LargestHalf);
}

void Decoder::decode(size_t pixels) {
    const ImageHeader& header = _file.header();
    if (header.eightBit) decodeBytes(pixels);
    if (format == gpu::TEXEL_RGBA8 || format == gpu::TEXEL_RGBA8_SRGB) {
        std::memcpy(_texels.data(), _bytes.data(), pixels * 4);
        return;
    }
    _values.resize(pixels);
    if (header.eightBit) {
        decodeTexels(gpu::TEXEL_RGBA8, _bytes.data(), pixels, _values.data());
    } else {
        opaque = false; // not looked for
        const float* in = reinterpret_cast<const float*>(_pixels.data());
        for (size_t i = 0; i < pixels; ++i)
            spread(in + i * size_t(header.channels), header.channels, 1.f, &_values[i].x);
    }
    if (_transfer == TexelTransfer::Convert) _color.convert(_colorSpace, &_values[0].x, pixels);
    for (size_t i = 0; i < pixels; ++i) {
        glm::vec4& v = _values[i];
        if (_transfer == TexelTransfer::Srgb)
            v = glm::vec4(decodeSrgb(v.x), decodeSrgb(v.y), decodeSrgb(v.z), v.w);
        for (int c = 0; c < 4; ++c)
            makeFinite(v[c]);
    }
    encodeTexels(format, _values.data(), pixels, _texels.data());
}

/// Turns floats to halves.
void narrow(Image& image) {
    std::vector<unsigned char> halves(image.texels.size() / 2);
    std::vector<glm::vec4> values(4096);
    const size_t texels = image.texels.size() / bytesPerTexel(gpu::TEXEL_RGBA32F);
    for (size_t i = 0; i < texels; i += values.size()) {
        const size_t count = std::min(values.size(), texels - i);
        decodeTexels(gpu::TEXEL_RGBA32F, image.texels.data() + i * 16, count, values.data());
        encodeTexels(gpu::TEXEL_RGBA16F, values.data(), count, halves.data() + i * 8);
    }
    image.texels = std::move(halves);
    image.format = gpu::TEXEL_RGBA16F;
}

void describe(const ImageFile& file, const Decoder& decoder, size_t finest, Image& image) {
    const ImageHeader& header = file.header();
    const LevelSize size = levelSizes(header.levels[0])[finest];
    image.width = size.width;
    image.height = size.height;
    image.format = decoder.format;
    image.wrapS = header.wrapS;
    image.wrapT = header.wrapT;
    image.opaque = decoder.opaque;
    if (image.format == gpu::TEXEL_RGBA32F && decoder.halvesDo) narrow(image);
}

/// Copies rows that come from the top to a level that starts at the bottom.
bool copyLevel(Decoder& decoder, size_t level, LevelSize size, unsigned char* texels, std::string& error) {
    const size_t bytes = size.width * bytesPerTexel(decoder.format);
    unsigned char* row = texels + size.height * bytes;
    return decoder.rows(level, error, [&](const unsigned char* in) { std::memcpy(row -= bytes, in, bytes); });
}

} // namespace

glm::vec4 Image::texel(uint32_t x, uint32_t y) const {
    glm::vec4 value;
    decodeTexels(format, texels.data() + (size_t(y) * width + x) * bytesPerTexel(format), 1, &value);
    return value;
}

uint32_t texelFormat(const ImageHeader& header, const std::string& colorSpace, const ColorManager& color) {
    const TexelTransfer transfer = color.transfer(colorSpace, header.eightBit, header.channels);
    if (header.eightBit && transfer != TexelTransfer::Convert)
        return transfer == TexelTransfer::Srgb ? gpu::TEXEL_RGBA8_SRGB : gpu::TEXEL_RGBA8;
    return header.large ? gpu::TEXEL_RGBA32F : gpu::TEXEL_RGBA16F;
}

bool decodeImage(ImageFile& file, const std::string& colorSpace, const ColorManager& color, Image& image,
                 std::string& error) {
    try {
        Decoder decoder(file, colorSpace, color);
        const LevelSize size = file.header().levels[0];
        image.texels.resize(levelBytes({size}, decoder.format));
        if (!copyLevel(decoder, 0, size, image.texels.data(), error)) return false;
        describe(file, decoder, 0, image);
    } catch (const std::exception& e) { // out of memory on a broken or huge file
        error = reasonOf(e);
        return false;
    }
    return true;
}

bool decodeLevels(ImageFile& file, const std::string& colorSpace, const ColorManager& color, size_t finest,
                  Image& image, std::string& error) {
    try {
        Decoder decoder(file, colorSpace, color);
        const std::vector<LevelSize>& stored = file.header().levels;
        std::vector<LevelSize> kept = levelSizes(stored[0]);
        kept.erase(kept.begin(), kept.begin() + ptrdiff_t(finest));
        image.texels.resize(levelBytes(kept, decoder.format));
        unsigned char* texels = image.texels.data();
        for (size_t level = finest; level + 1 < stored.size(); ++level) {
            if (!copyLevel(decoder, level, stored[level], texels, error)) return false;
            texels += levelBytes({stored[level]}, decoder.format);
        }
        const size_t last = stored.size() - 1, first = finest > last ? finest - last : 0;
        LevelBuilder builder(stored[last], decoder.format, decoder.weighted(), uint32_t(first), texels);
        if (!decoder.rows(last, error, [&](const unsigned char* row) { builder.addRow(row); })) return false;
        describe(file, decoder, finest, image);
    } catch (const std::exception& e) {
        error = reasonOf(e);
        return false;
    }
    return true;
}

} // namespace hipr
