// Splats in the picture: over, behind and between what is path traced, and through edits.
#include <algorithm>

#include <gtest/gtest.h>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

constexpr uint32_t Size = 64;
const std::vector<AovRequest> Aovs{{AovKind::Color, {}},    {AovKind::Depth, {}},  {AovKind::CameraDepth, {}},
                                   {AovKind::PrimId, {}},   {AovKind::Normal, {}}, {AovKind::InstanceId, {}},
                                   {AovKind::ElementId, {}}};

/// A ball of one splat, dense in the middle.
SplatCloud ball(glm::vec3 color, float scale = 0.2f, float opacity = 0.99f) {
    SplatCloud cloud;
    cloud.name = "/splats";
    cloud.positions = {glm::vec3(0)};
    cloud.scales = {glm::vec3(scale)};
    cloud.opacities = {opacity};
    cloud.coefficients = {(color - 0.5f) / 0.28209479177387814f};
    return cloud;
}

/// Two matte squares, one behind the other, the left half of the nearer one cut away; seen from +z.
class SplatStage : public Stage {
public:
    explicit SplatStage(uint32_t samples = 4, RendererInternals internals = {})
        : Stage(withSamples(samples), internals) {
        LightDesc sun;
        sun.kind = LightKind::Distant;
        add(sun);
        back = add(quadMesh(), matte({0.2f, 0.4f, 0.8f}), {scaled(translation(0, 0, -2), 8)});
        front = add(quadMesh(), matte({0.8f, 0.4f, 0.2f}), {scaled(translation(4, 0, 0), 8)});
        look({0, 0, 6});
        film(Size, Size, Aovs);
    }
    static Settings withSamples(uint32_t samples) {
        Settings settings;
        settings.samples = int(samples);
        return settings;
    }
    static glm::mat4x3 scaled(glm::mat4x3 m, float by) {
        for (int c = 0; c < 3; ++c)
            m[c] *= by;
        return m;
    }
    void look(glm::dvec3 eye) { edit.setCamera(lookAt(eye, {0, 0, 0})); }
    void addSplats(const SplatCloud& cloud, std::vector<glm::mat4x3> transforms) {
        splats = renderer->newId<SplatsId>();
        object = renderer->newId<ObjectId>();
        edit.setSplats(splats, std::make_shared<SplatCloud>(cloud));
        ObjectDesc desc;
        desc.name = cloud.name;
        desc.splats = splats;
        desc.primId = 77;
        edit.setObject(object, desc);
        place(transforms);
    }
    void place(std::vector<glm::mat4x3> transforms) {
        InstancesDesc instances;
        instances.transforms = std::move(transforms);
        edit.setInstances(object, instances);
    }
    /// The picture of the same scene, made at once.
    template <class Build> static ColorPicture fresh(Build&& build) {
        SplatStage stage;
        build(stage);
        stage.render();
        return stage.color();
    }

    ObjectId back, front, object;
    SplatsId splats;
};

const glm::vec3 Green(0.1f, 0.9f, 0.1f);

} // namespace

TEST(Splats, LieOverWhatIsBehindThemAndNotOverWhatIsInFront) {
    const ColorPicture bare = SplatStage::fresh([](SplatStage&) {});
    // Between the squares: seen beside the nearer one, hidden behind it.
    const ColorPicture between = SplatStage::fresh(
        [](SplatStage& stage) { stage.addSplats(ball(Green, 0.5f), {translation(0, 0, -1)}); });
    save(between, "splat_between");
    uint32_t covered = 0;
    for (uint32_t y = 0; y < Size; ++y)
        for (uint32_t x = 0; x < Size; ++x) {
            if (x > Size / 2) {
                EXPECT_EQ(between.at(x, y), bare.at(x, y)) << x << ' ' << y;
            }
            covered += between.at(x, y) != bare.at(x, y);
        }
    EXPECT_GT(covered, 50u);
    EXPECT_NEAR(between.at(Size / 2 - 1, Size / 2).y,
                0.99f * 0.9f + 0.01f * bare.at(Size / 2 - 1, Size / 2).y, 0.02f);

    const ColorPicture behind = SplatStage::fresh(
        [](SplatStage& stage) { stage.addSplats(ball(Green, 0.5f), {translation(0, 0, -3)}); });
    EXPECT_TRUE(sameBits(behind, bare));

    const ColorPicture ahead = SplatStage::fresh(
        [](SplatStage& stage) { stage.addSplats(ball(Green, 0.5f), {translation(0, 0, 1)}); });
    save(ahead, "splat_ahead");
    EXPECT_NE(ahead.at(Size / 2 + 4, Size / 2), bare.at(Size / 2 + 4, Size / 2));
    EXPECT_NEAR(ahead.at(Size / 2 + 4, Size / 2).y, ahead.at(Size / 2 - 5, Size / 2).y, 0.05f);
}

