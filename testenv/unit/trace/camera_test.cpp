#include <gtest/gtest.h>

#include <random>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/scene/camera.h"

using hipr::CameraDesc;
using hipr::cameraRecord;
using hipr::gpu::CameraRecord;

namespace {

struct HostRay {
    glm::dvec3 origin, direction;
    double tMin, tMax;
};

// The formula of CameraRecord's comment, as shaders/trace/camera.glsl evaluates it.
HostRay rayOf(const CameraRecord& c, glm::dvec2 ndc) {
    HostRay ray;
    ray.origin = glm::dvec3(c.origin) + ndc.x * glm::dvec3(c.originX) + ndc.y * glm::dvec3(c.originY);
    ray.direction = glm::normalize(glm::dvec3(c.direction) + ndc.x * glm::dvec3(c.directionX) +
                                   ndc.y * glm::dvec3(c.directionY));
    const double perDepth = 1 / glm::dot(ray.direction, glm::dvec3(c.forward));
    ray.tMin = c.nearDepth * perDepth;
    ray.tMax = c.farDepth * perDepth;
    return ray;
}

glm::dvec3 toNdc(const CameraDesc& camera, glm::dvec3 p) {
    const glm::dvec4 clip = camera.projection * camera.worldToView * glm::dvec4(p, 1);
    return glm::dvec3(clip) / clip.w;
}

glm::dmat4 someView(std::mt19937& random, double distance) {
    std::uniform_real_distribution<double> u(-1, 1);
    const glm::dvec3 eye(distance * u(random), distance * u(random), distance * u(random));
    return glm::lookAt(eye, eye + glm::dvec3(u(random), u(random), u(random)), glm::dvec3(0.1, 1, 0.2));
}

/// Every ray passes through its pixel on the near plane and on the far plane, and is clipped there.
void expectMatches(const CameraDesc& camera, double tolerance) {
    const auto record = cameraRecord(camera);
    ASSERT_TRUE(record);
    for (glm::dvec2 ndc : {glm::dvec2(0), glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(0.3, 0.8)}) {
        const HostRay ray = rayOf(*record, ndc);
        const glm::dvec3 near = toNdc(camera, ray.origin + ray.tMin * ray.direction);
        const glm::dvec3 far = toNdc(camera, ray.origin + ray.tMax * ray.direction);
        EXPECT_NEAR(near.x, ndc.x, tolerance);
        EXPECT_NEAR(near.y, ndc.y, tolerance);
        EXPECT_NEAR(near.z, -1, tolerance);
        EXPECT_NEAR(far.x, ndc.x, tolerance);
        EXPECT_NEAR(far.y, ndc.y, tolerance);
        EXPECT_NEAR(far.z, 1, tolerance);
    }
}

} // namespace

TEST(Camera, PerspectiveRaysMatchTheMatrices) {
    std::mt19937 random(1);
    for (int i = 0; i < 50; ++i) {
        CameraDesc camera{someView(random, 10), glm::perspective(0.2 + 0.02 * i, 1.5, 0.1, 50.0)};
        expectMatches(camera, 1e-4);
        camera.projection =
            glm::frustum(-0.02, 0.1, -0.01, 0.07, 0.1, 50.0); // off-centre: aperture offsets, tiles
        expectMatches(camera, 1e-4);
    }
}

TEST(Camera, OrthographicRaysMatchTheMatrices) {
    std::mt19937 random(2);
    for (int i = 0; i < 50; ++i) {
        expectMatches({someView(random, 10), glm::ortho(-3.0, 5.0, -2.0, 2.5, 0.5, 40.0)}, 1e-4);
        expectMatches({someView(random, 10), glm::ortho(-3.0, 5.0, -2.0, 2.5, -20.0, 40.0)}, 1e-4);
    }
}

TEST(Camera, KeepsPrecisionFarFromTheOrigin) {
    // A near plane at 1e-4, seen from 1e6 away from the world's origin: unprojecting two points in float
    // would fail.
    const glm::dvec3 eye(1e6, -1e6, 1e6);
    const CameraDesc camera{glm::lookAt(eye, eye + glm::dvec3(1, 2, 3), glm::dvec3(0, 1, 0)),
                            glm::perspective(0.8, 1.0, 1e-4, 1e6)};
    const CameraDesc atOrigin{glm::lookAt(glm::dvec3(0), glm::dvec3(1, 2, 3), glm::dvec3(0, 1, 0)),
                              camera.projection};
    const auto record = cameraRecord(camera), expected = cameraRecord(atOrigin);
    ASSERT_TRUE(record && expected);
    for (glm::dvec2 ndc : {glm::dvec2(0), glm::dvec2(-1, 1), glm::dvec2(0.5, 0.25)}) {
        const glm::dvec3 error = rayOf(*record, ndc).direction - rayOf(*expected, ndc).direction;
        EXPECT_LT(glm::length(error), 1e-6);
    }
}

TEST(Camera, ViewsThatScale) {
    std::mt19937 random(3);
    for (double size : {0.01, 1.0, 250.0})
        expectMatches({glm::scale(glm::dmat4(1), glm::dvec3(size, size, size)) * someView(random, 10 / size),
                       glm::perspective(0.7, 1.5, 0.1, 50.0)},
                      1e-4);
}

TEST(Camera, InfiniteAndReversedDepth) {
    const glm::dmat4 view = glm::lookAt(glm::dvec3(1, 2, 3), glm::dvec3(0), glm::dvec3(0, 1, 0));
    const auto infinite = cameraRecord({view, glm::infinitePerspective(0.8, 1.0, 0.5)});
    ASSERT_TRUE(infinite);
    EXPECT_NEAR(infinite->nearDepth, 0.5, 1e-6);
    EXPECT_GT(infinite->farDepth, 1e30);
    glm::dmat4 reversed = glm::perspective(0.8, 1.0, 0.5, 20.0);
    for (int c = 0; c < 4; ++c)
        reversed[c].z = -reversed[c].z;
    const auto swapped = cameraRecord({view, reversed});
    ASSERT_TRUE(swapped);
    EXPECT_NEAR(swapped->nearDepth, 0.5, 1e-5);
    EXPECT_NEAR(swapped->farDepth, 20, 1e-4);
}

TEST(Camera, RejectsWhatCannotBeInverted) {
    const glm::dmat4 view(1), projection = glm::perspective(0.8, 1.0, 0.5, 20.0);
    EXPECT_FALSE(cameraRecord({glm::dmat4(0), projection}));
    EXPECT_FALSE(cameraRecord({view, glm::dmat4(0)}));
    EXPECT_FALSE(cameraRecord({glm::dmat4(std::nan("")), projection}));
    EXPECT_TRUE(cameraRecord({view, projection}));
}
