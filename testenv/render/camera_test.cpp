// Lens, clipping planes and exposure, against what optics says.
#include <gtest/gtest.h>

#include <cmath>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

constexpr uint32_t Side = 64;
constexpr int Many = 1024, Few = 16;             // samples
constexpr double Distance = 4, FieldOfView = 40; // of the camera from the dot; degrees

/// A glowing square in the middle of a black picture.
class Dot : public Stage {
public:
    explicit Dot(const CameraDesc& camera, int samples = Many, const std::string& mode = "delta")
        : Stage(boxFiltered(samples, mode)) {
        MaterialDesc glow = matte(glm::vec3(0.f));
        glow.emissiveColor = constantColor(glm::vec3(100.f));
        add(quadMesh(), glow, {scaling(Size, Size, 1)});
        LightDesc off;
        off.name = "/off";
        off.visible = false;
        add(off);
        edit.setCamera(camera);
        film(Side, Side);
    }
    static constexpr float Size = 0.2f;
};

CameraDesc camera(Lens lens = {}) {
    CameraDesc desc = lookAt({0, 0, Distance}, {0, 0, 0}, FieldOfView);
    desc.lens = lens;
    return desc;
}

/// Pixels a length at a distance from the camera has in the picture.
double pixelsOf(double length, double distance) {
    return length / (distance * std::tan(glm::radians(FieldOfView / 2))) * Side / 2;
}

struct Moments {
    double sum = 0;
    glm::dvec2 mean{0}, variance{0}; // in pixels
};

Moments momentsOf(const ColorPicture& picture) {
    Moments m;
    glm::dvec2 squares(0);
    for (uint32_t y = 0; y < picture.height; ++y)
        for (uint32_t x = 0; x < picture.width; ++x) {
            const glm::dvec2 p(x + 0.5 - 0.5 * Side, y + 0.5 - 0.5 * Side);
            const double value = picture.at(x, y).x;
            m.sum += value;
            m.mean += value * p;
            squares += value * p * p;
        }
    m.mean /= m.sum;
    m.variance = squares / m.sum - m.mean * m.mean;
    return m;
}

/// Variance of the picture of the dot, of the pixels (a box) and of the square itself, without blur.
double sharpVariance() {
    const double size = pixelsOf(Dot::Size, Distance);
    return (1 + size * size) / 12;
}

ColorPicture pictureOf(Stage& stage) {
    stage.render();
    return stage.color();
}

} // namespace

// A point out of focus becomes the image of the aperture: R |z - f| / z at the distance f.
TEST(Camera, BlursByTheCircleOfConfusion) {
    for (double focus : {2.0, 8.0}) {
        Dot dot(camera({0.4, focus}));
        const ColorPicture picture = pictureOf(dot);
        save(picture, "circle_of_confusion");
        const Moments m = momentsOf(picture);
        const double radius = pixelsOf(0.4 * std::abs(Distance - focus) / Distance, focus);
        const double expected = radius * radius / 4 + sharpVariance(); // of a disk, per axis
        EXPECT_NEAR(m.variance.x, expected, 0.02 * expected) << focus;
        EXPECT_NEAR(m.variance.y, expected, 0.02 * expected) << focus;
        EXPECT_NEAR(m.mean.x, 0, 0.15);
        EXPECT_NEAR(m.mean.y, 0, 0.15);
    }
}

TEST(Camera, IsSharpInFocusAndLosesNoLight) {
    Dot pinhole(camera()), focused(camera({0.4, Distance})), blurred(camera({0.4, 2}));
    const Moments sharp = momentsOf(pictureOf(pinhole)), inFocus = momentsOf(pictureOf(focused));
    EXPECT_NEAR(sharp.variance.x, sharpVariance(), 0.02);
    EXPECT_NEAR(inFocus.variance.x, sharp.variance.x, 0.02);
    EXPECT_NEAR(inFocus.sum, sharp.sum, 0.02 * sharp.sum);
    EXPECT_NEAR(momentsOf(pictureOf(blurred)).sum, sharp.sum, 0.02 * sharp.sum);
}

