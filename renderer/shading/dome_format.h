/// @file dome_format.h
/// Pictures of an environment in other projections than latitude-longitude.
#pragma once

#include "renderer/api/light.h"
#include "renderer/shading/image.h"

namespace hipr {

/// The environment of a picture as a latitude-longitude one (see shaders/light/environment.glsl), about as
/// fine, bilinearly resampled. LatLong leaves the picture as it is. See DomeFormat for what looks where.
Image toLatLong(Image image, DomeFormat format);

} // namespace hipr
