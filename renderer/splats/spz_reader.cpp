// .spz: a gzip stream of a header of 16 bytes and, attribute by attribute, all splats' positions, opacities,
// colours, scales, orientations and higher coefficients (https://github.com/nianticlabs/spz, README).
#include <algorithm>
#include <cmath>
#include <limits>

#include <zlib.h>

#include "renderer/splats/arrays.h"
#include "renderer/splats/splat_file.h"
#include "renderer/splats/tidy.h"

namespace hipr {
namespace {

using Byte = unsigned char;

constexpr uint32_t magic = 0x5053474e;
constexpr size_t headerBytes = 16;
/// What deflate can make of one byte at most; a header that promises more lies.
constexpr double mostInflation = 1032;
constexpr size_t blockSplats = 4096;
/// Of the first coefficient's 8 bits: the value at both ends is +-0.5 / colourScale.
constexpr float colourScale = 0.15f;

uint32_t little(const Byte* from, int bytes) {
    uint32_t value = 0;
    for (int i = bytes; i-- > 0;)
        value = value << 8 | from[i];
    return value;
}

class Inflater {
public:
    Inflater(ByteView file, const SplatReadOptions& options) : _file(file), _options(options) {
        constexpr int gzip = 16;
        if (inflateInit2(&_stream, MAX_WBITS + gzip) != Z_OK) throw SplatFileError("cannot be inflated");
    }
    ~Inflater() { inflateEnd(&_stream); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    void read(Byte* out, size_t bytes) {
        _stream.next_out = out;
        _stream.avail_out = uInt(bytes);
        while (_stream.avail_out > 0) {
            if (_stream.avail_in == 0) feed();
            const int result = inflate(&_stream, Z_NO_FLUSH);
            if (_stream.avail_out == 0) break;
            if (result == Z_STREAM_END) throw SplatFileError("is cut off: it ends before all its splats do");
            if (result != Z_OK) throw SplatFileError("is damaged: its compressed data makes no sense");
        }
        if (_options.progress) _options.progress(double(_fed - _stream.avail_in) / double(_file.size));
    }

private:
    void feed() {
        if (_fed == _file.size) throw SplatFileError("is cut off: it ends before all its splats do");
        const size_t some = std::min<size_t>(_file.size - _fed, 1 << 20);
        _stream.next_in = const_cast<Byte*>(_file.data + _fed); // zlib reads only
        _stream.avail_in = uInt(some);
        _fed += some;
    }

    ByteView _file;
    const SplatReadOptions& _options;
    z_stream _stream{};
    size_t _fed = 0;
};

struct Header {
    uint32_t version, count;
    uint32_t degree; ///< in the file: 0..4
    uint32_t fractionalBits;

