#include "plugin/hdHipr/materialNetwork.h"

#include <algorithm>
#include <cmath>

#include "plugin/hdHipr/assets.h"
#include "plugin/hdHipr/convert.h"
#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/primvars.h"
#include "pxr/base/tf/stringUtils.h"
#include "pxr/imaging/hd/tokens.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

using hipr::MaterialInput;
using Node = HdMaterialNode;

struct Connection {
    const Node* node = nullptr;
    TfToken output;
};

/// Parses one network. Every node is visited at a bounded depth, so that a cycle ends.
class Parser {
public:
    Parser(SdfPath const& material, HdMaterialNetwork const& network)
        : _material(material), _network(network) {}

    hipr::MaterialDesc previewSurface(Node const& node) const;
    hipr::MaterialDesc openPbr(Node const& node) const;

private:
    void complain(std::string const& text) const { warnOnce(_material.GetString(), text); }
    const Node* find(SdfPath const& path) const;
    Connection upstream(Node const& node, const char* input) const;
    VtValue param(Node const& node, const char* name) const;
    glm::vec4 vec(Node const& node, const char* name, glm::vec4 fallback) const;
    std::string text(Node const& node, const char* name, std::string const& fallback) const;
    void input(Node const& node, const char* name, MaterialInput& out) const;
    void texture(Node const& node, hipr::TextureDesc& out) const;
    void coordinates(Node const& textureNode, hipr::TextureDesc& out) const;
    void primvarReader(Node const& node, MaterialInput& out) const;

    SdfPath const& _material;
    HdMaterialNetwork const& _network;
};

bool isPrimvarReader(Node const& node) {
    return TfStringStartsWith(node.identifier.GetString(), "UsdPrimvarReader_");
}

hipr::Channel channelOf(TfToken const& output) {
    if (output == "r") {
        return hipr::Channel::R;
    }
    if (output == "g") {
        return hipr::Channel::G;
    }
    if (output == "b") {
        return hipr::Channel::B;
    }
    if (output == "a") {
        return hipr::Channel::A;
    }
    return hipr::Channel::Rgb;
}

hipr::WrapMode wrapMode(std::string const& text) {
    if (text == "black") {
        return hipr::WrapMode::Black;
    }
    if (text == "clamp") {
        return hipr::WrapMode::Clamp;
    }
    if (text == "repeat") {
        return hipr::WrapMode::Repeat;
    }
    if (text == "mirror") {
        return hipr::WrapMode::Mirror;
    }
    return hipr::WrapMode::UseMetadata;
}

/// The transform of UsdTransform2d: scale, then rotate counter-clockwise, then translate.
glm::mat3x2 transform2d(glm::vec4 scale, float degrees, glm::vec4 translation) {
    const float radians = glm::radians(degrees), c = std::cos(radians), s = std::sin(radians);
    return glm::mat3x2(scale.x * glm::vec2(c, s), scale.y * glm::vec2(-s, c), glm::vec2(translation));
}

/// First `inner`, then `outer`.
glm::mat3x2 compose(glm::mat3x2 const& outer, glm::mat3x2 const& inner) {
    const auto linear = [&](glm::vec2 v) { return outer[0] * v.x + outer[1] * v.y; };
    return glm::mat3x2(linear(inner[0]), linear(inner[1]), linear(inner[2]) + outer[2]);
}

const Node* Parser::find(SdfPath const& path) const {
    const auto found = std::find_if(_network.nodes.begin(), _network.nodes.end(),
                                    [&](Node const& node) { return node.path == path; });
    return found == _network.nodes.end() ? nullptr : &*found;
}

/// Hydra names the ends of a relationship by data flow: the "input" node produces, the "output" node
/// consumes.
Connection Parser::upstream(Node const& node, const char* input) const {
    for (HdMaterialRelationship const& link : _network.relationships) {
        if (link.outputId != node.path || link.outputName != input) {
            continue;
        }
        if (const Node* source = find(link.inputId)) {
            return {source, link.inputName};
        }
        complain("input '" + std::string(input) + "' of <" + node.path.GetString() +
                 "> is connected to the missing node <" + link.inputId.GetString() + ">");
    }
    return {};
}

VtValue Parser::param(Node const& node, const char* name) const {
    const auto found = node.parameters.find(TfToken(name));
    return found == node.parameters.end() ? VtValue() : found->second;
}

