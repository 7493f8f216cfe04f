// Discovery's arithmetic, which kernels and host share, and the host's part of it.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/hipr/discovery.h"
#include "renderer/scene/camera.h"

using namespace hipr;

namespace {

constexpr uint32_t Width = 64, Height = 48;

gpu::CameraRecord cameraOf(const glm::dmat4& projection) {
    CameraDesc desc;
    desc.worldToView = glm::lookAt(glm::dvec3(2, 1, 5), glm::dvec3(0, 0.5, 0), glm::dvec3(0, 1, 0));
    desc.projection = projection;
    return *cameraRecord(desc);
}

std::vector<gpu::CameraRecord> cameras() {
    return {cameraOf(glm::perspective(glm::radians(50.0), double(Width) / Height, 0.5, 100.0)),
            cameraOf(glm::ortho(-4.0, 4.0, -3.0, 3.0, 0.5, 100.0))};
}

/// The point at `depth` that a camera sees at a place of the film, as trace/camera.glsl makes rays.
glm::vec3 pointSeen(const gpu::CameraRecord& camera, glm::vec2 film, float depth) {
    const glm::vec2 ndc = 2.f * film / glm::vec2(Width, Height) - 1.f;
    const glm::vec3 direction =
        glm::normalize(camera.direction + ndc.x * camera.directionX + ndc.y * camera.directionY);
    const glm::vec3 origin = camera.origin + ndc.x * camera.originX + ndc.y * camera.originY;
    return origin + direction * (depth / glm::dot(direction, camera.forward));
}

gpu::FilmPoint project(const gpu::CameraRecord& camera, glm::vec3 position) {
    return gpu::projectToFilm(camera, position, Width, Height);
}

WorldBox boxAt(float x, float size) {
    return {glm::vec3(x, 0, 0), glm::vec3(x + size, size, size)};
}

bool inside(const WorldBox& box, const std::vector<WorldBox>& boxes) {
    for (const WorldBox& b : boxes)
        if (glm::all(glm::lessThanEqual(b.min, box.min)) && glm::all(glm::greaterThanEqual(b.max, box.max)))
            return true;
    return false;
}

std::vector<std::pair<uint32_t, uint32_t>> pairs(const std::vector<gpu::ElementKey>& keys) {
    std::vector<std::pair<uint32_t, uint32_t>> result;
    for (const gpu::ElementKey& key : keys)
        result.push_back({key.object, key.instance});
    return result;
}

} // namespace

TEST(Projection, FindsThePixelAndTheDepthOfARay) {
    for (const gpu::CameraRecord& camera : cameras())
        for (uint32_t y = 0; y < Height; ++y)
            for (uint32_t x = 0; x < Width; ++x) {
                const float depth = 1.f + 0.37f * float((x * 7 + y * 13) % 100);
                const gpu::FilmPoint p =
                    project(camera, pointSeen(camera, glm::vec2(float(x) + 0.3f, float(y) + 0.8f), depth));
                ASSERT_TRUE(p.inside);
                EXPECT_EQ(p.x, x);
                EXPECT_EQ(p.y, y);
                EXPECT_NEAR(p.depth, depth, 1e-4f * depth);
            }
}

TEST(Projection, LeavesOutWhatTheCameraDoesNotSee) {
    for (const gpu::CameraRecord& camera : cameras()) {
        EXPECT_FALSE(project(camera, pointSeen(camera, {-0.5f, 10}, 5)).inside);
        EXPECT_FALSE(project(camera, pointSeen(camera, {Width + 0.5f, 10}, 5)).inside);
        EXPECT_FALSE(project(camera, pointSeen(camera, {10, -0.5f}, 5)).inside);
        EXPECT_FALSE(project(camera, pointSeen(camera, {10, Height + 0.5f}, 5)).inside);
        EXPECT_FALSE(project(camera, pointSeen(camera, {10, 10}, -5)).inside);
        EXPECT_FALSE(project(camera, pointSeen(camera, {10, 10}, 120)).inside);
        EXPECT_TRUE(project(camera, pointSeen(camera, {10, 10}, 5)).inside);
        EXPECT_FALSE(project(camera, glm::vec3(std::numeric_limits<float>::quiet_NaN())).inside);
    }
}

