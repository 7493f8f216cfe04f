#include "renderer/materialx/surfaces.h"

namespace hipr {

using namespace gpu;

namespace {

using Surface = MtlxSurface;
using In = OpenPbrInput;

const GraphValue One(1.f), Zero(0.f);

/// A tangent-space normal that a graph makes, to world space.
GraphValue toWorld(GraphBuilder& b, GraphValue v) {
    const auto part = [&](MtlxGeometry axis, uint32_t which) {
        return b.multiply(mtlxGeometry(b, axis), b.component(v, which));
    };
    const GraphValue flat = b.add(part(MtlxGeometry::TangentWorld, 0), part(MtlxGeometry::BitangentWorld, 1));
    return b.add(flat, part(MtlxGeometry::NormalWorld, 2));
}

struct OpenPbrWriter {
    const Surface& surface;
    MaterialDesc& desc;

    GraphBuilder& build() const { return surface.build; }
    GraphValue in(const char* name, float standard = 0.f) const { return surface.value({name, standard}); }
    void set(In which, const GraphValue& value) const {
        desc.openPbr[which] = build().input(value, openPbrDefault(which));
    }
    void set(In which, const char* name, float standard) const { set(which, in(name, standard)); }

    /// Directions keep the surface's own unless the network gives one. A picture alone is a normal map.
    void direction(In which, const char* name) const {
        if (!surface.given(name)) return;
        const GraphValue value = in(name);
        set(which, value);
        if (which == In::GeometryCoatNormal && desc.openPbr[which].source == MaterialInput::Source::Texture)
            set(which, toWorld(build(), value));
    }
    /// A tangent, turned around the normal by a share of a whole turn.
    void tangent(In which, const char* name, const char* rotation) const {
        GraphBuilder& b = build();
        const GraphValue turns = in(rotation);
        const bool turned = !(turns == Zero);
        if (!turned) return direction(which, name);
        const GraphValue along = surface.given(name) ? in(name) : mtlxGeometry(b, MtlxGeometry::TangentWorld);
        set(which, b.op(GRAPH_ROTATE, along, b.multiply(turns, GraphValue(360.f)),
                        mtlxGeometry(b, MtlxGeometry::NormalWorld)));
    }
    /// Says that an input has no effect where it is given.
    void unused(const char* name) const {
        if (surface.given(name)) surface.complain(std::string("input '") + name + "' has no effect");
    }
};

/// Inputs that are there, as they are.
void openPbr(const Surface& surface, MaterialDesc& desc) {
    const OpenPbrWriter w{surface, desc};
    for (size_t i = 0; i < openPbrInputs().size(); ++i) {
        const OpenPbrInputInfo& info = openPbrInputs()[i];
        if (!surface.given(info.name)) continue;
        if (info.use == InputUse::Graph)
            w.direction(In(i), info.name);
        else
            w.set(In(i), surface.value({info.name, info.value}));
    }
}

/// The weight of specular reflection: of OpenPBR it dims metal too, of others the dielectric alone.
void specularWeight(const OpenPbrWriter& w, GraphValue weight, GraphValue metalness) {
    w.set(In::SpecularWeight, w.build().mix(weight, One, metalness));
}

GraphValue largest(GraphBuilder& b, GraphValue color) {
    const GraphValue two = b.op(GRAPH_MAX, b.component(color, 0), b.component(color, 1));
    return b.op(GRAPH_MAX, two, b.component(color, 2));
}

void standardSubsurface(const OpenPbrWriter& w) {
    GraphBuilder& b = w.build();
    w.set(In::SubsurfaceWeight, "subsurface", 0.f);
    w.set(In::SubsurfaceColor, "subsurface_color", 1.f);
    const GraphValue radius = w.in("subsurface_radius", 1.f), most = largest(b, radius);
    w.set(In::SubsurfaceRadius, b.multiply(w.in("subsurface_scale", 1.f), most));
    w.set(In::SubsurfaceRadiusScale, b.divide(radius, most));
    w.set(In::SubsurfaceScatterAnisotropy, "subsurface_anisotropy", 0.f);
}

void standardTransmission(const OpenPbrWriter& w) {
    w.set(In::TransmissionWeight, "transmission", 0.f);
    w.set(In::TransmissionColor, "transmission_color", 1.f);
    w.set(In::TransmissionDepth, "transmission_depth", 0.f);
    w.set(In::TransmissionScatter, "transmission_scatter", 0.f);
    w.set(In::TransmissionScatterAnisotropy, "transmission_scatter_anisotropy", 0.f);
    const GraphValue abbe = w.in("transmission_dispersion", 0.f);
    w.set(In::TransmissionDispersionScale, w.build().greater(abbe, Zero));
    w.set(In::TransmissionDispersionAbbeNumber, abbe);
}

void standardCoat(const OpenPbrWriter& w) {
    w.set(In::CoatWeight, "coat", 0.f);
    w.set(In::CoatColor, "coat_color", 1.f);
    w.set(In::CoatRoughness, "coat_roughness", 0.1f);
    w.set(In::CoatRoughnessAnisotropy, "coat_anisotropy", 0.f);
    w.set(In::CoatIor, "coat_IOR", 1.5f);
    w.set(In::CoatDarkening, "coat_affect_color", 0.f);
}

/// Nanometres to OpenPBR's micrometres.
void thinFilm(const OpenPbrWriter& w, GraphValue weight, const char* thickness, float standard) {
    w.set(In::ThinFilmWeight, weight);
    w.set(In::ThinFilmThickness, w.build().multiply(w.in(thickness, standard), GraphValue(0.001f)));
}

/// Version 1.0.0 has other defaults.
template <bool First> void standardSurface(const Surface& surface, MaterialDesc& desc) {
    const OpenPbrWriter w{surface, desc};
    GraphBuilder& b = surface.build;
    w.set(In::BaseWeight, "base", First ? 0.8f : 1.f);
    w.set(In::BaseColor, "base_color", First ? 1.f : 0.8f);
    w.set(In::BaseDiffuseRoughness, "diffuse_roughness", 0.f);
    const GraphValue metalness = w.in("metalness", 0.f);
    w.set(In::BaseMetalness, metalness);
    specularWeight(w, w.in("specular", 1.f), metalness);
    w.set(In::SpecularColor, "specular_color", 1.f);
    w.set(In::SpecularRoughness, "specular_roughness", 0.2f);
    w.set(In::SpecularIor, "specular_IOR", 1.5f);
    w.set(In::SpecularRoughnessAnisotropy, "specular_anisotropy", 0.f);
    standardTransmission(w);
    standardSubsurface(w);
    w.set(In::FuzzWeight, "sheen", 0.f);
    w.set(In::FuzzColor, "sheen_color", 1.f);
    w.set(In::FuzzRoughness, b.op(GRAPH_POWER, w.in("sheen_roughness", 0.3f), GraphValue(0.4f)));
    standardCoat(w);
    thinFilm(w, b.greater(w.in("thin_film_thickness"), Zero), "thin_film_thickness", 0.f);
    w.set(In::ThinFilmIor, "thin_film_IOR", 1.5f);
    w.set(In::EmissionLuminance, "emission", 0.f);
    w.set(In::EmissionColor, "emission_color", 1.f);
    w.set(In::GeometryOpacity, b.op(GRAPH_DOT, w.in("opacity", 1.f), GraphValue(1.f / 3.f), {}, 3));
    w.set(In::GeometryThinWalled, "thin_walled", 0.f);
    w.set(In::DielectricPriority, "dielectric_priority", 0.f);
    w.direction(In::GeometryNormal, "normal");
    w.direction(In::GeometryCoatNormal, "coat_normal");
    w.tangent(In::GeometryTangent, "tangent", "specular_rotation");
    w.tangent(In::GeometryCoatTangent, "tangent", "coat_rotation");
    w.unused("transmission_extra_roughness");
}

/// 0 opaque, 1 cut out, 2 blended.
GraphValue gltfOpacity(const OpenPbrWriter& w) {
    GraphBuilder& b = w.build();
    const GraphValue alpha = w.in("alpha", 1.f), mode = w.in("alpha_mode", 0.f);
    const GraphValue kept = b.subtract(One, b.greater(w.in("alpha_cutoff", 0.5f), alpha));
    return b.select(b.op(GRAPH_EQUAL, mode, Zero), One, b.select(b.op(GRAPH_EQUAL, mode, One), kept, alpha));
}

void gltfTransmission(const OpenPbrWriter& w, GraphValue baseColor) {
    const GraphValue distance = w.in("attenuation_distance", 0.f);
    const bool thick = distance.isConstant() && distance.constant.x > 0.f;
    w.set(In::TransmissionWeight, "transmission", 0.f);
    w.set(In::TransmissionDepth, thick ? distance : Zero);
    w.set(In::TransmissionColor, thick ? w.in("attenuation_color", 1.f) : baseColor);
    const GraphValue thickness = w.in("thickness", 0.f);
    const bool thin = !thick && thickness.isConstant() && thickness.constant.x == 0.f;
    w.set(In::GeometryThinWalled, thin && w.surface.given("transmission") ? One : Zero);
}

void gltfPbr(const Surface& surface, MaterialDesc& desc) {
    const OpenPbrWriter w{surface, desc};
    GraphBuilder& b = surface.build;
    const GraphValue color = w.in("base_color", 1.f), metallic = w.in("metallic", 1.f);
    w.set(In::BaseColor, color);
    w.set(In::BaseMetalness, metallic);
    w.set(In::SpecularRoughness, "roughness", 1.f);
    specularWeight(w, w.in("specular", 1.f), metallic);
    w.set(In::SpecularColor, b.mix(w.in("specular_color", 1.f), One, metallic));
    w.set(In::SpecularIor, "ior", 1.5f);
    gltfTransmission(w, color);
    const GraphValue sheen = w.in("sheen_color", 0.f), weight = largest(b, sheen);
    w.set(In::FuzzWeight, weight);
    w.set(In::FuzzColor, b.divide(sheen, weight));
    w.set(In::FuzzRoughness, "sheen_roughness", 0.f);
    w.set(In::CoatWeight, "clearcoat", 0.f);
    w.set(In::CoatRoughness, "clearcoat_roughness", 0.f);
    w.set(In::CoatIor, GraphValue(1.5f));
    w.set(In::CoatDarkening, Zero);
    thinFilm(w, w.in("iridescence", 0.f), "iridescence_thickness", 100.f);
    w.set(In::ThinFilmIor, "iridescence_ior", 1.3f);
    w.set(In::EmissionLuminance, "emissive_strength", 1.f);
    w.set(In::EmissionColor, "emissive", 0.f);
    w.set(In::GeometryOpacity, gltfOpacity(w));
    w.direction(In::GeometryNormal, "normal");
    w.direction(In::GeometryCoatNormal, "clearcoat_normal");
    w.direction(In::GeometryTangent, "tangent");
}

/// Light and nothing else.
void unlit(const Surface& surface, MaterialDesc& desc) {
    const OpenPbrWriter w{surface, desc};
    GraphBuilder& b = surface.build;
    w.set(In::BaseWeight, Zero);
    w.set(In::SpecularWeight, Zero);
    w.set(In::EmissionLuminance, "emission", 1.f);
    w.set(In::EmissionColor, "emission_color", 1.f);
    const GraphValue stopped = b.subtract(One, w.in("transmission", 0.f));
    w.set(In::GeometryOpacity, b.multiply(w.in("opacity", 1.f), stopped));
    w.unused("transmission_color");
}

struct PreviewInput {
    const char* name;
    MaterialInput MaterialDesc::*member;
};

constexpr PreviewInput PreviewInputs[] = {
    {"diffuseColor", &MaterialDesc::diffuseColor},
    {"emissiveColor", &MaterialDesc::emissiveColor},
    {"specularColor", &MaterialDesc::specularColor},
    {"metallic", &MaterialDesc::metallic},
    {"roughness", &MaterialDesc::roughness},
    {"clearcoat", &MaterialDesc::clearcoat},
    {"clearcoatRoughness", &MaterialDesc::clearcoatRoughness},
    {"opacity", &MaterialDesc::opacity},
    {"opacityThreshold", &MaterialDesc::opacityThreshold},
    {"ior", &MaterialDesc::ior},
    {"occlusion", &MaterialDesc::occlusion},
    {"normal", &MaterialDesc::normal},
};

void previewSurface(const Surface& surface, MaterialDesc& desc) {
    for (const PreviewInput& row : PreviewInputs) {
        MaterialInput& input = desc.*row.member;
        const GraphValue value = surface.value({row.name, input.constant});
        input = surface.build.input(value, input);
    }
    if (desc.normal.source == MaterialInput::Source::Graph) {
        GraphValue value;
        value.node = desc.normal.node;
        desc.normal = surface.build.input(toWorld(surface.build, value), desc.normal);
    }
    desc.useSpecularWorkflow = surface.value({"useSpecularWorkflow", 0.f}).constant.x != 0.f;
    const bool presence = surface.text("opacityMode") == "presence" ||
                          surface.value({"opacityMode", 0.f}).constant.x == 1.f; // MaterialX has a number
    desc.opacityMode = presence ? OpacityMode::Presence : OpacityMode::Transparent;
}

} // namespace

bool mtlxSurface(const std::string& id, const MtlxSurface& surface, MaterialDesc& desc) {
    struct Model {
        const char* id;
        MaterialModel model;
        void (*make)(const Surface&, MaterialDesc&);
    };
    static constexpr Model models[] = {
        {"UsdPreviewSurface", MaterialModel::UsdPreviewSurface, previewSurface},
        {"ND_UsdPreviewSurface_surfaceshader", MaterialModel::UsdPreviewSurface, previewSurface},
        {"ND_open_pbr_surface_surfaceshader", MaterialModel::OpenPbr, openPbr},
        {"open_pbr_surface", MaterialModel::OpenPbr, openPbr},
        {"OpenPBR", MaterialModel::OpenPbr, openPbr},
        {"OpenPBRSurface", MaterialModel::OpenPbr, openPbr},
        {"ND_standard_surface_surfaceshader", MaterialModel::OpenPbr, standardSurface<false>},
        {"ND_standard_surface_surfaceshader_100", MaterialModel::OpenPbr, standardSurface<true>},
        {"ND_gltf_pbr_surfaceshader", MaterialModel::OpenPbr, gltfPbr},
        {"ND_surface_unlit", MaterialModel::OpenPbr, unlit},
    };
    for (const Model& model : models) {
        if (id != model.id) continue;
        desc.model = model.model;
        model.make(surface, desc);
        const auto isGraph = [](const MaterialInput& i) { return i.source == MaterialInput::Source::Graph; };
        bool graph = false;
        for (const auto& [which, input] : desc.openPbr)
            graph |= isGraph(input);
        for (const PreviewInput& row : PreviewInputs)
            graph |= isGraph(desc.*row.member);
        if (graph) desc.graph = surface.build.graph();
        return true;
    }
    return false;
}

} // namespace hipr
