// Curves of round segments in pictures: where they are, what they are called, and that light treats them as
// any surface.
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/api/curves.h"
#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

std::shared_ptr<const TriangleMesh> built(CurvesDesc desc, bool round = true) {
    CurveForm form = curveForm(desc);
    form.round = round;
    size_t segments = 0; // of curves with two points each, or as chosen
    for (const int count : desc.vertexCounts)
        segments += size_t(std::max(count - 1, 0));
    if (form.steps.empty()) form.steps.assign(segments, desc.basis == CurveBasis::Linear ? 1 : 4);
    desc.form = form;
    auto mesh = buildCurves(
        desc, [](Severity, const std::string&, const std::string& text) { ADD_FAILURE() << text; });
    EXPECT_EQ(mesh->segments.empty(), !round);
    return mesh;
}

/// Two straight lines along x, 1 and 0.5 wide, the second one away and made of two segments.
CurvesDesc twoLines() {
    CurvesDesc desc;
    desc.name = "/lines";
    desc.vertexCounts = {2, 3};
    desc.points = {{-1, 0.5, 0}, {1, 0.5, 0}, {-1, -0.6, 0.2}, {0.5, -0.6, 0.2}, {1, -0.6, 0.2}};
    Primvar widths{"widths", Interpolation::Uniform, 1, {1.f, 0.5f}, {}};
    Primvar color{"color", Interpolation::Uniform, 3, {1, 0, 0, 0, 0, 1}, {}};
    Primvar along{"along", Interpolation::Vertex, 1, {-1, 1, -1, 0.5f, 1}, {}};
    desc.primvars = {widths, color, along};
    return desc;
}

/// Hair on a ball: bent curves that run into a point.
CurvesDesc fur(int count, float width = 0.02f) {
    CurvesDesc desc;
    desc.name = "/fur";
    desc.basis = CurveBasis::BSpline;
    desc.wrap = CurveWrap::Pinned;
    desc.vertexCounts.assign(size_t(count), 4);
    Primvar widths{"widths", Interpolation::Vertex, 1, {}, {}};
    for (int i = 0; i < count; ++i) {
        const float z = 1 - 2 * (float(i) + 0.5f) / float(count), r = std::sqrt(1 - z * z),
                    a = 2.4f * float(i);
        const glm::vec3 n(r * std::cos(a), r * std::sin(a), z);
        for (int k = 0; k < 4; ++k) {
            desc.points.push_back(n * (0.7f + 0.15f * float(k)) +
                                  glm::vec3(0.02f * float(k * k), -0.03f * float(k * k), 0));
            widths.values.push_back(k < 3 ? width : 0.f);
        }
    }
    desc.primvars = {widths};
    return desc;
}

} // namespace

