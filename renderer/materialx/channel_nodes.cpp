// Components and decisions: MaterialX specification, "Channel Nodes" and "Conditional Nodes".
#include <algorithm>

#include "renderer/materialx/nodes.h"

namespace hipr {

using namespace gpu;

namespace {

using Call = MtlxCall;

const GraphValue One(1.f), Zero(0.f);

GraphValue same(Call& c) {
    return c.in[0];
}

/// Digits as for GRAPH_SWIZZLE of one character.
uint32_t digitOf(char channel) {
    const std::string names = "rgba01xyzw";
    const size_t at = names.find(channel);
    if (at == std::string::npos) return 0;
    return uint32_t(at < 6 ? at : at - 6);
}

/// The component that an output names by its last letter: outr, outx, r.
GraphValue separated(Call& c) {
    return c.build.component(c.in[0], c.output.empty() ? 0 : digitOf(c.output.back()));
}

GraphValue extract(Call& c) {
    GraphBuilder& b = c.build;
    if (c.in[1].isConstant()) return b.component(c.in[0], uint32_t(std::clamp(c.in[1].constant.x, 0.f, 3.f)));
    GraphValue value = b.component(c.in[0], 0);
    for (uint32_t i = 1; i < 4; ++i)
        value = b.select(b.op(GRAPH_EQUAL, c.in[1], GraphValue(float(i))), b.component(c.in[0], i), value);
    return value;
}

/// Of MaterialX 1.38.
GraphValue swizzle(Call& c) {
    const std::string channels = c.text("channels");
    uint32_t digits = 0;
    for (uint32_t i = 0; i < 4; ++i)
        digits |= (channels.empty() ? i : digitOf(channels[std::min<size_t>(i, channels.size() - 1)]))
                  << 4 * i;
    return c.build.swizzle(c.in[0], digits);
}

/// A vector2 of two numbers, or what its type tells: C or V for a colour or vector, F for a number.
GraphValue combine2(Call& c) {
    GraphBuilder& b = c.build;
    const std::string& type = c.type;
    if (type == "color4CF" || type == "vector4VF") return b.op(GRAPH_WITH_W, c.in[0], c.in[1]);
    if (type != "vector4VV") return b.op(GRAPH_COMBINE, c.in[0], c.in[1], Zero);
    const GraphValue three = b.op(GRAPH_COMBINE, c.in[0], b.component(c.in[0], 1), c.in[1]);
    return b.op(GRAPH_WITH_W, three, b.component(c.in[1], 1));
}

GraphValue combine3(Call& c) {
    return c.build.op(GRAPH_COMBINE, c.in[0], c.in[1], c.in[2]);
}

GraphValue combine4(Call& c) {
    return c.build.op(GRAPH_WITH_W, combine3(c), c.in[3]);
}

/// Numbers spread; what a shorter type lacks is 0, and 1 in the fourth place.
GraphValue convert(Call& c) {
    const char first = c.type.empty() ? 'f' : c.type[0];
    if (first == 'f' || first == 'i' || first == 'b') return c.in[0];
    const size_t digit = c.type.find_first_of("234");
    const char from = digit == std::string::npos ? '4' : c.type[digit];
    return c.build.swizzle(c.in[0], from == '2' ? 0x5410 : (from == '3' ? 0x5210 : 0x3210));
}

GraphValue ifGreater(Call& c) {
    return c.build.select(c.op(GRAPH_GREATER, 0, 1), c.in[2], c.in[3]);
}

GraphValue ifGreaterEqual(Call& c) {
    return c.build.select(c.op(GRAPH_GREATER, 1, 0), c.in[3], c.in[2]);
}

GraphValue ifEqual(Call& c) {
    return c.build.select(c.op(GRAPH_EQUAL, 0, 1), c.in[2], c.in[3]);
}

/// in1 for `which` below 1, in2 below 2, and so on; 0 beyond the last.
GraphValue chosen(Call& c) {
    const GraphValue which = c.in.back();
    GraphValue value = Zero;
    for (size_t i = c.in.size() - 1; i-- > 0;)
        value = c.build.select(c.build.greater(GraphValue(float(i + 1)), which), c.in[i], value);
    return value;
}

GraphValue both(Call& c) {
    return c.op(GRAPH_MULTIPLY, 0, 1);
}

GraphValue either(Call& c) {
    return c.op(GRAPH_MAX, 0, 1);
}

GraphValue oneOf(Call& c) {
    return c.build.subtract(One, c.op(GRAPH_EQUAL, 0, 1));
}

GraphValue negated(Call& c) {
    return c.build.subtract(One, c.in[0]);
}

} // namespace

std::vector<MtlxNode> mtlxChannelNodes() {
    const char* const channel = "channel";
    const char* const condition = "conditional";
    const std::vector<MtlxInput> compared = {{"value1", 1.f}, "value2", "in1", "in2"};
    return {
        {"constant", channel, {"value"}, same},
        {"dot", channel, {"in"}, same},
        {"extract", channel, {"in", "index"}, extract},
        {"swizzle", channel, {"in"}, swizzle},
        {"separate2", channel, {"in"}, separated},
        {"separate3", channel, {"in"}, separated},
        {"separate4", channel, {"in"}, separated},
        {"combine2", channel, {"in1", "in2"}, combine2},
        {"combine3", channel, {"in1", "in2", "in3"}, combine3},
        {"combine4", channel, {"in1", "in2", "in3", "in4"}, combine4},
        {"convert", channel, {"in"}, convert},
        {"ifgreater", condition, compared, ifGreater},
        {"ifgreatereq", condition, compared, ifGreaterEqual},
        {"ifequal", condition, {"value1", "value2", "in1", "in2"}, ifEqual},
        {"switch",
         condition,
         {"in1", "in2", "in3", "in4", "in5", "in6", "in7", "in8", "in9", "in10", "which"},
         chosen},
        {"and", condition, {"in1", "in2"}, both},
        {"or", condition, {"in1", "in2"}, either},
        {"xor", condition, {"in1", "in2"}, oneOf},
        {"not", condition, {"in"}, negated},
    };
}

} // namespace hipr
