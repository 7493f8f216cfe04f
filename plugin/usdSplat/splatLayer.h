/// @file splatLayer.h
/// A cloud of splats as a layer of USD, and back.
#pragma once

#include <optional>
#include <string>

#include "pxr/base/gf/vec3f.h"
#include "pxr/base/vt/array.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/layer.h"
#include "renderer/api/splats.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Which axis of a capture points up. A file does not say; photogrammetry's captures often have -Y up.
enum class UsdSplatUp { Y, MinusY, Z, MinusZ };

/// From "y", "-y", "z" or "-z".
std::optional<UsdSplatUp> UsdSplatUpNamed(std::string const& name);

/// The extent attribute of a cloud's prim: its lower and its upper corner; none without splats.
VtVec3fArray UsdSplatExtent(hipr::SplatCloud const& cloud);

/// A layer whose default prim, /Splats, is the cloud as a ParticleField3DGaussianSplat in single precision,
/// with its extent, turned so that `up` becomes Y. The cloud's arrays are emptied on the way, to need the
/// memory only once.
SdfLayerRefPtr UsdSplatMakeLayer(hipr::SplatCloud&& cloud, UsdSplatUp up);

PXR_NAMESPACE_CLOSE_SCOPE
