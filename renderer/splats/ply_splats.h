/// @file ply_splats.h
/// What the two forms of splats in PLY files share: numbers by name (ply_reader.cpp), and packed ones
/// (ply_packed.cpp).
#pragma once

#include "renderer/splats/ply_rows.h"

namespace hipr {

/// The first coefficient of spherical harmonics, which is the same in all directions.
constexpr float shConstant = 0.28209479f;

/// The number of a property "f_rest_<number>", or -1.
int restNumber(const std::string& name);
/// The degree of spherical harmonics that have so many properties f_rest_*.
/// @throws SplatFileError: no degree has
uint32_t degreeOfRest(size_t properties);

/// Moves the cursor past the rows of an element.
void skipRows(const PlyElement& element, PlyFormat format, PlyCursor& cursor);

/// Whether the file holds packed splats.
bool holdsPackedSplats(const PlyHeader& header);
/// Reads splats as PlayCanvas and SuperSplat compress them
/// (https://developer.playcanvas.com/user-manual/gaussian-splatting/formats/ply/#compressed-ply): chunks of
/// 256 with the ranges of their numbers, four words a splat, and coefficients in bytes.
/// @throws SplatFileError
SplatCloud readPackedSplats(const PlyHeader& header, PlyCursor cursor, const SplatReadOptions& options);

} // namespace hipr
