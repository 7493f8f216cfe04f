#include <algorithm>
#include <cmath>
#include <functional>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "renderer/shading/light_shape.h"
#include "testenv/unit/shading/light_kernel.h"
#include "testenv/unit/shading/sphere_grid.h"

namespace hipr::test {
namespace {

constexpr double Pi = 3.14159265358979323846;
const glm::vec3 Origin(0.f), Up(0.f, 0.f, 1.f);

LightDesc light(LightKind kind, const glm::dmat4& transform) {
    LightDesc desc;
    desc.name = "/light";
    desc.kind = kind;
    desc.transform = transform;
    desc.intensity = 2.f;
    return desc;
}

glm::dmat4 at(double x, double y, double z) {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, z));
}

/// All three estimates against the truth, within 1 %.
void expectIrradiance(const LightDesc& desc, double truth, const glm::vec3& normal = Up) {
    const LitScene scene({desc});
    const Irradiance e = irradiance(scene, Origin, normal);
    EXPECT_NEAR(e.byLight.y, truth, 0.01 * truth) << "by light sampling";
    EXPECT_NEAR(e.byMeeting.y, truth, 0.01 * truth) << "by meeting the light";
    EXPECT_NEAR(e.combined.y, truth, 0.01 * truth) << "by both";
}

/// J. H. Lambert's formula for a polygon of uniform radiance 1 wholly above the horizon, seen from the
/// origin.
double lambertPolygon(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal) {
    double sum = 0.0;
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(corners[i]),
                         b = glm::normalize(corners[(i + 1) % corners.size()]);
        sum += std::acos(glm::clamp(glm::dot(a, b), -1.0, 1.0)) *
               glm::dot(glm::normalize(glm::cross(a, b)), normal);
    }
    return 0.5 * std::abs(sum);
}

/// Irradiance at the origin from a surface given by position and area vector over the unit square, in
/// float64; only the side the area vector points to emits.
double surfaceIrradiance(const std::function<void(double, double, glm::dvec3&, glm::dvec3&)>& surface) {
    constexpr int Steps = 1500;
    double sum = 0.0;
    for (int i = 0; i < Steps; ++i)
        for (int j = 0; j < Steps; ++j) {
            glm::dvec3 p, area;
            surface((i + 0.5) / Steps, (j + 0.5) / Steps, p, area);
            const double squared = glm::dot(p, p), facing = -glm::dot(p, area), cosine = p.z;
            if (facing > 0.0 && cosine > 0.0) sum += facing * cosine / (squared * squared);
        }
    return sum / (double(Steps) * Steps);
}

double sphereIrradiance(const LightDesc& desc) {
    const glm::dmat3 m(desc.transform),
        cofactor = glm::transpose(glm::inverse(m)) * std::abs(glm::determinant(m));
    const double r = desc.radius;
    return surfaceIrradiance([&](double u, double v, glm::dvec3& p, glm::dvec3& area) {
        const double z = 1.0 - 2.0 * u, s = std::sqrt(1.0 - z * z), phi = 2.0 * Pi * v;
        const glm::dvec3 n(s * std::cos(phi), s * std::sin(phi), z);
        p = glm::dvec3(desc.transform * glm::dvec4(r * n, 1.0));
        area = cofactor * n * (4.0 * Pi * r * r);
    });
}

double cylinderIrradiance(const LightDesc& desc) {
    const glm::dmat3 m(desc.transform),
        cofactor = glm::transpose(glm::inverse(m)) * std::abs(glm::determinant(m));
    const double r = desc.radius;
    return surfaceIrradiance([&](double u, double v, glm::dvec3& p, glm::dvec3& area) {
        const double phi = 2.0 * Pi * v;
        const glm::dvec3 n(0.0, std::cos(phi), std::sin(phi));
        p = glm::dvec3(desc.transform * glm::dvec4(glm::dvec3((u - 0.5) * desc.length, 0, 0) + r * n, 1.0));
        area = cofactor * n * (2.0 * Pi * r * desc.length);
    });
}

TEST(LightIrradiance, Dome) {
    expectIrradiance(light(LightKind::Dome, glm::dmat4(1.0)), 2.0 * Pi);
}

TEST(LightIrradiance, DistantWithAngle) {
    // Local -Z is where the light goes: the identity shines down.
    LightDesc sun = light(LightKind::Distant, glm::rotate(glm::dmat4(1.0), 0.5, glm::dvec3(1, 0, 0)));
    sun.angle = 40.f;
    const double sine = std::sin(20.0 * Pi / 180.0);
    expectIrradiance(sun, 2.0 * Pi * sine * sine * std::cos(0.5));
    sun.normalize = true;
    expectIrradiance(sun, 2.0 * std::cos(0.5));
}