    uint32_t positionBytes() const { return version == 1 ? 6 : 9; }
    uint32_t orientationBytes() const { return version >= 3 ? 4 : 3; }
    uint32_t restBytes() const { return 3 * (shCoefficients(degree) - 1); }
    uint32_t splatBytes() const { return positionBytes() + 1 + 3 + 3 + orientationBytes() + restBytes(); }
};

Header readHeader(Inflater& in, ByteView file) {
    Byte bytes[headerBytes];
    in.read(bytes, headerBytes);
    if (little(bytes, 4) != magic) throw SplatFileError("is compressed, but not a .spz file");
    const Header header{little(bytes + 4, 4), little(bytes + 8, 4), bytes[12], bytes[13]};
    if (header.version < 1 || header.version > 3)
        throw SplatFileError("is of .spz version " + std::to_string(header.version) + "; 1 to 3 are read");
    if (header.degree > 4 || header.fractionalBits > 24) throw SplatFileError("has an invalid .spz header");
    if (header.count == 0) throw SplatFileError("holds no splats");
    if (double(header.count) * header.splatBytes() > double(file.size) * mostInflation)
        throw SplatFileError("is cut off: it announces " + std::to_string(header.count) + " splats");
    return header;
}

float half(uint32_t bits) {
    const float sign = bits & 0x8000 ? -1.f : 1.f;
    const int exponent = int(bits >> 10 & 31);
    const float fraction = float(bits & 1023);
    if (exponent == 31) return std::numeric_limits<float>::quiet_NaN(); // no place either way
    return exponent == 0 ? sign * std::ldexp(fraction, -24)
                         : sign * std::ldexp(1024 + fraction, exponent - 25);
}

glm::vec3 position(const Byte* from, const Header& header) {
    glm::vec3 result;
    for (int axis = 0; axis < 3; ++axis)
        if (header.version == 1) {
            result[axis] = half(little(from + 2 * axis, 2));
        } else {
            const uint32_t bits = little(from + 3 * axis, 3);
            const int32_t value = int32_t(bits) - (bits & 0x800000 ? 0x1000000 : 0);
            result[axis] = std::ldexp(float(value), -int(header.fractionalBits));
        }
    return result;
}

/// x, y and z, of which w follows.
glm::quat threeParts(const Byte* from) {
    const glm::vec3 v = glm::vec3(from[0], from[1], from[2]) / 127.5f - 1.f;
    return glm::quat(std::sqrt(std::max(0.f, 1.f - glm::dot(v, v))), v.x, v.y, v.z);
}

/// All but the largest part, of which that one follows: 2 bits tell which it is, then come nine bits and a
/// sign for each of the others.
glm::quat smallestThree(const Byte* from) {
    uint32_t bits = little(from, 4);
    const uint32_t largest = bits >> 30;
    float parts[4] = {}, sum = 0; // x y z w
    for (uint32_t i = 4; i-- > 0;) {
        if (i == largest) continue;
        const float size = std::sqrt(0.5f) * float(bits & 511) / 511.f;
        parts[i] = bits & 512 ? -size : size;
        sum += size * size;
        bits >>= 10;
    }
    parts[largest] = std::sqrt(std::max(0.f, 1.f - sum));
    return glm::quat(parts[3], parts[0], parts[1], parts[2]);
}

/// Calls use(splat, bytes) for every splat's `bytes` of one attribute.
template <class Use> void eachSplat(Inflater& in, const Header& header, uint32_t bytes, Use&& use) {
    std::vector<Byte> block(size_t(blockSplats) * bytes);
    for (size_t first = 0; first < header.count; first += blockSplats) {
        const size_t splats = std::min<size_t>(blockSplats, header.count - first);
        in.read(block.data(), splats * bytes);
        for (size_t i = 0; i < splats; ++i)
            use(first + i, &block[i * bytes]);
    }
}

void readCoefficients(Inflater& in, const Header& header, SplatCloud& cloud) {
    const uint32_t all = shCoefficients(cloud.shDegree);
    if (header.restBytes() == 0) return;
    eachSplat(in, header, header.restBytes(), [&](size_t i, const Byte* from) {
        for (uint32_t k = 1; k < all; ++k, from += 3)
            cloud.coefficients[i * all + k] = (glm::vec3(from[0], from[1], from[2]) - 128.f) / 128.f;
    });
}

} // namespace

SplatCloud readSpz(ByteView file, const SplatReadOptions& options) {
    Inflater in(file, options);
    const Header header = readHeader(in, file);
    SplatCloud cloud;
    cloud.name = options.name;
    cloud.shDegree = std::min(header.degree, 3u);
    const uint32_t coefficients = shCoefficients(cloud.shDegree);
    if (header.degree > 3 && options.messages)
        options.messages(Severity::Warning, cloud.name,
                         "its spherical harmonics are of degree 4; those beyond degree 3 are left out");
    // Grows with what has really been read.
    eachSplat(in, header, header.positionBytes(),
              [&](size_t, const Byte* from) { cloud.positions.push_back(position(from, header)); });
    forEachArray(cloud, header.count, [](auto& array, size_t length) { array.resize(length); });
    eachSplat(in, header, 1, [&](size_t i, const Byte* from) { cloud.opacities[i] = float(*from) / 255.f; });
    eachSplat(in, header, 3, [&](size_t i, const Byte* from) {
        cloud.coefficients[i * coefficients] =
            (glm::vec3(from[0], from[1], from[2]) / 255.f - 0.5f) / colourScale;
    });
    eachSplat(in, header, 3, [&](size_t i, const Byte* from) {
        cloud.scales[i] = glm::exp(glm::vec3(from[0], from[1], from[2]) / 16.f - 10.f);
    });
    eachSplat(in, header, header.orientationBytes(), [&](size_t i, const Byte* from) {
        cloud.orientations[i] = header.version >= 3 ? smallestThree(from) : threeParts(from);
    });
    readCoefficients(in, header, cloud);
    tidySplats(cloud, options.messages);
    if (options.progress) options.progress(1.0);
    return cloud;
}

} // namespace hipr