TEST(DepthTest, ToleratesAShareOfTheDepthOrOfTheSlope) {
    EXPECT_TRUE(gpu::depthAgrees(10.05f, 10.f, 0.f, 0.01f));
    EXPECT_FALSE(gpu::depthAgrees(10.15f, 10.f, 0.f, 0.01f)); // behind a thin occluder
    EXPECT_FALSE(gpu::depthAgrees(9.85f, 10.f, 0.f, 0.01f));
    EXPECT_TRUE(gpu::depthAgrees(10.15f, 10.f, 0.2f, 0.01f)); // a surface seen at a grazing angle
    EXPECT_FALSE(gpu::depthAgrees(10.35f, 10.f, 0.2f, 0.01f));
}

TEST(PathClass, FollowsHeckbert) {
    using namespace gpu;
    const auto classOf = [](std::initializer_list<uint32_t> scatters) {
        uint32_t history = 0, k = 0;
        for (uint32_t scatter : scatters)
            history = extendHistory(history, scatter, k++);
        EXPECT_EQ(history & HISTORY_LAST, *(scatters.end() - 1));
        return pathClass(history, k);
    };
    const uint32_t D = SCATTER_DIFFUSE, G = SCATTER_GLOSSY, S = SCATTER_SPECULAR, T = SCATTER_TRANSMISSION;
    for (uint32_t scatter : {D, G, S, T})
        EXPECT_EQ(classOf({scatter}), PATH_DIRECT);
    EXPECT_EQ(classOf({S, S}), PATH_DIRECT);
    EXPECT_EQ(classOf({T, T, S}), PATH_DIRECT);
    EXPECT_EQ(classOf({D, S}), PATH_CAUSTIC);
    EXPECT_EQ(classOf({G, T, T}), PATH_CAUSTIC);
    EXPECT_EQ(classOf({D, D}), PATH_INDIRECT);
    EXPECT_EQ(classOf({D, S, D}), PATH_INDIRECT);
    EXPECT_EQ(classOf({D, D, S}), PATH_INDIRECT);
    EXPECT_EQ(classOf({S, D}), PATH_INDIRECT);
    EXPECT_EQ(classOf({S, G, S}), PATH_INDIRECT);
}

TEST(DiscoveryWeights, AreNormalisedApart) {
    Settings settings;
    settings.weightSpecular = 4.f, settings.weightGlossy = 3.f;
    settings.weightDiffuse = 2.f, settings.weightTransmission = 1.f;
    settings.weightDirect = 0.f, settings.weightIndirect = 0.f, settings.weightCaustic = 0.f;
    const DiscoveryWeights weights = discoveryWeights(settings);
    EXPECT_FLOAT_EQ(weights.scatter[gpu::SCATTER_SPECULAR], 0.4f);
    EXPECT_FLOAT_EQ(weights.scatter[gpu::SCATTER_GLOSSY], 0.3f);
    EXPECT_FLOAT_EQ(weights.scatter[gpu::SCATTER_DIFFUSE], 0.2f);
    EXPECT_FLOAT_EQ(weights.scatter[gpu::SCATTER_TRANSMISSION], 0.1f);
    EXPECT_EQ(weights.path, glm::vec4(1.f / 3, 1.f / 3, 1.f / 3, 0)); // none is as good as equal ones
    EXPECT_FLOAT_EQ(weights.shadow(), 0.2f / 3);
}

