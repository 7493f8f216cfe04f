#include <algorithm>
#include <cmath>

#include "renderer/splats/arrays.h"
#include "renderer/splats/ply_splats.h"

namespace hipr {
namespace {

constexpr size_t chunkSplats = 256;

/// What a chunk says of its splats, in this order.
enum ChunkColumn { Position, LogScale = 6, Colour = 12, ChunkColumns = 18 };
constexpr const char* chunkNames[ChunkColumns] = {
    "min_x",       "min_y",       "min_z",       "max_x",       "max_y",       "max_z",
    "min_scale_x", "min_scale_y", "min_scale_z", "max_scale_x", "max_scale_y", "max_scale_z",
    "min_r",       "min_g",       "min_b",       "max_r",       "max_g",       "max_b"};

const PlyElement* elementNamed(const PlyHeader& header, const char* name) {
    const auto found = std::find_if(header.elements.begin(), header.elements.end(),
                                    [&](const PlyElement& element) { return element.name == name; });
    return found == header.elements.end() ? nullptr : &*found;
}

/// Where a property of a type stands in the rows of an element.
size_t offsetOf(const PlyElement& element, const std::string& name, PlyType type) {
    size_t offset = 0;
    for (const PlyProperty& property : element.properties) {
        if (property.name == name && property.type == type) return offset;
        offset += plySize(property.type);
    }
    throw SplatFileError("lacks the property '" + name + "' of packed splats, in the type they have");
}

/// Rows of an element that stay in the file.
struct Rows {
    const unsigned char* first = nullptr;
    size_t bytes = 0; ///< of a row
    const unsigned char* at(size_t row, size_t offset) const { return first + row * bytes + offset; }
};

/// A fraction of a number's range: `bits` bits from bit `shift` on.
float fraction(uint32_t word, int shift, int bits) {
    const uint32_t most = (1u << bits) - 1;
    return float(word >> shift & most) / float(most);
}

/// 11, 10 and 11 bits.
glm::vec3 fractions(uint32_t word) {
    return {fraction(word, 21, 11), fraction(word, 11, 10), fraction(word, 0, 11)};
}

/// All parts but the largest, which follows from them: two bits say which one that is, in the order w x y z.
glm::quat turn(uint32_t word) {
    const uint32_t largest = word >> 30;
    float parts[4] = {}, sum = 0;
    int shift = 20;
    for (uint32_t i = 0; i < 4; ++i) {
        if (i == largest) continue;
        parts[i] = (fraction(word, shift, 10) - 0.5f) * std::sqrt(2.f);
        sum += parts[i] * parts[i];
        shift -= 10;
    }
    parts[largest] = std::sqrt(std::max(0.f, 1.f - sum));
    return glm::quat(parts[0], parts[1], parts[2], parts[3]);
}

/// A coefficient: the range is -4 to 4, its ends being 0 and 255.
float coefficient(unsigned char byte) {
    const float at = byte == 0 ? 0.f : byte == 255 ? 1.f : (float(byte) + 0.5f) / 256.f;
    return 8.f * at - 4.f;
}

class PackedSplats {
public:
    PackedSplats(const PlyHeader& header, PlyCursor cursor, const SplatReadOptions& options)
        : _format(header.format), _options(options) {
        if (_format == PlyFormat::Ascii)
            throw SplatFileError("holds packed splats as text, a form that is not read");
        const PlyElement *chunks = elementNamed(header, "chunk"), *vertices = elementNamed(header, "vertex"),
                         *harmonics = elementNamed(header, "sh");
        if (!chunks) throw SplatFileError("has no element 'chunk', which packed splats need");
        _count = size_t(vertices->count);
        if (_count == 0) throw SplatFileError("holds no splats");
        if (chunks->count < (vertices->count - 1) / chunkSplats + 1)
            throw SplatFileError("has too few chunks for its splats");
        if (harmonics && harmonics->count != vertices->count)
            throw SplatFileError("has coefficients of " + std::to_string(harmonics->count) + " instead of " +
                                 std::to_string(_count) + " splats");
        for (const PlyElement& element : header.elements) {
            if (&element == chunks)
                readChunks(element, cursor);
            else if (&element == vertices)
                _words = rowsOf(element, cursor);
            else if (&element == harmonics)
                _harmonics = rowsOf(element, cursor);
            else
                skipRows(element, _format, cursor);
        }
        static constexpr const char* wordNames[] = {"packed_position", "packed_rotation", "packed_scale",
                                                    "packed_color"};
        for (int i = 0; i < 4; ++i)
            _wordOffsets[i] = offsetOf(*vertices, wordNames[i], PlyType::Uint32);
        if (harmonics) findHarmonics(*harmonics);
    }

