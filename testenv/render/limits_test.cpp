// Limits of time and threads: they end and slow the work, and change no pixel.
#include <gtest/gtest.h>

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

void build(Stage& stage) {
    addFloor(stage);
    stage.edit.setCamera(lookAt({0, 1, 5}, {0, 0, 0}));
    stage.film(32, 32);
}

} // namespace

TEST(Limits, TimeEndsThePictureAndMoreGoesOn) {
    Settings settings;
    settings.samples = 1 << 20;
    settings.timeLimit = 0.2f;
    Stage stage(settings);
    build(stage);
    stage.render();
    const Progress ended = stage.renderer->progress();
    EXPECT_TRUE(ended.converged);
    EXPECT_GE(ended.seconds, 0.2);
    EXPECT_LT(ended.samplesDone, ended.samplesTotal);
    const ColorPicture picture = stage.color();
    EXPECT_FALSE(stage.renderer->renderBatch()) << "there is nothing left to do";
    EXPECT_TRUE(sameBits(stage.color(), picture));

    settings.timeLimit = float(ended.seconds) + 0.1f;
    stage.settings(settings);
    stage.render();
    EXPECT_GT(stage.renderer->progress().samplesDone, ended.samplesDone) << "nothing was thrown away";

    // However short the time, every pixel has a sample.
    settings.timeLimit = 1e-9f;
    settings.seed = 1;
    stage.settings(settings);
    stage.render();
    EXPECT_TRUE(stage.renderer->progress().converged);
    EXPECT_GE(stage.renderer->progress().samplesDone, 1u);
}

TEST(Limits, ThreadsAreThoseAskedFor) {
    const int all = tbb::info::default_concurrency();
    int seen = 0;
    RendererOptions options;
    options.messages = [](Severity, const std::string&, const std::string&) {};
    options.assets = [&](const std::string&) { // called where the renderer works
        seen = tbb::this_task_arena::max_concurrency();
        return std::vector<unsigned char>();
    };
    std::string error;
    const auto renderer = createRenderer(options, {}, &error);
    ASSERT_TRUE(renderer) << error;
    const std::pair<int, int> limits[] = {
        {0, all}, {1, 1}, {-1, std::max(1, all - 1)}, {-4096, 1}, {4096, all}};
    int number = 0;
    for (const auto& [limit, expected] : limits) {
        Settings settings;
        settings.threadLimit = limit;
        renderer->setSettings(settings);
        SceneEdit edit;
        LightDesc dome;
        dome.kind = LightKind::Dome;
        dome.texture = "none" + std::to_string(++number) + ".exr";
        edit.setLight(renderer->newId<LightId>(), dome);
        renderer->commit(edit);
        EXPECT_EQ(seen, expected) << limit;
    }
}

TEST(Limits, ThreadsChangeNoPixel) {
    Settings settings;
    settings.samples = 4;
    Stage all(settings);
    build(all);
    all.render();
    settings.threadLimit = 1;
    Stage one(settings);
    build(one);
    one.render();
    EXPECT_TRUE(sameBits(all.color(), one.color()));
}
