// Motion while the shutter is open, against what geometry says: how long each pixel was covered.
#include <gtest/gtest.h>

#include <cmath>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

constexpr uint32_t Side = 64;
constexpr double Distance = 4, FieldOfView = 40;
const Shutter Half{0.0, 0.5}; ///< frames

/// World units that a pixel is wide where z is 0.
double pixelSize() {
    return 2 * Distance * std::tan(glm::radians(FieldOfView / 2)) / Side;
}

double worldX(double pixel) {
    return (pixel - 0.5 * Side) * pixelSize();
}

CameraDesc camera(const Shutter& shutter = Half) {
    CameraDesc desc = lookAt({0, 0, Distance}, {0, 0, 0}, FieldOfView);
    desc.shutter = shutter;
    return desc;
}

InstancesDesc moving(const glm::mat4x3& from, const glm::mat4x3& to, float close = 0.5f) {
    InstancesDesc desc;
    desc.transforms = {from};
    desc.motion.times = {0.f, close};
    desc.motion.transforms = {{from}, {to}};
    return desc;
}

glm::mat4x3 turned(double degrees, const glm::mat4x3& first) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), glm::radians(degrees), glm::dvec3(0, 0, 1));
    return glm::mat4x3(glm::mat4(turn)) * glm::mat4(first);
}

/// A scene of one glowing object, whose coverage is the picture's alpha.
class Glow : public Stage {
public:
    explicit Glow(std::shared_ptr<const TriangleMesh> mesh, const CameraDesc& camera, int samples = 256,
                  const std::string& mode = "delta")
        : Stage(boxFiltered(samples, mode)) {
        MaterialDesc glow = matte(glm::vec3(0.f));
        glow.emissiveColor = constantColor(glm::vec3(1.f));
        object = add(std::move(mesh), glow);
        LightDesc off;
        off.name = "/off";
        off.visible = false;
        add(off);
        edit.setCamera(camera);
        film(Side, Side, {{AovKind::Color, {}}, {AovKind::CameraDepth, {}}});
    }
    ColorPicture picture(const InstancesDesc& instances) {
        edit.setInstances(object, instances);
        render();
        return color();
    }
    ObjectId object;
};

/// The share of the shutter's time for which a pixel around `x` is covered by an interval that goes from [a,
/// b] to [c, d].
double covered(double x, double a, double b, double c, double d) {
    constexpr int Times = 1000, Places = 16;
    int inside = 0;
    for (int i = 0; i < Times * Places; ++i) {
        const double t = (i / Places + 0.5) / Times,
                     at = x + ((i % Places + 0.5) / Places - 0.5) * pixelSize();
        inside += at >= a + t * (c - a) && at <= b + t * (d - b);
    }
    return double(inside) / (Times * Places);
}

void expectRow(const ColorPicture& picture, double a, double b, double c, double d) {
    for (uint32_t x = 0; x < Side; ++x)
        EXPECT_NEAR(picture.at(x, Side / 2).w, covered(worldX(x + 0.5), a, b, c, d), 0.04) << x;
}

double meanDifference(const ColorPicture& a, const ColorPicture& b) {
    double sum = 0;
    for (size_t i = 0; i < a.values.size(); ++i)
        sum += std::abs(a.values[i].w - b.values[i].w);
    return sum / double(a.values.size());
}

TEST(MotionBlur, AnEdgeThatMovesIsARamp) {
    Glow stage(quadMesh(), camera());
    expectRow(stage.picture(moving(translation(-0.6f, 0, 0), translation(0.5f, 0, 0))), -1.1, -0.1, 0, 1);
}

TEST(MotionBlur, OnlyWhatTheShutterSeesOfAMotion) {
    CameraDesc late = camera({0.25, 0.5});
    Glow stage(quadMesh(), late);
    const auto instances = moving(translation(-0.6f, 0, 0), translation(0.6f, 0, 0), 1.f);
    expectRow(stage.picture(instances), -0.8, 0.2, -0.5, 0.5);
    late.shutter = {-2, -1}; // before the first sample it stands still
    stage.edit.setCamera(late);
    stage.render();
    expectRow(stage.color(), -1.1, -0.1, -1.1, -0.1);
}

