// OpenPBR Surface as a node of the shader registry, made from the renderer's table of inputs. Without it
// UsdImaging leaves out such nodes, unless OpenUSD was built with MaterialX.
#include <algorithm>

#include "pxr/base/gf/vec3f.h"
#include "pxr/base/vt/value.h"
#include "pxr/pxr.h"
#include "pxr/usd/ndr/discoveryPlugin.h"
#include "pxr/usd/ndr/parserPlugin.h"
#include "pxr/usd/sdr/shaderNode.h"
#include "pxr/usd/sdr/shaderProperty.h"
#include "renderer/api/openpbr.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace {

const char* const nodeName = "ND_open_pbr_surface_surfaceshader";
const char* const nodeType = "hipr"; // of discovery and of source

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
        return {NdrNodeDiscoveryResult(TfToken(nodeName), NdrVersion(1, 1).GetAsDefault(), "open_pbr_surface",
                                       TfToken("open_pbr_surface"), TfToken(nodeType), TfToken(nodeType), "",
                                       "")};
    }
    NdrStringVec const& GetSearchURIs() const override {
        static const NdrStringVec none;
        return none;
    }
};

class HiprNodeParser final : public NdrParserPlugin {
public:
    NdrNodeUniquePtr Parse(NdrNodeDiscoveryResult const& found) override {
        NdrPropertyUniquePtrVec properties;
        for (hipr::OpenPbrInputInfo const& info : hipr::openPbrInputs()) {
            properties.push_back(input(info));
        }
        properties.push_back(std::make_unique<SdrShaderProperty>(TfToken("out"), SdrPropertyTypes->Terminal,
                                                                 VtValue(), true, 0, NdrTokenMap(),
                                                                 NdrTokenMap(), NdrOptionVec()));
        return std::make_unique<SdrShaderNode>(found.identifier, found.version, found.name, found.family,
                                               TfToken("surface"), found.sourceType, found.resolvedUri,
                                               found.resolvedUri, std::move(properties));
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
