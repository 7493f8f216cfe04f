#include "renderer/shading/material_inputs.h"

#include <array>
#include <cmath>

#include "renderer/shading/graph_program.h"
#include "renderer/shading/material_traits.h"
#include "renderer/shading/media.h"

namespace hipr {

namespace {

using Source = MaterialInput::Source;

constexpr float Unbounded = std::numeric_limits<float>::max();

/// An input of a UsdPreviewSurface: where it is in MaterialDesc, its name, and the range of its components.
struct PreviewRow {
    MaterialInput MaterialDesc::*member;
    const char* name;
    float least, most;
};

/// By INPUT_*.
constexpr std::array<PreviewRow, gpu::PREVIEW_INPUT_COUNT> PreviewRows = {{
    {&MaterialDesc::diffuseColor, "diffuseColor", 0.f, 1.f},
    {&MaterialDesc::emissiveColor, "emissiveColor", 0.f, Unbounded},
    {&MaterialDesc::specularColor, "specularColor", 0.f, 1.f},
    {&MaterialDesc::metallic, "metallic", 0.f, 1.f},
    {&MaterialDesc::roughness, "roughness", 0.f, 1.f},
    {&MaterialDesc::clearcoat, "clearcoat", 0.f, 1.f},
    {&MaterialDesc::clearcoatRoughness, "clearcoatRoughness", 0.f, 1.f},
    {&MaterialDesc::opacity, "opacity", 0.f, 1.f},
    {&MaterialDesc::opacityThreshold, "opacityThreshold", 0.f, 1.f},
    {&MaterialDesc::ior, "ior", 0.f, 100.f},
    {&MaterialDesc::normal, "normal", -Unbounded, Unbounded},
}};

/// The inputs of OpenPBR that kernels read, by INPUT_*; Count: none.
constexpr std::array<OpenPbrInput, gpu::INPUT_COUNT> OpenPbrRows = {
    OpenPbrInput::BaseColor,
    OpenPbrInput::EmissionColor,
    OpenPbrInput::SpecularColor,
    OpenPbrInput::BaseMetalness,
    OpenPbrInput::SpecularRoughness,
    OpenPbrInput::CoatWeight,
    OpenPbrInput::CoatRoughness,
    OpenPbrInput::GeometryOpacity,
    OpenPbrInput::Count,
    OpenPbrInput::SpecularIor,
    OpenPbrInput::GeometryNormal,
    OpenPbrInput::BaseWeight,
    OpenPbrInput::BaseDiffuseRoughness,
    OpenPbrInput::SpecularWeight,
    OpenPbrInput::SpecularRoughnessAnisotropy,
    OpenPbrInput::TransmissionWeight,
    OpenPbrInput::TransmissionColor,
    OpenPbrInput::SubsurfaceWeight,
    OpenPbrInput::SubsurfaceColor,
    OpenPbrInput::SubsurfaceScatterAnisotropy,
    OpenPbrInput::FuzzWeight,
    OpenPbrInput::FuzzColor,
    OpenPbrInput::FuzzRoughness,
    OpenPbrInput::CoatColor,
    OpenPbrInput::CoatRoughnessAnisotropy,
    OpenPbrInput::CoatIor,
    OpenPbrInput::CoatDarkening,
    OpenPbrInput::EmissionLuminance,
    OpenPbrInput::ThinFilmWeight,
    OpenPbrInput::ThinFilmThickness,
    OpenPbrInput::ThinFilmIor,
    OpenPbrInput::Count,
    OpenPbrInput::SubsurfaceRadius,
    OpenPbrInput::SubsurfaceRadiusScale,
};

/// The constant of an input within its range. NaN and infinity become the specification's default.
glm::vec4 checkedConstant(const char* name, const MaterialInput& input, const glm::vec4& standard,
                          float least, float most, std::string& complaints) {
    glm::vec4 value = input.constant;
    const int used = input.channel == Channel::Rgb ? 3 : 1;
    bool bad = false;
    for (int c = 0; c < 4; ++c) {
        float checked = std::isfinite(value[c]) ? value[c] : standard[c];
        checked = std::min(std::max(checked, least), most);
        if (c < used && checked != value[c]) bad = true; // also true for NaN
        value[c] = checked;
    }
    if (bad) complaints += std::string(complaints.empty() ? "" : ", ") + name;
    return value;
}

gpu::InputNode describeNode(const MaterialInput& input, NameTable& names) {
    gpu::InputNode node{};
    node.texture = gpu::NO_INDEX;
    node.uvAxisU = {1.f, 0.f};
    node.uvAxisV = {0.f, 1.f};
    node.channel = uint32_t(input.channel);
    node.fallback = input.constant;
    if (input.source == Source::Primvar) {
        node.primvar = names.intern(input.primvar);
        return node;
    }
    const TextureDesc& t = input.texture;
    node.primvar = names.intern(t.uvPrimvar);
    node.scale = t.scale;
    node.bias = t.bias;
    node.fallback = t.fallback;
    node.uvAxisU = t.uvTransform[0];
    node.uvAxisV = t.uvTransform[1];
    node.uvOffset = t.uvTransform[2];
    node.uvFallback = t.uvFallback;
    return node;
}

/// Whether opacity is the same all over, and opacityThreshold too; then they decide here and now.
bool constantOpacity(const ResolvedMaterial& m, const TextureStore& textures, float& opacity) {
    const ResolvedInput& input = m.inputs[gpu::INPUT_OPACITY];
    const ResolvedInput& threshold = m.inputs[gpu::INPUT_OPACITY_THRESHOLD];
    if (threshold.kind != Source::Constant) return false;
    opacity = input.constant.x;
    if (input.kind == Source::Texture) {
        // The alpha of a picture without transparency, a frequent connection, is no reason to look through
        // surfaces.
        const ResolvedRead& read = m.reads[m.opacityRead];
        if (read.node.channel != uint32_t(Channel::A) || !textures.opaque(read.texture) ||
            textures.range(read.texture).udimTiles)
            return false;
        opacity = read.node.scale.w + read.node.bias.w;
    } else if (input.kind != Source::Constant) {
        return false;
    }
    if (threshold.constant.x > 0.f) opacity = opacity >= threshold.constant.x ? 1.f : 0.f;
    return true;
}

/// How (1 - opacity) of the light passes; see shaders/shared/material.h.
uint32_t opacityFlags(const ResolvedMaterial& m, const TextureStore& textures) {
    constexpr uint32_t Straight = gpu::MATERIAL_PRESENCE | gpu::MATERIAL_NON_OPAQUE;
    float opacity;
    if (!constantOpacity(m, textures, opacity)) return Straight;
    if (opacity >= 1.f) return 0;
    if (m.model == MaterialModel::OpenPbr) return Straight;
    const ResolvedInput& ior = m.inputs[gpu::INPUT_SPECULAR_IOR];
    const bool bends = ior.kind != Source::Constant || std::abs(ior.constant.x - 1.f) >= gpu::MIN_IOR_STEP;
    const bool cutOut = m.inputs[gpu::INPUT_OPACITY_THRESHOLD].constant.x > 0.f;
    return m.opacityMode == OpacityMode::Transparent && bends && !cutOut ? gpu::MATERIAL_REFRACTIVE
                                                                         : Straight;
}

uint32_t materialFlags(const ResolvedMaterial& m, const TextureStore& textures) {
    uint32_t flags = opacityFlags(m, textures);
    if (m.specularWorkflow) flags |= gpu::MATERIAL_SPECULAR_WORKFLOW;
    if (isEmissive(m)) flags |= gpu::MATERIAL_EMISSIVE;
    if (m.model != MaterialModel::OpenPbr) return flags;
    flags |= gpu::MATERIAL_OPENPBR;
    if (m.thinWalled) flags |= gpu::MATERIAL_THIN_WALLED;
    if (!m.thinWalled && mayExceed(m.inputs[gpu::INPUT_TRANSMISSION_WEIGHT], 0.f))
        flags |= gpu::MATERIAL_REFRACTIVE;
    if (m.subsurfaceTravels) flags |= gpu::MATERIAL_SUBSURFACE;
    return flags;
}

/// What an authored input of OpenPBR does not do; empty when it does everything.
const char* shortfall(const OpenPbrInputInfo& info, const MaterialInput& input) {
    const bool driven = input.source != Source::Constant;
    const bool standard = !driven && input.constant == info.value;
    switch (info.use) {
    case InputUse::Full:
        return "";
    case InputUse::Constant:
        return driven ? "its constant alone is used" : "";
    case InputUse::Texture:
        return standard || input.source == Source::Texture || input.source == Source::Graph
                   ? ""
                   : "it is used from normal maps alone";
    case InputUse::Graph:
        break;
    }
    return standard || input.source == Source::Graph ? "" : "it is used from graphs alone";
}

/// Checks the inputs of one description, one after the other.
struct Resolver {
    const MaterialDesc& desc;
    NameTable& names;
    TextureStore& textures;
    std::string complaints{};
    std::vector<ProgramTarget> targets{};