TEST(MotionBlur, SamplesAtUnevenTimesAreMet) {
    Glow stage(quadMesh(), camera({0, 1}));
    InstancesDesc instances = moving(translation(-0.6f, 0, 0), translation(-0.6f, 0, 0), 1.f);
    instances.motion.times = {0.f, 0.3f, 1.f}; // waits, then moves
    instances.motion.transforms = {{instances.transforms}, {instances.transforms}, {translation(0.5f, 0, 0)}};
    const ColorPicture picture = stage.picture(instances);
    for (uint32_t x = 0; x < Side; ++x) {
        const double at = worldX(x + 0.5), still = covered(at, -1.1, -0.1, -1.1, -0.1);
        EXPECT_NEAR(picture.at(x, Side / 2).w, 0.3 * still + 0.7 * covered(at, -1.1, -0.1, 0, 1), 0.04) << x;
    }
}

TEST(MotionBlur, LightIsKept) {
    Glow stage(sphereMesh(), camera(), 64);
    const auto ball = [](float x) { return placed(scaling(0.25f, 0.25f, 0.25f), x, 0.1f, 0); };
    InstancesDesc still;
    still.transforms = {ball(0.f)};
    const float sharp = mean(stage.picture(still)).x;
    const float blurred = mean(stage.picture(moving(ball(-0.5f), ball(0.5f)))).x;
    EXPECT_NEAR(blurred / sharp, 1.0, 0.01);
}

/// A bar that turns by 120 degrees, against the mean of many pictures of it at rest.
TEST(MotionBlur, ATurnIsTheMeanOfAllItsMoments) {
    constexpr int Moments = 96, Samples = 8;
    const glm::mat4x3 bar = scaling(1.8f, 0.3f, 1.f);
    Glow stage(quadMesh(), camera(), Moments * Samples);
    const ColorPicture blurred = stage.picture(moving(turned(0, bar), turned(120, bar)));
    stage.settings(boxFiltered(Samples));
    std::vector<double> sum(blurred.values.size(), 0.0);
    for (int i = 0; i < Moments; ++i) {
        InstancesDesc still;
        still.transforms = {turned(120 * (i + 0.5) / Moments, bar)};
        const ColorPicture moment = stage.picture(still);
        for (size_t p = 0; p < sum.size(); ++p)
            sum[p] += moment.values[p].w / Moments;
    }
    double difference = 0, variance = 0;
    for (size_t p = 0; p < sum.size(); ++p) {
        difference += std::pow(blurred.values[p].w - sum[p], 2);
        // Of as many independent samples, twice; and moments that start half a step early or late.
        variance +=
            2 * sum[p] * (1 - sum[p]) / (Moments * Samples) + (sum[p] > 0 ? 0.25 / (Moments * Moments) : 0);
    }
    EXPECT_LT(difference, 1.2 * variance);
    EXPECT_GT(variance, 0);
}

TEST(MotionBlur, ACameraThatMovesSeesWhatMovesTheOtherWay) {
    Glow first(quadMesh(), camera());
    const ColorPicture object = first.picture(moving(translation(0, 0, 0), translation(0.5f, 0.2f, -0.3f)));
    CameraDesc desc = camera();
    desc.motion = {{0.f, desc.worldToView},
                   {0.5f, glm::translate(desc.worldToView, glm::dvec3(0.5, 0.2, -0.3))}};
    Glow second(quadMesh(), desc);
    second.render();
    EXPECT_LT(meanDifference(object, second.color()), 1e-3);

    desc.motion[1].worldToView =
        glm::rotate(glm::dmat4(1), glm::radians(50.), glm::dvec3(0, 0, 1)) * desc.worldToView;
    second.edit.setCamera(desc);
    second.render();
    const ColorPicture turning = second.color();
    const ColorPicture turn =
        first.picture(moving(turned(0, glm::mat4x3(1.f)), turned(50, glm::mat4x3(1.f))));
    EXPECT_LT(meanDifference(turn, turning), 1e-3);
}