TEST(Splats, BlendByTheirTransmittance) {
    const ColorPicture bare = SplatStage::fresh([](SplatStage&) {});
    const ColorPicture thin = SplatStage::fresh(
        [](SplatStage& stage) { stage.addSplats(ball(Green, 2.f, 0.25f), {translation(0, 0, 2)}); });
    const glm::vec4 behind = bare.at(Size / 2, Size / 2), seen = thin.at(Size / 2, Size / 2);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen[c], 0.25f * Green[c] + 0.75f * behind[c], 2e-3f);
    EXPECT_EQ(seen.w, 1.f);
}

TEST(Splats, MayHoldDisplayColours) {
    const SplatCloud grey = ball(glm::vec3(0.5f), 2.f);
    Settings settings = SplatStage::withSamples(1);
    const auto seen = [&](const char* colors) {
        settings.splatColors = colors;
        SplatStage stage;
        stage.settings(settings);
        stage.addSplats(grey, {translation(0, 0, 2)});
        stage.render();
        return stage.color().at(Size / 2, Size / 2).x;
    };
    // The decoded value of 0.5 by IEC 61966-2-1; the splat covers all but 1 %.
    EXPECT_NEAR(seen("linear") - seen("sRGB"), 0.99f * (0.5f - 0.21404114f), 2e-3f);
}

TEST(Splats, HaveDepthAndIdsWhereTheyCover) {
    SplatStage stage;
    stage.addSplats(ball(Green, 0.3f), {translation(0, 0, 2), translation(0, 30, 2)});
    stage.render();
    const uint32_t middle = Size / 2;
    EXPECT_EQ(stage.read<int>(AovKind::PrimId).at(middle, middle), 77);
    EXPECT_EQ(stage.read<int>(AovKind::InstanceId).at(middle, middle), 0);
    EXPECT_EQ(stage.read<int>(AovKind::ElementId).at(middle, middle), 0);
    EXPECT_EQ(stage.read<glm::vec3>(AovKind::Normal).at(middle, middle), glm::vec3(0));
    EXPECT_NEAR(stage.read<float>(AovKind::CameraDepth).at(middle, middle), 4.f, 1e-4f);
    EXPECT_NE(stage.read<int>(AovKind::PrimId).at(2, 2), 77);
    EXPECT_EQ(stage.read<glm::vec3>(AovKind::Normal).at(2, 2), glm::vec3(0, 0, 1));
    // The depth of a mesh and of a splat at the same place are the same.
    const float splat = stage.read<float>(AovKind::Depth).at(middle, middle);
    stage.edit.removeObject(stage.object);
    stage.add(quadMesh(), matte({0.5f, 0.5f, 0.5f}), {translation(0, 0, 2)});
    stage.render();
    EXPECT_NEAR(stage.read<float>(AovKind::Depth).at(middle, middle), splat, 1e-5f);
}

// A host that reads ids as soon as they are said to be there must find those of splats in them.
TEST(Splats, IdsAreNotDoneBeforeTheyAreDrawn) {
    SplatStage stage;
    stage.render();
    EXPECT_TRUE(stage.renderer->progress().firstHitsDone);
    stage.addSplats(ball(Green, 0.5f), {translation(0, 0, 1)});
    stage.renderer->commit(stage.edit);
    EXPECT_FALSE(stage.renderer->progress().firstHitsDone);
    while (!stage.renderer->progress().firstHitsDone)
        ASSERT_TRUE(stage.renderer->renderBatch() || stage.renderer->progress().firstHitsDone);
    EXPECT_EQ(stage.read<int>(AovKind::PrimId).at(Size / 2, Size / 2), 77);
}

