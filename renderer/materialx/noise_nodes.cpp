// Noise: MaterialX specification, "Procedural Nodes". shaders/shared/noise.h has the functions.
#include "renderer/materialx/nodes.h"

namespace hipr {

using namespace gpu;

namespace {

using G = MtlxGeometry;
using Call = MtlxCall;

const GraphValue One(1.f), Zero(0.f);

GraphValue octaves(GraphBuilder& b, GraphValue count, GraphValue lacunarity, GraphValue diminish) {
    return b.op(GRAPH_COMBINE, count, lacunarity, diminish);
}

/// As many independent values as the type has components; further than three come from `further` away.
/// `pairs`: the second of two comes from there too.
GraphValue noiseOf(Call& c, GraphValue p, GraphValue settings, uint32_t dimensions, glm::vec4 further,
                   bool pairs) {
    GraphBuilder& b = c.build;
    const GraphValue here = b.op(GRAPH_NOISE, p, settings, {}, dimensions);
    const uint32_t components = c.components();
    if (components == 1) return b.component(here, 0);
    if (components == 3 || (components == 2 && !pairs)) return here;
    const GraphValue there = b.op(GRAPH_NOISE, b.add(p, GraphValue(further)), settings, {}, dimensions);
    if (components == 2) return b.op(GRAPH_COMBINE, here, there, Zero);
    return b.op(GRAPH_WITH_W, here, there);
}

template <uint32_t Dimensions> GraphValue noise(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue once(glm::vec4(1, 1, 1, 0));
    const GraphValue value = noiseOf(c, c.in[2], once, Dimensions, glm::vec4(19, 73, 29, 0), false);
    return b.add(b.multiply(value, c.in[0]), c.in[1]);
}

template <uint32_t Dimensions> GraphValue fractal(Call& c) {
    const GraphValue settings = octaves(c.build, c.in[1], c.in[2], c.in[3]);
    const GraphValue value = noiseOf(c, c.in[4], settings, Dimensions, glm::vec4(19, 193, 17, 0), true);
    return c.build.multiply(value, c.in[0]);
}

template <uint32_t Dimensions> GraphValue cell(Call& c) {
    return c.build.op(GRAPH_CELL, c.in[0], {}, {}, Dimensions);
}

/// Style 0: distances to the nearest points; 1: a random value for the nearest one.
GraphValue worleyOf(Call& c, GraphValue p, GraphValue jitter, GraphValue style, uint32_t dimensions) {
    GraphBuilder& b = c.build;
    const bool number = c.components() == 1;
    const GraphValue distances = b.op(GRAPH_WORLEY, p, jitter, {}, dimensions);
    const GraphValue nearest = b.op(GRAPH_WORLEY, p, jitter, {}, dimensions | GRAPH_NEAREST);
    const GraphValue solid = b.op(number ? GRAPH_CELL : GRAPH_CELL3, nearest, {}, {}, dimensions);
    const GraphValue solidChosen = b.op(GRAPH_EQUAL, style, One);
    return b.select(solidChosen, solid, number ? b.component(distances, 0) : distances);
}

template <uint32_t Dimensions> GraphValue worley(Call& c) {
    return worleyOf(c, c.in[0], c.in[1], c.in[2], Dimensions);
}

/// A switch over the noises, as MaterialX's own graph of nodes.
template <uint32_t Dimensions> GraphValue unified(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue moved = b.add(b.multiply(c.in[0], c.in[1]), c.in[2]);
    const GraphValue turn = b.multiply(b.subtract(c.in[3], One), GraphValue(90000.f));
    const GraphValue axis(Dimensions == 3 ? glm::vec4(0.1f, 1, 0, 0) : glm::vec4(0, 0, 1, 0));
    const GraphValue p = b.op(GRAPH_ROTATE, moved, turn, axis);
    const GraphValue half(0.5f), once(glm::vec4(1, 1, 1, 0));
    const GraphValue plain = b.component(b.op(GRAPH_NOISE, p, once, {}, Dimensions), 0);
    const GraphValue settings = octaves(b, c.in[7], c.in[8], c.in[9]);
    GraphValue value = b.component(b.op(GRAPH_NOISE, p, settings, {}, Dimensions), 0);
    const auto below = [&](float type, GraphValue v) {
        value = b.select(b.greater(GraphValue(type), c.in[10]), v, value);
    };
    below(3.f, worleyOf(c, moved, c.in[3], c.in[11], Dimensions));
    below(2.f, b.op(GRAPH_CELL, p, {}, {}, Dimensions));
    below(1.f, b.add(b.multiply(plain, half), half));
    return mtlxRange(b, value, Zero, One, One, c.in[4], c.in[5], c.in[6]);
}

/// One value of `min`..`max` for each of 4096 steps of `in`, by the seed.
GraphValue randomOf(GraphBuilder& b, GraphValue in, GraphValue seed) {
    const GraphValue p = b.op(GRAPH_COMBINE, b.multiply(in, GraphValue(4096.f)), seed, Zero);
    return b.op(GRAPH_CELL, p, {}, {}, 2);
}

GraphValue randomNumber(Call& c) {
    return mtlxRange(c.build, randomOf(c.build, c.in[0], c.in[3]), Zero, One, One, c.in[1], c.in[2], One);
}

GraphValue randomColor(Call& c) {
    GraphBuilder& b = c.build;
    const float seeds[] = {413.3f, 1522.4f, 1813.8f};
    GraphValue hsv[3];
    for (size_t i = 0; i < 3; ++i) {
        const GraphValue low = c.in[1 + 2 * i], high = c.in[2 + 2 * i];
        const GraphValue offset = b.subtract(Zero, b.add(c.in[7], GraphValue(seeds[i])));
        const GraphValue seed = b.subtract(Zero, b.op(GRAPH_FLOOR, offset)); // rounded up
        hsv[i] = mtlxRemap(b, randomOf(b, c.in[0], seed), Zero, One, low, high);
    }
    return b.op(GRAPH_HSV_TO_RGB, b.op(GRAPH_COMBINE, hsv[0], hsv[1], hsv[2]));
}

std::vector<MtlxInput> unifiedInputs(MtlxInput place) {
    return {place,
            {"freq", 1.f},
            "offset",
            {"jitter", 1.f},
            "outmin",
            {"outmax", 1.f},
            {"clampoutput", 1.f},
            {"octaves", 3.f},
            {"lacunarity", 2.f},
            {"diminish", 0.5f},
            "type",
            "style"};
}

} // namespace

std::vector<MtlxNode> mtlxNoiseNodes() {
    const char* const group = "procedural";
    const MtlxInput st{"texcoord", G::Uv}, p{"position", G::PositionObject};
    const MtlxInput amplitude{"amplitude", 1.f}, count{"octaves", 3.f};
    const MtlxInput lacunarity{"lacunarity", 2.f}, diminish{"diminish", 0.5f}, jitter{"jitter", 1.f};
    return {
        {"noise2d", group, {amplitude, "pivot", st}, noise<2>},
        {"noise3d", group, {amplitude, "pivot", p}, noise<3>},
        {"fractal2d", group, {amplitude, count, lacunarity, diminish, st}, fractal<2>},
        {"fractal3d", group, {amplitude, count, lacunarity, diminish, p}, fractal<3>},
        {"cellnoise2d", group, {st}, cell<2>},
        {"cellnoise3d", group, {p}, cell<3>},
        {"worleynoise2d", group, {st, jitter, "style"}, worley<2>},
        {"worleynoise3d", group, {p, jitter, "style"}, worley<3>},
        {"unifiednoise2d", group, unifiedInputs(st), unified<2>},
        {"unifiednoise3d", group, unifiedInputs(p), unified<3>},
        {"randomfloat", group, {"in", "min", {"max", 1.f}, "seed"}, randomNumber},
        {"randomcolor",
         group,
         {"in",
          "huelow",
          {"huehigh", 1.f},
          {"saturationlow", 0.825f},
          {"saturationhigh", 1.f},
          {"brightnesslow", 1.f},
          {"brightnesshigh", 1.f},
          "seed"},
         randomColor},
    };
}

} // namespace hipr
