/// @file openpbr_albedo.h
/// Directional albedos that OpenPBR's layers and energy compensation need; read by
/// shaders/material/openpbr_albedo.glsl.
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace hipr {

/// What a single-scattering rough dielectric interface does with light from a direction: the part it reflects
/// (x), and that plus the part it transmits (y); what is missing to 1 would be scattered by several
/// microfacets. `eta` is the index of refraction beyond the interface over the one before it. By quadrature
/// with `steps`^2 / 2 points.
glm::vec2 interfaceAlbedo(double cosine, double alpha, double eta, int steps);

/// The part of light from a direction that the fuzz reflects (shaders/shared/fuzz.h).
float fuzzAlbedo(double cosine, double roughness, int steps);

/// All tables of the model, laid out as shaders/shared/material.h says: the interface at indices whose
/// |(1 - eta) / (1 + eta)| is INTERFACE_MOST * (k / (INTERFACE_STEPS - 1))^2, at cosines (i / (n - 1))^2
/// followed by their mean over the hemisphere with cosine weight, from outside (eta >= 1) and from inside;
/// then the fuzz. Computed at the first call, which takes some tenths of a second.
const std::vector<float>& openPbrAlbedoTable();

} // namespace hipr