TEST(LightIrradiance, DistantPointLike) {
    for (const float angle : {0.f, 0.53f}) {
        LightDesc sun = light(LightKind::Distant, glm::rotate(glm::dmat4(1.0), -0.3, glm::dvec3(0, 1, 0)));
        sun.angle = angle;
        sun.normalize = true;
        const LitScene scene({sun});
        const Irradiance e = irradiance(scene, Origin, Up);
        EXPECT_NEAR(e.byLight.y, 2.0 * std::cos(0.3), 1e-3) << angle;
        if (angle == 0.f) {
            EXPECT_NEAR(e.combined.y, 2.0 * std::cos(0.3), 1e-3);
            EXPECT_EQ(e.byMeeting.y, 0.0);
        }
    }
}

TEST(LightIrradiance, Rect) {
    LightDesc rect =
        light(LightKind::Rect, at(0.4, -0.3, 1.0) * glm::rotate(glm::dmat4(1.0), 0.4, glm::dvec3(1, 1, 0)));
    rect.width = 1.2f;
    rect.height = 0.7f;
    // A mirrored, sheared and scaled parallelogram too.
    glm::dmat4 shear(1.0);
    shear[1][0] = 0.6;
    for (const glm::dmat4& extra :
         {glm::dmat4(1.0), shear * glm::scale(glm::dmat4(1.0), glm::dvec3(-1.5, 0.8, 2.0))}) {
        LightDesc desc = rect;
        desc.transform = rect.transform * extra;
        std::vector<glm::dvec3> corners;
        for (const glm::dvec2 c :
             {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)})
            corners.push_back(glm::dvec3(
                desc.transform * glm::dvec4(0.5 * desc.width * c.x, 0.5 * desc.height * c.y, 0.0, 1.0)));
        expectIrradiance(desc, 2.0 * lambertPolygon(corners, glm::dvec3(Up)));
    }
}

/// Close to a rectangle its solid angle matters, far from it single precision does.
TEST(LightIrradiance, RectNearAndFar) {
    for (const double height : {1e-3, 0.03, 30.0, 3000.0}) {
        const LightDesc rect = light(LightKind::Rect, at(0.2, 0.1, height));
        std::vector<glm::dvec3> corners;
        for (const glm::dvec2 c :
             {glm::dvec2(-0.3, -0.4), glm::dvec2(0.7, -0.4), glm::dvec2(0.7, 0.6), glm::dvec2(-0.3, 0.6)})
            corners.push_back(glm::dvec3(c, height));
        const double truth =
            height < 1000.0 ? 2.0 * lambertPolygon(corners, glm::dvec3(Up)) : 2.0 / (height * height);
        const Irradiance e = irradiance(LitScene({rect}), Origin, Up);
        EXPECT_NEAR(e.byLight.y, truth, 0.01 * truth) << height;
        EXPECT_NEAR(e.combined.y, truth, 0.01 * truth) << height;
    }
}

TEST(LightIrradiance, RectShinesToOneSide) {
    const LightDesc away =
        light(LightKind::Rect, at(0, 0, 1) * glm::rotate(glm::dmat4(1.0), Pi, glm::dvec3(1, 0, 0)));
    const Irradiance e = irradiance(LitScene({away}), Origin, Up);
    EXPECT_EQ(e.byLight.y, 0.0);
    EXPECT_EQ(e.combined.y, 0.0);
}

TEST(LightIrradiance, Disk) {
    LightDesc disk = light(LightKind::Disk, at(0, 0, 1.5));
    disk.radius = 0.8f;
    expectIrradiance(disk, 2.0 * Pi * 0.64 / (0.64 + 2.25));
    // An ellipse: a strongly scaled disk, against quadrature.
    disk.transform = at(0.5, 0, 1.5) * glm::scale(glm::dmat4(1.0), glm::dvec3(2.0, 0.7, 1.0));
    const double truth = surfaceIrradiance([&](double u, double v, glm::dvec3& p, glm::dvec3& area) {
        const double r = 0.8 * std::sqrt(u), phi = 2.0 * Pi * v;
        p = glm::dvec3(disk.transform * glm::dvec4(r * std::cos(phi), r * std::sin(phi), 0.0, 1.0));
        area = glm::dvec3(0, 0, -1) * (Pi * 0.64 * 1.4);
    });
    expectIrradiance(disk, 2.0 * truth);
}

TEST(LightIrradiance, Sphere) {
    LightDesc sphere = light(LightKind::Sphere, at(0.6, 0.0, 1.8));
    sphere.radius = 0.7f;
    const double squared = 0.36 + 3.24, cosine = 1.8 / std::sqrt(squared);
    expectIrradiance(sphere, 2.0 * Pi * 0.49 / squared * cosine);
}

