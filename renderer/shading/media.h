/// @file media.h
/// What light travels through inside an object, from the inputs of OpenPBR Surface.
#pragma once

#include <glm/glm.hpp>

#include "shaders/shared/material.h"

namespace hipr {

/// Sets extinction, albedo and anisotropy so that light is left with `color` after `depth` (> 0, world
/// space), while `scatter` is the share of 1 / depth that scatters (specification, "Translucent base").
void setTransmissionMedium(gpu::MediumRecord& medium, const glm::vec3& color, float depth,
                           const glm::vec3& scatter, float anisotropy);

/// Dense scattering with mean free paths `radius` times `scale`, in world space (specification, "Subsurface";
/// scales count as 0.01 at least); no medium for a radius of 0. Paths bring the albedo along.
gpu::MediumRecord subsurfaceMedium(float radius, const glm::vec3& scale, float anisotropy);

/// The Abbe number that the two inputs of dispersion make, 0 for none.
float abbeNumber(float scale, float number);

} // namespace hipr
