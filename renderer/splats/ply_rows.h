/// @file ply_rows.h
/// The rows of a PLY element, whatever they are written in, as floats.
#pragma once

#include <memory>

#include "renderer/splats/ply_header.h"

namespace hipr {

/// Where reading has got to.
struct PlyCursor {
    const unsigned char *at, *end;
    size_t left() const { return size_t(end - at); }
};

class PlyRows {
public:
    virtual ~PlyRows() = default;
    /// Reads the next rows. The value of property p goes to out[columns[p] * rows + row]; properties whose
    /// column is negative are skipped. Numbers too large for a float become infinite.
    /// @throws SplatFileError when the file ends before, or holds no number where one belongs
    virtual void read(size_t rows, float* out) = 0;

    static constexpr int Skip = -1;
};

/// `columns`: one for each property of the element; a list's has to be Skip. The cursor moves with every row
/// read. Both have to outlive the result.
std::unique_ptr<PlyRows> plyRows(const PlyElement& element, PlyFormat format, const std::vector<int>& columns,
                                 PlyCursor& cursor);

/// A number of four bytes in a binary file.
uint32_t plyWord(const unsigned char* at, PlyFormat format);

/// Throws unless the file may hold as many rows as the element announces.
void expectRoomFor(const PlyElement& element, PlyFormat format, const PlyCursor& cursor);

} // namespace hipr
