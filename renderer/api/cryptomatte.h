/// @file cryptomatte.h
/// Names as ids of Cryptomatte: J. Friedman and A. C. Jones, "Fully Automatic ID Mattes with Support for
/// Motion Blur and Transparency", SIGGRAPH 2015 posters, and the Cryptomatte specification, version 1.2.
///
/// A Cryptomatte AOV has three layers of two ranks each, (id, coverage, id, coverage), the largest coverage
/// first. Coverage is the share of the pixel's samples that saw what has the id; with what is transparent
/// each sample decides by chance whether it does. The seventh and further ids of a pixel find room only where
/// one that was seen by a single sample makes it, and are else left out.
#pragma once

#include <cstdint>
#include <string_view>

namespace hipr {

/// The id of a name as bits of a float: the MurmurHash3 (x86, 32 bits, seed 0) of its bytes, with one bit of
/// the exponent turned over where it would else be no ordinary number. A manifest has it in hexadecimals.
uint32_t cryptomatteBits(std::string_view name);
/// The same as a float.
float cryptomatteId(std::string_view name);

/// What objects without a material show.
constexpr const char* CryptomatteNoMaterial = "default";

} // namespace hipr
