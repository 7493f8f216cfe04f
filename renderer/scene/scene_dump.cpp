#include "renderer/scene/scene_dump.h"

#include <algorithm>
#include <cstdio>

namespace hipr {
namespace {

const char* name(Interpolation interpolation) {
    static const char* const names[] = {"constant", "uniform", "vertex", "faceVarying"};
    return names[uint32_t(interpolation)];
}

const char* name(WrapMode mode) {
    static const char* const names[] = {"black", "clamp", "repeat", "mirror", "useMetadata"};
    return names[uint32_t(mode)];
}

const char* name(Channel channel) {
    static const char* const names[] = {"r", "g", "b", "a", "rgb"};
    return names[uint32_t(channel)];
}

const char* name(LightKind kind) {
    static const char* const names[] = {"dome", "distant", "rect", "sphere", "disk", "cylinder"};
    return names[uint32_t(kind)];
}

void dumpTexture(SceneDump::Element& out, const char* input, const TextureDesc& texture) {
    out.fact(input, "path", texture.path);
    out.fact(input, "colorSpace", texture.colorSpace);
    out.fact(input, "wrap", name(texture.wrapS), name(texture.wrapT));
    out.fact(input, "scale", texture.scale);
    out.fact(input, "bias", texture.bias);
    out.fact(input, "fallback", texture.fallback);
    out.fact(input, "uv", texture.uvPrimvar, "fallback", texture.uvFallback);
    out.fact(input, "uvTransform", texture.uvTransform);
}

void dumpInput(SceneDump::Element& out, const char* input, const MaterialInput& value) {
    switch (value.source) {
    case MaterialInput::Source::Constant:
        out.fact(input, "constant", value.constant);
        break;
    case MaterialInput::Source::Primvar:
        out.fact(input, "primvar", value.primvar, name(value.channel), "fallback", value.constant);
        break;
    case MaterialInput::Source::Texture:
        out.fact(input, "texture", name(value.channel));
        dumpTexture(out, input, value.texture);
        break;
    case MaterialInput::Source::Graph:
        out.fact(input, "graph", value.node);
        break;
    }
}

void dumpGraph(SceneDump::Element& out, const MaterialGraph& graph) {
    for (const GraphNode& node : graph.nodes) {
        out.fact("node", node.op, node.immediate);
        for (size_t k = 0; k < graphOperandCount(node.op); ++k)
            out.fact("operand", node.operands[k].node, node.operands[k].constant);
    }
    for (const MaterialInput& read : graph.reads)
        dumpInput(out, "read", read);
}

} // namespace

void SceneDump::Element::put(const char* word) {
    if (!_text.empty() || !_head.empty()) _text += ' ';
    _text += word;
}

void SceneDump::Element::put(const std::string& word) {
    const bool plain = !word.empty() && word.find_first_of(" \t\r\n\"") == std::string::npos;
    if (plain) return put(word.c_str());
    std::string quoted = "\"";
    for (const char c : word) {
        if (c == '\n')
            quoted += "\\n";
        else {
            if (c == '"' || c == '\\') quoted += '\\';
            quoted += c;
        }
    }
    put((quoted + "\"").c_str());
}

void SceneDump::Element::put(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%a", value);
    put(text);
}

SceneDump::Element& SceneDump::element(const std::string& kind, const std::string& name) {
    Element& element = _elements.emplace_back();
    element.put(kind.c_str());
    element.put(name);
    std::swap(element._head, element._text);
    return element;
}

void SceneDump::write(std::ostream& out) const {
    std::vector<const Element*> sorted;
    for (const Element& element : _elements)
        sorted.push_back(&element);
    std::sort(sorted.begin(), sorted.end(), [](const Element* a, const Element* b) {
        return a->_head != b->_head ? a->_head < b->_head : a->_text < b->_text;
    });
    for (const Element* element : sorted)
        out << element->_text;
}

std::string MaterialNames::byId(MaterialId id) const {
    if (id == MaterialId::None) return "(fallback)";
    const auto found = names.find(id);
    return found == names.end() ? "(missing)" : found->second;
}

std::string MaterialNames::byIndex(uint32_t index) const {
    const auto found = indices.find(index);
    return found == indices.end() ? "(fallback)" : byId(found->second);
}

std::string contentHash(const void* data, size_t bytes) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < bytes; ++i)
        hash = (hash ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3u;
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

void dumpCamera(SceneDump& dump, const CameraDesc& camera) {
    SceneDump::Element& out = dump.element("camera", "view");
    out.fact("worldToView", camera.worldToView);
    out.fact("projection", camera.projection);
    out.fact("lens", camera.lens.radius, camera.lens.focusDistance, camera.lens.blades,
             camera.lens.bladeRotation);
    for (const glm::dvec4& plane : camera.clipPlanes)
        out.fact("clipPlane", plane);
    out.fact("exposure", camera.exposure);
    out.fact("shutter", camera.shutter.open, camera.shutter.close);
    for (const CameraKey& key : camera.motion)
        out.fact("key", key.time, key.worldToView);
}

void dumpMesh(SceneDump& dump, const TriangleMesh& mesh) {
    SceneDump::Element& out = dump.element("geometry", mesh.name);
    out.fact("positions", mesh.positions.size(), contentHash(mesh.positions));
    out.fact("triangles", mesh.triangles.size(), contentHash(mesh.triangles));
    if (!mesh.segments.empty())
        out.fact("segments", mesh.segments.size(), contentHash(mesh.segments), contentHash(mesh.radii));
    out.fact("faces", mesh.triangleFace.size(), contentHash(mesh.triangleFace));
    out.fact("slots", mesh.triangleSlot.size(), contentHash(mesh.triangleSlot));
    out.fact("normals", name(mesh.normalInterpolation), mesh.normals.size(), contentHash(mesh.normals));
    out.fact("doubleSided", mesh.doubleSided);
    out.fact("bounds", mesh.boundsMin, mesh.boundsMax);
    for (const MeshKey& key : mesh.motion)
        out.fact("key", key.time, contentHash(key.positions), contentHash(key.normals));
    std::vector<const TrianglePrimvar*> primvars;
    for (const TrianglePrimvar& primvar : mesh.primvars)
        primvars.push_back(&primvar);
    std::sort(primvars.begin(), primvars.end(), [](auto* a, auto* b) { return a->name < b->name; });
    for (const TrianglePrimvar* primvar : primvars)
        out.fact("primvar", primvar->name, name(primvar->interpolation), primvar->components,
                 primvar->values.size(), contentHash(primvar->values));
}

void dumpMaterial(SceneDump& dump, const MaterialDesc& material, bool nonOpaque) {
    SceneDump::Element& out = dump.element("material", material.name);
    dumpGraph(out, material.graph);
    if (material.model == MaterialModel::OpenPbr) {
        out.fact("model", "OpenPBR");
        for (size_t i = 0; i < openPbrInputs().size(); ++i)
            dumpInput(out, openPbrInputs()[i].name, openPbrInput(material, OpenPbrInput(i)));
        out.fact("nonOpaque", nonOpaque);
        return;
    }
    out.fact("model", "UsdPreviewSurface");
    const std::pair<const char*, const MaterialInput*> inputs[] = {
        {"diffuseColor", &material.diffuseColor},
        {"emissiveColor", &material.emissiveColor},
        {"specularColor", &material.specularColor},
        {"metallic", &material.metallic},
        {"roughness", &material.roughness},
        {"clearcoat", &material.clearcoat},
        {"clearcoatRoughness", &material.clearcoatRoughness},
        {"opacity", &material.opacity},
        {"opacityThreshold", &material.opacityThreshold},
        {"ior", &material.ior},
        {"normal", &material.normal},
        {"occlusion", &material.occlusion},
    };
    for (const auto& [input, value] : inputs)
        dumpInput(out, input, *value);
    out.fact("useSpecularWorkflow", material.useSpecularWorkflow);
    out.fact("opacityMode", material.opacityMode == OpacityMode::Presence ? "presence" : "transparent");
    out.fact("nonOpaque", nonOpaque);
}

void dumpLightControls(SceneDump::Element& out, const LightShaping& shaping, const LightShadow& shadow,
                       const std::string& lightLink, const std::string& shadowLink) {
    out.fact("focus", shaping.focus, "tint", shaping.focusTint);
    out.fact("cone", shaping.coneAngle, "softness", shaping.coneSoftness);
    out.fact("ies", shaping.iesFile, "angleScale", shaping.iesAngleScale, "normalize", shaping.iesNormalize);
    out.fact("shadow", shadow.enable, shadow.color, "distance", shadow.distance, "falloff", shadow.falloff,
             shadow.falloffGamma);
    out.fact("lightLink", lightLink, "shadowLink", shadowLink);
}

void dumpLight(SceneDump& dump, const LightDesc& light, bool emits) {
    SceneDump::Element& out = dump.element("light", light.name);
    out.fact("kind", name(light.kind));
    out.fact("transform", light.transform);
    out.fact("intensity", light.intensity, "exposure", light.exposure);
    out.fact("color", light.color);
    out.fact("colorTemperature", light.enableColorTemperature, light.colorTemperature);
    out.fact("normalize", light.normalize);
    out.fact("radius", light.radius, "width", light.width, "height", light.height, "length", light.length);
    out.fact("angle", light.angle);
    out.fact("diffuse", light.diffuse, "specular", light.specular);
    out.fact("texture", light.texture);
    out.fact("thin", light.thin, "domeFormat", uint32_t(light.domeFormat));
    dumpLightControls(out, light.shaping, light.shadow, light.lightLink, light.shadowLink);
    out.fact("visible", light.visible);
    if (!light.group.empty()) out.fact("group", light.group);
    out.fact("emits", emits);
}

} // namespace hipr
