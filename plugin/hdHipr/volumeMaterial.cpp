#include "plugin/hdHipr/volumeMaterial.h"

#include <algorithm>

#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/primvars.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

/// A MaterialX node's name, by the name of its definition or as it is.
bool isNode(HdMaterialNode const& node, const char* name) {
    return node.identifier == name || node.identifier == "ND_" + std::string(name);
}

class Reader {
public:
    Reader(SdfPath const& material, HdMaterialNetwork const& network)
        : _material(material), _network(network) {}

    std::optional<hipr::VolumeLook> read(HdMaterialNode const& terminal) const {
        hipr::VolumeLook look;
        look.absorption = look.scattering = look.emission = glm::vec3(0.f);
        look.emissionByDensity = true;
        if (!isNode(terminal, "volume")) {
            return scatter(terminal, look) ? std::optional(look) : std::nullopt;
        }
        if (HdMaterialNode const* node = upstream(terminal, "vdf")) {
            scatter(*node, look);
        }
        if (HdMaterialNode const* node = upstream(terminal, "edf")) {
            emit(*node, look);
        }
        return look;
    }

private:
    void refuse(HdMaterialNode const& node) const {
        warnOnce(_material.GetString(), "<" + node.path.GetString() + ">, a '" + node.identifier.GetString() +
                                            "' node, is not supported in volumes and has no effect");
    }

    HdMaterialNode const* upstream(HdMaterialNode const& node, const char* input) const {
        for (HdMaterialRelationship const& link : _network.relationships) {
            if (link.outputId != node.path || link.outputName != input) {
                continue;
            }
            const auto found =
                std::find_if(_network.nodes.begin(), _network.nodes.end(),
                             [&](HdMaterialNode const& other) { return other.path == link.inputId; });
            return found == _network.nodes.end() ? nullptr : &*found;
        }
        return nullptr;
    }

    glm::vec3 value(HdMaterialNode const& node, const char* input, float fallback) const {
        if (HdMaterialNode const* driver = upstream(node, input)) {
            refuse(*driver);
        }
        const auto found = node.parameters.find(TfToken(input));
        if (found == node.parameters.end()) {
            return glm::vec3(fallback);
        }
        const std::optional<glm::vec3> authored = toColor(found->first, found->second);
        if (!authored) {
            warnOnce(_material.GetString(), "'" + std::string(input) + "' of <" + node.path.GetString() +
                                                "> is no finite number and has no effect");
        }
        return authored.value_or(glm::vec3(fallback));
    }

    bool scatter(HdMaterialNode const& node, hipr::VolumeLook& look) const {
        const bool scatters = isNode(node, "anisotropic_vdf");
        if (!scatters && !isNode(node, "absorption_vdf")) {
            refuse(node);
            return false;
        }
        look.absorption = value(node, "absorption", 0.f);
        if (scatters) {
            look.scattering = value(node, "scattering", 0.f);
            look.anisotropy = value(node, "anisotropy", 0.f).x;
        }
        return true;
    }

    void emit(HdMaterialNode const& node, hipr::VolumeLook& look) const {
        if (isNode(node, "uniform_edf")) {
            look.emission = value(node, "color", 1.f);
        } else {
            refuse(node);
        }
    }

    SdfPath const& _material;
    HdMaterialNetwork const& _network;
};

} // namespace

std::optional<hipr::VolumeLook> volumeLook(SdfPath const& material, HdMaterialNetworkMap const& networks) {
    const auto found = networks.map.find(HdMaterialTerminalTokens->volume);
    if (found == networks.map.end() || found->second.nodes.empty()) {
        return std::nullopt;
    }
    // Hosts put the terminal last.
    return Reader(material, found->second).read(found->second.nodes.back());
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