    ResolvedInput resolve(const char* name, MaterialInput input, const glm::vec4& standard, float least,
                          float most, uint32_t target) {
        input.constant = checkedConstant(name, input, standard, least, most, complaints);
        ResolvedInput resolved{input.source, input.constant};
        if (input.source == Source::Texture) {
            resolved.scale = input.texture.scale;
            resolved.bias = input.texture.bias;
        }
        const bool graph = input.source == Source::Graph;
        if (input.source == Source::Constant ||
            (target == gpu::INPUT_NORMAL && input.source == Source::Primvar))
            return resolved;
        const bool presence = target == gpu::INPUT_OPACITY || target == gpu::INPUT_OPACITY_THRESHOLD;
        if (target == gpu::INPUT_NORMAL && graph) target = gpu::INPUT_WORLD_NORMAL;
        targets.push_back({target, std::move(input), presence});
        return resolved;
    }

    /// Makes the program, and acquires what it reads.
    void program(ResolvedMaterial& out, const MessageSink& messages) {
        GraphProgram made = compileGraph(desc.graph, std::move(targets), uint32_t(out.inputs.size()));
        out.steps = std::move(made.steps);
        out.presenceSteps = made.presenceSteps;
        out.stepConstants = std::move(made.constants);
        for (const MaterialInput& input : made.reads) {
            ResolvedRead& read = out.reads.emplace_back();
            read.node = describeNode(input, names);
            read.textured = input.source == Source::Texture;
            const TextureDesc& t = input.texture;
            if (read.textured)
                read.texture = textures.acquire({t.path, t.colorSpace, t.wrapS, t.wrapT, false}, desc.name);
        }
        for (const gpu::GraphStep& step : out.steps)
            if (step.code >> 16 == gpu::INPUT_OPACITY) out.opacityRead = step.immediate;
        for (const uint32_t target : made.dropped) {
            if (target < out.inputs.size()) out.inputs[target].kind = Source::Constant;
            if (messages)
                messages(Severity::Warning, desc.name,
                         "one of its inputs is driven by too large a network (more than " +
                             std::to_string(gpu::GRAPH_REGISTERS) +
                             " values at a time); the input keeps its own value");
        }
    }

