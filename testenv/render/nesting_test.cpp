// Glass and liquids that overlap.
#include <cmath>

#include <gtest/gtest.h>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

using In = OpenPbrInput;

/// What fills a box from front to back, seen from the front.
struct Filling {
    float ior, front, back;
    int priority;
    glm::vec3 through; ///< what a length of 1 lets through
};

MaterialDesc glass(float ior, int priority, float roughness = 0.f, glm::vec3 through = glm::vec3(1.f)) {
    MaterialDesc desc;
    desc.name = "/glass";
    desc.model = MaterialModel::OpenPbr;
    const auto set = [&](In input, glm::vec3 value) {
        desc.openPbr[input] = openPbrDefault(input);
        desc.openPbr[input].constant = glm::vec4(value, 1.f);
    };
    set(In::TransmissionWeight, glm::vec3(1.f));
    set(In::SpecularRoughness, glm::vec3(roughness));
    set(In::SpecularIor, glm::vec3(ior));
    set(In::DielectricPriority, glm::vec3(float(priority)));
    set(In::TransmissionDepth, glm::vec3(1.f));
    set(In::TransmissionColor, through);
    return desc;
}

/// A box of half-width 50 between two depths, all faces outward.
std::shared_ptr<const TriangleMesh> slab(float front, float back) {
    auto mesh = std::make_shared<TriangleMesh>();
    for (int i = 0; i < 8; ++i)
        mesh->positions.push_back({i & 1 ? 50.f : -50.f, i & 2 ? 50.f : -50.f, i & 4 ? -front : -back});
    mesh->triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    for (uint32_t i = 0; i < 12; ++i)
        mesh->triangleFace.push_back(i / 2);
    mesh->boundsMin = {-50, -50, -back};
    mesh->boundsMax = {50, 50, -front};
    return mesh;
}

/// What is seen of a lamp of radiance 1 through boxes, straight on.
glm::vec3 seenThrough(const std::vector<Filling>& boxes) {
    Settings settings;
    settings.samples = 1024;
    settings.maxDepth = 64;
    settings.rouletteDepth = 64;
    Stage stage(settings);
    for (const Filling& box : boxes)
        stage.add(slab(box.front, box.back), glass(box.ior, box.priority, 0.f, box.through));
    MaterialDesc glow = matte(glm::vec3(0.f));
    glow.emissiveColor = constantColor(glm::vec3(1.f));
    stage.add(quadMesh(), glow, {placed(scaling(20, 20, 1), 0, 0, -8)});
    LightDesc off; // keeps the camera's light away
    off.visible = false;
    stage.add(off);
    stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}, 0.5));
    stage.film(8, 8);
    stage.render();
    return glm::vec3(mean(stage.color()));
}

/// A layer of a stack: its index, and what it lets through.
struct Layer {
    float ior;
    glm::vec3 through;
};

/// The same of parallel layers in air, all reflections between them included: the adding method.
glm::vec3 expectedThrough(const std::vector<Layer>& layers) {
    glm::dvec3 transmitted(1.0), back(0.0), through(1.0);
    double before = 1.0;
    const auto add = [&](double ior) {
        const double r = std::pow((before - ior) / (before + ior), 2.0);
        const glm::dvec3 between = 1.0 - back * r * through * through;
        transmitted = transmitted * through * (1.0 - r) / between;
        back = r + (1.0 - r) * (1.0 - r) * through * through * back / between;
        before = ior;
    };
    for (const Layer& layer : layers) {
        add(layer.ior);
        through = layer.through;
    }
    add(1.0);
    return glm::vec3(transmitted);
}

void expectSeen(const std::vector<Filling>& boxes, const std::vector<Layer>& layers) {
    const glm::vec3 seen = seenThrough(boxes), expected = expectedThrough(layers);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen[c], expected[c], 0.006f) << "channel " << c;
}

const glm::vec3 Amber(0.8f, 0.6f, 0.3f), Teal(0.4f, 0.7f, 0.9f), Clear(1.f);

} // namespace

