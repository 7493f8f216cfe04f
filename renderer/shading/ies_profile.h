/// @file ies_profile.h
/// Photometric profiles: ANSI/IES LM-63 files (1986 to 2019).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hipr {

/// Luminous intensity by direction, on a regular grid: rows from vertical angle 0 to 180 degrees, columns
/// from horizontal angle 0 to 360, both ends included; one column where it is the same all around. 0 at
/// vertical angles the file says nothing of.
struct IesProfile {
    uint32_t rows = 0, columns = 0;
    std::vector<float> candela; ///< rows * columns; multiplier and ballast factors are applied
    float mean = 0.f;           ///< over the sphere, or over the hemisphere if the file covers no more
};

/// Reads a profile. The grid is as fine as the file's finest step, within 0.05 to 0.5 degrees, so that the
/// usual files are met exactly. Returns false with the reason in `error`: text that is not LM-63, broken off
/// or with numbers out of range; and photometric types A and B.
bool parseIes(const std::vector<unsigned char>& bytes, IesProfile& profile, std::string& error);

} // namespace hipr