TEST(DiscoveryWeights, OfThroughputAreBoundedAndRounded) {
    EXPECT_FLOAT_EQ(gpu::scalarThroughput(glm::vec3(1)), 1.f);
    EXPECT_FLOAT_EQ(gpu::scalarThroughput({0, 1, 0}), 0.7152f);
    EXPECT_EQ(gpu::scalarThroughput(glm::vec3(1e30f)), 4.f);
    EXPECT_EQ(gpu::scalarThroughput(glm::vec3(-1)), 0.f);
    EXPECT_EQ(gpu::fixedWeight(0.f), 0u);
    EXPECT_EQ(gpu::fixedWeight(1.f), 4096u);
    EXPECT_EQ(gpu::fixedWeight(0.6f / 4096.f), 1u);
}

TEST(ChangedElements, AddUpSortedAndEachOnce) {
    const uint32_t all = gpu::EVERY_INSTANCE;
    ChangedElements changed;
    changed.add({{7, 3}, {5, 2}, {7, 3}, {7, 1}}, {});
    EXPECT_EQ(pairs(changed.keys()), (std::vector<std::pair<uint32_t, uint32_t>>{{5, 2}, {7, 1}, {7, 3}}));
    changed.add({{7, all}, {5, 0}, {6, all}}, {});
    EXPECT_EQ(pairs(changed.keys()),
              (std::vector<std::pair<uint32_t, uint32_t>>{{5, 0}, {5, 2}, {6, all}, {7, all}}));
    changed.clear();
    EXPECT_TRUE(changed.keys().empty());
}

TEST(ChangedElements, MergeBoxesThatFitEachOther) {
    ChangedElements changed;
    std::vector<WorldBox> boxes;
    for (int i = 0; i < 40; ++i)
        boxes.push_back(boxAt(i < 20 ? float(i) : 1000.f * float(i / 10) + float(i % 10), 0.5f));
    boxes.push_back({}); // empty
    changed.add({}, boxes);
    EXPECT_EQ(changed.boxes().size(), gpu::MAX_CHANGED_BOXES);
    boxes.pop_back();
    for (const WorldBox& box : boxes)
        EXPECT_TRUE(inside(box, changed.boxes()));
    for (const WorldBox& box : changed.boxes())
        EXPECT_LT(box.max.x - box.min.x, 100.f); // groups far apart were kept apart
}

TEST(MeetsBox, WithinTheReachOfTheRay) {
    const gpu::ChangedBox flat{{-1, 2, -1}, {1, 2, 1}};
    EXPECT_TRUE(gpu::meetsBox({0, 0, 0}, {0, 1, 0}, 5.f, flat, 2.f));
    EXPECT_FALSE(gpu::meetsBox({0, 0, 0}, {0, 1, 0}, 1.f, flat, 2.f));
    EXPECT_FALSE(gpu::meetsBox({0, 3, 0}, {0, 1, 0}, 5.f, flat, 2.f));
    EXPECT_FALSE(gpu::meetsBox({2, 0, 0}, {0, 1, 0}, 5.f, flat, 2.f));
    EXPECT_TRUE(gpu::meetsBox({-3, 2, 0}, {1, 0, 0}, 5.f, flat, 2.f)); // within the plane
    const gpu::ChangedBox around{{-1, -1, -1}, {1, 1, 1}};
    EXPECT_TRUE(gpu::meetsBox({0, 0, 0}, {0, 1, 0}, 0.1f, around, 1.f));
}

TEST(DiscoveredPriorities, PutActiveTilesFirst) {
    const uint64_t one = uint64_t(gpu::WEIGHT_SCALE);
    const std::vector<float> p = discoveredPriorities({0, 9 * one, one, 0, 3 * one}, {1, 0, 1, 0, 0});
    EXPECT_GT(p[2], p[0]);
    EXPECT_GT(p[0], p[1]);
    EXPECT_GT(p[1], p[4]);
    EXPECT_FLOAT_EQ(p[4], 3.f);
    EXPECT_EQ(p[3], 0.f);
}