// Every pixel of the first hits against the equation of a cylinder.
TEST(RoundCurves, FirstHitsOfStraightLines) {
    constexpr uint32_t Size = 96;
    Stage stage(boxFiltered(1));
    const glm::mat4x3 place = placed(scaling(1.3f, 1.3f, 1.3f), 0.1f, 0, 0);
    const ObjectId object = stage.add(built(twoLines()), matte(glm::vec3(0.5f)), {place});
    stage.add(skyLight());
    const CameraDesc camera = lookAt({0.3, 0.4, 6}, {0.1, 0, 0}, 30);
    stage.edit.setCamera(camera);
    stage.film(Size, Size,
               {{AovKind::Color, {}},
                {AovKind::CameraDepth, {}},
                {AovKind::Normal, {}},
                {AovKind::PrimId, {}},
                {AovKind::ElementId, {}},
                {AovKind::PatchCoord, {}},
                {AovKind::Primvar, "color"},
                {AovKind::Primvar, "along"}});
    stage.render();
    const auto depth = stage.read<float>(AovKind::CameraDepth);
    const auto normal = stage.read<glm::vec3>(AovKind::Normal),
               patch = stage.read<glm::vec3>(AovKind::PatchCoord),
               color = stage.read<glm::vec3>(AovKind::Primvar, "color"),
               along = stage.read<glm::vec3>(AovKind::Primvar, "along");
    const auto element = stage.read<int>(AovKind::ElementId), prim = stage.read<int>(AovKind::PrimId);
    const glm::dmat4 clipToWorld = glm::inverse(camera.projection * camera.worldToView);
    int seen[2] = {};
    for (uint32_t y = 0; y < Size; ++y)
        for (uint32_t x = 0; x < Size; ++x) {
            SCOPED_TRACE(testing::Message() << "pixel " << x << ", " << y);
            const glm::dvec2 ndc = 2.0 * (glm::dvec2(x, y) + 0.5) / double(Size) - 1.0;
            glm::dvec4 a = clipToWorld * glm::dvec4(ndc, -1, 1), b = clipToWorld * glm::dvec4(ndc, 0.9, 1);
            const auto toObject = [](const glm::dvec4& p) {
                return (glm::dvec3(p) / p.w - glm::dvec3(0.1f, 0, 0)) / double(1.3f);
            };
            const glm::dvec3 o = toObject(a), d = toObject(b) - o;
            int curve = -1;
            double nearest = 1e30;
            const glm::dvec3 axes[2] = {{0, 0.5, 0}, {0, -0.6f, 0.2f}};
            const double radii[2] = {0.5, 0.25};
            bool atEdge = false;
            for (int i = 0; i < 2; ++i) {
                const glm::dvec2 p(o.y - axes[i].y, o.z - axes[i].z), q(d.y, d.z);
                const double qq = glm::dot(q, q), pq = glm::dot(p, q),
                             disc = pq * pq - qq * (glm::dot(p, p) - radii[i] * radii[i]);
                atEdge |= std::abs(disc) < 1e-3 * qq;
                if (disc < 0) continue;
                const double t = (-pq - std::sqrt(disc)) / qq, at = o.x + t * d.x;
                atEdge |= std::abs(at) > 0.95; // and the spherical ends
                if (t < nearest) nearest = t, curve = i;
            }
            if (atEdge) continue;
            ASSERT_EQ(element.at(x, y), curve);
            ASSERT_EQ(prim.at(x, y), curve < 0 ? -1 : int(object));
            if (curve < 0) continue;
            ++seen[curve];
            const glm::dvec3 at = o + nearest * d;
            const glm::dvec4 view =
                camera.worldToView * glm::dvec4(at * double(1.3f) + glm::dvec3(0.1f, 0, 0), 1);
            ASSERT_NEAR(depth.at(x, y), -view.z, 1e-4);
            const glm::dvec3 n(0, (at.y - axes[curve].y) / radii[curve],
                               (at.z - axes[curve].z) / radii[curve]);
            ASSERT_LT(glm::length(glm::dvec3(normal.at(x, y)) - n), 1e-3);
            ASSERT_EQ(color.at(x, y), curve ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0));
            ASSERT_NEAR(along.at(x, y).x, at.x, 1e-4);
            const double from = curve && at.x > 0.5 ? 0.5 : -1, to = curve && at.x < 0.5 ? 0.5 : 1;
            ASSERT_NEAR(patch.at(x, y).x, (at.x - from) / (to - from), 1e-4);
            ASSERT_TRUE(patch.at(x, y).y >= 0 && patch.at(x, y).y <= 1);
        }
    EXPECT_GT(seen[0], 500);
    EXPECT_GT(seen[1], 200);
}