TEST(Splats, EditsOfThemKeepTheSamplesOfThePicture) {
    SplatStage stage;
    stage.addSplats(ball(Green), {translation(-1, 0, 1)});
    stage.render();
    const uint64_t paths = stage.renderer->progress().pathsTraced;
    stage.place({translation(-1.5f, 0.3f, 1)});
    stage.render();
    EXPECT_EQ(stage.renderer->progress().pathsTraced, paths);
    EXPECT_TRUE(sameBits(stage.color(), SplatStage::fresh([](SplatStage& other) {
                             other.addSplats(ball(Green), {translation(-1.5f, 0.3f, 1)});
                         })));
    stage.edit.setSplats(stage.splats, std::make_shared<SplatCloud>(ball({1, 0, 1}, 0.4f)));
    stage.render();
    EXPECT_EQ(stage.renderer->progress().pathsTraced, paths);
    EXPECT_TRUE(sameBits(stage.color(), SplatStage::fresh([](SplatStage& other) {
                             other.addSplats(ball({1, 0, 1}, 0.4f), {translation(-1.5f, 0.3f, 1)});
                         })));
    stage.edit.removeObject(stage.object);
    stage.render();
    EXPECT_EQ(stage.renderer->progress().pathsTraced, paths);
    EXPECT_TRUE(sameBits(stage.color(), SplatStage::fresh([](SplatStage&) {})));
}

TEST(Splats, FollowMeshesAndCamera) {
    SplatStage stage;
    stage.addSplats(ball(Green, 0.5f), {translation(0, 0, -1)});
    stage.render();
    InstancesDesc moved;
    moved.transforms = {SplatStage::scaled(translation(4, 0, -1.5f), 8)}; // behind the splats now
    stage.edit.setInstances(stage.front, moved);
    stage.render();
    EXPECT_TRUE(sameBits(stage.color(), SplatStage::fresh([&](SplatStage& other) {
                             other.addSplats(ball(Green, 0.5f), {translation(0, 0, -1)});
                             other.edit.setInstances(other.front, moved);
                         })));
    stage.look({2, 1, 5});
    stage.render();
    EXPECT_TRUE(sameBits(stage.color(), SplatStage::fresh([&](SplatStage& other) {
                             other.addSplats(ball(Green, 0.5f), {translation(0, 0, -1)});
                             other.edit.setInstances(other.front, moved);
                             other.look({2, 1, 5});
                         })));
    stage.film(Size, Size / 2, Aovs);
    // Before the splats are drawn anew: what was drawn for the larger film must not be put into this one.
    const size_t words = size_t(Size) * Size / 2 * 4;
    std::vector<float> color(2 * words, -7.f);
    ASSERT_TRUE(stage.renderer->readAov({AovKind::Color, {}}, color.data(), words));
    EXPECT_EQ(std::count(color.begin() + words, color.end(), -7.f), std::ptrdiff_t(words));
    stage.render();
    EXPECT_EQ(stage.read<int>(AovKind::PrimId).values.size(), size_t(Size) * Size / 2);
}

TEST(Splats, AreSeenFromANewCameraBeforeAnyRayIsTracedThere) {
    const auto build = [](SplatStage& stage) {
        stage.addSplats(ball(Green, 0.5f), {translation(0, 0, -1)}); // half hidden
    };
    SplatStage stage(4, {8, 512});
    build(stage);
    stage.render();
    stage.look({0.3, 0.2, 5.9});
    stage.renderer->commit(stage.edit);
    ASSERT_TRUE(stage.renderer->renderBatch());
    EXPECT_EQ(stage.renderer->progress().nearestRays, 0u);
    const Picture<int> shown = stage.read<int>(AovKind::PrimId);
    SplatStage other;
    build(other);
    other.look({0.3, 0.2, 5.9});
    other.render();
    const Picture<int> expected = other.read<int>(AovKind::PrimId);
    int covered = 0, wrong = 0;
    for (size_t i = 0; i < shown.values.size(); ++i) {
        covered += expected.values[i] == 77;
        wrong += (shown.values[i] == 77) != (expected.values[i] == 77);
    }
    EXPECT_GT(covered, 30);
    EXPECT_LE(wrong, covered / 10); // along the edge that hides them
    stage.render();
    EXPECT_TRUE(sameBits(stage.color(), other.color()));
}

