#include "testenv/bench/splat_scenes.h"

#include <cmath>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/scene/camera.h"
#include "renderer/splats/arrays.h"
#include "renderer/splats/splat_file.h"
#include "testenv/bench/statistics.h"
#include "testenv/common/numbers.h"

namespace hipr::bench {

namespace {

using test::Numbers;

glm::vec3 anyDirection(Numbers& random) {
    const float z = random(-1.f, 1.f), phi = random(0.f, 2.f * glm::pi<float>());
    const float r = std::sqrt(1.f - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

struct Ball {
    glm::vec3 center;
    float radius;
};
constexpr Ball Balls[] = {{{0.f, 0.6f, 0.f}, 0.6f},    {{-0.9f, 0.35f, 0.4f}, 0.35f},
                          {{0.8f, 0.3f, 0.6f}, 0.3f},  {{0.5f, 0.5f, -0.9f}, 0.5f},
                          {{-0.7f, 0.2f, 1.f}, 0.2f},  {{-1.2f, 0.7f, -0.8f}, 0.7f},
                          {{0.3f, 0.12f, 1.1f}, 0.12f}};
constexpr float FloorEdge = 4.f; // of a square around the origin

float area(const Ball& ball) {
    return 4.f * glm::pi<float>() * ball.radius * ball.radius;
}

void reserve(SplatCloud& cloud, size_t count) {
    forEachArray(cloud, count, [](auto& array, size_t length) { array.reserve(length); });
}

/// The shortest turn of the z axis to `direction`.
glm::quat fromZ(const glm::vec3& direction) {
    if (direction.z < -0.9999f) return {0, 1, 0, 0};
    return glm::normalize(glm::quat(1.f + direction.z, glm::cross(glm::vec3(0, 0, 1), direction)));
}

/// A flat splat on a surface; `spacing`: about how far splats are apart.
void addSplat(SplatCloud& cloud, Numbers& random, glm::vec3 position, glm::vec3 normal, float spacing) {
    cloud.positions.push_back(position);
    const glm::quat tilt = fromZ(normal);
    cloud.orientations.push_back(tilt * glm::angleAxis(random(0.f, glm::pi<float>()), glm::vec3(0, 0, 1)));
    // Captures have few large splats and many small ones.
    const auto edge = [&] {
        return spacing * std::exp2(random(-1.5f, 0.5f) + 2.f * std::pow(random(0.f, 1.f), 8.f));
    };
    const float x = edge(), y = edge();
    cloud.scales.emplace_back(x, y, 0.1f * std::min(x, y));
    const float u = random(0.f, 1.f);
    cloud.opacities.push_back(0.003f + 0.997f * std::sqrt(u));
    const glm::vec3 tint = 0.8f * glm::sin(6.f * position + glm::vec3(0.f, 2.f, 4.f));
    for (uint32_t k = 0; k < shCoefficients(cloud.shDegree); ++k) {
        const float s = k == 0 ? 0.3f : 0.08f;
        const glm::vec3 noise(random(-s, s), random(-s, s), random(-s, s));
        cloud.coefficients.push_back(k == 0 ? tint + noise : noise);
    }
}

} // namespace

SplatScene capturedSplats(const std::string& path) {
    SplatScene scene;
    scene.name = std::filesystem::path(path).stem().string();
    SplatReadOptions options;
    options.name = path;
    options.messages = [](Severity, const std::string& subject, const std::string& text) {
        std::cerr << subject << ": " << text << "\n";
    };
    try {
        scene.loadSeconds = timed([&] { scene.cloud = readSplatFile(path, options); }).clock;
    } catch (const SplatFileError& e) {
        throw std::runtime_error(path + " " + e.what());
    }
    scene.objectToWorld = glm::mat4x3(-1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, 0);
    return scene;
}

SplatScene syntheticSplats(size_t count) {
    SplatScene scene;
    scene.name = "synthetic " + std::to_string(count);
    scene.cloud.name = scene.name;
    scene.cloud.shDegree = 3;
    reserve(scene.cloud, count);
    float total = FloorEdge * FloorEdge;
    for (const Ball& ball : Balls)
        total += area(ball);
    const float spacing = std::sqrt(total / float(count));
    Numbers random(1);
    for (size_t i = 0; i < count; ++i) {
        float where = random(0.f, total) - FloorEdge * FloorEdge;
        if (where < 0.f) {
            const float half = FloorEdge / 2, x = random(-half, half), z = random(-half, half);
            addSplat(scene.cloud, random, {x, 0.f, z}, {0, 1, 0}, spacing);
            continue;
        }
        const Ball* ball = Balls;
        while (ball + 1 != std::end(Balls) && where > area(*ball))
            where -= area(*ball++);
        const glm::vec3 normal = anyDirection(random);
        addSplat(scene.cloud, random, ball->center + ball->radius * normal, normal, spacing);
    }
    return scene;
}

SplatCloud splatBall(size_t count) {
    SplatCloud cloud;
    cloud.name = "ball";
    cloud.shDegree = 3;
    reserve(cloud, count);
    const Ball ball{{0.95f, 0.75f, 0.6f}, 0.38f};
    Numbers random(2);
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 normal = anyDirection(random);
        addSplat(cloud, random, ball.center + ball.radius * normal, normal,
                 std::sqrt(area(ball) / float(count)));
    }
    return cloud;
}

SplatView splatView(uint32_t width, uint32_t height, int turn) {
    CameraDesc camera;
    const glm::dvec3 eye(1e-6 * turn, 1.1, 2.6);
    camera.worldToView = glm::lookAt(eye, glm::dvec3(0, 0.5, 0), glm::dvec3(0, 1, 0));
    camera.projection = glm::perspective(glm::radians(60.0), double(width) / height, 0.2, 1000.0);
    const auto record = cameraRecord(camera);
    if (!record) throw std::runtime_error("the camera cannot be used");
    SplatView view;
    view.camera = *record;
    view.width = width;
    view.height = height;
    return view;
}

} // namespace hipr::bench
