/// @file cryptomatte.h
/// Cryptomatte in files: three layers of ranks for each AOV, and what their header says.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plugin/record/images.h"

namespace hipr::record {

/// "CryptoObject" of "CryptoObject01" and the like; empty for other AOVs.
std::string cryptomatteOf(const std::string& aov);

/// The AOVs that a name stands for: the layers of CryptoObject, CryptoMaterial and CryptoAsset, else itself.
std::vector<std::string> expandedAov(const std::string& aov);

/// Keys and values of an EXR header, by version 1.2 of the specification: name, hash, conversion and manifest
/// of each Cryptomatte that the picture has layers of.
std::vector<std::pair<std::string, std::string>> cryptomatteMetadata(const Picture& picture);

} // namespace hipr::record