TEST(Splats, AloneInASceneWaitForNoRays) {
    const auto build = [](Stage& stage) {
        const SplatsId splats = stage.renderer->newId<SplatsId>();
        ObjectDesc desc;
        desc.name = "/splats";
        desc.splats = splats;
        stage.edit.setSplats(splats, std::make_shared<SplatCloud>(ball(Green)));
        stage.edit.setObject(stage.renderer->newId<ObjectId>(), desc);
        stage.edit.setCamera(lookAt({0, 0, 6}, {0, 0, 0}));
        stage.film(Size, Size);
    };
    Stage stage(SplatStage::withSamples(2), {8, 512});
    build(stage);
    stage.renderer->commit(stage.edit);
    bool more = true;
    while (more && !(stage.color().at(Size / 2, Size / 2).y > 0.8f))
        more = stage.renderer->renderBatch();
    EXPECT_TRUE(more);
    EXPECT_EQ(stage.renderer->progress().nearestRays, 0u);
    // A mesh comes before them, and goes.
    const ObjectId wall = stage.add(quadMesh(), matte(glm::vec3(0)), {translation(0, 0, 2)});
    stage.render();
    EXPECT_LT(stage.color().at(Size / 2, Size / 2).y, 0.1f);
    stage.edit.removeObject(wall);
    stage.render();
    Stage fresh(SplatStage::withSamples(2));
    build(fresh);
    fresh.render();
    EXPECT_TRUE(sameBits(stage.color(), fresh.color()));
}

TEST(Splats, MayGoWhileWhatHidesThemIsSought) {
    SplatStage stage(1, {8, 64});
    stage.film(Size, Size); // no AOV wants first hits
    stage.addSplats(ball(Green), {translation(0, 0, 1)});
    stage.renderer->commit(stage.edit);
    while (stage.renderer->progress().nearestRays == 0)
        ASSERT_TRUE(stage.renderer->renderBatch());
    stage.edit.removeObject(stage.object);
    stage.render();
    EXPECT_TRUE(stage.renderer->progress().converged);
    SplatStage bare(1);
    bare.render();
    EXPECT_TRUE(sameBits(stage.color(), bare.color()));
}

TEST(Splats, AreFetchedFromMemoryTheHostCannotRead) {
    const auto move = [](SplatStage& stage) {
        stage.addSplats(ball(Green), {translation(-1, 0.8f, 1), translation(1, -0.8f, 1)});
        stage.render();
        stage.place({translation(-1, 0.8f, 1), translation(0.6f, -0.7f, 1)});
        stage.render();
        return stage.color();
    };
    SplatStage near;
    const ColorPicture expected = move(near);
    setenv("HIPR_NO_HOST_MEMORY", "1", 1);
    SplatStage far;
    unsetenv("HIPR_NO_HOST_MEMORY");
    EXPECT_TRUE(sameBits(move(far), expected));
}

TEST(Splats, OfAllModesLookAlike) {
    SplatCloud cloud = ball(Green);
    cloud.positions.clear(), cloud.scales.clear(), cloud.opacities.clear(), cloud.coefficients.clear();
    for (int i = 0; i < 500; ++i) {
        const float t = 0.1f * float(i);
        cloud.positions.push_back({1.2f * std::sin(3 * t), 1.2f * std::cos(2.1f * t), 1.5f * std::sin(t)});
        cloud.scales.push_back({0.05f + 0.03f * std::sin(t), 0.1f, 0.02f});
        cloud.opacities.push_back(0.5f + 0.4f * std::cos(7 * t));
        cloud.coefficients.push_back({std::sin(t), std::cos(t), std::sin(5 * t)});
    }
    SplatStage stage;
    stage.addSplats(cloud, {translation(0, 0, 0)});
    stage.render();
    const ColorPicture automatic = stage.color();
    save(automatic, "splats_auto");
    for (const char* mode : {"flat16-exact", "flat8-exact", "higs8", "higs8-carry"}) {
        Settings settings = SplatStage::withSamples(4);
        settings.splatMode = mode;
        stage.settings(settings);
        stage.render();
        const ColorPicture picture = stage.color();
        for (size_t i = 0; i < picture.values.size(); ++i)
            for (int c = 0; c < 4; ++c)
                ASSERT_NEAR(picture.values[i][c], automatic.values[i][c], 2e-3f) << mode << ' ' << i;
    }
}