glm::vec4 Parser::vec(Node const& node, const char* name, glm::vec4 fallback) const {
    const std::optional<hipr::Primvar> value = toPrimvar(TfToken(name), param(node, name));
    if (!value) {
        return fallback;
    }
    if (value->components == 1) {
        return glm::vec4(value->values[0]);
    }
    for (uint32_t c = 0; c < value->components; ++c) {
        fallback[int(c)] = value->values[c];
    }
    return fallback;
}

std::string Parser::text(Node const& node, const char* name, std::string const& fallback) const {
    const VtValue value = param(node, name);
    if (value.IsHolding<TfToken>()) {
        return value.UncheckedGet<TfToken>().GetString();
    }
    if (value.IsHolding<std::string>()) {
        return value.UncheckedGet<std::string>();
    }
    return fallback;
}

void Parser::primvarReader(Node const& node, MaterialInput& out) const {
    out.primvar = text(node, "varname", "");
    out.constant = vec(node, "fallback", glm::vec4(0.f));
    if (out.primvar.empty()) {
        complain("<" + node.path.GetString() + "> names no primvar (varname); its fallback is used");
        return;
    }
    out.source = MaterialInput::Source::Primvar;
}

void Parser::coordinates(Node const& textureNode, hipr::TextureDesc& out) const {
    const Node* at = &textureNode;
    const char* inputName = "st";
    glm::mat3x2 transform(1.f, 0.f, 0.f, 1.f, 0.f, 0.f);
    out.uvPrimvar.clear();
    for (size_t depth = 0; depth <= _network.nodes.size(); ++depth) {
        const Connection from = upstream(*at, inputName);
        if (!from.node) { // an authored constant, or the specification's default
            out.uvFallback = glm::vec2(vec(*at, inputName, glm::vec4(0.f)));
            out.uvTransform = transform;
            return;
        }
        if (isPrimvarReader(*from.node)) {
            MaterialInput reader;
            primvarReader(*from.node, reader);
            out.uvPrimvar = reader.primvar;
            out.uvFallback = glm::vec2(reader.constant);
            out.uvTransform = transform;
            return;
        }
        if (from.node->identifier != "UsdTransform2d") {
            complain("<" + from.node->path.GetString() + ">, a '" + from.node->identifier.GetString() +
                     "' node, cannot drive texture coordinates; (0, 0) is used");
            return;
        }
        const Node& node = *from.node;
        transform = compose(transform, transform2d(vec(node, "scale", glm::vec4(1.f)),
                                                   vec(node, "rotation", glm::vec4(0.f)).x,
                                                   vec(node, "translation", glm::vec4(0.f))));
        at = from.node;
        inputName = "in";
    }
    complain("the network has a cycle through <" + at->path.GetString() +
             ">; texture coordinates (0, 0) are used");
}

void Parser::texture(Node const& node, hipr::TextureDesc& out) const {
    out.path = assetPath(param(node, "file"));
    out.colorSpace = text(node, "sourceColorSpace", "auto");
    out.wrapS = wrapMode(text(node, "wrapS", "useMetadata"));
    out.wrapT = wrapMode(text(node, "wrapT", "useMetadata"));
    out.scale = vec(node, "scale", glm::vec4(1.f));
    out.bias = vec(node, "bias", glm::vec4(0.f));
    out.fallback = vec(node, "fallback", glm::vec4(0.f, 0.f, 0.f, 1.f));
    coordinates(node, out);
}

void Parser::input(Node const& node, const char* name, MaterialInput& out) const {
    out.constant = vec(node, name, out.constant);
    const Connection from = upstream(node, name);
    if (!from.node) {
        return;
    }
    if (from.node->identifier == "UsdUVTexture") {
        const bool scalar = out.channel != hipr::Channel::Rgb;
        texture(*from.node, out.texture);
        out.channel = channelOf(from.output);
        if (scalar && out.channel == hipr::Channel::Rgb) {
            out.channel = hipr::Channel::R;
        }
        if (out.texture.path.empty()) {
            complain("<" + from.node->path.GetString() + "> names no file; its fallback is used");
        }
        out.source = MaterialInput::Source::Texture;
    } else if (isPrimvarReader(*from.node)) {
        primvarReader(*from.node, out);
    } else {
        complain("input '" + std::string(name) + "' is driven by <" + from.node->path.GetString() + ">, a '" +
                 from.node->identifier.GetString() +
                 "' node, which is not supported; the input keeps its own value");
    }
}

