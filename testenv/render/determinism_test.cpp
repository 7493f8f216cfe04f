// The picture at N samples is the same to the last bit, however it came about.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <thread>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

/// A bit of everything: instances, glossy and glass, a veil that lets rays through, area light and dome.
void build(Stage& stage) {
    stage.add(quadMesh(), matte({0.6f, 0.7f, 0.8f}),
              {glm::mat4x3({9, 0, 0}, {0, 0, -9}, {0, 9, 0}, {0, -1, 0})});
    MaterialDesc plastic;
    plastic.diffuseColor = constantColor({0.7f, 0.3f, 0.1f});
    plastic.roughness = constantValue(0.3f);
    stage.add(sphereMesh(16), plastic, {translation(-1.2f, 0, 0), translation(1.2f, 0, -1.f)});
    MaterialDesc glass;
    glass.opacity = constantValue(0.f);
    glass.roughness = constantValue(0.05f);
    stage.add(sphereMesh(16), glass, {[] {
                  auto m = scaling(0.5f, 0.5f, 0.5f);
                  m[3] = {0, -0.5f, 1.5f};
                  return m;
              }()});
    MaterialDesc veil = matte({0.2f, 0.6f, 0.2f});
    veil.opacity = constantValue(0.5f);
    veil.opacityMode = OpacityMode::Presence;
    stage.add(quadMesh(), veil, {[] {
                  auto m = scaling(2, 2, 1);
                  m[3] = {1.f, 0.5f, 1.f};
                  return m;
              }()});
    LightDesc lamp;
    lamp.kind = LightKind::Sphere;
    lamp.radius = 0.4f;
    lamp.intensity = 20.f;
    lamp.transform = glm::translate(glm::dmat4(1), glm::dvec3(2, 3, 2));
    stage.add(lamp);
    stage.add(skyLight(0.2f));
    stage.edit.setCamera(lookAt({0, 1, 6}, {0, 0, 0}, 45, 80.0 / 60.0));
    stage.film(80, 60);
}

ColorPicture rendered(Stage& stage) {
    build(stage);
    stage.render();
    return stage.color();
}

ColorPicture reference() {
    static const ColorPicture picture = [] {
        Stage stage(withSamples(6));
        save(rendered(stage), "determinism");
        return stage.color();
    }();
    return picture;
}

/// What kernels are specialised by: OpenPBR, and a graph that is more than one texture or primvar.
MaterialDesc graphOfOpenPbr() {
    MaterialDesc desc;
    desc.model = MaterialModel::OpenPbr;
    GraphBuilder graph;
    const GraphValue position = graph.geometry(gpu::GRAPH_POSITION, gpu::GRAPH_WORLD);
    const GraphValue color = graph.op(gpu::GRAPH_ABS, position);
    desc.openPbr[OpenPbrInput::BaseColor] = graph.input(color, constantColor(glm::vec3(0.5f)));
    desc.graph = graph.graph();
    return desc;
}

/// Samples that make another choice because of another last bit are few.
void expectNearlyTheSame(const ColorPicture& a, const ColorPicture& b) {
    size_t others = 0;
    for (size_t i = 0; i < a.values.size(); ++i)
        others += glm::length(a.values[i] - b.values[i]) > 1e-4f * glm::length(a.values[i]);
    EXPECT_LT(others, a.values.size() / 100);
    EXPECT_NEAR(mean(a).y, mean(b).y, 1e-3 * mean(a).y);
}

} // namespace

TEST(Determinism, KernelsThatCanMoreMakeTheSamePicture) {
    Stage stage(withSamples(6));
    build(stage);
    stage.edit.setMaterial(stage.renderer->newId<MaterialId>(), graphOfOpenPbr());
    stage.render();
    expectNearlyTheSame(reference(), stage.color());
}

