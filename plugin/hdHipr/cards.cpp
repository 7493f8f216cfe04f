#include "plugin/hdHipr/cards.h"

#include <algorithm>

#include "pxr/base/gf/vec3f.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/base/tf/stringUtils.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

/// The sides' pictures by the names of the shader's inputs, and their numbers in `cardsTexAssign`.
struct Side {
    const char* input;
    int number;
};
constexpr Side sides[] = {{"textureXPos", 1}, {"textureYPos", 2},  {"textureZPos", 4},
                          {"textureXNeg", 8}, {"textureYNeg", 16}, {"textureZNeg", 32}};

void connect(HdMaterialNetwork& network, SdfPath const& from, const char* output, SdfPath const& to,
             const char* input) {
    HdMaterialRelationship link;
    link.inputId = from;
    link.inputName = TfToken(output);
    link.outputId = to;
    link.outputName = TfToken(input);
    network.relationships.push_back(link);
}

SdfPath addNode(HdMaterialNetwork& network, SdfPath const& surface, std::string const& name,
                const char* identifier, std::map<TfToken, VtValue> parameters) {
    HdMaterialNode node;
    node.path = surface.AppendProperty(TfToken(name));
    node.identifier = TfToken(identifier);
    node.parameters = std::move(parameters);
    network.nodes.push_back(node);
    return node.path;
}

/// Pictures name the primvar of their coordinates themselves; a reader takes that over. They end at their
/// edges.
void connectCoordinates(HdMaterialNetwork& network, SdfPath const& surface) {
    const TfToken st("st");
    for (size_t i = 0, count = network.nodes.size(); i < count; ++i) {
        const auto named = network.nodes[i].parameters.find(st);
        if (named == network.nodes[i].parameters.end() || !named->second.IsHolding<TfToken>()) {
            continue;
        }
        const SdfPath picture = network.nodes[i].path;
        const VtValue primvar = named->second;
        network.nodes[i].parameters.erase(named);
        for (const char* wrap : {"wrapS", "wrapT"}) {
            network.nodes[i].parameters.emplace(TfToken(wrap), VtValue(TfToken("clamp")));
        }
        const SdfPath reader = addNode(network, surface, "st" + std::to_string(i), "UsdPrimvarReader_float2",
                                       {{TfToken("varname"), primvar}});
        connect(network, reader, "result", picture, "st");
    }
}

/// Color ("rgb") or opacity ("a") of a side without a picture.
VtValue ownValue(HdMaterialNode const& surface, Side const& side, std::string const& output) {
    const auto own = surface.parameters.find(TfToken(side.input));
    const GfVec4f value = own == surface.parameters.end() ? GfVec4f(0.18f, 0.18f, 0.18f, 1.f)
                                                          : own->second.GetWithDefault(GfVec4f(0.18f));
    return output == "a" ? VtValue(value[3]) : VtValue(GfVec3f(value[0], value[1], value[2]));
}

/// What one output of the pictures is on the card at hand: a chain of choices, one for each side, that ends
/// in `chosen`.
SdfPath chooseSide(HdMaterialNetwork& network, HdMaterialNode const& surface, SdfPath const& assigned,
                   SdfPath chosen, const char* output, const char* identifier) {
    for (Side const& side : sides) {
        const SdfPath node = addNode(
            network, surface.path, std::string(side.input) + "_" + output, identifier,
            {{TfToken("value2"), VtValue(side.number)}, {TfToken("in1"), ownValue(surface, side, output)}});
        connect(network, assigned, "result", node, "value1");
        const auto picture =
            std::find_if(network.relationships.begin(), network.relationships.end(), [&](auto const& link) {
                return link.outputId == surface.path && link.outputName == side.input;
            });
        if (picture != network.relationships.end()) {
            connect(network, SdfPath(picture->inputId), output, node, "in1");
        }
        connect(network, chosen, "out", node, "in2");
        chosen = node;
    }
    return chosen;
}

} // namespace

bool isCardShader(HdMaterialNode const& surface) {
    return TfStringEndsWith(surface.identifier.GetString(), "<glslfx>");
}

HdMaterialNetwork cardNetwork(HdMaterialNetwork const& network, HdMaterialNode const& surface) {
    HdMaterialNetwork result = network;
    connectCoordinates(result, surface.path);
    const SdfPath assigned = addNode(result, surface.path, "assigned", "UsdPrimvarReader_int",
                                     {{TfToken("varname"), VtValue(TfToken("cardsTexAssign"))}});
    // What is on no side, such as the lines of bounds, has the colour of the model.
    const SdfPath model = addNode(result, surface.path, "model", "ND_geompropvalue_color3",
                                  {{TfToken("geomprop"), VtValue(TfToken("displayColor"))}});
    const SdfPath opaque =
        addNode(result, surface.path, "opaque", "ND_constant_float", {{TfToken("value"), VtValue(1.f)}});
    const SdfPath color = chooseSide(result, surface, assigned, model, "rgb", "ND_ifequal_color3I");
    const SdfPath opacity = chooseSide(result, surface, assigned, opaque, "a", "ND_ifequal_floatI");
    const SdfPath preview =
        addNode(result, surface.path, "surface", "UsdPreviewSurface", {{TfToken("roughness"), VtValue(1.f)}});
    connect(result, color, "out", preview, "diffuseColor");
    connect(result, opacity, "out", preview, "opacity");
    return result;
}

bool isCards(hipr::MeshDesc const& mesh) {
    return std::any_of(mesh.primvars.begin(), mesh.primvars.end(),
                       [](hipr::Primvar const& primvar) { return primvar.name == "cardsUv"; });
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
