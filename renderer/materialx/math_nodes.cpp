// Arithmetic: MaterialX specification, "Math Nodes" and "Adjustment Nodes".
#include "renderer/materialx/nodes.h"

namespace hipr {

using namespace gpu;

namespace {

using G = MtlxGeometry;
using Call = MtlxCall;

template <uint32_t Op> GraphValue unary(Call& c) {
    return c.build.op(Op, c.in[0]);
}

template <uint32_t Op> GraphValue binary(Call& c) {
    return c.op(Op, 0, 1);
}

GraphValue negative(GraphBuilder& b, GraphValue v) {
    return b.subtract(GraphValue(0.f), v);
}

GraphValue dotOf(Call& c, GraphValue a, GraphValue b) {
    return c.build.op(GRAPH_DOT, a, b, {}, c.components());
}

GraphValue lengthOf(Call& c, GraphValue v) {
    return c.build.op(GRAPH_SQRT, dotOf(c, v, v));
}

GraphValue ceiling(Call& c) {
    return negative(c.build, c.build.op(GRAPH_FLOOR, negative(c.build, c.in[0])));
}

GraphValue nearest(Call& c) {
    return c.build.op(GRAPH_FLOOR, c.build.add(c.in[0], GraphValue(0.5f)));
}

GraphValue fraction(Call& c) {
    return c.build.subtract(c.in[0], c.build.op(GRAPH_FLOOR, c.in[0]));
}

GraphValue tangent(Call& c) {
    return c.build.divide(c.build.op(GRAPH_SIN, c.in[0]), c.build.op(GRAPH_COS, c.in[0]));
}

GraphValue arcCosine(Call& c) {
    return c.build.subtract(GraphValue(1.57079633f), c.build.op(GRAPH_ASIN, c.in[0]));
}

/// 1.38 names the inputs in1 and in2.
GraphValue arcTangent(Call& c) {
    return c.build.op(GRAPH_ATAN2, c.in[c.given[2] ? 2 : 0], c.in[c.given[3] ? 3 : 1]);
}

GraphValue safePower(Call& c) {
    GraphBuilder& b = c.build;
    return b.multiply(b.op(GRAPH_SIGN, c.in[0]), b.op(GRAPH_POWER, b.op(GRAPH_ABS, c.in[0]), c.in[1]));
}

GraphValue invert(Call& c) {
    return c.op(GRAPH_SUBTRACT, 1, 0);
}

GraphValue limited(Call& c) {
    return mtlxClamp(c.build, c.in[0], c.in[1], c.in[2]);
}

GraphValue smooth(Call& c) {
    return c.build.op(GRAPH_SMOOTHSTEP, c.in[0], c.in[1], c.in[2]);
}

GraphValue remap(Call& c) {
    return mtlxRemap(c.build, c.in[0], c.in[1], c.in[2], c.in[3], c.in[4]);
}

GraphValue range(Call& c) {
    return mtlxRange(c.build, c.in[0], c.in[1], c.in[2], c.in[3], c.in[4], c.in[5], c.in[6]);
}

GraphValue contrast(Call& c) {
    GraphBuilder& b = c.build;
    return b.add(b.multiply(b.subtract(c.in[0], c.in[2]), c.in[1]), c.in[2]);
}

GraphValue triangle(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue wave = b.op(GRAPH_MODULO, b.op(GRAPH_ABS, c.in[0]), GraphValue(1.f));
    return b.subtract(GraphValue(0.5f), b.op(GRAPH_ABS, b.subtract(wave, GraphValue(0.5f))));
}

GraphValue unit(Call& c) {
    return c.build.divide(c.in[0], lengthOf(c, c.in[0]));
}

GraphValue magnitude(Call& c) {
    return lengthOf(c, c.in[0]);
}

GraphValue distance(Call& c) {
    return lengthOf(c, c.op(GRAPH_SUBTRACT, 0, 1));
}

GraphValue dotProduct(Call& c) {
    return dotOf(c, c.in[0], c.in[1]);
}

GraphValue rotate2d(Call& c) {
    return c.build.op(GRAPH_ROTATE, c.in[0], c.in[1], GraphValue(glm::vec4(0, 0, 1, 0)));
}

GraphValue rotate3d(Call& c) {
    return c.build.op(GRAPH_ROTATE, c.in[0], c.in[1], c.in[2]);
}

/// Off the normal, as GLSL's reflect().
GraphValue reflection(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue along = b.op(GRAPH_DOT, c.in[0], c.in[1], {}, 3);
    return b.subtract(c.in[0], b.multiply(b.multiply(along, GraphValue(2.f)), c.in[1]));
}

const glm::vec4 yAxis{0, 1, 0, 0};

} // namespace

std::vector<MtlxNode> mtlxMathNodes() {
    const char* const math = "math";
    const char* const adjust = "adjustment";
    return {
        {"add", math, {"in1", "in2"}, binary<GRAPH_ADD>},
        {"subtract", math, {"in1", "in2"}, binary<GRAPH_SUBTRACT>},
        {"multiply", math, {"in1", {"in2", 1.f}}, binary<GRAPH_MULTIPLY>},
        {"divide", math, {"in1", {"in2", 1.f}}, binary<GRAPH_DIVIDE>},
        {"modulo", math, {"in1", {"in2", 1.f}}, binary<GRAPH_MODULO>},
        {"power", math, {"in1", {"in2", 1.f}}, binary<GRAPH_POWER>},
        {"safepower", math, {"in1", {"in2", 1.f}}, safePower},
        {"min", math, {"in1", "in2"}, binary<GRAPH_MIN>},
        {"max", math, {"in1", "in2"}, binary<GRAPH_MAX>},
        {"absval", math, {"in"}, unary<GRAPH_ABS>},
        {"floor", math, {"in"}, unary<GRAPH_FLOOR>},
        {"ceil", math, {"in"}, ceiling},
        {"round", math, {"in"}, nearest},
        {"fract", math, {"in"}, fraction},
        {"sign", math, {"in"}, unary<GRAPH_SIGN>},
        {"sin", math, {"in"}, unary<GRAPH_SIN>},
        {"cos", math, {"in"}, unary<GRAPH_COS>},
        {"tan", math, {"in"}, tangent},
        {"asin", math, {"in"}, unary<GRAPH_ASIN>},
        {"acos", math, {"in"}, arcCosine},
        {"atan2", math, {"iny", {"inx", 1.f}, "in1", "in2"}, arcTangent},
        {"sqrt", math, {"in"}, unary<GRAPH_SQRT>},
        {"ln", math, {{"in", 1.f}}, unary<GRAPH_LN>},
        {"exp", math, {"in"}, unary<GRAPH_EXP>},
        {"invert", math, {"in", {"amount", 1.f}}, invert},
        {"clamp", math, {"in", "low", {"high", 1.f}}, limited},
        {"trianglewave", math, {"in"}, triangle},
        {"normalize", math, {"in"}, unit},
        {"magnitude", math, {"in"}, magnitude},
        {"distance", math, {"in1", "in2"}, distance},
        {"dotproduct", math, {"in1", "in2"}, dotProduct},
        {"crossproduct", math, {"in1", "in2"}, binary<GRAPH_CROSS>},
        {"rotate2d", math, {"in", "amount"}, rotate2d},
        {"rotate3d", math, {"in", "amount", {"axis", yAxis}}, rotate3d},
        {"reflect", math, {{"in", glm::vec4(1, 0, 0, 0)}, {"normal", G::NormalWorld}}, reflection},
        {"remap", adjust, {"in", "inlow", {"inhigh", 1.f}, "outlow", {"outhigh", 1.f}}, remap},
        {"smoothstep", adjust, {"in", "low", {"high", 1.f}}, smooth},
        {"range",
         adjust,
         {"in", "inlow", {"inhigh", 1.f}, {"gamma", 1.f}, "outlow", {"outhigh", 1.f}, "doclamp"},
         range},
        {"contrast", adjust, {"in", {"amount", 1.f}, {"pivot", 0.5f}}, contrast},
    };
}

} // namespace hipr