TEST(Determinism, WhatASceneHadBeforeDoesNotMatter) {
    Stage stage(withSamples(6));
    build(stage);
    MaterialDesc glow = graphOfOpenPbr();
    glow.openPbr[OpenPbrInput::EmissionColor] = constantColor(glm::vec3(1.f));
    glow.openPbr[OpenPbrInput::EmissionLuminance] = constantValue(1.f);
    const ObjectId ball = stage.add(sphereMesh(8), glow);
    CameraDesc camera = lookAt({0, 1, 6}, {0, 0, 0}, 45, 80.0 / 60.0), open = camera;
    open.shutter = {0, 1};
    InstancesDesc moving{{translation(-1, 0, 0)}, {}, {}};
    moving.motion.times = {0.f, 1.f};
    moving.motion.transforms = {{translation(-1, 0, 0)}, {translation(1, 0, 0)}};
    stage.edit.setInstances(ball, moving);
    stage.edit.setCamera(open);
    stage.render();
    EXPECT_FALSE(sameBits(reference(), stage.color()));
    stage.edit.removeObject(ball);
    stage.edit.removeMaterial(MaterialId(uint32_t(ball) - 1)); // the id that was made before
    stage.edit.setCamera(camera);
    stage.render();
    EXPECT_TRUE(sameBits(reference(), stage.color()));
}

TEST(Determinism, BatchAndTileSizesDoNotMatter) {
    for (const RendererInternals& internals :
         {RendererInternals{8, 500}, {16, 3000}, {32, 1 << 16}, {64, 1 << 15}, {16, 1 << 16}}) {
        Stage stage(withSamples(6), internals);
        EXPECT_TRUE(sameBits(reference(), rendered(stage)))
            << internals.tileSize << " " << internals.batchPaths;
    }
}

TEST(Determinism, AllTraversalsAgree) {
    for (const char* traversal : {"embree", "bvh", "rayquery"}) {
        Settings settings = withSamples(6);
        settings.traversal = traversal;
        Stage stage(settings);
        if (!stage.messages().empty()) { // this device cannot run it
            std::cout << stage.messages()[0].text << "\n";
            continue;
        }
        EXPECT_TRUE(sameBits(reference(), rendered(stage))) << traversal;
    }
}

// A discrete device, whose memory is filled and read through staging buffers; several rounds go into one
// submission.
TEST(Determinism, MemoryOfItsOwnDoesNotMatter) {
    const ColorPicture expected = reference();
    setenv("HIPR_NO_HOST_MEMORY", "1", 1);
    Stage stage(withSamples(6));
    unsetenv("HIPR_NO_HOST_MEMORY");
    EXPECT_TRUE(sameBits(expected, rendered(stage)));
}

TEST(Determinism, MoreSamplesLaterAreTheSameSamples) {
    Settings settings = withSamples(6);
    settings.samples = 2;
    Stage stage(settings);
    EXPECT_FALSE(sameBits(reference(), rendered(stage)));
    stage.settings(withSamples(6));
    EXPECT_EQ(stage.renderer->progress().samplesDone, 2u); // nothing was thrown away
    stage.render();
    EXPECT_TRUE(sameBits(reference(), stage.color()));
}

TEST(Determinism, SeedChangesNoiseOnly) {
    Settings settings = withSamples(6);
    settings.seed = 1;
    Stage stage(settings);
    EXPECT_FALSE(sameBits(reference(), rendered(stage)));
    EXPECT_NEAR(mean(stage.color()).y, mean(reference()).y, 0.05f * mean(reference()).y);
}

TEST(Determinism, CancelLosesNothing) {
    Stage stage(withSamples(6), {16, 3000});
    build(stage);
    stage.renderer->commit(stage.edit);
    std::atomic<bool> done{false};
    std::thread nuisance([&] {
        while (!done) {
            stage.renderer->cancel();
            std::this_thread::sleep_for(std::chrono::milliseconds(3));
            stage.renderer->resume();
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    });
    while (!stage.renderer->progress().converged)
        stage.renderer->renderBatch();
    done = true;
    nuisance.join();
    EXPECT_TRUE(sameBits(reference(), stage.color()));
}
