/// @file ply_header.h
/// The header of a PLY file (Turk, "The PLY Polygon File Format", 1994).
#pragma once

#include <optional>

#include "renderer/splats/splat_file.h"

namespace hipr {

enum class PlyFormat { Ascii, BinaryLittleEndian, BinaryBigEndian };
enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

/// Bytes of a number in a binary file.
size_t plySize(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::Float32;  ///< of the value, or of a list's items
    std::optional<PlyType> countType; ///< a list, whose length has this type
};

struct PlyElement {
    std::string name;
    uint64_t count = 0; ///< rows; as announced, nothing says that they are there
    std::vector<PlyProperty> properties;

    bool hasLists() const;
    /// Bytes that a row takes at least; exactly, in a binary file without lists.
    size_t rowBytes(PlyFormat format) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::Ascii;
    std::vector<PlyElement> elements;
    size_t bytes = 0; ///< where the rows of the first element begin
};

/// @throws SplatFileError
PlyHeader readPlyHeader(ByteView file);

} // namespace hipr
