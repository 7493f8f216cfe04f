/// @file bsdf_kernel.h
/// The host's side of bsdf.comp.
#pragma once

#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/api/material.h"
#include "shaders/shared/material.h"

namespace hipr::test {

/// A UsdPreviewSurface, or the constants of an OpenPBR Surface.
struct SurfaceParameters {
    glm::vec3 diffuseColor{0.f};
    glm::vec3 specularColor{0.f};
    float metallic = 0.f, roughness = 0.5f, clearcoat = 0.f, clearcoatRoughness = 0.01f, opacity = 1.f,
          ior = 1.5f;
    uint32_t flags = 0;                  ///< of a UsdPreviewSurface
    std::optional<MaterialDesc> openPbr; ///< instead of all above
    glm::vec3 ng{0.f, 0.f, 1.f}, ns{0.f, 0.f, 1.f};
    glm::vec3 coatNormal{0.f}, tangent{0.f}; ///< 0: the surface's own
    uint32_t frontFacing = 1;
};

inline glm::vec3 grey(double value) {
    return glm::vec3(float(value));
}

/// An OpenPBR Surface with some inputs set; numbers are grey colours.
using OpenPbrValues = std::initializer_list<std::pair<OpenPbrInput, glm::vec3>>;
SurfaceParameters openPbr(OpenPbrValues values);
/// The same with further inputs set.
SurfaceParameters with(SurfaceParameters parameters, OpenPbrValues values);

struct Outcome {
    glm::vec3 f;
    float pdf;
    glm::vec3 sampled;
    float sampledPdf;
    glm::vec3 weight;
    uint32_t lobe;
    glm::vec3 sampledF;
    float sampledEvalPdf;
    bool failed() const { return lobe == 99; }
};

/// All vectors have one size. See bsdf.comp.
std::vector<Outcome> runBsdf(const SurfaceParameters& parameters, const std::vector<glm::vec3>& wo,
                             const std::vector<glm::vec3>& wi, const std::vector<glm::vec4>& u);

/// The same viewer for all of `wi`, sampled with fresh random numbers.
std::vector<Outcome> runBsdf(const SurfaceParameters& parameters, const glm::vec3& wo,
                             const std::vector<glm::vec3>& wi);

/// A material with a name for messages, and the materials that the tests go through.
struct NamedSurface {
    const char* name;
    SurfaceParameters parameters;
};
std::vector<NamedSurface> opaqueSurfaces();
std::vector<NamedSurface> glassSurfaces();

} // namespace hipr::test
