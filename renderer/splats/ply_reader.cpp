#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/splats/arrays.h"
#include "renderer/splats/ply_splats.h"
#include "renderer/splats/tidy.h"

namespace hipr {
namespace {

/// Rows read at once: small enough to stay in the cache, whatever the number of columns.
constexpr size_t blockRows = 2048;

/// Where the numbers of a splat stand among the columns that are read.
enum Column { X, Rot = 3, Scale = 7, Opacity = 10, Dc = 11, Rest = 14 };
constexpr const char* columnNames[] = {"x",       "y",      "z",       "rot_0",   "rot_1",
                                       "rot_2",   "rot_3",  "scale_0", "scale_1", "scale_2",
                                       "opacity", "f_dc_0", "f_dc_1",  "f_dc_2"};

/// The coefficients beyond the first, of one channel.
constexpr uint32_t restCoefficients(uint32_t degree) {
    return shCoefficients(degree) - 1;
}

/// What to read of an element, and where it goes.
struct Layout {
    std::vector<int> columns;
    uint32_t degree = 0;
    size_t columnCount = 0;
};

int columnOf(const std::string& name) {
    const auto known = std::find(std::begin(columnNames), std::end(columnNames), name);
    if (known != std::end(columnNames)) return int(known - std::begin(columnNames));
    const int rest = restNumber(name);
    return rest < 0 ? PlyRows::Skip : Rest + rest;
}

[[noreturn]] void missing(const PlyElement& element, const std::string& name) {
    const auto has = [&](const char* wanted) {
        return std::any_of(element.properties.begin(), element.properties.end(),
                           [&](const PlyProperty& property) { return property.name == wanted; });
    };
    const char* hint = has("x") ? ": it holds points or a mesh, no splats" : "";
    throw SplatFileError("lacks the property '" + name + "' of splats" + hint);
}

Layout layoutOf(const PlyElement& element) {
    Layout layout;
    std::vector<bool> found(Rest);
    for (const PlyProperty& property : element.properties) {
        const int column = columnOf(property.name);
        layout.columns.push_back(column);
        if (column == PlyRows::Skip) continue;
        if (property.countType) throw SplatFileError("has lists as the property '" + property.name + "'");
        if (size_t(column) >= found.size()) found.resize(size_t(column) + 1);
        if (found[size_t(column)]) throw SplatFileError("has the property '" + property.name + "' twice");
        found[size_t(column)] = true;
    }
    for (size_t column = 0; column < found.size(); ++column)
        if (!found[column])
            missing(element, column < Rest ? columnNames[column] : "f_rest_" + std::to_string(column - Rest));
    layout.columnCount = found.size();
    layout.degree = degreeOfRest(found.size() - Rest);
    return layout;
}

/// One block of columns to the splats from `first` on.
void store(const std::vector<float>& block, size_t rows, size_t first, SplatCloud& cloud) {
    const auto value = [&](size_t column, size_t row) { return block[column * rows + row]; };
    const auto triple = [&](size_t column, size_t row) {
        return glm::vec3(value(column, row), value(column + 1, row), value(column + 2, row));
    };
    const uint32_t coefficients = shCoefficients(cloud.shDegree), rest = coefficients - 1;
    for (size_t row = 0; row < rows; ++row) {
        const size_t i = first + row;
        cloud.positions[i] = triple(X, row);
        cloud.orientations[i].w = value(Rot, row);
        cloud.orientations[i].x = value(Rot + 1, row);
        cloud.orientations[i].y = value(Rot + 2, row);
        cloud.orientations[i].z = value(Rot + 3, row);
        cloud.scales[i] = glm::exp(triple(Scale, row));
        cloud.opacities[i] = 1.f / (1.f + std::exp(-value(Opacity, row)));
        glm::vec3* out = &cloud.coefficients[i * coefficients];
        out[0] = triple(Dc, row);
        for (uint32_t k = 0; k < rest; ++k) // channel by channel in the file
            out[k + 1] = {value(Rest + k, row), value(Rest + rest + k, row), value(Rest + 2 * rest + k, row)};
    }
}

/// Text where numbers of four bytes should be: 256 of them do not look like that by chance.
void expectBinary(const PlyCursor& cursor) {
    const size_t most = std::min<size_t>(cursor.left(), 256);
    const bool text = std::all_of(cursor.at, cursor.at + most, [](unsigned char c) {
        return (c >= ' ' && c <= '~') || (c >= '\t' && c <= '\r');
    });
    if (text && most >= 16)
        throw SplatFileError("holds text, though its PLY header announces binary numbers");
}

SplatCloud readVertices(const PlyElement& element, PlyFormat format, PlyCursor& cursor, size_t fileBytes,
                        const SplatReadOptions& options) {
    const Layout layout = layoutOf(element);
    if (element.count == 0) throw SplatFileError("holds no splats");
    expectRoomFor(element, format, cursor);
    SplatCloud cloud;
    cloud.name = options.name;
    cloud.shDegree = layout.degree;
    forEachArray(cloud, size_t(element.count), [](auto& array, size_t length) { array.resize(length); });
    const auto reader = plyRows(element, format, layout.columns, cursor);
    std::vector<float> block;
    for (size_t first = 0; first < cloud.size();) {
        const size_t rows = std::min(blockRows, cloud.size() - first);
        block.resize(layout.columnCount * rows);
        reader->read(rows, block.data());
        store(block, rows, first, cloud);
        first += rows;
        if (options.progress) options.progress(1.0 - double(cursor.left()) / double(fileBytes));
    }
    return cloud;
}

SplatCloud readNumbers(const PlyHeader& header, PlyCursor cursor, size_t fileBytes,
                       const SplatReadOptions& options) {
    for (const PlyElement& element : header.elements) {
        if (element.name == "vertex") return readVertices(element, header.format, cursor, fileBytes, options);
        skipRows(element, header.format, cursor);
    }
    throw SplatFileError("has no element 'vertex', which would hold the splats");
}

} // namespace

int restNumber(const std::string& name) {
    constexpr size_t prefix = 7;
    if (name.compare(0, prefix, "f_rest_") != 0 || name.size() == prefix || name.size() > prefix + 3)
        return -1;
    if (name.find_first_not_of("0123456789", prefix) != name.npos) return -1;
    return std::stoi(name.substr(prefix));
}

uint32_t degreeOfRest(size_t properties) {
    uint32_t degree = 0;
    while (degree < 3 && 3 * restCoefficients(degree) < properties)
        ++degree;
    if (3 * restCoefficients(degree) != properties)
        throw SplatFileError(
            "has " + std::to_string(properties) +
            " properties f_rest_*; spherical harmonics of degree 0 to 3 have 0, 9, 24 or 45");
    return degree;
}

void skipRows(const PlyElement& element, PlyFormat format, PlyCursor& cursor) {
    expectRoomFor(element, format, cursor);
    if (element.properties.empty()) return;
    const std::vector<int> none(element.properties.size(), PlyRows::Skip);
    const auto rows = plyRows(element, format, none, cursor);
    for (uint64_t left = element.count; left > 0;) {
        const size_t block = size_t(std::min<uint64_t>(left, blockRows));
        rows->read(block, nullptr);
        left -= block;
    }
}

SplatCloud readPly(ByteView file, const SplatReadOptions& options) {
    const PlyHeader header = readPlyHeader(file);
    PlyCursor cursor{file.data + header.bytes, file.data + file.size};
    if (header.format != PlyFormat::Ascii) expectBinary(cursor);
    SplatCloud cloud = holdsPackedSplats(header) ? readPackedSplats(header, cursor, options)
                                                 : readNumbers(header, cursor, file.size, options);
    tidySplats(cloud, options.messages);
    if (options.progress) options.progress(1.0);
    return cloud;
}

} // namespace hipr
