/// @file stretched_albedo.h
/// Directional albedo of stretched GGX lobes, the table behind shaders/material/stretched_albedo.glsl.
#pragma once

#include "renderer/vulkan/device.h"

namespace hipr {

/// Makes the table of STRETCHED_ROWS * STRETCHED_ROW vec2 (11 MB) on the device (blocking; a second on two
/// processor cores, a moment on a GPU). An entry is what single scattering by facets does with light from a
/// direction: the part reflected, and that plus the part transmitted. Entries of a row: cosines of the polar
/// angle (i / (n - 1))^2 for each cosine of the azimuth to the direction of stretching j / (n - 1), then
/// their mean over the hemisphere with cosine weight, exact for what is interpolated between them. Rows:
/// roughness rising from 0 to 1, for anisotropies 1 - (1 - k / (n - 1))^2, for planes as
/// shaders/shared/material.h says, whose indices are those of openPbrAlbedoTable(). Throws OutOfMemory.
Buffer stretchedAlbedoTable(Device& device);

} // namespace hipr
