// Patterns over texture coordinates: MaterialX specification, "Procedural Nodes".
#include "renderer/materialx/nodes.h"

namespace hipr {

using namespace gpu;

namespace {

using G = MtlxGeometry;
using Call = MtlxCall;

const GraphValue One(1.f), Zero(0.f), Half(0.5f), Two(2.f);

GraphValue unitCoordinate(Call& c, GraphValue st, uint32_t which) {
    return c.build.component(mtlxClamp(c.build, st, Zero, One), which);
}

GraphValue rampLeftRight(Call& c) {
    return c.build.mix(c.in[0], c.in[1], unitCoordinate(c, c.in[2], 0));
}

GraphValue rampTopBottom(Call& c) {
    return c.build.mix(c.in[1], c.in[0], unitCoordinate(c, c.in[2], 1));
}

/// Top is where t is 0, as in MaterialX's graph of nodes.
GraphValue ramp4(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue s = unitCoordinate(c, c.in[4], 0), t = unitCoordinate(c, c.in[4], 1);
    return b.mix(b.mix(c.in[0], c.in[1], s), b.mix(c.in[2], c.in[3], s), t);
}

/// A sharp edge: paths meet it at their own places, so that pixels see it smooth.
GraphValue split(Call& c, uint32_t coordinate, GraphValue below, GraphValue above) {
    const GraphValue at = c.build.component(c.in[3], coordinate);
    return c.build.select(c.build.greater(c.in[2], at), below, above);
}

GraphValue splitLeftRight(Call& c) {
    return split(c, 0, c.in[0], c.in[1]);
}

GraphValue splitTopBottom(Call& c) {
    return split(c, 1, c.in[1], c.in[0]);
}

GraphValue tiled(Call& c, GraphValue st, GraphValue tiling, GraphValue offset) {
    return c.build.subtract(c.build.multiply(st, tiling), offset);
}

GraphValue checkerboard(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue cell = b.op(GRAPH_FLOOR, tiled(c, c.in[4], c.in[2], c.in[3]));
    const GraphValue odd = b.op(GRAPH_MODULO, b.op(GRAPH_DOT, cell, One, {}, 2), Two);
    return b.mix(c.in[1], c.in[0], odd);
}

/// One interval of a ramp: `previous` before it.
GraphValue interval(GraphBuilder& b, GraphValue x, GraphValue low, GraphValue high, GraphValue color1,
                    GraphValue color2, GraphValue interpolation, GraphValue previous) {
    const GraphValue linear = mtlxRemap(b, mtlxClamp(b, x, low, high), low, high, Zero, One);
    const GraphValue smooth = b.op(GRAPH_SMOOTHSTEP, x, low, high);
    const GraphValue blend = b.mix(color1, color2, b.select(b.greater(One, interpolation), linear, smooth));
    const GraphValue step = b.select(b.greater(high, x), color1, color2);
    const GraphValue inside = b.select(b.greater(Two, interpolation), blend, step);
    return b.select(b.greater(x, low), inside, previous);
}

GraphValue rampGradient(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue value = interval(b, c.in[0], c.in[1], c.in[2], c.in[3], c.in[4], c.in[5], c.in[6]);
    return b.select(b.greater(c.in[8], c.in[7]), value, c.in[6]);
}

/// Where on the ramp a point is: along s, around the middle, away from it in circles or squares.
GraphValue rampPlace(Call& c, GraphValue st, GraphValue type) {
    GraphBuilder& b = c.build;
    const GraphValue off = b.subtract(st, Half), x = b.component(off, 0), y = b.component(off, 1);
    const GraphValue turn = b.add(b.divide(b.op(GRAPH_ATAN2, y, x), GraphValue(6.28319f)), Half);
    const GraphValue wide = b.multiply(off, GraphValue(1.414f));
    const GraphValue circle = b.op(GRAPH_SQRT, b.op(GRAPH_DOT, wide, wide, {}, 2));
    const GraphValue square = b.multiply(b.op(GRAPH_MAX, b.op(GRAPH_ABS, x), b.op(GRAPH_ABS, y)), Two);
    GraphValue place = square;
    place = b.select(b.greater(GraphValue(3.f), type), circle, place);
    place = b.select(b.greater(Two, type), turn, place);
    return b.select(b.greater(One, type), b.component(st, 0), place);
}

GraphValue ramp(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue x = rampPlace(c, c.in[0], c.in[1]), count = c.in[3];
    const auto at = [&](size_t i) { return c.in[4 + 2 * i]; }; // interval i
    const auto color = [&](size_t i) { return c.in[5 + 2 * i]; };
    GraphValue value = color(0);
    for (size_t i = 0; i + 1 < 10; ++i) {
        const GraphValue next = interval(b, x, at(i), at(i + 1), color(i), color(i + 1), c.in[2], value);
        value = b.select(b.greater(count, GraphValue(float(i + 1))), next, value);
    }
    return value;
}

GraphValue circle(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue off = b.subtract(c.in[0], c.in[1]);
    const GraphValue outside = b.greater(b.op(GRAPH_DOT, off, off, {}, 2), b.multiply(c.in[2], c.in[2]));
    return b.subtract(One, outside);
}

GraphValue line(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue from = b.subtract(b.subtract(c.in[0], c.in[1]), c.in[3]),
                     along = b.subtract(c.in[4], c.in[3]);
    const auto dot = [&](GraphValue v, GraphValue w) { return b.op(GRAPH_DOT, v, w, {}, 2); };
    const GraphValue share = mtlxClamp(b, b.divide(dot(from, along), dot(along, along)), Zero, One);
    const GraphValue off = b.subtract(from, b.multiply(along, share));
    return b.subtract(One, b.greater(b.op(GRAPH_SQRT, dot(off, off)), c.in[2]));
}

GraphValue grid(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue st = tiled(c, c.in[0], c.in[1], c.in[2]), y = b.component(st, 1);
    const GraphValue shifted = b.greater(b.op(GRAPH_MODULO, y, Two), One);
    const GraphValue shift = b.select(c.in[4], b.multiply(shifted, Half), Zero);
    const GraphValue place = b.op(GRAPH_COMBINE, b.add(b.component(st, 0), shift), y, Zero);
    const GraphValue within = b.op(GRAPH_MODULO, place, One);
    const GraphValue edge = b.op(GRAPH_ABS, b.subtract(b.multiply(within, Two), One));
    const GraphValue beyond = b.greater(edge, b.subtract(One, c.in[3]));
    return b.op(GRAPH_MAX, b.component(beyond, 0), b.component(beyond, 1));
}

std::vector<MtlxInput> rampInputs() {
    static const char* const names[] = {"interval1", "color1",    "interval2", "color2",     "interval3",
                                        "color3",    "interval4", "color4",    "interval5",  "color5",
                                        "interval6", "color6",    "interval7", "color7",     "interval8",
                                        "color8",    "interval9", "color9",    "interval10", "color10"};
    std::vector<MtlxInput> inputs = {
        {"texcoord", G::Uv}, "type", {"interpolation", 1.f}, {"num_intervals", 2.f}};
    for (size_t i = 0; i < 20; ++i) {
        inputs.emplace_back(names[i], 1.f);
        if (i == 0) inputs.back().value = glm::vec4(0.f);
        if (i == 1) inputs.back().value = glm::vec4(0, 0, 0, 1);
    }
    return inputs;
}

} // namespace

std::vector<MtlxNode> mtlxRampNodes() {
    const char* const group = "procedural";
    const MtlxInput st{"texcoord", G::Uv}, radius{"radius", 0.5f};
    const glm::vec4 black{0, 0, 0, 1};
    return {
        {"ramplr", group, {"valuel", "valuer", st}, rampLeftRight},
        {"ramptb", group, {"valuet", "valueb", st}, rampTopBottom},
        {"ramp4", group, {"valuetl", "valuetr", "valuebl", "valuebr", st}, ramp4},
        {"splitlr", group, {"valuel", "valuer", {"center", 0.5f}, st}, splitLeftRight},
        {"splittb", group, {"valuet", "valueb", {"center", 0.5f}, st}, splitTopBottom},
        {"checkerboard", group, {{"color1", 1.f}, "color2", {"uvtiling", 8.f}, "uvoffset", st}, checkerboard},
        {"ramp", group, rampInputs(), ramp},
        {"ramp_gradient",
         group,
         {"x",
          "interval1",
          {"interval2", 1.f},
          {"color1", black},
          {"color2", 1.f},
          {"interpolation", 1.f},
          {"prev_color", black},
          {"interval_num", 1.f},
          {"num_intervals", 2.f}},
         rampGradient},
        {"circle", group, {st, "center", radius}, circle},
        {"line",
         group,
         {st, "center", {"radius", 0.1f}, {"point1", glm::vec4(0.25f)}, {"point2", glm::vec4(0.75f)}},
         line},
        {"grid", group, {st, {"uvtiling", 1.f}, "uvoffset", {"thickness", 0.05f}, "staggered"}, grid},
    };
}

} // namespace hipr
