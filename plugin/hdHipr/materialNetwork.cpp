#include "plugin/hdHipr/materialNetwork.h"

#include <algorithm>
#include <map>
#include <set>

#include "plugin/hdHipr/assets.h"
#include "plugin/hdHipr/cards.h"
#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/primvars.h"
#include "pxr/base/tf/stringUtils.h"
#include "pxr/imaging/hd/tokens.h"
#include "pxr/usd/sdf/assetPath.h"
#include "renderer/materialx/surfaces.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

using hipr::GraphValue;
using Node = HdMaterialNode;

struct Connection {
    const Node* node = nullptr;
    TfToken output;
};

/// Numbers of an input; a shorter vector's last one fills the rest.
std::optional<glm::vec4> numbers(const char* name, VtValue const& value) {
    const std::optional<hipr::Primvar> found = toPrimvar(TfToken(name), value);
    if (!found) {
        return std::nullopt;
    }
    glm::vec4 result(0.f);
    for (uint32_t c = 0; c < 4; ++c) {
        result[int(c)] = found->values[std::min(c, found->components - 1)];
    }
    return result;
}

/// Text of any kind; of asset paths the resolved one.
std::string textOf(VtValue const& value) {
    if (value.IsHolding<TfToken>()) {
        return value.UncheckedGet<TfToken>().GetString();
    }
    if (value.IsHolding<std::string>()) {
        return value.UncheckedGet<std::string>();
    }
    return value.IsHolding<SdfAssetPath>() ? assetPath(value) : std::string();
}

/// Turns one network into a graph of operations, from the surface upwards.
class Translator {
public:
    Translator(SdfPath const& material, HdMaterialNetwork const& network)
        : _material(material), _network(network) {}

    bool surface(Node const& node, hipr::MaterialDesc& desc);
    /// Sets what the node at the end of a displacement network says; false if it is none that is known.
    bool displacement(Node const& node, hipr::Displacement& displacement);
    /// Says that a surface's displacement is not used, where it has one.
    void complainOfDisplacement(Node const& node) const;

private:
    void complain(std::string const& text) const { warnOnce(_material.GetString(), text); }
    void complainOf(Node const& node, std::string const& text) const {
        complain("<" + node.path.GetString() + "> " + text);
    }
    const Node* find(SdfPath const& path) const;
    Connection upstream(Node const& node, const char* input) const;
    VtValue param(Node const& node, const char* name) const;
    bool given(Node const& node, const char* name) const;
    /// What an input has of its own: a value, or what the surface gives.
    GraphValue own(Node const& node, hipr::MtlxInput const& input);
    GraphValue value(Node const& node, hipr::MtlxInput const& input);
    std::optional<GraphValue> output(Node const& node, TfToken const& name);

    SdfPath const& _material;
    HdMaterialNetwork const& _network;
    hipr::GraphBuilder _build;
    std::map<std::pair<SdfPath, TfToken>, std::optional<GraphValue>> _done;
    std::set<SdfPath> _open; ///< nodes whose inputs are being read
};

const Node* Translator::find(SdfPath const& path) const {
    const auto found = std::find_if(_network.nodes.begin(), _network.nodes.end(),
                                    [&](Node const& node) { return node.path == path; });
    return found == _network.nodes.end() ? nullptr : &*found;
}

