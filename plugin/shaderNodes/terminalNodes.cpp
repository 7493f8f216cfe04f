// Surfaces, displacements and volumes of MaterialX as nodes of the shader registry: UsdImaging passes a
// network on only if the registry knows the node it ends in. OpenUSD knows them itself where it was built
// with MaterialX, but not OpenPBR Surface where that MaterialX is an old one.
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/plug/registry.h"
#include "pxr/base/vt/value.h"
#include "pxr/pxr.h"
#include "pxr/usd/ndr/discoveryPlugin.h"
#include "pxr/usd/ndr/parserPlugin.h"
#include "pxr/usd/sdr/shaderNode.h"
#include "pxr/usd/sdr/shaderProperty.h"
#include "renderer/api/openpbr.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace {

const char* const nodeType = "hipr"; // of discovery and of source

struct Terminal {
    const char* id;
    const char* family;
    const char* context;
};

const Terminal openPbr = {"ND_open_pbr_surface_surfaceshader", "open_pbr_surface", "surface"};
const Terminal others[] = {
    {"ND_standard_surface_surfaceshader", "standard_surface", "surface"},
    {"ND_standard_surface_surfaceshader_100", "standard_surface", "surface"},
    {"ND_gltf_pbr_surfaceshader", "gltf_pbr", "surface"},
    {"ND_UsdPreviewSurface_surfaceshader", "UsdPreviewSurface", "surface"},
    {"ND_disney_principled", "disney_principled", "surface"},
    {"ND_surface_unlit", "surface_unlit", "surface"},
    {"ND_surface", "surface", "surface"},
    {"ND_mix_surfaceshader", "mix", "surface"},
    {"ND_displacement_float", "displacement", "displacement"},
    {"ND_displacement_vector3", "displacement", "displacement"},
    {"ND_volume", "volume", "volume"},
};

NdrNodeDiscoveryResult found(Terminal const& node) {
    return NdrNodeDiscoveryResult(TfToken(node.id), NdrVersion(1, 1).GetAsDefault(), node.family,
                                  TfToken(node.family), TfToken(nodeType), TfToken(nodeType), "", "");
}

TfToken contextOf(TfToken const& id) {
    for (Terminal const& node : others) {
        if (id == node.id) {
            return TfToken(node.context);
        }
    }
    return TfToken("surface");
}

NdrPropertyUniquePtr input(hipr::OpenPbrInputInfo const& info) {
    const bool color = info.components == 3;
    const VtValue value =
        color ? VtValue(GfVec3f(info.value.x, info.value.y, info.value.z)) : VtValue(info.value.x);
    return std::make_unique<SdrShaderProperty>(TfToken(info.name),
                                               color ? SdrPropertyTypes->Color : SdrPropertyTypes->Float,
                                               value, false, 0, NdrTokenMap(), NdrTokenMap(), NdrOptionVec());
}

} // namespace

class HiprNodeDiscovery final : public NdrDiscoveryPlugin {
public:
    NdrNodeDiscoveryResultVec DiscoverNodes(Context const&) override {
        NdrNodeDiscoveryResultVec nodes = {found(openPbr)};
        if (!PlugRegistry::GetInstance().GetPluginWithName("usdMtlx")) {
            for (Terminal const& node : others) {
                nodes.push_back(found(node));
            }
        }
        return nodes;
    }
    NdrStringVec const& GetSearchURIs() const override {
        static const NdrStringVec none;
        return none;
    }
};

/// Inputs are told of OpenPBR Surface; networks pass without.
class HiprNodeParser final : public NdrParserPlugin {
public:
    NdrNodeUniquePtr Parse(NdrNodeDiscoveryResult const& found) override {
        NdrPropertyUniquePtrVec properties;
        if (found.identifier == openPbr.id) {
            for (hipr::OpenPbrInputInfo const& info : hipr::openPbrInputs()) {
                properties.push_back(input(info));
            }
        }
        properties.push_back(std::make_unique<SdrShaderProperty>(TfToken("out"), SdrPropertyTypes->Terminal,
                                                                 VtValue(), true, 0, NdrTokenMap(),
                                                                 NdrTokenMap(), NdrOptionVec()));
        return std::make_unique<SdrShaderNode>(found.identifier, found.version, found.name, found.family,
                                               contextOf(found.identifier), found.sourceType,
                                               found.resolvedUri, found.resolvedUri, std::move(properties));
    }
    NdrTokenVec const& GetDiscoveryTypes() const override {
        static const NdrTokenVec types = {TfToken(nodeType)};
        return types;
    }
    TfToken const& GetSourceType() const override {
        static const TfToken type(nodeType);
        return type;
    }
};

NDR_REGISTER_DISCOVERY_PLUGIN(HiprNodeDiscovery)
NDR_REGISTER_PARSER_PLUGIN(HiprNodeParser)

PXR_NAMESPACE_CLOSE_SCOPE
