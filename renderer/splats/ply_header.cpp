#include "renderer/splats/ply_header.h"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace hipr {
namespace {

using Words = std::vector<std::string_view>;

/// More than any header needs; a file without an end of it is not searched to its own.
constexpr size_t mostHeaderBytes = 1 << 20;

constexpr struct {
    const char *name, *otherName;
    PlyType type;
    size_t bytes;
} types[] = {
    {"char", "int8", PlyType::Int8, 1},        {"uchar", "uint8", PlyType::Uint8, 1},
    {"short", "int16", PlyType::Int16, 2},     {"ushort", "uint16", PlyType::Uint16, 2},
    {"int", "int32", PlyType::Int32, 4},       {"uint", "uint32", PlyType::Uint32, 4},
    {"float", "float32", PlyType::Float32, 4}, {"double", "float64", PlyType::Float64, 8},
};

/// A piece of the file for a message: short, and without control characters.
std::string quoted(std::string_view text) {
    std::string result = "'";
    for (const char c : text.substr(0, 40))
        result += c >= ' ' && c <= '~' ? c : '?';
    return result + (text.size() > 40 ? "...'" : "'");
}

Words split(std::string_view line) {
    Words words;
    for (size_t at = 0; at < line.size();) {
        at = line.find_first_not_of(" \t\r", at);
        if (at == line.npos) break;
        const size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
        words.push_back(line.substr(at, end - at));
        at = end;
    }
    return words;
}

PlyType typeNamed(std::string_view name) {
    for (const auto& type : types)
        if (name == type.name || name == type.otherName) return type.type;
    throw SplatFileError("has a property of the unknown type " + quoted(name));
}

PlyFormat formatNamed(const Words& words) {
    if (words.size() == 3 && words[2] == "1.0") {
        if (words[1] == "ascii") return PlyFormat::Ascii;
        if (words[1] == "binary_little_endian") return PlyFormat::BinaryLittleEndian;
        if (words[1] == "binary_big_endian") return PlyFormat::BinaryBigEndian;
    }
    throw SplatFileError("has an unknown PLY format: " +
                         quoted(words.size() > 1 ? words[1] : std::string_view()));
}

PlyElement element(const Words& words) {
    PlyElement element;
    if (words.size() == 3) {
        element.name = words[1];
        const char* end = words[2].data() + words[2].size();
        const auto [last, error] = std::from_chars(words[2].data(), end, element.count);
        if (error == std::errc() && last == end) return element;
    }
    throw SplatFileError("has an element without a valid count: " +
                         quoted(words.size() > 2 ? words[2] : words.back()));
}

PlyProperty property(const Words& words) {
    PlyProperty property;
    if (words.size() == 5 && words[1] == "list") {
        property.countType = typeNamed(words[2]);
        property.type = typeNamed(words[3]);
    } else if (words.size() == 3) {
        property.type = typeNamed(words[1]);
    } else {
        throw SplatFileError("has a property that is neither a number nor a list");
    }
    property.name = words.back();
    return property;
}

} // namespace

size_t plySize(PlyType type) {
    return types[size_t(type)].bytes;
}

bool PlyElement::hasLists() const {
    return std::any_of(properties.begin(), properties.end(),
                       [](const PlyProperty& property) { return property.countType.has_value(); });
}

size_t PlyElement::rowBytes(PlyFormat format) const {
    if (format == PlyFormat::Ascii) return 2 * properties.size(); // a digit and what parts it from the next
    size_t bytes = 0;
    for (const PlyProperty& property : properties)
        bytes += plySize(property.countType.value_or(property.type));
    return bytes;
}

PlyHeader readPlyHeader(ByteView file) {
    const std::string_view text(reinterpret_cast<const char*>(file.data),
                                std::min(file.size, mostHeaderBytes));
    PlyHeader header;
    bool hasFormat = false;
    for (size_t at = 0, line = 0;; ++line) {
        const size_t end = text.find('\n', at);
        if (end == text.npos) throw SplatFileError("has a PLY header without an end");
        const Words words = split(text.substr(at, end - at));
        at = end + 1;
        const std::string_view what = words.empty() ? std::string_view() : words[0];
        if (line == 0) {
            if (what != "ply" || words.size() > 1) throw SplatFileError("is no PLY file");
        } else if (what == "end_header") {
            header.bytes = at;
            break;
        } else if (what == "format") {
            header.format = formatNamed(words);
            hasFormat = true;
        } else if (what == "element") {
            header.elements.push_back(element(words));
        } else if (what == "property" && !header.elements.empty()) {
            header.elements.back().properties.push_back(property(words));
        } else if (!what.empty() && what != "comment" && what != "obj_info") {
            throw SplatFileError("has a line in its PLY header that cannot be understood: " + quoted(what));
        }
    }
    if (!hasFormat) throw SplatFileError("has a PLY header without a format");
    return header;
}

} // namespace hipr
