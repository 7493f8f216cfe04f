/// @file alias.h
/// Alias tables: a choice among n with given probabilities in constant time.
#pragma once

#include <vector>

#include "shaders/shared/light.h"

namespace hipr {

/// M. D. Vose, "A linear algorithm for generating random numbers with a given distribution", IEEE Trans.
/// Softw. Eng. 17(9), 1991. `probabilities` sum to 1.
std::vector<gpu::AliasEntry> buildAliasTable(const std::vector<double>& probabilities);

} // namespace hipr
