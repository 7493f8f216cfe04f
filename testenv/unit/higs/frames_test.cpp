// From frame to frame: what is drawn again, counted, cancelled, and left alone.
#include <cstring>

#include <glm/gtc/matrix_transform.hpp>

#include "testenv/unit/higs/scenes.h"
#include "testenv/unit/sampling/gpu.h"

namespace hipr::test {
namespace {

constexpr SplatMode Modes[] = {SplatMode::Flat16Aabb, SplatMode::Flat16Exact, SplatMode::Flat8Exact,
                               SplatMode::Higs8, SplatMode::Higs8Carry};

class SplatFrames : public ::testing::TestWithParam<SplatKernels> {
protected:
    std::unique_ptr<SplatPass> passOf(const SplatScene& scene, SplatMode mode = SplatMode::Higs8Carry) {
        auto pass = std::make_unique<SplatPass>(testDevice(), SplatPassOptions{GetParam(), mode, false});
        pass->setView(viewOf(scene));
        return pass;
    }
    /// The picture of a pass that has to draw everything.
    std::vector<gpu::SplatPixel> fresh(const SplatScene& scene, const std::vector<SplatInstance>& instances,
                                       SplatMode mode) {
        SplatPass& pass = clearedPass({GetParam(), mode, false});
        pass.setView(viewOf(scene));
        pass.setInstances(instances);
        EXPECT_TRUE(pass.render());
        return pixelsOf(pass, scene);
    }
};

INSTANTIATE_TEST_SUITE_P(, SplatFrames, ::testing::Values(SplatKernels::Lanes, SplatKernels::Workgroups),
                         [](const auto& info) {
                             return info.param == SplatKernels::Lanes ? "Lanes" : "Workgroups";
                         });

bool sameBits(const std::vector<gpu::SplatPixel>& a, const std::vector<gpu::SplatPixel>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

SplatScene threeClouds() {
    CloudRecipe recipe;
    recipe.count = 150;
    recipe.largest = 0.05f;
    SplatScene scene = sceneOf(randomCloud(recipe));
    scene.width = 320;
    scene.height = 192;
    scene.camera = perspectiveCamera(320.0 / 192);
    recipe.lo = glm::vec3(-0.2f);
    recipe.hi = glm::vec3(0.2f);
    recipe.seed = 2;
    scene.clouds.push_back(randomCloud(recipe));
    recipe.seed = 3;
    scene.clouds.push_back(randomCloud(recipe));
    scene.transforms = {glm::dmat4(1), glm::translate(glm::dmat4(1), glm::dvec3(-1.2, 0.5, 0)),
                        glm::translate(glm::dmat4(1), glm::dvec3(1.2, -0.6, 0.5))};
    return scene;
}

TEST_P(SplatFrames, MovedHiddenAndShownAgain) {
    const SplatScene scene = threeClouds();
    for (const SplatMode mode : Modes) {
        const auto pass = passOf(scene, mode);
        std::vector<SplatInstance> instances = instancesOf(scene);
        pass->setInstances(instances);
        ASSERT_TRUE(pass->render());
        const size_t all = pass->drawnTiles().size();
        const auto drawn = [&] {
            size_t n = 0;
            for (const uint32_t tile : pass->drawnTiles())
                n += tile;
            return n;
        };
        EXPECT_EQ(drawn(), all);
        ASSERT_TRUE(pass->render());
        EXPECT_EQ(drawn(), 0u) << "nothing has changed";

        const auto edit = [&](const char* what) {
            pass->setInstances(instances);
            ASSERT_TRUE(pass->render());
            EXPECT_TRUE(sameBits(pixelsOf(*pass, scene), fresh(scene, instances, mode)))
                << what << " in mode " << splatModeName(mode);
            if (mode == SplatMode::Higs8Carry || mode == SplatMode::Higs8) {
                EXPECT_GT(drawn(), 0u) << what;
                EXPECT_LT(drawn(), all / 2) << what;
            }
        };
        instances[1].objectToWorld[3] += glm::vec3(0.1f, -0.2f, 0.4f);
        edit("moved");
        instances[2].visible = false;
        edit("hidden");
        instances[2].visible = true;
        instances[1].primId = 77;
        edit("shown, and renamed");
        instances[1].objectToWorld[3] += glm::vec3(0.f, -0.4f, 0.f);
        instances[2].objectToWorld[0] *= 0.5f;
        edit("both");
        pass->setDepthLimit(0);
        instances.pop_back();
        pass->setInstances(instances);
        ASSERT_TRUE(pass->render());
        EXPECT_TRUE(sameBits(pixelsOf(*pass, scene), fresh(scene, instances, mode)));
    }
}

TEST_P(SplatFrames, OpaqueThingsMoveBeforeAndAfterSplatsDo) {
    SplatScene scene = threeClouds();
    std::vector<SplatInstance> instances = instancesOf(scene);
    const auto pass = passOf(scene);
    scene.limits.assign(size_t(scene.width) * scene.height, 4.f);
    const Buffer near = toDevice(scene.limits);
    const auto expected = [&](bool limited) {
        const auto other = passOf(scene);
        other->setInstances(instances);
        if (limited) other->setDepthLimit(near.address());
        EXPECT_TRUE(other->render());
        return pixelsOf(*other, scene);
    };
    pass->setInstances(instances);
    for (int i = 0; i < 2; ++i) {
        pass->setDepthLimit(near.address());
        ASSERT_TRUE(pass->render());
        EXPECT_TRUE(sameBits(pixelsOf(*pass, scene), expected(true)));
        pass->setDepthLimit(0);
        ASSERT_TRUE(pass->render());
        EXPECT_TRUE(sameBits(pixelsOf(*pass, scene), expected(false)));
        instances[1].objectToWorld[3].x += 0.1f; // leaves lists of some tiles only
        pass->setInstances(instances);
        ASSERT_TRUE(pass->render());
    }
}

TEST_P(SplatFrames, InstancesOutOfSightAreNotProjected) {
    SplatScene scene = threeClouds();
    const uint64_t each = scene.clouds[0].size();
    std::vector<SplatInstance> instances = instancesOf(scene);
    const auto pass = passOf(scene);
    const auto projected = [&](const char* what) {
        pass->setInstances(instances);
        EXPECT_TRUE(pass->render());
        EXPECT_EQ(pass->statistics().splats, 3 * each);
        EXPECT_TRUE(sameBits(pixelsOf(*pass, scene), fresh(scene, instances, SplatMode::Higs8Carry))) << what;
        return pass->statistics().projected / each;
    };
    EXPECT_EQ(projected("all in sight"), 3u);
    const glm::vec3 home = instances[1].objectToWorld[3];
    SplatView view = viewOf(scene);
    for (const glm::vec3 away :
         {glm::vec3(0, 0, 9), glm::vec3(-9, 0, 0), glm::vec3(0, 5, 0), glm::vec3(0, 0, -200)}) {
        instances[1].objectToWorld[3] = home + away;
        projected("moved out of sight");
        view.srgb = !view.srgb; // everything is drawn again
        pass->setView(view);
        ASSERT_TRUE(pass->render());
        EXPECT_EQ(pass->statistics().projected, 2 * each) << away.x << ' ' << away.y << ' ' << away.z;
        view.srgb = !view.srgb;
        pass->setView(view);
        instances[1].objectToWorld[3] = home + 0.9f * away; // from one such place to another
        projected("still out of sight");
        instances[1].objectToWorld[3] = home;
        EXPECT_EQ(projected("back again"), 3u);
    }
    scene.camera.worldToView =
        glm::lookAt(glm::dvec3(0, 0, 4), glm::dvec3(0, 0, 9), glm::dvec3(0, 1, 0)); // turns its back to them
    pass->setView(viewOf(scene));
    EXPECT_EQ(projected("nothing in sight"), 0u);
}

// Around the edges of the picture, splats that reach far: their own footprints decide.
TEST_P(SplatFrames, BoundsHideNoSplatThatShows) {
    Numbers random(11);
    for (const SplatProjection projection : {SplatProjection::Perspective, SplatProjection::Tangential}) {
        CloudRecipe recipe;
        recipe.count = 4;
        recipe.largest = 0.5f;
        recipe.lo = glm::vec3(-0.2f);
        recipe.hi = glm::vec3(0.2f);
        SplatScene scene = sceneOf(randomCloud(recipe));
        scene.clouds[0].projection = projection;
        SplatCloud unbounded = scene.clouds[0]; // an invisible splat makes its bounds reach everywhere
        unbounded.positions.push_back({0, 0, 0});
        unbounded.orientations.push_back({1, 0, 0, 0});
        unbounded.scales.push_back(glm::vec3(1e4f));
        unbounded.opacities.push_back(0.f);
        unbounded.coefficients.push_back(glm::vec3(0));
        const auto bounded = std::make_shared<SplatStore>(testDevice(), scene.clouds[0]),
                   free = std::make_shared<SplatStore>(testDevice(), unbounded);
        std::vector<SplatInstance> some, all;
        for (int i = 0; i < 400; ++i) {
            const glm::vec3 place(random(-6, 6), random(-5, 5), random(-4, 5));
            const float size = random(0.05f, 1.f);
            glm::mat4x3 m(size);
            m[3] = place;
            some.push_back({bounded, m, i, i, true});
            all.push_back({free, m, i, i, true});
        }
        for (const CameraDesc& camera : {perspectiveCamera(4.0 / 3), orthographicCamera(4.0 / 3)}) {
            scene.camera = camera;
            const auto pass = passOf(scene);
            pass->setInstances(some);
            ASSERT_TRUE(pass->render());
            EXPECT_LT(pass->statistics().projected, 3 * some.size()); // of four splats each
            EXPECT_TRUE(sameBits(pixelsOf(*pass, scene), fresh(scene, all, SplatMode::Higs8Carry)));
        }
    }
}

TEST_P(SplatFrames, ModesAgree) {
    CloudRecipe recipe;
    recipe.count = 12000;
    recipe.largest = 0.06f;
    recipe.degree = 1;
    SplatScene scene = sceneOf(randomCloud(recipe));
    scene.width = 200;
    scene.height = 150;
    const std::vector<SplatInstance> instances = instancesOf(scene);
    const auto carry = fresh(scene, instances, SplatMode::Higs8Carry);
    for (const SplatMode mode : {SplatMode::Higs8, SplatMode::Flat8Exact, SplatMode::Flat16Exact}) {
        const auto pixels = fresh(scene, instances, mode);
        float largest = 0;
        size_t otherIds = 0;
        for (size_t i = 0; i < pixels.size(); ++i) {
            const glm::vec3 d = glm::abs(pixels[i].color - carry[i].color);
            largest = std::max(
                {largest, d.x, d.y, d.z, std::abs(pixels[i].transmittance - carry[i].transmittance)});
            otherIds += pixels[i].splat != carry[i].splat;
        }
        EXPECT_LE(largest, 2e-3f) << splatModeName(mode);
        EXPECT_LE(otherIds, pixels.size() / 1000) << splatModeName(mode);
        std::printf("%s: %.2g from higs8-carry, %zu other ids\n", splatModeName(mode), largest, otherIds);
    }
}

TEST_P(SplatFrames, ListsGrowWhenTheyMust) {
    CloudRecipe recipe; // every splat meets nearly every tile
    recipe.count = 500;
    recipe.smallest = 1.f;
    recipe.largest = 2.f;
    recipe.strongest = 0.06f;
    SplatScene scene = sceneOf(randomCloud(recipe));
    scene.width = 1024;
    scene.height = 256;
    for (const SplatMode mode : Modes) {
        const auto pass = passOf(scene, mode);
        pass->setInstances(instancesOf(scene));
        ASSERT_TRUE(pass->render());
        EXPECT_GT(pass->statistics().attempts, 1u);
        const auto first = pixelsOf(*pass, scene);
        SplatView view = viewOf(scene);
        view.antialiased = true;
        pass->setView(view);
        ASSERT_TRUE(pass->render());
        pass->setView(viewOf(scene));
        ASSERT_TRUE(pass->render());
        EXPECT_EQ(pass->statistics().attempts, 1u);
        EXPECT_TRUE(sameBits(first, pixelsOf(*pass, scene)));
    }
}

TEST_P(SplatFrames, CropsLeaveTheRestAsItIs) {
    const SplatScene scene = threeClouds();
    const std::vector<SplatInstance> instances = instancesOf(scene);
    for (const SplatMode mode : Modes) {
        const auto whole = fresh(scene, instances, mode);
        const auto pass = passOf(scene, mode);
        pass->setInstances(instances);
        pass->render();
        const std::vector<gpu::SplatPixel> marked(whole.size(), gpu::SplatPixel{glm::vec3(7), 7, 7, 7, 7, 7});
        testDevice().upload(pass->pixels(), marked.data(), marked.size() * sizeof(marked[0]));
        SplatView view = viewOf(scene);
        view.cropX = 37;
        view.cropY = 21;
        view.cropWidth = 150;
        view.cropHeight = 90;
        pass->setView(view);
        ASSERT_TRUE(pass->render());
        const auto pixels = pixelsOf(*pass, scene);
        for (uint32_t y = 0; y < scene.height; ++y)
            for (uint32_t x = 0; x < scene.width; ++x) {
                const size_t i = size_t(y) * scene.width + x;
                const bool inside = x >= 37 && x < 187 && y >= 21 && y < 111;
                ASSERT_EQ(std::memcmp(&pixels[i], inside ? &whole[i] : &marked[i], sizeof(pixels[i])), 0)
                    << x << " " << y << " " << splatModeName(mode);
            }
    }
}

TEST_P(SplatFrames, CancelledFramesAreDrawnWholeTheNextTime) {
    const SplatScene scene = threeClouds();
    const std::vector<SplatInstance> instances = instancesOf(scene);
    const auto pass = passOf(scene);
    pass->setInstances(instances);
    std::atomic<bool> cancel{true};
    EXPECT_FALSE(pass->render(&cancel));
    cancel = false;
    EXPECT_TRUE(pass->render(&cancel));
    EXPECT_TRUE(sameBits(pixelsOf(*pass, scene), fresh(scene, instances, SplatMode::Higs8Carry)));
}

TEST_P(SplatFrames, CountsAgreeWithTheOracle) {
    CloudRecipe recipe;
    recipe.count = 1500;
    recipe.smallest = 0.003f;
    recipe.faintest = 0.002f;
    SplatScene scene = sceneOf(randomCloud(recipe));
    scene.width = 400;
    scene.height = 300;
    for (const SplatMode mode : Modes) {
        const auto pass = passOf(scene, mode);
        pass->setInstances(instancesOf(scene));
        pass->setProfiling(true);
        ASSERT_TRUE(pass->render());
        const SplatStatistics& s = pass->statistics();
        const glm::uvec2 tile = mode == SplatMode::Flat8Exact ? glm::uvec2(8)
                                : mode == SplatMode::Flat16Aabb || mode == SplatMode::Flat16Exact
                                    ? glm::uvec2(16)
                                    : glm::uvec2(64, 32);
        const double expected = double(oraclePairs(scene, tile, mode == SplatMode::Flat16Aabb));
        EXPECT_NEAR(double(s.pairs), expected, 0.005 * expected) << splatModeName(mode);
        EXPECT_EQ(s.splats, 1500u);
        EXPECT_GT(s.visible, 1000u);
        EXPECT_LE(s.visible, 1500u);
        EXPECT_GT(s.blendsDone, 0u);
        EXPECT_GT(s.blendsTried, s.blendsDone);
        EXPECT_GT(s.sortBytes, s.pairs * sizeof(gpu::SplatPair));
        EXPECT_GE(s.stages.size(), 6u);
    }
}

} // namespace
} // namespace hipr::test
