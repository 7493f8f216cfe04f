#include "renderer/api/graph.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "shaders/shared/graph_value.h"

namespace hipr {

namespace {

using namespace gpu;

bool is(const GraphValue& value, float number) {
    return value.isConstant() && value.constant == glm::vec4(number);
}

/// The operand that an operation returns unchanged, if it does.
std::optional<GraphValue> unchanged(uint32_t op, const GraphValue& a, const GraphValue& b,
                                    const GraphValue& c) {
    switch (op) {
    case GRAPH_ADD:
        if (is(a, 0.f)) return b;
        return is(b, 0.f) ? std::optional(a) : std::nullopt;
    case GRAPH_SUBTRACT:
        return is(b, 0.f) ? std::optional(a) : std::nullopt;
    case GRAPH_MULTIPLY:
        if (is(a, 1.f)) return b;
        return is(b, 1.f) ? std::optional(a) : std::nullopt;
    case GRAPH_DIVIDE:
    case GRAPH_POWER:
        return is(b, 1.f) ? std::optional(a) : std::nullopt;
    case GRAPH_MIX:
        if (is(c, 0.f)) return a;
        return is(c, 1.f) || a == b ? std::optional(b) : std::nullopt;
    case GRAPH_SELECT:
        if (is(c, 0.f)) return b;
        return is(c, 1.f) || a == b ? std::optional(a) : std::nullopt;
    default:
        return std::nullopt;
    }
}

/// Equal nodes have equal ones.
size_t hashOf(const GraphNode& node) {
    size_t hash = std::hash<uint32_t>()(node.op);
    const auto add = [&](size_t part) { hash = hash * 31 + part; };
    add(node.immediate);
    for (const GraphValue& operand : node.operands) {
        add(operand.node);
        for (int i = 0; i < 4; ++i)
            add(std::hash<float>()(operand.constant[i]));
    }
    return hash;
}

} // namespace

uint32_t graphOperandCount(uint32_t op) {
    if (op < GRAPH_FIRST_WITH_OPERANDS) return 0;
    switch (op) {
    case GRAPH_MIX:
    case GRAPH_SMOOTHSTEP:
    case GRAPH_SELECT:
    case GRAPH_COMBINE:
    case GRAPH_ROTATE:
        return 3;
    case GRAPH_TEXTURE:
    case GRAPH_TRANSFORM:
    case GRAPH_MOVE:
    case GRAPH_ABS:
    case GRAPH_FLOOR:
    case GRAPH_SIGN:
    case GRAPH_SIN:
    case GRAPH_COS:
    case GRAPH_ASIN:
    case GRAPH_SQRT:
    case GRAPH_LN:
    case GRAPH_EXP:
    case GRAPH_SWIZZLE:
    case GRAPH_RGB_TO_HSV:
    case GRAPH_HSV_TO_RGB:
    case GRAPH_CELL:
    case GRAPH_CELL3:
        return 1;
    default:
        return 2;
    }
}

GraphValue GraphBuilder::keep(const GraphNode& node) {
    const size_t hash = hashOf(node);
    const auto [first, end] = _known.equal_range(hash);
    const auto known =
        std::find_if(first, end, [&](const auto& k) { return _graph.nodes[k.second] == node; });
    GraphValue value;
    value.node = known == end ? uint32_t(_graph.nodes.size()) : known->second;
    if (known == end) {
        _known.emplace(hash, value.node);
        _graph.nodes.push_back(node);
    }
    return value;
}

GraphValue GraphBuilder::op(uint32_t op, GraphValue a, GraphValue b, GraphValue c, uint32_t immediate) {
    if (a.isConstant() && b.isConstant() && c.isConstant())
        return GraphValue(graphValue(op, immediate, a.constant, b.constant, c.constant));
    if (const auto same = unchanged(op, a, b, c)) return *same;
    return keep({op, immediate, {a, b, c}});
}

GraphValue GraphBuilder::read(uint32_t op, const MaterialInput& source, GraphValue st) {
    const auto known = std::find(_graph.reads.begin(), _graph.reads.end(), source);
    const uint32_t index = uint32_t(known - _graph.reads.begin());
    if (known == _graph.reads.end()) _graph.reads.push_back(source);
    return keep({op, index, {st, {}, {}}});
}

GraphValue GraphBuilder::geometry(uint32_t op, uint32_t immediate, GraphValue a) {
    return keep({op, immediate, {a, {}, {}}});
}

GraphValue GraphBuilder::select(GraphValue condition, GraphValue a, GraphValue b) {
    return op(GRAPH_SELECT, a, b, condition);
}

GraphValue GraphBuilder::swizzle(GraphValue a, uint32_t digits) {
    constexpr uint32_t Same = 0x3210;
    return digits == Same ? a : op(GRAPH_SWIZZLE, a, {}, {}, digits);
}

MaterialInput GraphBuilder::input(const GraphValue& value, const MaterialInput& fallback) const {
    MaterialInput result = fallback;
    if (value.isConstant()) {
        result.constant = value.constant;
        return result;
    }
    const GraphNode& node = _graph.nodes[value.node];
    if (node.op == GRAPH_READ) return _graph.reads[node.immediate];
    result.source = MaterialInput::Source::Graph;
    result.node = value.node;
    return result;
}

} // namespace hipr
