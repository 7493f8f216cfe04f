#include "plugin/hdHipr/meshLight.h"

#include <cmath>

#include "plugin/hdHipr/convert.h"
#include "plugin/hdHipr/lightParams.h"
#include "plugin/hdHipr/messages.h"
#include "renderer/shading/blackbody.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

using hipr::MaterialDesc;
using hipr::MaterialInput;

namespace {

MaterialInput constant(glm::vec3 const& value) {
    MaterialInput input;
    input.constant = glm::vec4(value, 1.f);
    return input;
}

/// A node of `graph` with the value of an input.
hipr::GraphValue nodeOf(MaterialInput const& input, hipr::MaterialGraph& graph) {
    hipr::GraphValue value;
    value.node = input.node;
    if (input.source != MaterialInput::Source::Graph) {
        graph.reads.push_back(input);
        hipr::GraphNode read;
        read.op = hipr::gpu::GRAPH_READ;
        read.immediate = uint32_t(graph.reads.size() - 1);
        graph.nodes.push_back(read);
        value.node = uint32_t(graph.nodes.size() - 1);
    }
    return value;
}

/// Multiplies whatever feeds an input.
void scale(MaterialInput& input, glm::vec3 const& by, hipr::MaterialGraph& graph) {
    const glm::vec4 factor(by, 1.f);
    if (input.source == MaterialInput::Source::Constant) {
        input.constant *= factor;
    } else if (input.source == MaterialInput::Source::Texture) {
        input.texture.scale *= factor;
        input.texture.bias *= factor;
        input.texture.fallback *= factor;
    } else {
        hipr::GraphNode product;
        product.op = hipr::gpu::GRAPH_MULTIPLY;
        product.operands[0] = nodeOf(input, graph);
        product.operands[1] = hipr::GraphValue(factor);
        graph.nodes.push_back(product);
        input.source = MaterialInput::Source::Graph;
        input.node = uint32_t(graph.nodes.size() - 1);
        input.constant *= factor;
    }
}

void tintEmission(MaterialDesc& desc, glm::vec3 const& by) {
    if (desc.model == hipr::MaterialModel::OpenPbr) {
        MaterialInput color = openPbrInput(desc, hipr::OpenPbrInput::EmissionColor);
        scale(color, by, desc.graph);
        desc.openPbr[hipr::OpenPbrInput::EmissionColor] = color;
    } else {
        scale(desc.emissiveColor, by, desc.graph);
    }
}

void setEmission(MaterialDesc& desc, glm::vec3 const& radiance) {
    if (desc.model == hipr::MaterialModel::OpenPbr) {
        desc.openPbr[hipr::OpenPbrInput::EmissionLuminance] = constant(glm::vec3(1.f));
        desc.openPbr[hipr::OpenPbrInput::EmissionColor] = constant(radiance);
    } else {
        desc.emissiveColor = constant(radiance);
    }
}

/// Neither reflects nor lets anything through.
MaterialDesc blackMaterial() {
    MaterialDesc black;
    black.diffuseColor = constant(glm::vec3(0.f));
    black.useSpecularWorkflow = true;
    black.specularColor = constant(glm::vec3(0.f));
    return black;
}

/// What a mesh without a material shows.
MaterialDesc ownColours() {
    MaterialDesc desc;
    desc.diffuseColor.source = MaterialInput::Source::Primvar;
    desc.diffuseColor.primvar = "displayColor";
    return desc;
}

std::shared_ptr<const hipr::SurfaceLight> controlsOf(LightParams const& params) {
    hipr::SurfaceLight controls;
    controls.diffuse = params.get("diffuse", 1.f);
    controls.specular = params.get("specular", 1.f);
    controls.shaping = readShaping(params);
    controls.shadow = readShadow(params);
    controls.lightLink = readLink(params, "lightLink");
    controls.shadowLink = readLink(params, "shadowLink");
    return std::make_shared<const hipr::SurfaceLight>(std::move(controls));
}

} // namespace

std::optional<MeshLight> meshLight(HdSceneDelegate* delegate, SdfPath const& id) {
    const LightParams params{delegate, id};
    if (!isLightToo(delegate, id)) {
        return std::nullopt;
    }
    MeshLight light;
    const TfToken mode = params.get("materialSyncMode", TfToken("materialGlowTintsLight"));
    if (mode == "independent") {
        light.sync = MeshLight::Sync::Independent;
    } else if (mode == "noMaterialResponse") {
        light.sync = MeshLight::Sync::NoResponse;
    } else if (mode != "materialGlowTintsLight") {
        warnOnce(id.GetString(),
                 "materialSyncMode '" + mode.GetString() + "' is unknown; taken as materialGlowTintsLight");
    }
    light.normalize = params.get("normalize", false);
    light.radiance = toGlm(params.get("color", GfVec3f(1.f))) * params.get("intensity", 1.f) *
                     std::exp2(params.get("exposure", 0.f));
    if (params.get("enableColorTemperature", false)) {
        light.radiance *= hipr::blackbodyColor(params.get("colorTemperature", 6500.f));
    }
    light.radiance = glm::max(light.radiance, glm::vec3(0.f));
    light.group = readLightGroup(params);
    light.controls = controlsOf(params);
    return light;
}

MaterialDesc shiningMaterial(std::optional<MaterialDesc> const& base, MeshLight const& light) {
    MaterialDesc desc =
        light.sync == MeshLight::Sync::NoResponse ? blackMaterial() : base.value_or(ownColours());
    if (base && light.sync == MeshLight::Sync::GlowTintsLight) {
        tintEmission(desc, light.radiance);
    } else {
        setEmission(desc, light.radiance);
    }
    return desc;
}

double worldArea(hipr::TriangleMesh const& mesh, GfMatrix4d const& transform) {
    const glm::mat4x3 place = toGlmAffine(transform);
    double area = 0;
    for (glm::uvec3 const& triangle : mesh.triangles) {
        const glm::dvec3 a = place * glm::vec4(mesh.positions[triangle[0]], 1.f),
                         b = place * glm::vec4(mesh.positions[triangle[1]], 1.f),
                         c = place * glm::vec4(mesh.positions[triangle[2]], 1.f);
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return area;
}

void ShiningMaterials::set(hipr::MaterialId id, SdfPath const& base, std::optional<MaterialDesc> const& desc,
                           MeshLight const& light, hipr::SceneEdit& edit) {
    std::lock_guard<std::mutex> lock(_mutex);
    _entries[id] = {base, light};
    edit.setMaterial(id, shiningMaterial(desc, light));
}

void ShiningMaterials::remove(hipr::MaterialId id, hipr::SceneEdit& edit) {
    std::lock_guard<std::mutex> lock(_mutex);
    _entries.erase(id);
    edit.removeMaterial(id);
}

void ShiningMaterials::baseChanged(SdfPath const& base, std::optional<MaterialDesc> const& desc,
                                   hipr::SceneEdit& edit) {
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto const& [id, entry] : _entries) {
        if (entry.base == base) {
            edit.setMaterial(id, shiningMaterial(desc, entry.light));
        }
    }
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
