#include "renderer/api/openpbr.h"

#include <limits>

#include "renderer/api/material.h"

namespace hipr {

namespace {

constexpr float Unbounded = std::numeric_limits<float>::max();
using Use = InputUse;

constexpr OpenPbrInputInfo scalar(const char* name, float value, float least, float most,
                                  Use use = Use::Full) {
    return {name, 1, glm::vec4(value), least, most, use};
}

constexpr OpenPbrInputInfo color(const char* name, float r, float g, float b, float most = 1.f,
                                 Use use = Use::Full) {
    return {name, 3, glm::vec4(r, g, b, 1.f), 0.f, most, use};
}

constexpr OpenPbrInputInfo direction(const char* name, Use use) {
    return {name, 3, glm::vec4(0.f, 0.f, 1.f, 0.f), -Unbounded, Unbounded, use};
}

} // namespace

const std::array<OpenPbrInputInfo, size_t(OpenPbrInput::Count)>& openPbrInputs() {
    static const std::array<OpenPbrInputInfo, size_t(OpenPbrInput::Count)> rows = {{
        scalar("base_weight", 1.f, 0.f, 1.f),
        color("base_color", 0.8f, 0.8f, 0.8f),
        scalar("base_diffuse_roughness", 0.f, 0.f, 1.f),
        scalar("base_metalness", 0.f, 0.f, 1.f),
        scalar("specular_weight", 1.f, 0.f, 100.f),
        color("specular_color", 1.f, 1.f, 1.f),
        scalar("specular_roughness", 0.3f, 0.f, 1.f),
        scalar("specular_ior", 1.5f, 0.1f, 10.f),
        scalar("specular_roughness_anisotropy", 0.f, 0.f, 1.f),
        scalar("transmission_weight", 0.f, 0.f, 1.f),
        color("transmission_color", 1.f, 1.f, 1.f),
        scalar("transmission_depth", 0.f, 0.f, Unbounded, Use::Constant),
        color("transmission_scatter", 0.f, 0.f, 0.f, 1.f, Use::Constant),
        scalar("transmission_scatter_anisotropy", 0.f, -1.f, 1.f, Use::Constant),
        scalar("transmission_dispersion_scale", 0.f, 0.f, 1.f, Use::Constant),
        scalar("transmission_dispersion_abbe_number", 20.f, 0.f, Unbounded, Use::Constant),
        scalar("subsurface_weight", 0.f, 0.f, 1.f),
        color("subsurface_color", 0.8f, 0.8f, 0.8f),
        scalar("subsurface_radius", 1.f, 0.f, Unbounded),
        color("subsurface_radius_scale", 1.f, 0.5f, 0.25f),
        scalar("subsurface_scatter_anisotropy", 0.f, -1.f, 1.f),
        scalar("fuzz_weight", 0.f, 0.f, 1.f),
        color("fuzz_color", 1.f, 1.f, 1.f),
        scalar("fuzz_roughness", 0.5f, 0.f, 1.f),
        scalar("coat_weight", 0.f, 0.f, 1.f),
        color("coat_color", 1.f, 1.f, 1.f),
        scalar("coat_roughness", 0.f, 0.f, 1.f),
        scalar("coat_roughness_anisotropy", 0.f, 0.f, 1.f),
        scalar("coat_ior", 1.6f, 0.1f, 10.f),
        scalar("coat_darkening", 1.f, 0.f, 1.f),
        scalar("thin_film_weight", 0.f, 0.f, 1.f),
        scalar("thin_film_thickness", 0.5f, 0.f, Unbounded),
        scalar("thin_film_ior", 1.4f, 0.1f, 10.f),
        scalar("emission_luminance", 0.f, 0.f, Unbounded),
        color("emission_color", 1.f, 1.f, 1.f, Unbounded),
        scalar("geometry_opacity", 1.f, 0.f, 1.f),
        scalar("geometry_thin_walled", 0.f, 0.f, 1.f, Use::Constant),
        direction("geometry_normal", Use::Texture),
        direction("geometry_coat_normal", Use::Graph),
        direction("geometry_tangent", Use::Graph),
        direction("geometry_coat_tangent", Use::Graph),
        scalar("dielectric_priority", 0.f, -1e6f, 1e6f, Use::Constant),
    }};
    return rows;
}

MaterialInput openPbrDefault(OpenPbrInput input) {
    const OpenPbrInputInfo& info = openPbrInputs()[size_t(input)];
    return {MaterialInput::Source::Constant,
            info.value,
            info.components == 1 ? Channel::R : Channel::Rgb,
            {},
            {}};
}

MaterialInput openPbrInput(const MaterialDesc& material, OpenPbrInput input) {
    const auto found = material.openPbr.find(input);
    return found == material.openPbr.end() ? openPbrDefault(input) : found->second;
}

} // namespace hipr
