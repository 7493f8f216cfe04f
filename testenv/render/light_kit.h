/// @file light_kit.h
/// A floor under lights, for tests that compare one kind of light with another.
#pragma once

#include <cmath>

#include <gtest/gtest.h>

#include "testenv/render/scene_kit.h"

namespace hipr::test {

constexpr float FloorAlbedo = 0.5f;

inline MaterialDesc glowing(glm::vec3 emission) {
    MaterialDesc material = matte(glm::vec3(0.f));
    material.emissiveColor = constantColor(emission);
    return material;
}

/// A square of a width of `width` at (x, 0, z) that faces down.
inline glm::mat4x3 ceiling(float width, float z, float x = 0.f) {
    return placed(glm::mat4x3({width, 0, 0}, {0, -width, 0}, {0, 0, -1}, {0, 0, 0}), x, 0.f, z);
}

inline LightDesc rectLight(const glm::mat4x3& transform, glm::vec3 radiance) {
    LightDesc light;
    light.kind = LightKind::Rect;
    light.transform = glm::dmat4(glm::mat4(glm::vec4(transform[0], 0), glm::vec4(transform[1], 0),
                                           glm::vec4(-transform[2], 0), glm::vec4(transform[3], 1)));
    light.color = radiance;
    return light;
}

/// Rect lights are off by up to 0.2 % where they fill few solid angles: these are sums of angles in single
/// precision.
constexpr double RectSlack = 0.0025;

/// Mean and variance of the pixels.
struct Shown {
    glm::dvec3 mean{0.0};
    double variance = 0.0; ///< of the green channel
    double error() const { return std::sqrt(variance / 256.0); }
};

/// A floor at z = 0, of which some square millimetres are seen, so that all pixels have one truth.
class Floor : public Stage {
public:
    explicit Floor(int samples = 64, MaterialDesc floor = matte(glm::vec3(FloorAlbedo)), int depth = 1)
        : Stage(settingsOf(samples, depth)) {
        floor.name = "/floor/look";
        ObjectDesc desc;
        desc.categories = {"floor"};
        add(quadMesh(), floor, {scaling(40, 40, 1)}, desc);
        LightDesc off; // keeps the camera's light away
        off.kind = LightKind::Sphere;
        off.visible = false;
        Stage::add(off);
        edit.setCamera(lookAt({0, 0.001, 0.3}, {0, 0, 0}, 1));
        film(16, 16);
    }
    using Stage::add;
    Shown shown() {
        render();
        const ColorPicture picture = color();
        Shown result;
        for (const glm::vec4& v : picture.values)
            result.mean += glm::dvec3(v) / double(picture.values.size());
        for (const glm::vec4& v : picture.values)
            result.variance += std::pow(double(v.y) - result.mean.y, 2.0) / double(picture.values.size() - 1);
        return result;
    }

    static Settings settingsOf(int samples, int depth) {
        Settings settings;
        settings.samples = samples;
        settings.maxDepth = depth;
        return settings;
    }
};

inline void expectSame(const Shown& a, const Shown& b, double slack = 0.0) {
    const double sigma = std::sqrt(a.error() * a.error() + b.error() * b.error());
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(a.mean[c], b.mean[c], 3.0 * sigma + slack * b.mean[c] + 1e-4 * b.mean[c]) << c;
}

} // namespace hipr::test
