/// @file graph.h
/// Graphs of operations that compute inputs of materials, and how they are made.
#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "renderer/api/material_input.h"
#include "shaders/shared/graph.h"

namespace hipr {

/// An operand of a node: an earlier node's value, or a constant.
struct GraphValue {
    static constexpr uint32_t Constant = 0xffffffffu;
    uint32_t node = Constant;
    glm::vec4 constant{0.f};
    GraphValue() = default;
    explicit GraphValue(float number) : constant(number) {}
    explicit GraphValue(const glm::vec4& value) : constant(value) {}
    bool isConstant() const { return node == Constant; }
    bool operator==(const GraphValue& o) const { return node == o.node && constant == o.constant; }
};

/// How many operands an operation (gpu::GRAPH_*) has, 0..3.
uint32_t graphOperandCount(uint32_t op);

/// One operation. A number has the same value in all four components.
struct GraphNode {
    uint32_t op = gpu::GRAPH_MOVE; ///< gpu::GRAPH_*
    uint32_t immediate = 0; ///< as for the operation; of those that read: the index of MaterialGraph::reads
    std::array<GraphValue, 3> operands;
    bool operator==(const GraphNode& o) const {
        return op == o.op && immediate == o.immediate && operands == o.operands;
    }
};

/// Nodes in an order in which operands come first.
struct MaterialGraph {
    std::vector<GraphNode> nodes;
    std::vector<MaterialInput>
        reads; ///< textures and primvars, with what takes their place where they are missing
    bool operator==(const MaterialGraph& o) const { return nodes == o.nodes && reads == o.reads; }
};

/// Makes a graph node by node. What depends on constants alone is computed at once, equal nodes are made
/// once, and what changes nothing (times 1, plus 0) is left out.
class GraphBuilder {
public:
    /// A pure operation.
    GraphValue op(uint32_t op, GraphValue a, GraphValue b = {}, GraphValue c = {}, uint32_t immediate = 0);
    /// A texture or primvar, with GRAPH_READ, GRAPH_TANGENT, GRAPH_BITANGENT, or GRAPH_TEXTURE at `st`.
    GraphValue read(uint32_t op, const MaterialInput& source, GraphValue st = {});
    /// GRAPH_POSITION, GRAPH_NORMAL or GRAPH_TRANSFORM of `a`.
    GraphValue geometry(uint32_t op, uint32_t immediate, GraphValue a = {});

    GraphValue add(GraphValue a, GraphValue b) { return op(gpu::GRAPH_ADD, a, b); }
    GraphValue subtract(GraphValue a, GraphValue b) { return op(gpu::GRAPH_SUBTRACT, a, b); }
    GraphValue multiply(GraphValue a, GraphValue b) { return op(gpu::GRAPH_MULTIPLY, a, b); }
    GraphValue divide(GraphValue a, GraphValue b) { return op(gpu::GRAPH_DIVIDE, a, b); }
    GraphValue mix(GraphValue a, GraphValue b, GraphValue by) { return op(gpu::GRAPH_MIX, a, b, by); }
    /// `a` where `condition` is not 0, else `b`.
    GraphValue select(GraphValue condition, GraphValue a, GraphValue b);
    /// 1 where a > b, else 0.
    GraphValue greater(GraphValue a, GraphValue b) { return op(gpu::GRAPH_GREATER, a, b); }
    /// One component (0..3) as a number.
    GraphValue component(GraphValue a, uint32_t which) { return swizzle(a, which * 0x1111u); }
    /// Digits as for GRAPH_SWIZZLE: the lowest 4 bits make x.
    GraphValue swizzle(GraphValue a, uint32_t digits);

    /// The value as an input whose own value is `fallback`. A texture or primvar alone stays one.
    MaterialInput input(const GraphValue& value, const MaterialInput& fallback) const;

    const MaterialGraph& graph() const { return _graph; }

private:
    GraphValue keep(const GraphNode& node);

    MaterialGraph _graph;
    std::unordered_multimap<size_t, uint32_t> _known; ///< nodes by their hash
};

} // namespace hipr