TEST(LightIrradiance, Ellipsoid) {
    LightDesc sphere =
        light(LightKind::Sphere, at(0.5, 0.2, 1.8) * glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(0, 1, 1)) *
                                     glm::scale(glm::dmat4(1.0), glm::dvec3(2.0, -0.6, 1.0)));
    expectIrradiance(sphere, 2.0 * sphereIrradiance(sphere));
}

TEST(LightIrradiance, SmallSphereFarAway) {
    LightDesc sphere = light(LightKind::Sphere, at(0.0, 300.0, 400.0));
    sphere.radius = 0.05f;
    sphere.normalize = true;
    const Irradiance e = irradiance(LitScene({sphere}), Origin, Up);
    const double truth = 2.0 / (4.0 * 250000.0) * 0.8;
    EXPECT_NEAR(e.byLight.y, truth, 1e-3 * truth);
    EXPECT_NEAR(e.combined.y, truth, 1e-3 * truth);
}

TEST(LightIrradiance, Cylinder) {
    LightDesc tube = light(LightKind::Cylinder,
                           at(0.3, -0.4, 1.5) * glm::rotate(glm::dmat4(1.0), 0.5, glm::dvec3(0, 1, 0)));
    tube.radius = 0.4f;
    tube.length = 1.6f;
    expectIrradiance(tube, 2.0 * cylinderIrradiance(tube));
    tube.transform = tube.transform * glm::scale(glm::dmat4(1.0), glm::dvec3(1.5, 0.5, 1.2));
    expectIrradiance(tube, 2.0 * cylinderIrradiance(tube));
}

/// A sphere that is taken for a point has the power of the sphere: radiance times pi r^2 in each direction.
/// Only light samples find it.
TEST(LightIrradiance, SphereAsAPoint) {
    LightDesc point = light(LightKind::Sphere, at(0.6, 0.0, 1.8));
    point.radius = 0.7f;
    point.thin = true;
    const double squared = 0.36 + 3.24, geometry = 1.8 / (std::sqrt(squared) * squared);
    const auto expect = [&](double truth) {
        const Irradiance e = irradiance(LitScene({point}), Origin, Up);
        EXPECT_NEAR(e.byLight.y, truth, 1e-4 * truth);
        EXPECT_NEAR(e.combined.y, truth, 1e-4 * truth);
        EXPECT_EQ(e.byMeeting.y, 0.0);
    };
    expect(2.0 * Pi * 0.49 * geometry);
    point.normalize = true;
    expect(2.0 / 4.0 * geometry);
    point.radius = 0.f;
    expect(2.0 / 4.0 * geometry);
    point.shaping.coneAngle = 30.f; // shines down, past the origin by 18.4 degrees
    expect(2.0 / 4.0 * geometry);
    point.shaping.coneAngle = 15.f;
    EXPECT_EQ(irradiance(LitScene({point}), Origin, Up).combined.y, 0.0);
}

/// A very thin cylinder sends what a line does.
TEST(LightIrradiance, CylinderAsALine) {
    LightDesc tube = light(LightKind::Cylinder, at(0.3, -0.4, 1.5) *
                                                    glm::rotate(glm::dmat4(1.0), 0.5, glm::dvec3(0, 1, 0)) *
                                                    glm::scale(glm::dmat4(1.0), glm::dvec3(1.5, 0.8, 0.8)));
    tube.radius = 0.002f;
    tube.length = 1.6f;
    const double truth = 2.0 * cylinderIrradiance(tube);
    tube.thin = true;
    const Irradiance e = irradiance(LitScene({tube}), Origin, Up);
    EXPECT_NEAR(e.byLight.y, truth, 0.005 * truth);
    EXPECT_NEAR(e.combined.y, truth, 0.005 * truth);
    EXPECT_EQ(e.byMeeting.y, 0.0);
}

TEST(LightIrradiance, LightsAddUp) {
    LightDesc sphere = light(LightKind::Sphere, at(0.6, 0.0, 1.8));
    LightDesc dome = light(LightKind::Dome, glm::dmat4(1.0));
    dome.intensity = 0.1f;
    LightDesc sun = light(LightKind::Distant, glm::dmat4(1.0));
    sun.angle = 30.f;
    double truth = 0.0;
    for (const LightDesc& one : {sphere, dome, sun})
        truth += irradiance(LitScene({one}), Origin, Up).combined.y;
    const Irradiance all = irradiance(LitScene({sphere, dome, sun}), Origin, Up);
    EXPECT_NEAR(all.byLight.y, truth, 0.01 * truth);
    EXPECT_NEAR(all.byMeeting.y, truth, 0.01 * truth);
    EXPECT_NEAR(all.combined.y, truth, 0.01 * truth);
}