std::shared_ptr<TriangleMesh> wideningQuad() {
    auto mesh = std::make_shared<TriangleMesh>(*quadMesh());
    mesh->motion = {{0.f, mesh->positions, mesh->normals}, {0.5f, mesh->positions, mesh->normals}};
    for (glm::vec3& p : mesh->motion[1].positions)
        if (p.x > 0) p.x = 1.2f;
    mesh->boundsMax.x = 1.2f;
    return mesh;
}

TEST(MotionBlur, AMeshThatDeforms) {
    Glow stage(wideningQuad(), camera());
    stage.render();
    expectRow(stage.color(), -0.5, 0.5, -0.5, 1.2);
}

TEST(MotionBlur, FirstHitsAreThoseAtTheFrame) {
    const auto depthAt = [](const Shutter& shutter) {
        Glow stage(quadMesh(), camera(shutter), 1);
        InstancesDesc instances = moving(translation(0, 0, 0), translation(0, 0, 1), 1.f);
        stage.picture(instances);
        return stage.read<float>(AovKind::CameraDepth).at(Side / 2, Side / 2);
    };
    EXPECT_NEAR(depthAt({0, 1}), 4.f, 1e-5);
    EXPECT_NEAR(depthAt({-1, 1}), 4.f, 1e-5);
    EXPECT_NEAR(depthAt({0.5, 1}), 3.5f, 1e-5); // the frame is over before it opens
}

TEST(MotionBlur, NothingMovesBehindAClosedShutterOrWithoutTheSetting) {
    const auto instances = moving(translation(0, 0, 0), translation(0.5f, 0, 0));
    InstancesDesc still;
    still.transforms = instances.transforms;
    Glow stage(wideningQuad(), camera({0, 0}), 16), sharp(quadMesh(), camera({0, 0}), 16);
    const ColorPicture expected = sharp.picture(still);
    EXPECT_TRUE(sameBits(stage.picture(instances), expected));
    stage.edit.setCamera(camera());
    stage.render();
    EXPECT_FALSE(sameBits(stage.color(), expected));
    Settings off = boxFiltered(16);
    off.motionBlur = false;
    stage.settings(off);
    stage.render();
    EXPECT_TRUE(sameBits(stage.color(), expected));
}

/// A scene with all kinds of motion, lit, with shadows and a mirror.
struct Busy : Stage {
    explicit Busy(const Settings& settings, float goal = 0.7f, const Shutter& shutter = {-0.25, 0.25},
                  float wide = 1.2f)
        : Stage(settings) {
        addFloor(*this);
        ball = add(sphereMesh(16), mirror());
        auto mesh = wideningQuad();
        for (glm::vec3& p : mesh->motion[1].positions)
            if (p.x > 0) p.x = wide;
        quad = add(mesh, matte({0.8f, 0.3f, 0.2f}));
        add(lampAbove({0, 3, 0}, 1, 5));
        film(48, 48);
        move(goal);
        view(shutter);
    }
    void move(float goal) {
        edit.setInstances(ball, moving(placed(scaling(0.4f, 0.4f, 0.4f), -0.7f, -0.3f, 0),
                                       placed(scaling(0.4f, 0.4f, 0.4f), goal, -0.2f, 0.5f), 0.25f));
        edit.setInstances(quad, moving(turned(0, translation(0, 0.4f, -0.5f)),
                                       turned(70, translation(0, 0.4f, -0.5f)), 0.5f));
    }
    void view(const Shutter& shutter) {
        CameraDesc desc = camera(shutter);
        desc.motion = {{-0.25f, desc.worldToView},
                       {0.25f, glm::translate(desc.worldToView, glm::dvec3(0.1, 0, 0.3))}};
        edit.setCamera(desc);
    }
    ColorPicture picture() {
        render();
        return color();
    }
    ObjectId ball, quad;
};

TEST(MotionBlur, AllTraversalsAndModesGiveOnePicture) {
    Settings settings = boxFiltered(8);
    Busy stage(settings);
    const ColorPicture expected = stage.picture();
    save(expected, "motion_blur");
    for (const char* traversal : {"bvh", "rayquery", "host"}) {
        settings.traversal = traversal;
        settings.mode = std::string(traversal) == "bvh" ? "uniform" : "paper";
        Busy other(settings);
        EXPECT_TRUE(sameBits(other.picture(), expected)) << traversal;
        bool told = false;
        for (const Message& message : other.messages())
            told |= message.text.find("ray query knows nothing of motion") != std::string::npos;
        EXPECT_EQ(told, std::string(traversal) == "rayquery" && other.renderer->device().rayQuery)
            << traversal;
    }
}