// A regular polygon of n corners at R has variance R^2 (2 + cos(2 pi / n)) / 12 along any axis, n > 2.
TEST(Camera, BladesMakePolygons) {
    for (int blades : {3, 4, 6}) {
        Dot dot(camera({0.4, 2, blades, 0.f}));
        const ColorPicture picture = pictureOf(dot);
        save(picture, "blades_" + std::to_string(blades));
        const double radius = pixelsOf(0.4 * 0.5, 2);
        const double expected =
            radius * radius * (2 + std::cos(2 * glm::pi<double>() / blades)) / 12 + sharpVariance();
        const Moments m = momentsOf(picture);
        EXPECT_NEAR(m.variance.x, expected, 0.03 * expected) << blades;
        EXPECT_NEAR(m.variance.y, expected, 0.03 * expected) << blades;
    }
}

// A triangle points one way: turned by 180 degrees its picture is the mirror image. Focused nearer than the
// dot, what the lens is to the right of shows on the right.
TEST(Camera, BladesTurn) {
    const uint32_t middle = Side / 2, corner = uint32_t(0.95 * pixelsOf(0.4 * 0.5, 2));
    Dot right(camera({0.4, 2, 3, 0.f})), left(camera({0.4, 2, 3, 180.f}));
    const ColorPicture a = pictureOf(right), b = pictureOf(left);
    EXPECT_GT(a.at(middle + corner, middle).x, 0.f);
    EXPECT_EQ(a.at(middle - corner, middle).x, 0.f);
    EXPECT_EQ(b.at(middle + corner, middle).x, 0.f);
    EXPECT_GT(b.at(middle - corner, middle).x, 0.f);
}

// Units: a view that scales the world by 3 sees the same, lens and focus being lengths of the world.
TEST(Camera, LensIsMeasuredInTheWorld) {
    CameraDesc scaled = camera({0.4, 2});
    scaled.worldToView = glm::scale(glm::dmat4(1), glm::dvec3(3)) * scaled.worldToView;
    Dot dot(scaled), plain(camera({0.4, 2}));
    const Moments m = momentsOf(pictureOf(dot)), expected = momentsOf(pictureOf(plain));
    EXPECT_NEAR(m.variance.x, expected.variance.x, 0.01 * expected.variance.x);
    EXPECT_NEAR(m.sum, expected.sum, 0.01 * expected.sum);
}

TEST(Camera, WrongLensesArePinholes) {
    const double nan = std::nan("");
    Dot pinhole(camera(), Few);
    const ColorPicture expected = pictureOf(pinhole);
    for (Lens lens : {Lens{nan, 2}, Lens{0.4, nan}, Lens{-1, 2}, Lens{0.4, 0}, Lens{0, 2, 5, 0.f}}) {
        Dot dot(camera(lens), Few);
        EXPECT_TRUE(sameBits(pictureOf(dot), expected)) << lens.radius << ' ' << lens.focusDistance;
    }
}

// The right half of a wall is cut away, also for the first hits; what is cut away still casts its shadow.
TEST(Camera, ClipPlanesCutAwayWhatIsSeen) {
    CameraDesc cut = lookAt({0, 0, 4}, {0, 0, 0});
    Stage stage;
    stage.add(quadMesh(), matte(glm::vec3(0.5f)), {scaling(10, 10, 1)});
    stage.edit.setCamera(cut);
    stage.film(32, 32, {{AovKind::Color, {}}, {AovKind::CameraDepth, {}}});
    stage.render();
    EXPECT_GT(stage.color().at(24, 16).w, 0.f);
    cut.clipPlanes = {{-1, 0, 0, 0}}; // keeps x <= 0 of the view
    stage.edit.setCamera(cut);
    stage.render();
    const ColorPicture picture = stage.color();
    const Picture<float> depth = stage.read<float>(AovKind::CameraDepth);
    EXPECT_EQ(picture.at(24, 16).w, 0.f);
    EXPECT_EQ(picture.at(8, 16).w, 1.f);
    EXPECT_EQ(depth.at(24, 16), 0.f);
    EXPECT_NEAR(depth.at(8, 16), 4.f, 1e-4f);
    cut.clipPlanes = {{0, 0, -1, -4.5}, {0, 0, 1, 100}}; // keeps z <= -4.5: the wall at -4 is too near
    stage.edit.setCamera(cut);
    stage.render();
    EXPECT_EQ(mean(stage.color()).w, 0.f);
    cut.clipPlanes = {{0, 0, -1, -3.5}};
    stage.edit.setCamera(cut);
    stage.render();
    EXPECT_EQ(mean(stage.color()).w, 1.f);
}

