#include "renderer/materialx/nodes.h"

#include <algorithm>

namespace hipr {

using namespace gpu;

uint32_t MtlxCall::components() const {
    const size_t last = type.rfind('_');
    const std::string to = last == std::string::npos ? type : type.substr(last + 1);
    if (to == "normal" || to == "point" || to == "vector") return 3; // of UsdPrimvarReader
    const size_t digit = to.find_first_of("234");
    return digit == std::string::npos ? 1 : uint32_t(to[digit] - '0');
}

const std::vector<MtlxNode>& mtlxNodes() {
    static const std::vector<MtlxNode> all = [] {
        std::vector<MtlxNode> rows;
        for (const auto part : {mtlxMathNodes, mtlxBlendNodes, mtlxChannelNodes, mtlxGeometryNodes,
                                mtlxNoiseNodes, mtlxRampNodes, mtlxTextureNodes})
            for (MtlxNode& row : part())
                rows.push_back(std::move(row));
        std::sort(rows.begin(), rows.end(),
                  [](const MtlxNode& a, const MtlxNode& b) { return std::string(a.category) < b.category; });
        return rows;
    }();
    return all;
}

const MtlxNode* findMtlxNode(const std::string& id, std::string& type) {
    if (id.compare(0, 3, "Usd") == 0) return findMtlxNode("ND_" + id, type);
    if (id.compare(0, 3, "ND_") != 0) return nullptr;
    // The longest category that the id begins with: UsdPrimvarReader has underscores of its own.
    for (size_t end = id.size(); end != std::string::npos && end > 3; end = id.rfind('_', end - 1)) {
        const std::string category = id.substr(3, end - 3);
        const auto row = std::find_if(mtlxNodes().begin(), mtlxNodes().end(),
                                      [&](const MtlxNode& node) { return category == node.category; });
        if (row == mtlxNodes().end()) continue;
        type = end < id.size() ? id.substr(end + 1) : "";
        return &*row;
    }
    return nullptr;
}

GraphValue mtlxPrimvar(GraphBuilder& build, const std::string& name, uint32_t components,
                       const GraphValue& fallback) {
    MaterialInput reader;
    reader.source = MaterialInput::Source::Primvar;
    reader.primvar = name;
    reader.channel = components == 1 ? Channel::R : Channel::Rgb;
    reader.constant = fallback.constant;
    return build.read(GRAPH_READ, reader);
}

GraphValue mtlxGeometry(GraphBuilder& build, MtlxGeometry what) {
    MaterialInput st;
    st.source = MaterialInput::Source::Primvar;
    st.primvar = "st";
    switch (what) {
    case MtlxGeometry::Uv:
        return build.read(GRAPH_READ, st);
    case MtlxGeometry::PositionObject:
        return build.geometry(GRAPH_POSITION, GRAPH_OBJECT);
    case MtlxGeometry::NormalObject:
        return build.geometry(GRAPH_NORMAL, GRAPH_OBJECT);
    case MtlxGeometry::NormalWorld:
        return build.geometry(GRAPH_NORMAL, GRAPH_WORLD);
    case MtlxGeometry::TangentWorld:
        return build.read(GRAPH_TANGENT, st);
    case MtlxGeometry::BitangentWorld:
        return build.read(GRAPH_BITANGENT, st);
    case MtlxGeometry::None:
        break;
    }
    return {};
}

GraphValue mtlxRemap(GraphBuilder& b, GraphValue in, GraphValue low, GraphValue high, GraphValue outLow,
                     GraphValue outHigh) {
    const GraphValue share = b.divide(b.subtract(in, low), b.subtract(high, low));
    return b.add(b.multiply(share, b.subtract(outHigh, outLow)), outLow);
}

GraphValue mtlxClamp(GraphBuilder& b, GraphValue in, GraphValue low, GraphValue high) {
    return b.op(GRAPH_MIN, b.op(GRAPH_MAX, in, low), high);
}

GraphValue mtlxRange(GraphBuilder& b, GraphValue in, GraphValue low, GraphValue high, GraphValue gamma,
                     GraphValue outLow, GraphValue outHigh, GraphValue clamp) {
    const GraphValue share = mtlxRemap(b, in, low, high, GraphValue(0.f), GraphValue(1.f));
    const GraphValue size = b.op(GRAPH_POWER, b.op(GRAPH_ABS, share), b.divide(GraphValue(1.f), gamma));
    const bool straight = gamma.isConstant() && gamma.constant == glm::vec4(1.f);
    const GraphValue curved = straight ? share : b.multiply(size, b.op(GRAPH_SIGN, share));
    const GraphValue out = b.add(b.multiply(curved, b.subtract(outHigh, outLow)), outLow);
    return b.select(clamp, mtlxClamp(b, out, outLow, outHigh), out);
}

} // namespace hipr
