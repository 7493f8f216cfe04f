// Colours, and layers of them: MaterialX specification, "Adjustment Nodes" and "Compositing Nodes".
#include "renderer/materialx/nodes.h"

namespace hipr {

using namespace gpu;

namespace {

using Call = MtlxCall;

const GraphValue One(1.f), Zero(0.f);
constexpr size_t Fg = 0, Bg = 1, Mix = 2;

/// Alpha of a color4 stays what it was.
GraphValue withAlpha(Call& c, GraphValue color, GraphValue from) {
    return c.components() == 4 ? c.build.op(GRAPH_WITH_W, color, c.build.component(from, 3)) : color;
}

GraphValue luma(Call& c, GraphValue coefficients) {
    return c.build.op(GRAPH_DOT, c.in[0], coefficients, {}, 3);
}

GraphValue luminance(Call& c) {
    return withAlpha(c, luma(c, c.in[1]), c.in[0]);
}

GraphValue saturateColor(Call& c, GraphValue color, GraphValue amount, GraphValue coefficients) {
    const GraphValue grey = c.build.op(GRAPH_DOT, color, coefficients, {}, 3);
    return c.build.mix(grey, color, amount);
}

GraphValue saturate(Call& c) {
    return withAlpha(c, saturateColor(c, c.in[0], c.in[1], c.in[2]), c.in[0]);
}

template <uint32_t Op> GraphValue unary(Call& c) {
    return c.build.op(Op, c.in[0]);
}

GraphValue adjustHsv(Call& c, GraphValue color, GraphValue amount) {
    GraphBuilder& b = c.build;
    const GraphValue hue(glm::vec4(1, 0, 0, 0)), rest(glm::vec4(0, 1, 1, 0)), keep(glm::vec4(1, 0, 0, 1));
    const GraphValue shifted = b.add(b.op(GRAPH_RGB_TO_HSV, color), b.multiply(amount, hue));
    return b.op(GRAPH_HSV_TO_RGB, b.multiply(shifted, b.add(b.multiply(amount, rest), keep)));
}

GraphValue hsvAdjust(Call& c) {
    return withAlpha(c, adjustHsv(c, c.in[0], c.in[1]), c.in[0]);
}

const glm::vec4 lumaCoefficients{0.2722287f, 0.6740818f, 0.0536895f, 0.f}; // of ACEScg

/// hue, saturation, gamma, lift, gain, contrast, exposure, in this order.
GraphValue colorCorrect(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue turned = adjustHsv(c, c.in[0], b.op(GRAPH_COMBINE, c.in[1], One, One));
    const GraphValue saturated = saturateColor(c, turned, c.in[2], GraphValue(lumaCoefficients));
    const GraphValue curved = mtlxRange(b, saturated, Zero, One, c.in[3], Zero, One, Zero);
    const GraphValue lifted = b.add(b.multiply(curved, b.subtract(One, c.in[4])), c.in[4]);
    const GraphValue gained = b.multiply(lifted, c.in[5]);
    const GraphValue stretched = b.add(b.multiply(b.subtract(gained, c.in[7]), c.in[6]), c.in[7]);
    return withAlpha(c, b.multiply(stretched, b.op(GRAPH_POWER, GraphValue(2.f), c.in[8])), c.in[0]);
}

GraphValue premultiply(Call& c) {
    const GraphValue alpha = c.build.component(c.in[0], 3);
    return withAlpha(c, c.build.multiply(c.in[0], alpha), c.in[0]);
}

GraphValue unpremultiply(Call& c) {
    const GraphValue alpha = c.build.component(c.in[0], 3);
    return withAlpha(c, c.build.divide(c.in[0], alpha), c.in[0]);
}

/// By `mix` from the background.
GraphValue blended(Call& c, GraphValue result) {
    return c.build.mix(c.in[Bg], result, c.in[Mix]);
}

GraphValue plus(Call& c) {
    return blended(c, c.op(GRAPH_ADD, Bg, Fg));
}

GraphValue minus(Call& c) {
    return blended(c, c.op(GRAPH_SUBTRACT, Bg, Fg));
}

GraphValue difference(Call& c) {
    return blended(c, c.build.op(GRAPH_ABS, c.op(GRAPH_SUBTRACT, Bg, Fg)));
}

/// 0 where what it divides by is next to nothing.
GraphValue unlessTiny(Call& c, GraphValue divisor, GraphValue result) {
    const GraphValue tiny = c.build.greater(GraphValue(1e-6f), c.build.op(GRAPH_ABS, divisor));
    return c.build.select(tiny, Zero, result);
}

GraphValue burn(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue burnt = b.subtract(One, b.divide(b.subtract(One, c.in[Bg]), c.in[Fg]));
    return unlessTiny(c, c.in[Fg], blended(c, burnt));
}

GraphValue dodge(Call& c) {
    const GraphValue left = c.build.subtract(One, c.in[Fg]);
    return unlessTiny(c, left, blended(c, c.build.divide(c.in[Bg], left)));
}

GraphValue inverseProduct(Call& c) {
    GraphBuilder& b = c.build;
    return b.multiply(b.subtract(One, c.in[Fg]), b.subtract(One, c.in[Bg]));
}

GraphValue screen(Call& c) {
    return blended(c, c.build.subtract(One, inverseProduct(c)));
}

GraphValue overlay(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue two(2.f);
    const GraphValue light = b.subtract(One, b.multiply(inverseProduct(c), two));
    const GraphValue dark = b.multiply(c.op(GRAPH_MULTIPLY, Fg, Bg), two);
    return blended(c, b.select(b.greater(GraphValue(0.5f), c.in[Bg]), dark, light));
}

GraphValue alphaOf(Call& c, size_t which) {
    return c.build.component(c.in[which], 3);
}

GraphValue inOver(Call& c) {
    return blended(c, c.build.multiply(c.in[Fg], alphaOf(c, Bg)));
}

GraphValue mask(Call& c) {
    return blended(c, c.build.multiply(c.in[Bg], alphaOf(c, Fg)));
}

GraphValue out(Call& c) {
    return blended(c, c.build.multiply(c.in[Fg], c.build.subtract(One, alphaOf(c, Bg))));
}

GraphValue behind(Call& c, GraphValue fg) {
    return c.build.add(fg, c.build.multiply(c.in[Bg], c.build.subtract(One, alphaOf(c, Fg))));
}

GraphValue over(Call& c) {
    return blended(c, behind(c, c.in[Fg]));
}

GraphValue matte(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue alpha = alphaOf(c, Fg);
    return blended(c, behind(c, b.op(GRAPH_WITH_W, b.multiply(c.in[Fg], alpha), alpha)));
}

GraphValue disjointOver(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue fa = alphaOf(c, Fg), ba = alphaOf(c, Bg), sum = b.add(fa, ba);
    const GraphValue part = b.divide(b.subtract(One, fa), ba);
    const GraphValue much = unlessTiny(c, ba, b.add(c.in[Fg], b.multiply(c.in[Bg], part)));
    const GraphValue color = b.select(b.greater(sum, One), much, c.op(GRAPH_ADD, Fg, Bg));
    return blended(c, b.op(GRAPH_WITH_W, color, b.op(GRAPH_MIN, sum, One)));
}

GraphValue inside(Call& c) {
    return c.op(GRAPH_MULTIPLY, 0, 1);
}

GraphValue outside(Call& c) {
    return c.build.multiply(c.in[0], c.build.subtract(One, c.in[1]));
}

GraphValue mixed(Call& c) {
    return c.build.mix(c.in[Bg], c.in[Fg], c.in[Mix]);
}

} // namespace

std::vector<MtlxNode> mtlxBlendNodes() {
    const char* const adjust = "adjustment";
    const char* const composite = "compositing";
    const MtlxInput luma{"lumacoeffs", lumaCoefficients}, opaque{"in", glm::vec4(0, 0, 0, 1)};
    const std::vector<MtlxInput> layers = {"fg", "bg", {"mix", 1.f}};
    return {
        {"luminance", adjust, {"in", luma}, luminance},
        {"saturate", adjust, {"in", {"amount", 1.f}, luma}, saturate},
        {"rgbtohsv", adjust, {"in"}, unary<GRAPH_RGB_TO_HSV>},
        {"hsvtorgb", adjust, {"in"}, unary<GRAPH_HSV_TO_RGB>},
        {"hsvadjust", adjust, {"in", {"amount", glm::vec4(0, 1, 1, 0)}}, hsvAdjust},
        {"colorcorrect",
         adjust,
         {{"in", 1.f},
          "hue",
          {"saturation", 1.f},
          {"gamma", 1.f},
          "lift",
          {"gain", 1.f},
          {"contrast", 1.f},
          {"contrastpivot", 0.5f},
          "exposure"},
         colorCorrect},
        {"premult", composite, {opaque}, premultiply},
        {"unpremult", composite, {opaque}, unpremultiply},
        {"plus", composite, layers, plus},
        {"minus", composite, layers, minus},
        {"difference", composite, layers, difference},
        {"burn", composite, layers, burn},
        {"dodge", composite, layers, dodge},
        {"screen", composite, layers, screen},
        {"overlay", composite, layers, overlay},
        {"in", composite, layers, inOver},
        {"mask", composite, layers, mask},
        {"matte", composite, layers, matte},
        {"out", composite, layers, out},
        {"over", composite, layers, over},
        {"disjointover", composite, layers, disjointOver},
        {"inside", composite, {"in", {"mask", 1.f}}, inside},
        {"outside", composite, {"in", "mask"}, outside},
        {"mix", composite, {"fg", "bg", "mix"}, mixed},
    };
}

} // namespace hipr