    void preview(std::vector<ResolvedInput>& inputs) {
        static const MaterialDesc standard;
        for (const PreviewRow& row : PreviewRows)
            inputs.push_back(resolve(row.name, desc.*row.member, (standard.*row.member).constant, row.least,
                                     row.most, uint32_t(inputs.size())));
    }

    /// Of an input that takes effect by its constant alone.
    glm::vec4 constant(OpenPbrInput which) {
        const OpenPbrInputInfo& info = openPbrInputs()[size_t(which)];
        return checkedConstant(info.name, openPbrInput(desc, which), info.value, info.least, info.most,
                               complaints);
    }

    /// What light travels through inside the object. With a depth, transmission_color is what absorption
    /// makes of light over that depth, and no tint of the surface.
    void media(ResolvedMaterial& out) {
        const float depth = constant(OpenPbrInput::TransmissionDepth).x;
        ResolvedInput& color = out.inputs[gpu::INPUT_TRANSMISSION_COLOR];
        out.interior.dispersion = abbeNumber(constant(OpenPbrInput::TransmissionDispersionScale).x,
                                             constant(OpenPbrInput::TransmissionDispersionAbbeNumber).x);
        const ResolvedInput &radius = out.inputs[gpu::INPUT_SUBSURFACE_RADIUS],
                            &scale = out.inputs[gpu::INPUT_SUBSURFACE_RADIUS_SCALE];
        const bool driven = radius.kind != Source::Constant || scale.kind != Source::Constant;
        out.subsurface = subsurfaceMedium(driven ? 1.f : radius.constant.x, glm::vec3(scale.constant),
                                          out.inputs[gpu::INPUT_SUBSURFACE_ANISOTROPY].constant.x);
        if (driven) out.subsurface.extinction = glm::vec3(0.f); // comes with the path
        out.subsurfaceTravels = mayExceed(radius, 0.f);
        if (depth <= 0.f) return;
        setTransmissionMedium(out.interior, glm::vec3(color.constant), depth,
                              glm::vec3(constant(OpenPbrInput::TransmissionScatter)),
                              constant(OpenPbrInput::TransmissionScatterAnisotropy).x);
        color.constant = glm::vec4(1.f);
    }

