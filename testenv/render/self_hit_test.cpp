// Surfaces of any size and shape do not hit themselves.
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

/// A white floor that glows with radiance 1, seen from near its middle: nothing else can light it.
class GlowingFloor : public Stage {
public:
    explicit GlowingFloor(const glm::mat4x3& transform) : Stage(settingsOf()) {
        MaterialDesc material = matte(glm::vec3(1.f));
        material.emissiveColor = constantColor(glm::vec3(1.f));
        add(quadMesh(), material, {transform});
        LightDesc off; // keeps the camera's light away
        off.kind = LightKind::Sphere;
        off.visible = false;
        Stage::add(off);
        film(48, 48);
    }
    using Stage::add;

    /// The share of pixels that are brighter than the floor's own light.
    double lit(glm::dvec3 eye, glm::dvec3 target) {
        edit.setCamera(lookAt(eye, target, 40));
        render();
        const ColorPicture picture = color();
        size_t lit = 0, seen = 0;
        for (const glm::vec4& pixel : picture.values) {
            if (pixel.w < 1.f) continue;
            ++seen;
            if (pixel.x > 1.f + 1e-5f) ++lit;
        }
        EXPECT_GT(seen, picture.values.size() / 2);
        return double(lit) / double(seen);
    }

private:
    static Settings settingsOf() {
        Settings settings;
        settings.samples = 16;
        settings.maxDepth = 4;
        return settings;
    }
};

/// Turned about the axis (1, 1, 1), so that no coordinate is special.
glm::mat4x3 turned(float x, float y) {
    const glm::mat4 turn = glm::rotate(glm::mat4(1.f), 0.7f, glm::normalize(glm::vec3(1, 1, 1)));
    return glm::mat4x3(turn * glm::scale(glm::mat4(1.f), {x, y, x}));
}

TEST(SelfHit, WideFloors) {
    for (const float width : {2.f, 200.f, 2000.f, 200000.f})
        EXPECT_EQ(GlowingFloor(scaling(width, width, width)).lit({3e-1, 2e-1, 2e-1}, {0, 0, 0}), 0.0)
            << width;
}

TEST(SelfHit, FloorsWithoutASpecialCoordinate) {
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1, 1, 1))));
    for (const float width : {2.f, 2000.f})
        EXPECT_EQ(GlowingFloor(turned(width, width)).lit(turn * glm::dvec3(0.3, 0.2, 0.2), {0, 0, 0}), 0.0)
            << width;
}

TEST(SelfHit, Strips) {
    EXPECT_EQ(GlowingFloor(turned(2000, 100)).lit(glm::dvec3(1, 3, 30), {0, 0, 0}), 0.0);
}

} // namespace
