// What the surface gives: MaterialX specification, "Geometric Nodes"; and USD's primvar readers.
#include "renderer/materialx/nodes.h"

namespace hipr {

using namespace gpu;

namespace {

using G = MtlxGeometry;
using Call = MtlxCall;

bool inWorld(Call& c, const char* name) {
    return c.text(name) == "world";
}

GraphValue position(Call& c) {
    return c.build.geometry(GRAPH_POSITION, inWorld(c, "space") ? GRAPH_WORLD : GRAPH_OBJECT);
}

GraphValue normal(Call& c) {
    return c.build.geometry(GRAPH_NORMAL, inWorld(c, "space") ? GRAPH_WORLD : GRAPH_OBJECT);
}

GraphValue direction(Call& c, G what) {
    const GraphValue v = mtlxGeometry(c.build, what);
    return inWorld(c, "space") ? v : c.build.geometry(GRAPH_TRANSFORM, GRAPH_OBJECT | GRAPH_AS_VECTOR, v);
}

GraphValue tangent(Call& c) {
    return direction(c, G::TangentWorld);
}

GraphValue bitangent(Call& c) {
    return direction(c, G::BitangentWorld);
}

/// Set 0 is st, set n stn.
GraphValue texcoord(Call& c) {
    const int set = c.in[0].isConstant() ? int(c.in[0].constant.x) : 0;
    return mtlxPrimvar(c.build, set > 0 ? "st" + std::to_string(set) : "st", 2, GraphValue(0.f));
}

GraphValue geomColor(Call& c) {
    return mtlxPrimvar(c.build, "displayColor", c.components(), GraphValue(glm::vec4(0, 0, 0, 1)));
}

GraphValue named(Call& c, const char* name) {
    const std::string primvar = c.text(name);
    if (!primvar.empty()) return mtlxPrimvar(c.build, primvar, c.components(), c.in[0]);
    c.complain(std::string("names no primvar (") + name + "); its fallback is used");
    return c.in[0];
}

GraphValue geomProperty(Call& c) {
    return named(c, "geomprop");
}

GraphValue primvarReader(Call& c) {
    return named(c, "varname");
}

template <uint32_t As> GraphValue transformed(Call& c) {
    const bool toWorld = inWorld(c, "tospace");
    if (toWorld == inWorld(c, "fromspace")) return c.in[0];
    return c.build.geometry(GRAPH_TRANSFORM, As | (toWorld ? GRAPH_WORLD : GRAPH_OBJECT), c.in[0]);
}

/// To world space. Of 1.38 the input `space` says which kind of map it is.
GraphValue normalMap(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue direction = b.subtract(b.multiply(c.in[0], GraphValue(2.f)), GraphValue(1.f));
    GraphValue mapped;
    if (c.text("space") == "object") {
        mapped = b.geometry(GRAPH_TRANSFORM, GRAPH_WORLD | GRAPH_AS_NORMAL, direction);
    } else {
        const GraphValue scaled = b.multiply(direction, c.in[1]);
        mapped = b.add(
            b.add(b.multiply(c.in[3], b.component(scaled, 0)), b.multiply(c.in[4], b.component(scaled, 1))),
            b.multiply(c.in[2], b.component(direction, 2)));
    }
    return b.divide(mapped, b.op(GRAPH_SQRT, b.op(GRAPH_DOT, mapped, mapped, {}, 3)));
}

} // namespace

std::vector<MtlxNode> mtlxGeometryNodes() {
    const char* const geometric = "geometric";
    return {
        {"position", geometric, {}, position},
        {"normal", geometric, {}, normal},
        {"tangent", geometric, {}, tangent},
        {"bitangent", geometric, {}, bitangent},
        {"texcoord", geometric, {"index"}, texcoord},
        {"geomcolor", geometric, {}, geomColor},
        {"geompropvalue", geometric, {"default"}, geomProperty},
        {"UsdPrimvarReader", geometric, {"fallback"}, primvarReader},
        {"transformpoint", geometric, {"in"}, transformed<GRAPH_AS_POINT>},
        {"transformvector", geometric, {"in"}, transformed<GRAPH_AS_VECTOR>},
        {"transformnormal", geometric, {{"in", glm::vec4(0, 0, 1, 0)}}, transformed<GRAPH_AS_NORMAL>},
        {"normalmap",
         geometric,
         {{"in", glm::vec4(0.5f, 0.5f, 1.f, 0.f)},
          {"scale", 1.f},
          {"normal", G::NormalWorld},
          {"tangent", G::TangentWorld},
          {"bitangent", G::BitangentWorld}},
         normalMap},
    };
}

} // namespace hipr