// The two forms are one shape, of one look: where a tube of triangles has many sides, pictures are alike.
TEST(RoundCurves, LookLikeTubesOfTriangles) {
    ColorPicture pictures[2];
    for (const bool round : {false, true}) {
        Stage stage(boxFiltered(64));
        CurvesDesc desc = fur(40, 0.1f);
        desc.refineLevel = 3;
        MaterialDesc material = matte({0.7f, 0.4f, 0.2f});
        material.specularColor = constantColor(glm::vec3(0.2f));
        material.roughness = constantValue(0.3f);
        stage.add(built(desc, round), material);
        stage.add(sphereMesh(), matte(glm::vec3(0.5f)), {scaling(0.78f, 0.78f, 0.78f)}); // the ends differ
        stage.add(skyLight(0.5f));
        LightDesc sun;
        sun.name = "/sun";
        sun.kind = LightKind::Distant;
        sun.angle = 5;
        sun.intensity = 3;
        stage.add(sun);
        stage.edit.setCamera(lookAt({0, 0.5, 5}, {0, 0, 0}, 30));
        stage.film(64, 64);
        stage.render();
        pictures[round] = stage.color();
        save(pictures[round], round ? "curves_round" : "curves_tubes");
    }
    double difference = 0;
    for (size_t i = 0; i < pictures[0].values.size(); ++i)
        difference +=
            glm::length(pictures[0].values[i] - pictures[1].values[i]) / double(pictures[0].values.size());
    EXPECT_LT(difference, 0.02);
    EXPECT_LT(glm::length(mean(pictures[0]) - mean(pictures[1])), 0.004f);
    EXPECT_GT(mean(pictures[1]).w, 0.2f);
}

// White hair in a white sky cannot be seen: no light is lost between hairs, in their joints, or off their
// surface; nor is any of glass, which light goes straight through.
TEST(RoundCurves, WhiteFurnace) {
    for (int kind = 0; kind < 2; ++kind)
        for (const float scale : {1.f, 0.01f}) { // as thin as 0.0002
            Settings settings = boxFiltered(64);
            settings.maxDepth = 1024;
            Stage stage(settings);
            MaterialDesc material = matte(glm::vec3(1.f));
            if (kind == 1) {
                material.model = MaterialModel::OpenPbr;
                material.openPbr[OpenPbrInput::TransmissionWeight] = constantValue(1.f);
                material.openPbr[OpenPbrInput::SpecularRoughness] = constantValue(0.f);
            }
            stage.add(built(fur(3000)), material, {scaling(scale, scale, scale)});
            stage.add(skyLight());
            CameraDesc camera = lookAt({0, 0, 5 * scale}, {0, 0, 0}, 30);
            camera.projection = glm::perspective(glm::radians(30.0), 1.0, 1.0 * scale, 10.0 * scale);
            stage.edit.setCamera(camera);
            stage.film(32, 32);
            stage.render();
            save(stage.color(), "curves_furnace" + std::to_string(kind) + std::to_string(scale));
            EXPECT_NEAR(mean(stage.color()).x, 1.f, 0.01f) << kind << ", " << scale;
            EXPECT_GT(mean(stage.color()).w, 0.3f);
        }
}

// What lets half of the light through is met once, not where rays leave it again; nor does a hair shadow
// itself.
TEST(RoundCurves, PresenceCountsOnce) {
    Stage stage(boxFiltered(256));
    MaterialDesc material = matte(glm::vec3(0.f));
    material.opacity = constantValue(0.5f);
    CurvesDesc desc = twoLines();
    desc.primvars[0].values = {1.f, 0.f};
    stage.add(built(desc), material);
    stage.add(skyLight());
    stage.edit.setCamera(lookAt({0, 0.5, 4}, {0, 0.5, 0}, 4)); // sees nothing but the first
    stage.film(16, 16);
    stage.render();
    EXPECT_NEAR(mean(stage.color()).x, 0.5f, 0.01f);
}

