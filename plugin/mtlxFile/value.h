/// @file value.h
/// Types and values of MaterialX as those of USD.
#pragma once

#include <optional>
#include <string>

#include "pxr/base/vt/value.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/valueTypeName.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// Such as color3f for "color3"; token for shaders and closures.
SdfValueTypeName mtlxType(std::string const& type);

/// The value of a text, such as GfVec3f(1, 0, 0) for "1, 0, 0" as "color3"; nothing when it is none of that
/// type. Files are taken as they are.
std::optional<VtValue> mtlxValue(std::string const& type, std::string const& text);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