    SplatCloud read() const {
        SplatCloud cloud;
        cloud.name = _options.name;
        cloud.shDegree = degreeOfRest(_restOffsets.size());
        forEachArray(cloud, _count, [](auto& array, size_t length) { array.resize(length); });
        for (size_t i = 0; i < _count; ++i) {
            readSplat(cloud, i);
            if (_options.progress && i % 65536 == 0) _options.progress(double(i) / double(_count));
        }
        return cloud;
    }

private:
    /// Leaves the rows where they are.
    Rows rowsOf(const PlyElement& element, PlyCursor& cursor) {
        if (element.hasLists()) throw SplatFileError("has lists among its packed splats");
        expectRoomFor(element, _format, cursor);
        const Rows rows{cursor.at, element.rowBytes(_format)};
        cursor.at += size_t(element.count) * rows.bytes;
        return rows;
    }

    void readChunks(const PlyElement& element, PlyCursor& cursor) {
        std::vector<int> columns;
        size_t found = 0;
        for (const PlyProperty& property : element.properties) {
            const auto name = std::find(std::begin(chunkNames), std::end(chunkNames), property.name);
            const bool known = name != std::end(chunkNames) && !property.countType;
            columns.push_back(known ? int(name - std::begin(chunkNames)) : PlyRows::Skip);
            found |= known ? size_t(1) << columns.back() : 0;
        }
        constexpr size_t all = (size_t(1) << ChunkColumns) - 1, colourless = (size_t(1) << Colour) - 1;
        if (found != all && found != colourless)
            throw SplatFileError("has chunks that do not tell the ranges of packed splats");
        _coloured = found == all;
        expectRoomFor(element, _format, cursor);
        _chunkCount = size_t(element.count);
        _chunks.resize(_chunkCount * ChunkColumns);
        plyRows(element, _format, columns, cursor)->read(_chunkCount, _chunks.data());
    }

    void findHarmonics(const PlyElement& element) {
        size_t rest = 0;
        for (const PlyProperty& property : element.properties)
            rest += restNumber(property.name) >= 0;
        degreeOfRest(rest);
        for (size_t n = 0; n < rest; ++n)
            _restOffsets.push_back(offsetOf(element, "f_rest_" + std::to_string(n), PlyType::Uint8));
    }

    /// `at`, from 0 to 1, of the range that begins at a column of the splat's chunk.
    glm::vec3 within(size_t i, int column, const glm::vec3& at) const {
        const auto range = [&](int c) { return _chunks[size_t(column + c) * _chunkCount + i / chunkSplats]; };
        const glm::vec3 lo(range(0), range(1), range(2)), hi(range(3), range(4), range(5));
        return glm::mix(lo, hi, at);
    }

    void readSplat(SplatCloud& cloud, size_t i) const {
        uint32_t words[4];
        for (int w = 0; w < 4; ++w)
            words[w] = plyWord(_words.at(i, _wordOffsets[w]), _format);
        cloud.positions[i] = within(i, Position, fractions(words[0]));
        cloud.orientations[i] = turn(words[1]);
        cloud.scales[i] = glm::exp(within(i, LogScale, fractions(words[2])));
        const glm::vec3 bytes(fraction(words[3], 24, 8), fraction(words[3], 16, 8), fraction(words[3], 8, 8));
        const glm::vec3 colour = _coloured ? within(i, Colour, bytes) : bytes;
        cloud.opacities[i] = fraction(words[3], 0, 8);
        const size_t rest = _restOffsets.size() / 3;
        glm::vec3* out = &cloud.coefficients[i * (rest + 1)];
        out[0] = (colour - 0.5f) / shConstant;
        for (size_t k = 0; k < rest; ++k) // channel by channel in the file
            for (size_t c = 0; c < 3; ++c)
                out[k + 1][int(c)] = coefficient(*_harmonics.at(i, _restOffsets[c * rest + k]));
    }

    const PlyFormat _format;
    const SplatReadOptions& _options;
    size_t _count = 0, _chunkCount = 0;
    std::vector<float> _chunks; ///< column by column
    bool _coloured = false;     ///< chunks tell the ranges of colours; otherwise these are from 0 to 1
    Rows _words, _harmonics;
    size_t _wordOffsets[4] = {};
    std::vector<size_t> _restOffsets;
};

} // namespace

bool holdsPackedSplats(const PlyHeader& header) {
    const PlyElement* vertices = elementNamed(header, "vertex");
    return vertices &&
           std::any_of(vertices->properties.begin(), vertices->properties.end(),
                       [](const PlyProperty& property) { return property.name == "packed_position"; });
}

SplatCloud readPackedSplats(const PlyHeader& header, PlyCursor cursor, const SplatReadOptions& options) {
    return PackedSplats(header, cursor, options).read();
}

} // namespace hipr
