/// @file nodes.h
/// The pattern nodes of MaterialX 1.38 and 1.39 (https://materialx.org/Specification.html) as operations of a
/// MaterialGraph. One table says what there is; translators, documentation and tests read it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/api/graph.h"

namespace hipr {

/// What an input that nothing feeds reads.
enum class MtlxGeometry : uint32_t {
    None,
    Uv,
    PositionObject,
    NormalObject,
    NormalWorld,
    TangentWorld,
    BitangentWorld
};

struct MtlxInput {
    const char* name;
    glm::vec4 value{0.f};                       ///< without one of its own
    MtlxGeometry geometry = MtlxGeometry::None; ///< the same, where the surface gives it
    MtlxInput(const char* name, float number = 0.f) : name(name), value(number) {}
    MtlxInput(const char* name, const glm::vec4& value) : name(name), value(value) {}
    MtlxInput(const char* name, MtlxGeometry geometry) : name(name), geometry(geometry) {}
};

/// One node of a network, with its inputs' values by the table's row.
struct MtlxCall {
    GraphBuilder& build;
    std::string type;   ///< what follows the category in the id: "color3FA", "color3_vector3"
    std::string output; ///< which output is asked for: "out", "outr", ...
    std::vector<GraphValue> in;
    std::vector<bool> given; ///< whether the network has the input
    /// Inputs that are no numbers: names, file paths (resolved), options; empty where absent.
    std::function<std::string(const char*)> text;
    std::function<void(const std::string&)> complain; ///< says what is wrong with the node
    bool usd = false; ///< a node of USD itself, whose defaults differ from those of its ND_ twin

    /// Components of the output, 1..4.
    uint32_t components() const;
    GraphValue op(uint32_t op, size_t a, size_t b) const { return build.op(op, in[a], in[b]); }
};

struct MtlxNode {
    const char* category; ///< "add": the id is ND_add_<type>
    const char* group;    ///< for the documentation
    std::vector<MtlxInput> inputs;
    GraphValue (*emit)(MtlxCall&);
};

/// All nodes, by category.
const std::vector<MtlxNode>& mtlxNodes();

/// The row of a node's id ("ND_add_color3FA", or USD's own "UsdUVTexture"), and what follows the category
/// ("color3FA"); null: unknown.
const MtlxNode* findMtlxNode(const std::string& id, std::string& type);

/// What the surface gives.
GraphValue mtlxGeometry(GraphBuilder& build, MtlxGeometry what);

/// A primvar as the renderer reads it.
GraphValue mtlxPrimvar(GraphBuilder& build, const std::string& name, uint32_t components,
                       const GraphValue& fallback);

/// The parts of the table.
std::vector<MtlxNode> mtlxMathNodes();
std::vector<MtlxNode> mtlxBlendNodes();
std::vector<MtlxNode> mtlxChannelNodes();
std::vector<MtlxNode> mtlxGeometryNodes();
std::vector<MtlxNode> mtlxNoiseNodes();
std::vector<MtlxNode> mtlxRampNodes();
std::vector<MtlxNode> mtlxTextureNodes();

/// Used by several parts: in * inverse range, from [low, high] to [outLow, outHigh].
GraphValue mtlxRemap(GraphBuilder& b, GraphValue in, GraphValue low, GraphValue high, GraphValue outLow,
                     GraphValue outHigh);
GraphValue mtlxClamp(GraphBuilder& b, GraphValue in, GraphValue low, GraphValue high);
/// remap with a power curve between, as the node `range`.
GraphValue mtlxRange(GraphBuilder& b, GraphValue in, GraphValue low, GraphValue high, GraphValue gamma,
                     GraphValue outLow, GraphValue outHigh, GraphValue clamp);

} // namespace hipr
