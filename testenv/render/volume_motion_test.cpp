// Volumes that move while the shutter is open, against closed forms and against the mean of their moments.
#include "testenv/render/volume_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

void move(Stage& stage, ObjectId object, const glm::mat4x3& from, const glm::mat4x3& to) {
    InstancesDesc places;
    places.transforms = {from};
    places.motion.times = {0.f, 1.f};
    places.motion.transforms = {{from}, {to}};
    stage.edit.setInstances(object, places);
}

void openShutter(Stage& stage, CameraDesc camera) {
    camera.shutter = {0.0, 1.0};
    stage.edit.setCamera(camera);
}

/// A cloud with colours and a glow of its own, lit from the side.
ObjectId addGlowingCloud(Box& box) {
    const auto density = [](glm::ivec3 p) { return 0.6f + 0.1f * float(p.x % 5); };
    const auto tint = [](glm::ivec3 p) { return p.y < 0 ? 0.2f : 0.9f; };
    const auto glow = [](glm::ivec3 p) { return 0.03f * float(p.z); };
    const glm::ivec3 lo(-10, -10, 0), hi(10, 10, 12);
    VolumeLook look = scattering(1.5f, 0.8f, 0.3f);
    look.emission = glm::vec3(0.5f);
    const ObjectId object = box.add(
        {makeField(lo, hi, 0.1, density), makeField(lo, hi, 0.1, glow), {}, makeField(lo, hi, 0.1, tint)},
        look);
    LightDesc sun;
    sun.name = "/sun";
    sun.kind = LightKind::Distant;
    sun.angle = 5.f;
    sun.intensity = 40.f;
    sun.transform = glm::rotate(glm::dmat4(1), glm::radians(50.0), glm::dvec3(0, 1, 0));
    box.stage.add(sun);
    box.stage.add(sky(0.3f));
    box.stage.edit.setCamera(lookAt({0.2, 0.1, 10}, {0.2, 0.1, 0}, 4));
    return object;
}

glm::mat4x3 turned(double degrees, double x) {
    return glm::mat4x3(glm::translate(glm::dmat4(1), glm::dvec3(x, 0, 0)) *
                       glm::rotate(glm::dmat4(1), glm::radians(degrees), glm::dvec3(0, 0, 1)));
}

} // namespace

/// The edge of a slab crosses the place that is seen: before it comes there is all light, then what the slab
/// leaves.
TEST(MovingVolumes, AnEdgeThatPassesIsTheShareOfItsTime) {
    Box box(1024);
    const ObjectId object = box.add({slab(1.f)}, absorbing(glm::vec3(1.f)));
    box.stage.add(sky());
    openShutter(box.stage, lookAt({0.03, 0.02, 10}, {0.03, 0.02, 0}, 0.5));
    // The density falls from 1 at x = 2.4 to 0 at 2.5; the way of the edge is 2 long.
    move(box.stage, object, translation(-3.45f, 0, 0), translation(-1.45f, 0, 0));
    const float depth = Spacing * Deep, left = std::exp(-depth), before = (1.f + 0.03f - 0.05f) / 2.f,
                crossing = 0.05f;
    const float expected = before + crossing * (1.f - left) / depth + (1.f - before - crossing) * left;
    EXPECT_NEAR(box.shown().x, expected, box.spread(expected) + 0.002f);
}

/// What scatters, glows and throws shadows, with fields of all kinds: moved and turned while light comes in.
TEST(MovingVolumes, AreTheMeanOfTheirMoments) {
    constexpr int Moments = 16;
    Box box(512, 4);
    const ObjectId object = addGlowingCloud(box);
    glm::vec4 sum(0.f);
    for (int i = 0; i < Moments; ++i) {
        const double t = (i + 0.5) / Moments;
        box.stage.edit.setInstances(object, {{turned(20 * t, 1.2 * t - 0.6)}, {}, {}, {}});
        sum += box.shown();
    }
    openShutter(box.stage, lookAt({0.2, 0.1, 10}, {0.2, 0.1, 0}, 4));
    move(box.stage, object, turned(0, -0.6), turned(20, 0.6));
    const glm::vec4 blurred = box.shown(), mean = sum / float(Moments);
    EXPECT_GT(mean.x, 0.1f);
    for (int c = 0; c < 4; ++c)
        EXPECT_NEAR(blurred[c], mean[c], 0.015f * mean[c]) << c;
}

TEST(MovingVolumes, EditsGiveThePictureOfAFreshStartInAllModes) {
    const auto picture = [](const char* mode, bool edited) {
        Box box(8, 3);
        Settings settings = makeSettings(8, 3);
        settings.mode = mode;
        box.stage.settings(settings);
        const ObjectId object = addGlowingCloud(box);
        if (edited) {
            box.shown();
            move(box.stage, object, turned(0, -0.2), turned(10, 0.4));
            box.shown();
        }
        openShutter(box.stage, lookAt({0.2, 0.1, 10}, {0.2, 0.1, 0}, 4));
        move(box.stage, object, turned(0, -0.6), turned(20, 0.6));
        box.shown();
        return box.stage.color();
    };
    const ColorPicture fresh = picture("uniform", false);
    EXPECT_TRUE(sameBits(fresh, picture("uniform", true)));
    EXPECT_TRUE(sameBits(fresh, picture("delta", true)));
}