TEST(MotionBlur, EditsGiveThePictureOfAFreshScene) {
    for (const char* mode : {"delta", "paper"}) {
        const Settings settings = boxFiltered(4, mode);
        Busy stage(settings);
        stage.picture();
        const auto expectFresh = [&](Busy& fresh, const char* what) {
            EXPECT_TRUE(sameBits(stage.picture(), fresh.picture())) << mode << ": " << what;
        };
        stage.move(0.2f);
        Busy key(settings, 0.2f);
        expectFresh(key, "one key of an instance");
        stage.view({0, 0.1});
        Busy shutter(settings, 0.2f, {0, 0.1});
        expectFresh(shutter, "the shutter");
        stage.view({0, 0});
        Busy closed(settings, 0.2f, {0, 0});
        expectFresh(closed, "the shutter closes");
        stage.view({-0.25, 0.25});
        Busy open(settings, 0.2f);
        expectFresh(open, "the shutter opens");
    }
}

TEST(MotionBlur, MotionThatIsNotCompleteIsNamedAndLeftOut) {
    Glow stage(quadMesh(), camera(), 4);
    InstancesDesc instances = moving(translation(0, 0, 0), translation(1, 0, 0));
    instances.motion.transforms[1].clear();
    const ColorPicture picture = stage.picture(instances);
    InstancesDesc still;
    still.transforms = instances.transforms;
    EXPECT_TRUE(sameBits(picture, stage.picture(still)));
    bool told = false;
    for (const Message& message : stage.messages())
        told |= message.text.find("not complete") != std::string::npos;
    EXPECT_TRUE(told);
}

/// The AOV motion of a stage that has rendered, in world units.
Picture<glm::vec2> motionOf(Stage& stage) {
    stage.film(Side, Side, {{AovKind::Color, {}}, {AovKind::Motion, {}}});
    stage.render();
    Picture<glm::vec2> motion = stage.read<glm::vec2>(AovKind::Motion);
    for (glm::vec2& vector : motion.values)
        vector *= float(pixelSize());
    return motion;
}

void expectVector(const glm::vec2& found, glm::vec2 expected) {
    EXPECT_NEAR(found.x, expected.x, 1e-4);
    EXPECT_NEAR(found.y, expected.y, 1e-4);
}

TEST(MotionVectors, GoFromWhereThingsAreToWhereTheyWillBe) {
    Glow object(quadMesh(), camera(), 1);
    object.picture(moving(translation(0, 0, 0), translation(0.5f, -0.2f, 0)));
    const auto motion = motionOf(object);
    expectVector(motion.at(Side / 2, Side / 2), {0.5f, -0.2f});
    expectVector(motion.at(0, 0), {0, 0});

    CameraDesc desc = camera();
    desc.motion = {{0.f, desc.worldToView},
                   {0.5f, glm::translate(desc.worldToView, glm::dvec3(0.5, -0.2, 0))}};
    Glow seen(quadMesh(), desc, 1);
    seen.render();
    expectVector(motionOf(seen).at(Side / 2, Side / 2), {0.5f, -0.2f});

    Glow wide(wideningQuad(), camera(), 1);
    wide.render();
    const auto widening = motionOf(wide);
    for (uint32_t x = Side / 2 - 8; x < Side / 2 + 8; ++x)
        expectVector(widening.at(x, Side / 2), {0.7f * float(worldX(x + 0.5) + 0.5), 0});
}

TEST(MotionVectors, AreNoneBehindAClosedShutter) {
    Glow stage(quadMesh(), camera({0, 0}), 1);
    stage.picture(moving(translation(0, 0, 0), translation(0.5f, -0.2f, 0)));
    expectVector(motionOf(stage).at(Side / 2, Side / 2), {0, 0});
}

} // namespace