// Curves that deform are where curves that move as a whole would be.
TEST(RoundCurves, Deform) {
    const auto coverage = [](bool deforms) {
        Stage stage(boxFiltered(256));
        MaterialDesc material = matte(glm::vec3(0.5f));
        const auto mesh = built(fur(60, 0.04f));
        auto shifted = std::make_shared<TriangleMesh>(*mesh);
        for (glm::vec3& p : shifted->positions)
            p.x += 0.5f;
        const auto deforming = withMotion(*mesh, {{0.f, mesh}, {0.5f, shifted}});
        EXPECT_NEAR(deforming->boundsMax.x, mesh->boundsMax.x + 0.5f, 1e-5f);
        const ObjectId object = stage.add(deforms ? deforming : mesh, material);
        if (!deforms) {
            InstancesDesc one;
            one.transforms = {glm::mat4x3(1.f)};
            one.motion.times = {0.f, 0.5f};
            one.motion.transforms = {{translation(0, 0, 0)}, {translation(0.5f, 0, 0)}};
            stage.edit.setInstances(object, one);
        }
        stage.add(skyLight());
        CameraDesc camera = lookAt({0, 0, 5}, {0, 0, 0}, 35);
        camera.shutter = {0.0, 0.5};
        stage.edit.setCamera(camera);
        stage.film(48, 48);
        stage.render();
        return stage.color();
    };
    const ColorPicture deformed = coverage(true), moved = coverage(false);
    double difference = 0;
    for (size_t i = 0; i < moved.values.size(); ++i)
        difference += std::abs(deformed.values[i].w - moved.values[i].w) / double(moved.values.size());
    EXPECT_LT(difference, 1e-3);
    EXPECT_GT(mean(moved).w, 0.05f);
}

namespace {

/// Hair that gives and takes shadows, mirrored and see-through, some of it twice.
struct Barber : Stage {
    explicit Barber(const Settings& settings, float width = 0.03f, int count = 200) : Stage(settings) {
        addFloor(*this);
        MaterialDesc material = matte({0.6f, 0.3f, 0.2f});
        material.opacity = constantValue(0.8f);
        geometry = renderer->newId<GeometryId>();
        shape(fur(count, width));
        const MaterialId look = renderer->newId<MaterialId>();
        edit.setMaterial(look, material);
        ObjectDesc hair;
        hair.name = "/hair";
        hair.geometry = geometry;
        hair.materials = {look};
        const ObjectId object = renderer->newId<ObjectId>();
        edit.setObject(object, hair);
        edit.setInstances(object, {{placed(scaling(0.6f, 0.6f, 0.6f), -0.7f, -0.2f, 0),
                                    placed(scaling(0.5f, 0.7f, -0.5f), 0.8f, -0.2f, 0)},
                                   {},
                                   {}});
        add(sphereMesh(16), mirror(), {placed(scaling(0.4f, 0.4f, 0.4f), 0, 0.2f, -1.2f)});
        add(lampAbove({0, 3, 0}, 1, 5));
        edit.setCamera(lookAt({0, 0.6, 4}, {0, -0.2, 0}));
        film(48, 48);
    }
    void shape(const CurvesDesc& desc, bool round = true) { edit.setGeometry(geometry, built(desc, round)); }
    ColorPicture picture() {
        render();
        return color();
    }
    GeometryId geometry{};
};

} // namespace

TEST(RoundCurves, AllTraversalsAndModesGiveOnePicture) {
    Settings settings = boxFiltered(8);
    const ColorPicture expected = Barber(settings).picture();
    save(expected, "curves_barber");
    for (const char* traversal : {"bvh", "rayquery", "embree", "host"}) {
        settings.traversal = traversal;
        settings.mode = std::string(traversal) == "bvh"    ? "uniform"
                        : std::string(traversal) == "host" ? "delta"
                                                           : "paper";
        EXPECT_TRUE(sameBits(Barber(settings).picture(), expected)) << traversal;
    }
}

TEST(RoundCurves, EditsGiveThePictureOfAFreshScene) {
    for (const char* mode : {"delta", "paper"}) {
        Settings settings = boxFiltered(4);
        settings.mode = mode;
        Barber stage(settings);
        stage.picture();
        stage.shape(fur(200, 0.05f));
        EXPECT_TRUE(sameBits(stage.picture(), Barber(settings, 0.05f).picture())) << mode << ", widths";
        stage.shape(fur(120, 0.02f));
        EXPECT_TRUE(sameBits(stage.picture(), Barber(settings, 0.02f, 120).picture())) << mode << ", fewer";
        stage.shape(fur(120, 0.02f), false);
        stage.picture();
        stage.shape(fur(120, 0.02f));
        EXPECT_TRUE(sameBits(stage.picture(), Barber(settings, 0.02f, 120).picture()))
            << mode << ", tubes and back";
    }
}
