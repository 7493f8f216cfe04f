/// @file usdaText.h
/// The text form of scene description, as people write it inside other files.
#pragma once

#include <string>

namespace hipr::record {

/// A whole usda file from a piece of one: adds the header where there is none, and the line breaks around
/// closing braces that OpenUSD's grammar asks for, so that `over "A" { over "B" { int x = 1 } }` may stand on
/// one line. Strings, asset paths, prim paths and comments stay as they are.
std::string completeUsda(const std::string& text);

} // namespace hipr::record