std::vector<LightDesc> shapes() {
    LightDesc cylinder = light(LightKind::Cylinder,
                               at(0.3, 0.2, 1.0) * glm::scale(glm::dmat4(1.0), glm::dvec3(1.5, 0.7, 1.0)));
    LightDesc sun = light(LightKind::Distant, glm::rotate(glm::dmat4(1.0), 0.8, glm::dvec3(1, 0, 0)));
    sun.angle = 70.f;
    return {
        light(LightKind::Rect, at(0.2, 0.1, 0.6)),
        light(LightKind::Disk, at(-0.4, 0.1, 0.6)),
        light(LightKind::Sphere, at(0.0, 0.5, 0.9)),
        light(LightKind::Sphere, at(0.5, 0.2, 1.0) * glm::scale(glm::dmat4(1.0), glm::dvec3(1.5, 0.6, 1.0))),
        cylinder,
        sun,
        light(LightKind::Dome, glm::dmat4(1.0))};
}

/// Meeting a light where it was sampled must see the density it was sampled with: the weight against an equal
/// one is 1/2.
TEST(LightSampling, MeetingKnowsThePdfOfSampling) {
    for (const LightDesc& desc : shapes()) {
        size_t samples = 0, agree = 0;
        for (const LightOutcome& o : LitScene({desc}).run(glm::vec3(0.1f, 0.f, -0.2f), Up, 20000)) {
            if (!(o.pdf > 0.f)) continue;
            ++samples;
            agree += std::abs(o.atSample - 0.5f) < 5e-3f;
        }
        EXPECT_GT(samples, 15000u) << int(desc.kind);
        EXPECT_GT(double(agree), 0.996 * double(samples))
            << int(desc.kind); // rounding matters at a rim seen edge-on
    }
}

/// Samples weighted by 1 / pdf measure solid angle: in every bin of the sphere they must add up to the part
/// of it from which rays meet the light. (Comparing counts with the integrated pdf says the same, but the pdf
/// is singular at rims.)
TEST(LightSampling, SamplesFollowThePdf) {
    const SphereGrid grid(16, 24, 40);
    const size_t n = grid.points().size();
    const double binArea = 4.0 * Pi / grid.bins();
    for (const LightDesc& desc : shapes()) {
        const std::vector<LightOutcome> outcomes = LitScene({desc}).run(Origin, Up, n, grid.points());
        std::vector<double> measured(size_t(grid.bins())), truth(size_t(grid.bins()));
        double all = 0.0, allTruth = 0.0;
        for (size_t i = 0; i < n; ++i) {
            const LightOutcome& o = outcomes[i];
            const double seen = o.weighted.y > 0.f ? grid.area(i) : 0.0;
            truth[grid.binOfPoint(i)] += seen;
            allTruth += seen;
            if (!(o.pdf > 0.f)) continue;
            measured[grid.binOf(o.wi)] += 1.0 / (double(o.pdf) * double(n));
            all += 1.0 / (double(o.pdf) * double(n));
        }
        EXPECT_NEAR(all, allTruth, 0.005 * allTruth) << int(desc.kind);
        for (size_t b = 0; b < truth.size(); ++b)
            EXPECT_NEAR(measured[b], truth[b], 0.01 * truth[b] + 0.01 * binArea)
                << int(desc.kind) << " bin " << b;
    }
}

TEST(LightSampling, CameraSeesAreaLightsAndDomesButNoDistantLight) {
    const LitScene rect({light(LightKind::Rect, at(0, 0, 1))});
    EXPECT_EQ(rect.run(Origin, Up, 1)[0].seen.y, 2.f);
    LightDesc sun = light(LightKind::Distant, glm::dmat4(1.0));
    sun.angle = 20.f;
    EXPECT_EQ(LitScene({sun}).run(Origin, Up, 1)[0].seen.y, 0.f);
    EXPECT_EQ(LitScene({light(LightKind::Dome, glm::dmat4(1.0))}).run(Origin, Up, 1)[0].seen.y, 2.f);
}

/// Lights with multipliers count by light sampling alone: a ray that meets one cannot tell which lobe sent
/// it.
TEST(LightSampling, MultipliersScaleLightSamplesAndTurnMeetingOff) {
    LightDesc rect = light(LightKind::Rect, at(0, 0, 1));
    const double plain = irradiance(LitScene({rect}), Origin, Up).combined.y;
    rect.diffuse = 0.25f;
    const Irradiance e = irradiance(LitScene({rect}), Origin, Up);
    EXPECT_NEAR(e.combined.y, 0.25 * plain, 0.005 * plain);
    EXPECT_NEAR(e.byLight.y, 0.25 * plain, 0.005 * plain);
}

TEST(LightSampling, FromInsideASphereThereIsNoLight) {
    LightDesc sphere = light(LightKind::Sphere, glm::dmat4(1.0));
    const Irradiance e = irradiance(LitScene({sphere}), Origin, Up);
    EXPECT_EQ(e.byLight.y, 0.0);
    EXPECT_EQ(e.byMeeting.y, 0.0);
}

} // namespace
} // namespace hipr::test
