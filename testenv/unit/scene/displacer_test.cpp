// What displacements of materials say at the corners of meshes: constants, textures, primvars and graphs.
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/scene/displacer.h"
#include "testenv/unit/shading/picture.h"

namespace hipr::test {
namespace {

/// Two squares side by side in the xy plane with material slots 0 and 1; `st` is x / 2 and y.
TriangleMesh squares() {
    TriangleMesh mesh;
    TrianglePrimvar st{"st", Interpolation::Vertex, 2, {}};
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) {
            mesh.positions.emplace_back(x, y, 0);
            st.values.insert(st.values.end(), {0.5f * float(x), float(y)});
        }
    mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
    mesh.triangleFace = {0, 0, 1, 1};
    mesh.triangleSlot = {0, 0, 1, 1};
    mesh.normals.assign(6, glm::vec3(0, 0, 1));
    mesh.primvars = {st, {"height", Interpolation::Uniform, 1, {1.f, 1.f, 3.f, 3.f}}};
    return mesh;
}

MaterialInput number(float value) {
    return {MaterialInput::Source::Constant, glm::vec4(value), Channel::R, {}, {}, 0};
}

class Displacers : public testing::Test {
protected:
    std::shared_ptr<const Displacer> make(const Displacement& displacement) {
        const MessageSink sink = [this](Severity, const std::string& subject, const std::string& text) {
            messages.push_back(subject + ": " + text);
        };
        return std::make_shared<Displacer>(displacement, [&](const TextureDesc& desc) {
            return std::make_shared<HostTexture>(desc, serve(files), *ColorManager::create(sink), sink, "/m");
        });
    }
    /// Heights of the six vertices.
    std::vector<float> heights(const std::vector<std::shared_ptr<const Displacer>>& slots) {
        std::vector<float> z;
        const auto mesh = displacedMesh(squares(), slots);
        for (const glm::vec3& p : mesh->positions)
            z.push_back(p.z);
        return z;
    }
    std::vector<float> heights(const MaterialInput& amount, const MaterialGraph& graph = {}) {
        const auto displacer = make({graph, amount, false});
        return heights({displacer, displacer});
    }

    Files files;
    std::vector<std::string> messages;
};

TEST_F(Displacers, AreOfTheirMaterialsSlots) {
    const auto one = make({{}, number(1.f), false}), two = make({{}, number(2.f), false});
    const std::vector<float> both = heights({one, two});
    EXPECT_EQ(both[0], 1.f);
    EXPECT_EQ(both[2], 2.f);
    EXPECT_TRUE(both[1] > 1.f && both[1] < 2.f) << "the seam stays closed";
    const std::vector<float> second = heights({nullptr, two});
    EXPECT_EQ(second[0], 0.f);
    EXPECT_EQ(second[2], 2.f);
    EXPECT_EQ(heights({one})[2], 0.f) << "a slot without a material";
}

TEST_F(Displacers, ReadTexturesAsKernelsDo) {
    files = {{"h.exr", encodeFloat("exr", 4, 1, 1, {0.f, 1.f, 2.f, 3.f})}};
    MaterialInput input = number(0.f);
    input.source = MaterialInput::Source::Texture;
    input.texture.path = "h.exr";
    input.texture.wrapS = input.texture.wrapT = WrapMode::Clamp;
    input.texture.scale = glm::vec4(2.f);
    input.texture.bias = glm::vec4(-1.f);
    const std::vector<float> z = heights(input);
    EXPECT_NEAR(z[0], -1.f, 1e-6);
    EXPECT_NEAR(z[1], 2.f * 1.5f - 1.f, 1e-5) << "between the two texels in the middle";
    EXPECT_NEAR(z[2], 5.f, 1e-5);
    input.texture.uvTransform = glm::mat3x2(0.f, 0.f, 0.f, 1.f, 0.625f, 0.f);
    EXPECT_NEAR(heights(input)[0], 2.f * 2.f - 1.f, 1e-5) << "the centre of the third texel";
    input.texture.wrapS = WrapMode::Repeat;
    input.texture.uvTransform = glm::mat3x2(1.f, 0.f, 0.f, 1.f, -0.875f, 0.f);
    EXPECT_NEAR(heights(input)[0], -1.f, 1e-5) << "the first texel, one period on";
    EXPECT_TRUE(messages.empty());
}

TEST_F(Displacers, ReadTilesOfUdims) {
    files = {{"h.1001.exr", encodeFloat("exr", 1, 1, 1, {1.f})},
             {"h.1002.exr", encodeFloat("exr", 1, 1, 1, {2.f})}};
    MaterialInput input = number(0.f);
    input.source = MaterialInput::Source::Texture;
    input.texture.path = "h.<UDIM>.exr";
    input.texture.wrapS = input.texture.wrapT = WrapMode::Clamp;
    input.texture.fallback = glm::vec4(7.f);
    input.texture.uvTransform = glm::mat3x2(2.2f, 0.f, 0.f, 0.5f, 0.f, 0.f); // s: 0, 1.1, 2.2
    const std::vector<float> z = heights(input);
    EXPECT_EQ(z[0], 1.f);
    EXPECT_EQ(z[1], 2.f);
    EXPECT_EQ(z[2], 7.f) << "a tile that is not there";
}

TEST_F(Displacers, SayWhichTextureCannotBeRead) {
    MaterialInput input = number(0.f);
    input.source = MaterialInput::Source::Texture;
    input.texture.path = "none.exr";
    input.texture.fallback = glm::vec4(0.5f);
    EXPECT_EQ(heights(input)[0], 0.5f);
    ASSERT_FALSE(messages.empty());
    EXPECT_EQ(messages[0], "/m: texture none.exr: cannot be read");
}

TEST_F(Displacers, ReadPrimvars) {
    MaterialInput input = number(0.25f);
    input.source = MaterialInput::Source::Primvar;
    input.primvar = "height";
    const std::vector<float> z = heights(input);
    EXPECT_EQ(z[0], 1.f);
    EXPECT_EQ(z[2], 3.f);
    input.primvar = "none";
    EXPECT_EQ(heights(input)[0], 0.25f) << "its fallback";
}

/// 2 * st.x + |position.y|
TEST_F(Displacers, RunGraphs) {
    GraphBuilder build;
    MaterialInput st = number(0.f);
    st.source = MaterialInput::Source::Primvar;
    st.channel = Channel::R;
    st.primvar = "st";
    const GraphValue s = build.multiply(build.read(gpu::GRAPH_READ, st), GraphValue(2.f));
    const GraphValue y = build.component(build.geometry(gpu::GRAPH_POSITION, gpu::GRAPH_OBJECT), 1);
    const MaterialInput sum = build.input(build.add(s, y), number(0.f));
    const std::vector<float> z = heights(sum, build.graph());
    EXPECT_EQ(z, (std::vector<float>{0.f, 1.f, 2.f, 1.f, 2.f, 3.f}));
}

TEST_F(Displacers, MayBeVectors) {
    Displacement displacement;
    displacement.vector = true;
    displacement.amount.channel = Channel::Rgb;
    displacement.amount.constant = glm::vec4(1.f, 2.f, 3.f, 0.f);
    const auto displacer = make(displacement);
    const TriangleMesh before = squares();
    const auto after = displacedMesh(before, {displacer, displacer});
    for (size_t v = 0; v < before.positions.size(); ++v)
        EXPECT_LT(glm::distance(after->positions[v] - before.positions[v], glm::vec3(1, 2, 3)), 1e-6f);
}

} // namespace
} // namespace hipr::test
