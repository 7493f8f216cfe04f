/// Pattern nodes on the host: their values, and the programs made of them.
#include <set>

#include <gtest/gtest.h>

#include "renderer/shading/graph_program.h"
#include "shaders/shared/graph_value.h"
#include "testenv/unit/materialx/node_rows.h"

namespace hipr::test {
namespace {

TEST(MtlxNodes, ConstantsGiveTheSpecifiedValues) {
    for (const NodeRow& row : nodeRows()) {
        GraphBuilder build;
        const GraphValue value = emitNode(build, row, [](const std::string&, const std::vector<float>& v) {
            return GraphValue(operand(v));
        });
        ASSERT_TRUE(value.isConstant()) << row.id;
        for (size_t c = 0; c < row.expected.size(); ++c)
            EXPECT_NEAR(value.constant[int(c)], row.expected[c], allowance(row.expected[c]))
                << row.id << " component " << c;
    }
}

/// What needs a hit: unit_shading and the render tests have these.
const std::set<std::string> readers = {
    "position",        "normal",        "tangent",          "bitangent",           "texcoord",
    "geomcolor",       "geompropvalue", "UsdPrimvarReader", "transformpoint",      "transformvector",
    "transformnormal", "image",         "tiledimage",       "triplanarprojection", "UsdUVTexture"};

TEST(MtlxNodes, EveryNodeHasARow) {
    std::set<std::string> tested = readers;
    for (const NodeRow& row : nodeRows()) {
        std::string type;
        tested.insert(findMtlxNode(row.id, type)->category);
    }
    for (const MtlxNode& node : mtlxNodes())
        EXPECT_TRUE(tested.count(node.category)) << node.category;
}

TEST(MtlxNodes, IdsAreSplitIntoCategoryAndType) {
    const auto split = [](const std::string& id) {
        std::string type;
        const MtlxNode* node = findMtlxNode(id, type);
        return node ? std::string(node->category) + "|" + type : "none";
    };
    EXPECT_EQ(split("ND_add_color3FA"), "add|color3FA");
    EXPECT_EQ(split("ND_convert_color3_vector3"), "convert|color3_vector3");
    EXPECT_EQ(split("ND_ramp_gradient"), "ramp_gradient|");
    EXPECT_EQ(split("ND_normalmap"), "normalmap|");
    EXPECT_EQ(split("ND_UsdUVTexture_23"), "UsdUVTexture|23");
    EXPECT_EQ(split("UsdPrimvarReader_float2"), "UsdPrimvarReader|float2");
    EXPECT_EQ(split("ND_nothing_float"), "none");
    EXPECT_EQ(split("add_float"), "none");
}

TEST(GraphBuilder, LeavesOutWhatChangesNothing) {
    GraphBuilder b;
    const GraphValue st = mtlxGeometry(b, MtlxGeometry::Uv);
    EXPECT_EQ(b.multiply(st, GraphValue(1.f)), st);
    EXPECT_EQ(b.add(GraphValue(0.f), st), st);
    EXPECT_EQ(b.select(GraphValue(0.f), GraphValue(3.f), st), st);
    EXPECT_EQ(mtlxGeometry(b, MtlxGeometry::Uv), st); // made once
    EXPECT_EQ(b.graph().nodes.size(), 1u);
}

/// A program on the host, as kernels run it.
std::vector<glm::vec4> run(const GraphProgram& program, const std::vector<glm::vec4>& inputs,
                           uint32_t targets, const std::vector<glm::vec4>& reads) {
    std::vector<glm::vec4> registers(gpu::GRAPH_REGISTERS), out(targets);
    const auto value = [&](uint32_t operand) {
        if (operand < gpu::GRAPH_CONSTANT) return registers.at(operand);
        const uint32_t i = operand - gpu::GRAPH_CONSTANT;
        return i < inputs.size() ? inputs[i] : program.constants.at(i - inputs.size());
    };
    for (const gpu::GraphStep& step : program.steps) {
        const uint32_t op = step.code & 0xffu, result = step.code >> 8 & 0xffu, target = step.code >> 16;
        const glm::vec4 v = op == gpu::GRAPH_READ
                                ? reads.at(step.immediate)
                                : gpu::graphValue(op, step.immediate, value(step.operands & 0xffffu),
                                                  value(step.operands >> 16), value(step.operand));
        if (result != gpu::GRAPH_NOWHERE) registers.at(result) = v;
        if (target != gpu::GRAPH_NOWHERE) out.at(target) = v;
    }
    return out;
}

MaterialInput fromNode(const GraphValue& value) {
    MaterialInput input;
    input.source = MaterialInput::Source::Graph;
    input.node = value.node;
    return input;
}

TEST(GraphProgram, SharesValuesBetweenTargetsAndPutsOpacityFirst) {
    GraphBuilder b;
    const GraphValue st = mtlxGeometry(b, MtlxGeometry::Uv);
    const GraphValue twice = b.multiply(st, GraphValue(2.f)), sum = b.add(twice, st);
    const GraphValue color = b.multiply(sum, sum);
    GraphProgram p =
        compileGraph(b.graph(), {{0, fromNode(color)}, {1, fromNode(sum), true}, {2, fromNode(sum)}}, 1);
    EXPECT_TRUE(p.dropped.empty());
    EXPECT_EQ(p.steps.size(), 5u); // st, twice, sum, color, and sum once more
    EXPECT_EQ(p.presenceSteps, 3u);
    const auto out = run(p, {glm::vec4(9.f)}, 3, {glm::vec4(0.5f, 1.f, 0.f, 1.f)});
    EXPECT_EQ(out[0].x, 2.25f);
    EXPECT_EQ(out[1].y, 3.f);
    EXPECT_EQ(out[2].y, 3.f);
}

TEST(GraphProgram, ReadsOnlyWhatItNeeds) {
    GraphBuilder b;
    mtlxPrimvar(b, "unused", 3, GraphValue(0.f));
    const GraphValue used = mtlxPrimvar(b, "used", 3, GraphValue(0.f));
    const GraphProgram p = compileGraph(b.graph(), {{0, fromNode(b.add(used, GraphValue(1.f)))}}, 1);
    ASSERT_EQ(p.reads.size(), 1u);
    EXPECT_EQ(p.reads[0].primvar, "used");
    EXPECT_EQ(run(p, {glm::vec4(0.f)}, 1, {glm::vec4(2.f)})[0].x, 3.f);
}

/// 2^depth sums of different primvars need `depth` and one registers.
GraphValue tree(GraphBuilder& b, uint32_t depth, uint32_t& leaves) {
    if (!depth) return mtlxPrimvar(b, "p" + std::to_string(leaves++), 3, GraphValue(0.f));
    const GraphValue left = tree(b, depth - 1, leaves), right = tree(b, depth - 1, leaves);
    return b.add(left, right);
}

TEST(GraphProgram, DeepTreesNeedFewRegisters) {
    GraphBuilder b;
    uint32_t leaves = 0;
    const GraphValue sum = tree(b, 8, leaves);
    const GraphProgram p = compileGraph(b.graph(), {{0, fromNode(sum)}}, 1);
    EXPECT_TRUE(p.dropped.empty());
    EXPECT_EQ(run(p, {glm::vec4(0.f)}, 1, std::vector<glm::vec4>(leaves, glm::vec4(1.f)))[0].x, 256.f);
}

TEST(GraphProgram, WhatDoesNotFitIsDroppedAndTheRestStays) {
    GraphBuilder b;
    uint32_t leaves = 0;
    const GraphValue large = tree(b, gpu::GRAPH_REGISTERS + 1, leaves), small = tree(b, 1, leaves);
    const GraphProgram p = compileGraph(b.graph(), {{0, fromNode(large), true}, {1, fromNode(small)}}, 1);
    EXPECT_EQ(p.dropped, std::vector<uint32_t>{0});
    EXPECT_EQ(p.presenceSteps, 0u);
    EXPECT_EQ(run(p, {glm::vec4(0.f)}, 2, std::vector<glm::vec4>(2, glm::vec4(1.f)))[1].x, 2.f);
}

} // namespace
} // namespace hipr::test
