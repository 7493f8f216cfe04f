#include "renderer/shading/material_inputs.h"

#include <cmath>

#include "shaders/shared/scene.h"

namespace hipr {

namespace {

using Source = MaterialInput::Source;

/// One row per INPUT_*: where it is in MaterialDesc, its name, and the range of its components.
struct InputRow {
    MaterialInput MaterialDesc::*member;
    const char* name;
    float least, most;
};

constexpr float Unbounded = std::numeric_limits<float>::max();
constexpr std::array<InputRow, gpu::INPUT_COUNT> Rows = {{
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

/// The constant of an input within its range. NaN and infinity become the specification's default.
glm::vec4 checkedConstant(const InputRow& row, const MaterialInput& input, std::string& complaints) {
    glm::vec4 value = input.constant;
    const int used = input.channel == Channel::Rgb ? 3 : 1;
    bool bad = false;
    for (int c = 0; c < 4; ++c) {
        float checked = std::isfinite(value[c]) ? value[c] : (MaterialDesc().*row.member).constant[c];
        checked = std::min(std::max(checked, row.least), row.most);
        if (c < used && checked != value[c]) bad = true; // also true for NaN
        value[c] = checked;
    }
    if (bad) complaints += std::string(complaints.empty() ? "" : ", ") + row.name;
    return value;
}

gpu::InputNode describeNode(const MaterialInput& input, const glm::vec4& constant, NameTable& names) {
    gpu::InputNode node{};
    node.texture = gpu::NO_INDEX;
    node.channel = uint32_t(input.channel);
    node.fallback = constant;
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
        const gpu::InputNode& node = input.node;
        if (node.channel != uint32_t(Channel::A) || !textures.opaque(input.texture) ||
            textures.range(input.texture).udimTiles)
            return false;
        opacity = node.scale.w + node.bias.w;
    } else if (input.kind == Source::Primvar) {
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
    const ResolvedInput& ior = m.inputs[gpu::INPUT_IOR];
    const bool bends = ior.kind != Source::Constant || std::abs(ior.constant.x - 1.f) >= gpu::MIN_IOR_STEP;
    const bool cutOut = m.inputs[gpu::INPUT_OPACITY_THRESHOLD].constant.x > 0.f;
    return m.opacityMode == OpacityMode::Transparent && bends && !cutOut ? gpu::MATERIAL_REFRACTIVE
                                                                         : Straight;
}

} // namespace

ResolvedMaterial resolveMaterial(const MaterialDesc& desc, NameTable& names, TextureStore& textures,
                                 const MessageSink& messages) {
    ResolvedMaterial result;
    result.specularWorkflow = desc.useSpecularWorkflow;
    result.opacityMode = desc.opacityMode;
    std::string complaints;
    for (size_t i = 0; i < Rows.size(); ++i) {
        const MaterialInput& input = desc.*Rows[i].member;
        ResolvedInput& resolved = result.inputs[i];
        resolved.kind = input.source;
        resolved.constant = checkedConstant(Rows[i], input, complaints);
        if (input.source == Source::Constant) continue;
        resolved.node = describeNode(input, resolved.constant, names);
        if (input.source != Source::Texture) continue;
        const TextureDesc& t = input.texture;
        resolved.texture = textures.acquire({t.path, t.colorSpace, t.wrapS, t.wrapT, false}, desc.name);
    }
    if (!complaints.empty() && messages)
        messages(Severity::Warning, desc.name, "material inputs out of range, clamped: " + complaints);
    const ResolvedInput& normal = result.inputs[gpu::INPUT_NORMAL];
    const bool plainNormal =
        normal.kind == Source::Constant && normal.constant.x == 0.f && normal.constant.y == 0.f;
    if (normal.kind != Source::Texture && !plainNormal && messages)
        messages(Severity::Warning, desc.name, "material input normal is used from textures alone; ignored");
    return result;
}

gpu::MaterialRecord describeMaterial(const ResolvedMaterial& material, const TextureStore& textures,
                                     std::vector<gpu::InputNode>& nodes) {
    gpu::MaterialRecord record{};
    for (size_t i = 0; i < material.inputs.size(); ++i) {
        const ResolvedInput& input = material.inputs[i];
        record.constants[i] = input.constant;
        record.nodes[i] = gpu::NO_INDEX;
        if (input.kind == Source::Constant) continue;
        record.nodes[i] = uint32_t(nodes.size());
        nodes.push_back(input.node);
        if (input.kind != Source::Texture) continue;
        const TextureRange range = textures.range(input.texture);
        nodes.back().texture = range.first;
        nodes.back().udimTiles = range.udimTiles;
    }
    record.flags = opacityFlags(material, textures);
    if (material.specularWorkflow) record.flags |= gpu::MATERIAL_SPECULAR_WORKFLOW;
    if (isEmissive(material)) record.flags |= gpu::MATERIAL_EMISSIVE;
    if (!nodes.empty()) record.flags |= gpu::MATERIAL_HAS_NODES;
    return record;
}

bool isEmissive(const ResolvedMaterial& material) {
    const ResolvedInput& input = material.inputs[gpu::INPUT_EMISSIVE_COLOR];
    return input.kind != Source::Constant || glm::vec3(input.constant) != glm::vec3(0.f);
}

} // namespace hipr
