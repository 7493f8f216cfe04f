/// @file light_shape.h
/// Checking of light descriptions and their photometry; shaders/light/ has the matching sampling.
#pragma once

#include <optional>
#include <string>

#include "renderer/api/light.h"
#include "shaders/shared/light.h"

namespace hipr {

/// World-space area of an area light's emitting side (exact for every affine transform), or what UsdLux
/// divides a distant light by: pi sin^2 of its half angle up to 90 degrees, (2 - sin^2) pi beyond, 1 at angle
/// 0. A dome: 1, since normalize has no meaning there.
double lightSizeFactor(const LightDesc& desc);

/// Whether all numbers of a surface's light are finite.
bool hasFiniteNumbers(const SurfaceLight& light);

/// Fills the record of a light that emits: transforms, shape, radiance (UsdLux: intensity * 2^exposure *
/// colour * black-body colour, divided by lightSizeFactor() when normalised). Returns false for a light that
/// emits nothing; then `problem` tells why when that cannot have been meant.
bool describeLight(const LightDesc& desc, gpu::LightRecord& record, std::string& problem);

/// The record of shadows that are not plain. `category`: of the objects that cast them.
std::optional<gpu::ShadowRecord> describeShadow(const LightShadow& shadow, uint32_t category);

/// Radiant power up to a common factor, for the choice of a light. `sceneRadius` bounds what infinite lights
/// reach; `pictureMean` is the mean of the light's texture.
double lightPower(const gpu::LightRecord& record, const glm::vec3& pictureMean, double sceneRadius);

} // namespace hipr