hipr::MaterialDesc Parser::previewSurface(Node const& node) const {
    hipr::MaterialDesc desc;
    desc.name = _material.GetString();
    desc.useSpecularWorkflow = vec(node, "useSpecularWorkflow", glm::vec4(0.f)).x != 0.f;
    desc.opacityMode = text(node, "opacityMode", "transparent") == "presence"
                           ? hipr::OpacityMode::Presence
                           : hipr::OpacityMode::Transparent;
    const std::pair<const char*, MaterialInput*> scalars[] = {
        {"metallic", &desc.metallic},
        {"roughness", &desc.roughness},
        {"clearcoat", &desc.clearcoat},
        {"clearcoatRoughness", &desc.clearcoatRoughness},
        {"opacity", &desc.opacity},
        {"opacityThreshold", &desc.opacityThreshold},
        {"ior", &desc.ior},
        {"occlusion", &desc.occlusion},
    };
    const std::pair<const char*, MaterialInput*> colors[] = {
        {"diffuseColor", &desc.diffuseColor},
        {"emissiveColor", &desc.emissiveColor},
        {"specularColor", &desc.specularColor},
        {"normal", &desc.normal},
    };
    for (auto const& [name, value] : scalars) {
        value->channel = hipr::Channel::R;
        input(node, name, *value);
    }
    for (auto const& [name, value] : colors) {
        input(node, name, *value);
    }
    const bool displaced =
        upstream(node, "displacement").node || vec(node, "displacement", glm::vec4(0.f)).x != 0.f;
    if (displaced) {
        complain("displacement is not supported and has no effect");
    }
    return desc;
}

hipr::MaterialDesc Parser::openPbr(Node const& node) const {
    hipr::MaterialDesc desc;
    desc.name = _material.GetString();
    desc.model = hipr::MaterialModel::OpenPbr;
    for (size_t i = 0; i < hipr::openPbrInputs().size(); ++i) {
        const char* name = hipr::openPbrInputs()[i].name;
        if (param(node, name).IsEmpty() && !upstream(node, name).node) {
            continue;
        }
        const auto which = hipr::OpenPbrInput(i);
        MaterialInput value = hipr::openPbrDefault(which);
        input(node, name, value);
        desc.openPbr[which] = value;
    }
    return desc;
}

/// The names that OpenPBR Surface has as a node.
bool isOpenPbr(TfToken const& identifier) {
    return identifier == "ND_open_pbr_surface_surfaceshader" || identifier == "open_pbr_surface" ||
           identifier == "OpenPBR" || identifier == "OpenPBRSurface";
}

} // namespace

std::optional<hipr::MaterialDesc> materialDesc(SdfPath const& materialPath,
                                               HdMaterialNetworkMap const& networks) {
    if (networks.map.count(HdMaterialTerminalTokens->volume)) {
        warnOnce(materialPath.GetString(), "volume terminals are not supported and have no effect");
    }
    const auto surface = networks.map.find(HdMaterialTerminalTokens->surface);
    if (surface == networks.map.end() || surface->second.nodes.empty()) {
        return std::nullopt;
    }
    HdMaterialNetwork const& network = surface->second;
    const auto isTerminal = [&](Node const& node) {
        return std::find(networks.terminals.begin(), networks.terminals.end(), node.path) !=
               networks.terminals.end();
    };
    // Hosts put the terminal last; `terminals` also lists those of the other networks.
    const auto found = std::find_if(network.nodes.rbegin(), network.nodes.rend(), isTerminal);
    Node const& terminal = found == network.nodes.rend() ? network.nodes.back() : *found;
    if (TfStringEndsWith(terminal.identifier.GetString(), "<glslfx>")) {
        // UsdImaging's stand-in for models drawn as cards. Without textures it shows displayColor, as meshes
        // do.
        if (network.nodes.size() > 1) {
            warnOnce(materialPath.GetString(),
                     "textures of card draw modes are not supported; displayColor is shown");
        }
        return std::nullopt;
    }
    const Parser parser(materialPath, network);
    if (isOpenPbr(terminal.identifier)) {
        return parser.openPbr(terminal);
    }
    if (terminal.identifier != "UsdPreviewSurface") {
        warnOnce(materialPath.GetString(),
                 "its surface <" + terminal.path.GetString() + "> is a '" + terminal.identifier.GetString() +
                     "' node, which is not supported; displayColor is shown instead");
        return std::nullopt;
    }
    return parser.previewSurface(terminal);
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