/// Hydra names the ends of a relationship by data flow: the "input" node produces, the "output" node
/// consumes.
Connection Translator::upstream(Node const& node, const char* input) const {
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

VtValue Translator::param(Node const& node, const char* name) const {
    const auto found = node.parameters.find(TfToken(name));
    return found == node.parameters.end() ? VtValue() : found->second;
}

bool Translator::given(Node const& node, const char* name) const {
    return !param(node, name).IsEmpty() || upstream(node, name).node;
}

GraphValue Translator::own(Node const& node, hipr::MtlxInput const& input) {
    if (const auto value = numbers(input.name, param(node, input.name))) {
        return GraphValue(*value);
    }
    const bool geometry = input.geometry != hipr::MtlxGeometry::None;
    return geometry ? hipr::mtlxGeometry(_build, input.geometry) : GraphValue(input.value);
}

GraphValue Translator::value(Node const& node, hipr::MtlxInput const& input) {
    const Connection from = upstream(node, input.name);
    if (!from.node) {
        return own(node, input);
    }
    if (const auto value = output(*from.node, from.output)) {
        return *value;
    }
    complain("input '" + std::string(input.name) + "' is driven by <" + from.node->path.GetString() +
             ">, a '" + from.node->identifier.GetString() +
             "' node, which is not supported; the input keeps its own value");
    return own(node, input);
}

/// An output of a pattern node; nothing if the node is not known.
std::optional<GraphValue> Translator::output(Node const& node, TfToken const& name) {
    const auto key = std::make_pair(node.path, name);
    const auto done = _done.find(key);
    if (done != _done.end()) {
        return done->second;
    }
    std::string type;
    const hipr::MtlxNode* row = hipr::findMtlxNode(node.identifier.GetString(), type);
    if (!row) {
        return std::nullopt;
    }
    if (!_open.insert(node.path).second) {
        complain("the network has a cycle through <" + node.path.GetString() + ">; 0 is used");
        return GraphValue(0.f);
    }
    hipr::MtlxCall call{_build, type, name.GetString(), {}, {}, {}, {}};
    call.usd = TfStringStartsWith(node.identifier.GetString(), "Usd");
    call.text = [&](const char* text) { return textOf(param(node, text)); };
    call.complain = [&](std::string const& text) { complainOf(node, text); };
    for (hipr::MtlxInput const& input : row->inputs) {
        call.given.push_back(given(node, input.name));
        call.in.push_back(value(node, input));
    }
    _open.erase(node.path);
    return _done[key] = row->emit(call);
}

bool Translator::surface(Node const& node, hipr::MaterialDesc& desc) {
    const hipr::MtlxSurface surface{_build, [&](hipr::MtlxInput const& input) { return value(node, input); },
                                    [&](const char* name) { return given(node, name); },
                                    [&](const char* name) { return textOf(param(node, name)); },
                                    [&](std::string const& text) { complainOf(node, text); }};
    return hipr::mtlxSurface(node.identifier.GetString(), surface, desc);
}

void Translator::complainOfDisplacement(Node const& node) const {
    const auto height = numbers("displacement", param(node, "displacement"));
    if (upstream(node, "displacement").node || (height && height->x != 0.f)) {
        complain("the displacement of its surface has no effect, for outputs:displacement is not connected");
    }
}

bool Translator::displacement(Node const& node, hipr::Displacement& displacement) {
    std::string const& id = node.identifier.GetString();
    const bool scaled = id == "ND_displacement_float" || id == "ND_displacement_vector3";
    if (!scaled && id != "UsdPreviewSurface" && id != "ND_UsdPreviewSurface_surfaceshader") {
        return false;
    }
    displacement.vector = id == "ND_displacement_vector3";
    GraphValue amount = value(node, hipr::MtlxInput("displacement"));
    if (scaled) {
        amount = _build.multiply(amount, value(node, hipr::MtlxInput("scale", 1.f)));
    }
    displacement.amount.channel = displacement.vector ? hipr::Channel::Rgb : hipr::Channel::R;
    displacement.amount = _build.input(amount, displacement.amount);
    if (displacement.amount.source == hipr::MaterialInput::Source::Graph) {
        displacement.graph = _build.graph();
    }
    return true;
}

/// The node that a network ends in. Hosts put it last; `terminals` also lists those of the other networks.
Node const& terminalOf(HdMaterialNetworkMap const& networks, HdMaterialNetwork const& network) {
    const auto found = std::find_if(network.nodes.rbegin(), network.nodes.rend(), [&](Node const& node) {
        return std::find(networks.terminals.begin(), networks.terminals.end(), node.path) !=
               networks.terminals.end();
    });
    return found == network.nodes.rend() ? network.nodes.back() : *found;
}

void setDisplacement(SdfPath const& materialPath, HdMaterialNetworkMap const& networks,
                     HdMaterialNetwork const& network, hipr::Displacement& displacement) {
    Node const& terminal = terminalOf(networks, network);
    if (!Translator(materialPath, network).displacement(terminal, displacement)) {
        warnOnce(materialPath.GetString(), "its displacement <" + terminal.path.GetString() + "> is a '" +
                                               terminal.identifier.GetString() +
                                               "' node, which is not supported and has no effect");
    }
}

} // namespace

HdMaterialNetworkMap materialNetworks(HdSceneDelegate& delegate, SdfPath const& material) {
    return delegate.GetMaterialResource(material).GetWithDefault<HdMaterialNetworkMap>();
}

std::optional<hipr::MaterialDesc> materialDesc(SdfPath const& materialPath,
                                               HdMaterialNetworkMap const& networks) {
    const auto surface = networks.map.find(HdMaterialTerminalTokens->surface);
    if (surface == networks.map.end() || surface->second.nodes.empty()) {
        return std::nullopt;
    }
    HdMaterialNetwork const& network = surface->second;
    Node const& terminal = terminalOf(networks, network);
    if (isCardShader(terminal)) {
        HdMaterialNetworkMap cards;
        cards.map[HdMaterialTerminalTokens->surface] = cardNetwork(network, terminal);
        cards.terminals = {cards.map[HdMaterialTerminalTokens->surface].nodes.back().path};
        return materialDesc(materialPath, cards);
    }
    Translator translator(materialPath, network);
    hipr::MaterialDesc desc;
    desc.name = materialPath.GetString();
    if (!translator.surface(terminal, desc)) {
        warnOnce(materialPath.GetString(),
                 "its surface <" + terminal.path.GetString() + "> is a '" + terminal.identifier.GetString() +
                     "' node, which is not supported; displayColor is shown instead");
        return std::nullopt;
    }
    const auto displacement = networks.map.find(HdMaterialTerminalTokens->displacement);
    if (displacement == networks.map.end() || displacement->second.nodes.empty()) {
        translator.complainOfDisplacement(terminal);
    } else {
        setDisplacement(materialPath, networks, displacement->second, desc.displacement);
    }
    return desc;
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
