/// @file light_choice.h
/// Which light next event estimation samples, in proportion to power.
#pragma once

#include <vector>

namespace hipr {

/// A power as the choice of lights sees it: the nearest power of two, never 0.
double roundedPower(double power);

/// The chance of each light, from its power; they sum to 1.
///
/// Powers count rounded to a power of two, so that an edit of a light, or of the size of the scene, mostly
/// leaves the chances of all lights as they are: then every path that the edit does not touch stays the same
/// path, by which HiPR tells where it shows. A tenth goes to all lights alike: a weak light may be the only
/// one that a corner of the scene sees.
std::vector<double> lightChances(const std::vector<double>& powers);

/// Sums of the chances up to and including each light; the last is 1. A random number chooses the first light
/// whose sum is above it: in this order, so that where chances do change, few numbers choose another light.
std::vector<float> cumulativeChances(const std::vector<double>& chances);

} // namespace hipr