TEST(Nesting, GlassKeepsTheLiquidOut) {
    expectSeen({{1.5f, 0, 1, 2, Amber}, {1.33f, 0.5f, 2, 1, Teal}}, {{1.5f, Amber}, {1.33f, Teal}});
}

TEST(Nesting, LiquidKeepsTheGlassOut) {
    expectSeen({{1.5f, 0, 1, 1, Clear}, {1.33f, 0.5f, 2.5f, 2, Teal}}, {{1.5f, Clear}, {1.33f, Teal * Teal}});
}

TEST(Nesting, OneWithinAnother) {
    expectSeen({{1.33f, 0, 3, 1, Teal}, {1.8f, 1, 2, 5, Amber}},
               {{1.33f, Teal}, {1.8f, Amber}, {1.33f, Teal}});
    expectSeen({{1.33f, 0, 3, 5, Clear}, {1.8f, 1, 2, 1, Amber}}, {{1.33f, Clear}}); // it is not there
    expectSeen({{1.5f, 0, 3, 1, Teal}, {1.f, 1, 2, 5, Clear}}, {{1.5f, Teal}, {1.f, Clear}, {1.5f, Teal}});
}

TEST(Nesting, OfEqualPrioritiesTheLaterIsThere) {
    expectSeen({{1.5f, 0, 1.2f, 3, Amber}, {1.8f, 1, 2, 3, Teal}}, {{1.5f, Amber}, {1.8f, Teal}});
    expectSeen({{1.5f, 0, 3, 3, Amber}, {1.8f, 1, 2, 3, Teal}, {1.33f, 5, 6, 4, Clear}},
               {{1.5f, Amber}, {1.8f, Teal}, {1.5f, Amber}, {1.f, Clear}, {1.33f, Clear}});
}

/// White light all around: nothing is lost at rough interfaces either, whichever side is the denser one.
TEST(Nesting, WhiteFurnace) {
    for (const auto& [inner, priority] : {std::pair{1.f, 3}, {1.33f, 3}, {1.9f, 3}, {1.33f, 1}}) {
        Settings settings;
        settings.samples = 128;
        settings.maxDepth = 256;
        settings.rouletteDepth = 64;
        Stage stage(settings);
        stage.add(sphereMesh(64), glass(1.5f, 2, 0.4f));
        stage.add(sphereMesh(64), glass(inner, priority, 0.4f),
                  {placed(scaling(0.6f, 0.6f, 0.6f), 0.5f, 0, 0)});
        stage.add(skyLight());
        stage.edit.setCamera(lookAt({0, 0, 4.2}, {0, 0, 0}, 30));
        stage.film(24, 24);
        stage.render();
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(mean(stage.color())[c], 1.f, 0.012f) << inner << " " << priority;
    }
}

TEST(Nesting, EditedIsAsFresh) {
    const auto picture = [](Stage& stage, int before, int after) {
        const ObjectId ball = stage.add(sphereMesh(32), glass(1.5f, before));
        stage.add(sphereMesh(32), glass(1.33f, 0), {placed(scaling(0.7f, 0.7f, 0.7f), 0.6f, 0, 0)});
        stage.add(skyLight());
        addFloor(stage);
        stage.edit.setCamera(lookAt({0, 0.5, 4.2}, {0, 0, 0}, 30));
        stage.film(24, 24);
        stage.render();
        stage.edit.setMaterial(MaterialId(uint32_t(ball) - 1), glass(1.5f, after)); // the id made before
        stage.render();
        return stage.color();
    };
    Settings settings;
    settings.samples = 16;
    Stage edited(settings), fresh(settings);
    const ColorPicture nested = picture(fresh, 1, 1);
    EXPECT_TRUE(sameBits(picture(edited, 0, 1), nested));
    Stage flat(settings), back(settings);
    const ColorPicture overlapping = picture(flat, 0, 0);
    EXPECT_FALSE(sameBits(nested, overlapping));
    EXPECT_TRUE(sameBits(picture(back, 1, 0), overlapping));
}