// Light that a clipped blocker keeps away stays away.
TEST(Camera, ClippedObjectsCastShadows) {
    float lit[2];
    for (int clipped = 0; clipped < 2; ++clipped) {
        Stage stage;
        stage.add(quadMesh(), matte(glm::vec3(0.5f)), {scaling(10, 10, 1)});
        stage.add(quadMesh(), matte(glm::vec3(0.5f)), {placed(scaling(10, 10, 1), 0, 0, 2)});
        LightDesc sun;
        sun.kind = LightKind::Distant;
        stage.add(sun);
        CameraDesc desc = lookAt({0, 0, 4}, {0, 0, 0});
        desc.clipPlanes = {{0, 0, -1, -3}};
        if (!clipped) stage.edit.setCamera(lookAt({0, 0, 1.5}, {0, 0, 0}));
        if (clipped) stage.edit.setCamera(desc);
        stage.film(8, 8);
        stage.render();
        lit[clipped] = mean(stage.color()).x;
        EXPECT_EQ(mean(stage.color()).w, 1.f);
    }
    EXPECT_EQ(lit[0], 0.f);
    EXPECT_EQ(lit[1], 0.f);
}

// The exposure is a factor on the finished picture: no path is traced for it.
TEST(Camera, ExposureMultipliesAndCostsNoSample) {
    Dot dot(camera(), Few);
    const ColorPicture before = pictureOf(dot);
    const uint64_t paths = dot.renderer->progress().pathsTraced;
    CameraDesc brighter = camera();
    brighter.exposure = 2.5f;
    dot.edit.setCamera(brighter);
    const ColorPicture after = pictureOf(dot);
    EXPECT_EQ(dot.renderer->progress().pathsTraced, paths);
    for (size_t i = 0; i < before.values.size(); ++i) {
        EXPECT_EQ(after.values[i].x, 2.5f * before.values[i].x);
        EXPECT_EQ(after.values[i].w, before.values[i].w);
    }
    Settings settings = dot.renderer->settings();
    settings.exposureCompensation = false;
    dot.settings(settings);
    EXPECT_TRUE(sameBits(pictureOf(dot), before));
    EXPECT_EQ(dot.renderer->progress().pathsTraced, paths);
}

// Behind the far plane is the sky, seen by the camera's own rays.
TEST(Camera, RaysEndAtTheFarPlaneInTheSky) {
    Settings settings;
    settings.samples = 4;
    Stage stage(settings);
    stage.add(skyLight(3.f));
    CameraDesc desc = camera();
    desc.projection = glm::perspective(1.0, 1.0, 0.1, 10.0);
    stage.edit.setCamera(desc);
    stage.film(16, 16);
    stage.render();
    const Progress progress = stage.renderer->progress();
    EXPECT_EQ(progress.pathsTraced, 16u * 16u * 4u);
    EXPECT_EQ(progress.nearestRays, progress.pathsTraced);
    for (const glm::vec4& pixel : stage.color().values)
        EXPECT_EQ(pixel.x, 3.f);
}

// Pulling the focus of a live picture ends in the picture that a new renderer makes.
TEST(Camera, RefocusingEqualsAFreshPicture) {
    for (const char* mode : {"uniform", "delta", "paper"}) {
        Dot live(camera({0.4, Distance}), Few, mode);
        live.render();
        live.edit.setCamera(camera({0.4, 2, 5, 20.f}));
        Dot fresh(camera({0.4, 2, 5, 20.f}), Few, mode);
        EXPECT_TRUE(sameBits(pictureOf(live), pictureOf(fresh))) << mode;
    }
}