    void openPbr(std::vector<ResolvedInput>& inputs) {
        for (const OpenPbrInput which : OpenPbrRows) {
            if (which == OpenPbrInput::Count) {
                inputs.emplace_back();
                continue;
            }
            const OpenPbrInputInfo& info = openPbrInputs()[size_t(which)];
            inputs.push_back(resolve(info.name, openPbrInput(desc, which), info.value, info.least, info.most,
                                     uint32_t(inputs.size())));
        }
        addTangent(inputs);
        constexpr std::pair<OpenPbrInput, uint32_t> directions[] = {
            {OpenPbrInput::GeometryCoatNormal, gpu::INPUT_COAT_NORMAL},
            {OpenPbrInput::GeometryTangent, gpu::INPUT_SPECULAR_TANGENT},
            {OpenPbrInput::GeometryCoatTangent, gpu::INPUT_COAT_TANGENT}};
        for (const auto& [which, target] : directions) {
            const MaterialInput input = openPbrInput(desc, which);
            if (input.source == Source::Graph) targets.push_back({target, input});
        }
    }

    /// Stretched highlights follow the texture coordinates: those of the normal map, else st.
    void addTangent(std::vector<ResolvedInput>& inputs) {
        if (!isStretched(inputs)) return;
        const MaterialInput normal = openPbrInput(desc, OpenPbrInput::GeometryNormal);
        MaterialInput reader;
        reader.source = Source::Primvar;
        reader.primvar = normal.source == Source::Texture ? normal.texture.uvPrimvar : "st";
        targets.push_back({gpu::INPUT_TANGENT, reader});
    }
};

/// Names what the material asks for and does not get, each with the reason.
void tellShortfalls(const MaterialDesc& desc, const MessageSink& messages) {
    const bool deep = openPbrInput(desc, OpenPbrInput::TransmissionDepth).constant.x > 0.f;
    if (deep && openPbrInput(desc, OpenPbrInput::TransmissionColor).source != Source::Constant)
        messages(Severity::Warning, desc.name,
                 "material input transmission_color: with a transmission_depth what drives it colours the "
                 "surface, its constant the inside");
    for (const auto& [which, input] : desc.openPbr) {
        const OpenPbrInputInfo& info = openPbrInputs()[size_t(which)];
        const std::string text = shortfall(info, input);
        if (!text.empty())
            messages(Severity::Warning, desc.name, std::string("material input ") + info.name + ": " + text);
    }
}

} // namespace

ResolvedMaterial resolveMaterial(const MaterialDesc& desc, NameTable& names, TextureStore& textures,
                                 const MessageSink& messages) {
    ResolvedMaterial result;
    result.model = desc.model;
    Resolver resolver{desc, names, textures};
    if (desc.model == MaterialModel::OpenPbr) {
        result.thinWalled = resolver.constant(OpenPbrInput::GeometryThinWalled).x > 0.5f;
        result.priority = int(resolver.constant(OpenPbrInput::DielectricPriority).x);
        resolver.openPbr(result.inputs);
        if (!result.thinWalled) resolver.media(result);
    } else {
        result.specularWorkflow = desc.useSpecularWorkflow;
        result.opacityMode = desc.opacityMode;
        resolver.preview(result.inputs);
    }
    resolver.program(result, messages);
    if (!messages) return result;
    if (!resolver.complaints.empty())
        messages(Severity::Warning, desc.name,
                 "material inputs out of range, clamped: " + resolver.complaints);
    if (desc.model == MaterialModel::OpenPbr) {
        tellShortfalls(desc, messages);
        return result;
    }
    const ResolvedInput& normal = result.inputs[gpu::INPUT_NORMAL];
    const bool plainNormal =
        normal.kind == Source::Constant && normal.constant.x == 0.f && normal.constant.y == 0.f;
    if (normal.kind == Source::Primvar || (normal.kind == Source::Constant && !plainNormal))
        messages(Severity::Warning, desc.name, "material input normal is used from textures alone; ignored");
    return result;
}

MaterialRow describeMaterial(const ResolvedMaterial& material, const TextureStore& textures) {
    MaterialRow row;
    row.flags = materialFlags(material, textures);
    row.interior = material.interior;
    row.subsurface = material.subsurface;
    row.steps = material.steps;
    row.presenceSteps = material.presenceSteps;
    row.priority = material.priority;
    for (const ResolvedInput& input : material.inputs)
        row.constants.push_back(input.constant);
    row.constants.insert(row.constants.end(), material.stepConstants.begin(), material.stepConstants.end());
    for (const ResolvedRead& read : material.reads) {
        gpu::InputNode& node = row.nodes.emplace_back(read.node);
        if (!read.textured) continue;
        const TextureRange range = textures.range(read.texture);
        node.texture = range.first;
        node.udimTiles = range.udimTiles;
    }
    return row;
}

} // namespace hipr
