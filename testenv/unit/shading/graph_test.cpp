/// Programs of materials in kernels: every pattern node's value, and what reads the hit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testenv/unit/materialx/node_rows.h"
#include "testenv/unit/sampling/gpu.h"
#include "testenv/unit/shading/surface_scene.h"

namespace hipr::test {
namespace {

/// A black material that emits a value of a graph.
MaterialDesc emitting(GraphBuilder& build, const GraphValue& value) {
    MaterialDesc desc = matte(constantInput(glm::vec3(0.f)));
    desc.emissiveColor = build.input(value, desc.emissiveColor);
    desc.graph = build.graph();
    return desc;
}

/// The first three components of a value at a point, seen as light, which has no sign: hence twice.
glm::vec3 valueAt(SurfaceScene scene, GraphBuilder build, const GraphValue& value,
                  glm::vec2 point = {0.3f, 0.6f}) {
    const GraphValue negative = build.subtract(GraphValue(0.f), value);
    scene.materials = {emitting(build, value)};
    const glm::vec3 light = scene.look(point).emission;
    scene.materials = {emitting(build, negative)};
    return light - scene.look(point).emission;
}

/// Inputs come from primvars, so that nothing is known before kernels run.
TEST(Graph, EveryNodeHasItsValueOnTheDevice) {
    for (const NodeRow& row : nodeRows()) {
        SurfaceScene scene;
        GraphBuilder build;
        const GraphValue value =
            emitNode(build, row, [&](const std::string& name, const std::vector<float>& v) {
                scene.instancePrimvars.push_back(
                    {"in:" + name, gpu::INTERPOLATION_CONSTANT, uint32_t(v.size()), v});
                return mtlxPrimvar(build, "in:" + name, uint32_t(v.size()), GraphValue(0.f));
            });
        const glm::vec3 seen = valueAt(scene, build, value);
        const glm::vec3 last =
            row.expected.size() > 3 ? valueAt(scene, build, build.component(value, 3)) : glm::vec3(0.f);
        for (size_t c = 0; c < row.expected.size(); ++c)
            EXPECT_NEAR(c < 3 ? seen[int(c)] : last.x, row.expected[c], allowance(row.expected[c]))
                << row.id << " component " << c;
    }
    EXPECT_EQ(messageLog().count("/matte", "too large"), 0);
}

GraphValue node(GraphBuilder& build, const std::string& id, std::pair<std::string, std::string> text = {},
                const std::vector<std::pair<std::string, std::vector<float>>>& inputs = {}) {
    return emitNode(build, {id, inputs, {}, "out", std::move(text)},
                    [](const std::string&, const std::vector<float>& v) { return GraphValue(operand(v)); });
}

/// Twice as large, turned by 90 degrees around x, moved.
SurfaceScene movedScene() {
    SurfaceScene scene;
    scene.objectToWorld = {{2, 0, 0, 0}, {0, 0, 2, 0}, {0, -2, 0, 0}, {5, 6, 7, 1}};
    return scene;
}

TEST(Graph, GeometryInObjectAndWorldSpace) {
    const SurfaceScene scene = movedScene();
    GraphBuilder b;
    const std::pair<std::string, std::string> world{"space", "world"}, object{"space", "object"};
    const auto at = [&](const GraphValue& value) { return valueAt(scene, b, value); };
    expectNear(at(node(b, "ND_position_vector3", object)), {0.3f, 0.6f, 0.f}, 1e-5f);
    expectNear(at(node(b, "ND_position_vector3", world)), {5.6f, 6.f, 8.2f}, 1e-5f);
    expectNear(at(node(b, "ND_normal_vector3", object)), {0, 0, 1}, 1e-5f);
    expectNear(at(node(b, "ND_normal_vector3", world)), {0, -1, 0}, 1e-5f);
    expectNear(at(node(b, "ND_tangent_vector3", world)), {1, 0, 0}, 1e-5f);
    expectNear(at(node(b, "ND_bitangent_vector3", world)), {0, 0, 1}, 1e-5f);
    expectNear(at(node(b, "ND_texcoord_vector2")) * glm::vec3(1, 1, 0), {0.3f, 0.6f, 0.f}, 1e-5f);
}

TEST(Graph, TransformsBetweenSpaces) {
    const SurfaceScene scene = movedScene();
    for (const auto& [id, expected] : {std::pair("ND_transformpoint_vector3", glm::vec3(5.6f, 6.f, 8.2f)),
                                       std::pair("ND_transformvector_vector3", glm::vec3(0.6f, 0.f, 1.2f))}) {
        GraphBuilder b;
        const GraphValue p = node(b, "ND_position_vector3");
        std::string type;
        MtlxCall call{b, "vector3", "out", {p}, {true}, {}, {}};
        call.text = [](const char* name) {
            return std::string(std::string(name) == "tospace" ? "world" : "object");
        };
        expectNear(valueAt(scene, b, findMtlxNode(id, type)->emit(call)), expected, 1e-5f);
    }
}

TEST(Graph, PrimvarsWithTheirFallback) {
    SurfaceScene scene;
    scene.primvars.push_back({"tint", gpu::INTERPOLATION_VERTEX, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}});
    GraphBuilder b;
    const GraphValue there = node(b, "ND_geompropvalue_color3", {"geomprop", "tint"});
    const GraphValue absent =
        node(b, "ND_geompropvalue_color3", {"geomprop", "none"}, {{"default", {0.1f, 0.2f, 0.3f}}});
    const GraphValue reader = node(b, "UsdPrimvarReader_float3", {"varname", "tint"});
    const glm::vec2 at(0.7f, 0.2f);
    expectNear(valueAt(scene, b, b.multiply(there, GraphValue(2.f)), at), {0.6f, 1.f, 0.4f}, 1e-5f);
    expectNear(valueAt(scene, b, b.add(absent, GraphValue(1.f)), at), {1.1f, 1.2f, 1.3f}, 1e-5f);
    expectNear(valueAt(scene, b, reader, at), {0.3f, 0.5f, 0.2f}, 1e-5f);
}

/// Four texels in a row: 0, 64, 128 and 192.
const Files stripes = {{"stripes.png", encode8("png", 4, 1, 1, {0, 64, 128, 192})}};

GraphValue stripe(GraphBuilder& b, const std::string& id, const GraphValue& st) {
    std::string type;
    const MtlxNode* row = findMtlxNode(id, type);
    MtlxCall call{b, type, "out", {}, {}, {}, {}};
    call.text = [](const char* name) {
        return std::string(std::string(name) == "file" ? "stripes.png" : "");
    };
    for (const MtlxInput& in : row->inputs) {
        call.given.push_back(false);
        call.in.push_back(in.geometry == MtlxGeometry::Uv ? st : GraphValue(in.value));
    }
    return row->emit(call);
}

TEST(Graph, TexturesAtComputedCoordinates) {
    SurfaceScene scene;
    scene.files = stripes;
    GraphBuilder b;
    const GraphValue st = mtlxGeometry(b, MtlxGeometry::Uv);
    const auto red = [&](const GraphValue& v) { return valueAt(scene, b, v, {0.375f, 0.5f}).x * 255.f; };
    EXPECT_NEAR(red(stripe(b, "ND_image_float", st)), 64.f, 0.01f);
    // A constant transform becomes the texture's own; one by a primvar is computed.
    const GraphValue moved = b.add(st, GraphValue(0.25f));
    EXPECT_EQ(b.graph().nodes[stripe(b, "ND_image_float", moved).node].op, gpu::GRAPH_READ);
    EXPECT_NEAR(red(stripe(b, "ND_image_float", moved)), 128.f, 0.01f);
    const GraphValue bent = b.add(st, b.component(st, 1));
    EXPECT_EQ(b.graph().nodes[stripe(b, "ND_image_float", bent).node].op, gpu::GRAPH_TEXTURE);
    EXPECT_NEAR(red(stripe(b, "ND_image_float", bent)), 192.f, 0.01f);
}

TEST(Graph, TriplanarTakesThePictureAlongTheNormal) {
    SurfaceScene scene;
    scene.files = stripes;
    GraphBuilder b;
    std::string type;
    const MtlxNode* row = findMtlxNode("ND_triplanarprojection_float", type);
    MtlxCall call{b, type, "out", {}, {}, {}, {}};
    call.text = [](const char* name) {
        return std::string(std::string(name) == "filez" ? "stripes.png" : "");
    };
    call.complain = [](const std::string&) {};
    for (const MtlxInput& in : row->inputs) {
        call.given.push_back(false);
        call.in.push_back(in.geometry == MtlxGeometry::None ? GraphValue(in.value)
                                                            : mtlxGeometry(b, in.geometry));
    }
    EXPECT_NEAR(valueAt(scene, b, row->emit(call), {0.375f, 0.5f}).x * 255.f, 64.f, 0.01f);
}

TEST(Graph, WorldSpaceNormalsTurnTheSurface) {
    GraphBuilder b;
    const GraphValue map = node(b, "ND_normalmap_float", {}, {{"in", {0.8f, 0.5f, 0.9f}}, {"scale", {1.f}}});
    MaterialDesc desc = matte(constantInput(glm::vec3(0.5f)));
    desc.normal = b.input(map, desc.normal);
    desc.graph = b.graph();
    SurfaceScene scene = movedScene();
    scene.materials = {desc};
    // (0.6, 0, 0.8) in the frame (x, z, -y).
    expectNear(scene.look({0.3f, 0.6f}).ns, {0.6f, -0.8f, 0.f}, 1e-5f);
    expectNear(scene.look({0.3f, 0.6f}, true).ns, {-0.6f, 0.8f, 0.f}, 1e-5f);
}

TEST(Graph, OpacityIsPresence) {
    GraphBuilder b;
    const GraphValue st = mtlxGeometry(b, MtlxGeometry::Uv);
    MaterialDesc desc = matte(b.input(b.multiply(st, GraphValue(0.5f)), constantInput(glm::vec3(0.f))));
    desc.opacity = b.input(b.multiply(b.component(st, 0), GraphValue(0.5f)), desc.opacity);
    desc.graph = b.graph();
    const SurfaceScene scene = sceneWith(desc);
    EXPECT_TRUE(scene.nonOpaque(0));
    const SurfaceOutcome s = scene.look({0.4f, 0.2f});
    EXPECT_NEAR(s.opacity, 0.2f, 1e-6f);
    EXPECT_NEAR(s.presence, 0.2f, 1e-6f);
    EXPECT_NEAR(s.diffuse.x, 0.2f, 1e-6f);
}

TEST(Graph, WhatIsNoNumberCountsAsZero) {
    SurfaceScene scene;
    scene.instancePrimvars.push_back({"bad", gpu::INTERPOLATION_CONSTANT, 1, {std::nanf("")}});
    GraphBuilder b;
    const GraphValue bad = mtlxPrimvar(b, "bad", 1, GraphValue(0.f));
    expectNear(valueAt(scene, b, b.add(bad, GraphValue(2.f))), glm::vec3(2.f), 1e-6f);
}

} // namespace
} // namespace hipr::test
