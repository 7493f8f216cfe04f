/// @file albedo.h
/// Directional albedo of the GGX reflection lobe, the table behind specularAlbedo() in
/// shaders/material/microfacet.glsl.
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace hipr {

/// The part of light from a direction that a single-scattering GGX lobe with Schlick Fresnel reflects, split
/// so that it is f0 * x + y (B. Karis, "Real Shading in Unreal Engine 4", SIGGRAPH 2013 course notes, "split
/// sum"). ALBEDO_ROUGHNESSES rows, roughness rising from 0 to 1; in a row ALBEDO_COSINES values at cosines (i
/// / (n - 1))^2, then their mean over the hemisphere with cosine weight.
const std::vector<glm::vec2>& specularAlbedoTable();

/// One entry by quadrature with `steps`^2 / 2 points; alpha is roughness^2.
glm::vec2 specularAlbedo(double cosine, double alpha, int steps);

} // namespace hipr
