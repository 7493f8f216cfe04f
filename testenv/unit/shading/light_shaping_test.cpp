// Shaped lights: focus, cone and IES profiles, against closed forms and quadrature.
#include <cmath>
#include <functional>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "renderer/shading/ies_profile.h"
#include "testenv/unit/sampling/gpu.h"
#include "testenv/unit/shading/light_kernel.h"

namespace hipr::test {
namespace {

constexpr double Pi = 3.14159265358979323846;
const glm::vec3 Origin(0.f), Up(0.f, 0.f, 1.f);

glm::dmat4 at(double x, double y, double z) {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, z));
}

LightDesc light(LightKind kind, const glm::dmat4& transform) {
    LightDesc desc;
    desc.name = "/light";
    desc.kind = kind;
    desc.transform = transform;
    return desc;
}

double radians(double degrees) {
    return degrees * Pi / 180.0;
}

/// Irradiance at the origin, facing +Z, from a rectangle or a sphere of radiance `radiance(cosine off the
/// light's axis)`, the axis being `axis`; midpoint rule over its surface.
double quadrature(const LightDesc& desc, const std::function<double(double)>& radiance) {
    constexpr int Steps = 1500;
    const glm::dvec3 axis = -glm::normalize(glm::dvec3(desc.transform[2]));
    double sum = 0.0;
    for (int i = 0; i < Steps; ++i)
        for (int j = 0; j < Steps; ++j) {
            const double u = (i + 0.5) / Steps, v = (j + 0.5) / Steps;
            glm::dvec3 local, normal;
            double area;
            if (desc.kind == LightKind::Rect) {
                local = {(u - 0.5) * desc.width, (v - 0.5) * desc.height, 0.0};
                normal = {0, 0, -1};
                area = desc.width * desc.height;
            } else {
                const double z = 1.0 - 2.0 * u, s = std::sqrt(1.0 - z * z), phi = 2.0 * Pi * v;
                normal = {s * std::cos(phi), s * std::sin(phi), z};
                local = normal * double(desc.radius);
                area = 4.0 * Pi * desc.radius * desc.radius;
            }
            const glm::dvec3 p(desc.transform * glm::dvec4(local, 1.0)),
                n = glm::dmat3(desc.transform) * normal;
            const double squared = glm::dot(p, p), distance = std::sqrt(squared);
            const double facing = -glm::dot(p, n) / distance, cosine = p.z / distance;
            if (facing > 0.0 && cosine > 0.0)
                sum += radiance(glm::dot(-p / distance, axis)) * facing * cosine / squared * area;
        }
    return sum / (double(Steps) * Steps);
}

void expectIrradiance(const LightDesc& desc, double truth,
                      std::vector<std::pair<std::string, std::vector<unsigned char>>> files = {}) {
    const Irradiance e = irradiance(LitScene({desc}, std::move(files)), Origin, Up);
    EXPECT_NEAR(e.byLight.y, truth, 0.01 * truth) << "by light sampling";
    EXPECT_NEAR(e.byMeeting.y, truth, 0.01 * truth) << "by meeting the light";
    EXPECT_NEAR(e.combined.y, truth, 0.01 * truth) << "by both";
}

/// A rectangle and a sphere above the origin, tilted so that all angles off the axis matter.
std::vector<LightDesc> tilted() {
    LightDesc rect =
        light(LightKind::Rect, at(0.4, -0.3, 1.0) * glm::rotate(glm::dmat4(1.0), 0.4, glm::dvec3(1, 1, 0)));
    rect.width = 1.2f;
    LightDesc sphere =
        light(LightKind::Sphere, at(-0.5, 0.2, 1.3) * glm::rotate(glm::dmat4(1.0), 0.6, glm::dvec3(0, 1, 0)));
    return {rect, sphere};
}

TEST(LightShaping, Focus) {
    for (LightDesc desc : tilted()) {
        desc.shaping.focus = 3.f;
        const auto focus = [](double cosine) { return std::pow(std::abs(cosine), 3.0); };
        expectIrradiance(desc, quadrature(desc, focus));
        desc.shaping.focusTint = {0.1f, 0.25f, 1.f};
        expectIrradiance(desc, quadrature(desc, [&](double c) { return 0.25 + 0.75 * focus(c); }));
        desc.shaping.focusTint = glm::vec3(1.f); // white: no focus
        expectIrradiance(desc, quadrature(desc, [](double) { return 1.0; }));
    }
}

TEST(LightShaping, Cone) {
    for (LightDesc desc : tilted()) {
        desc.shaping.coneAngle = 35.f;
        expectIrradiance(
            desc, quadrature(desc, [](double c) { return std::acos(c) <= radians(35.0) ? 1.0 : 0.0; }));
        desc.shaping.coneSoftness = 0.75f;
        expectIrradiance(desc, quadrature(desc, [](double c) {
                             const double lo = radians(0.25 * 35.0), hi = radians(35.0);
                             const double x = glm::clamp((std::acos(c) - lo) / (hi - lo), 0.0, 1.0);
                             return 1.0 - x * x * (3.0 - 2.0 * x);
                         }));
    }
}

/// From far away the light is a point: radiance times area over the squared distance.
TEST(LightShaping, ConeOfAFarSpotlight) {
    LightDesc spot = light(LightKind::Sphere, at(0, 0, 100));
    spot.radius = 0.1f;
    spot.shaping.coneAngle = 20.f;
    const auto lit = [&](double degrees) {
        LightDesc turned = spot;
        turned.transform =
            spot.transform * glm::rotate(glm::dmat4(1.0), radians(degrees), glm::dvec3(1, 0, 0));
        return irradiance(LitScene({turned}), Origin, Up).byLight.y;
    };
    const double plain = Pi * 0.01 / 1e4;
    EXPECT_NEAR(lit(0.0), plain, 0.01 * plain);
    EXPECT_NEAR(lit(19.5), plain, 0.01 * plain);
    EXPECT_EQ(lit(20.5), 0.0);
    spot.shaping.coneSoftness = 1.f; // smoothstep is 1/2 in the middle
    EXPECT_NEAR(lit(10.0), 0.5 * plain, 0.01 * plain);
}

TEST(LightShaping, DistantLights) {
    LightDesc sun = light(LightKind::Distant, glm::dmat4(1.0));
    sun.angle = 60.f;
    sun.shaping.coneAngle = 20.f;
    const double sine = std::sin(radians(20.0));
    expectIrradiance(sun, Pi * sine * sine);
}

TEST(LightShaping, AConeOfNothingIsNoLight) {
    LightDesc rect = light(LightKind::Rect, at(0, 0, 1));
    rect.shaping.coneAngle = 0.f;
    EXPECT_EQ(LitScene({rect}).record().lightCount, 0u);
}

std::vector<unsigned char> file(const std::string& text) {
    return {text.begin(), text.end()};
}

std::string ies(const std::string& verticals, const std::string& horizontals, const std::string& candela,
                const std::string& counts, const std::string& type = "1") {
    return "IESNA:LM-63-2002\r\n[TEST] made up\r\nTILT=NONE\r\n1 1000 2 " + counts + " " + type +
           " 2 0 0 0\r\n0.5 1 100\r\n" + verticals + "\r\n" + horizontals + "\r\n" + candela + "\r\n";
}

IesProfile parsed(const std::string& text) {
    IesProfile profile;
    std::string error;
    EXPECT_TRUE(parseIes(file(text), profile, error)) << error;
    return profile;
}

double candela(const IesProfile& p, double theta, double phi) {
    const auto row = size_t(std::lround(theta / 180.0 * (p.rows - 1))),
               column = size_t(std::lround(phi / 360.0 * (p.columns - 1)));
    return double(p.candela[row * p.columns + column]);
}

TEST(IesProfiles, AreReadWithTheirFactors) {
    const IesProfile p = parsed(ies("0, 45 90", "0", "100 50 10", "3 1"));
    EXPECT_EQ(p.columns, 1u);
    EXPECT_NEAR(candela(p, 0, 0), 100.0, 1e-4); // times 2, times the ballast's 0.5
    EXPECT_NEAR(candela(p, 22.5, 0), 75.0, 1e-3);
    EXPECT_NEAR(candela(p, 90, 0), 10.0, 1e-4);
    EXPECT_EQ(candela(p, 120, 0), 0.0);
    // Mean over the hemisphere: the integral of a piecewise linear function and the sine.
    double mean = 0.0;
    for (int i = 0; i < 90000; ++i) {
        const double t = (i + 0.5) / 1000.0,
                     v = t < 45.0 ? 100.0 - 50.0 * t / 45.0 : 50.0 - 40.0 * (t - 45.0) / 45.0;
        mean += v * std::sin(radians(t)) * radians(1e-3);
    }
    EXPECT_NEAR(double(p.mean), mean, 0.01 * mean);
}

TEST(IesProfiles, SymmetriesOfHorizontalAngles) {
    const std::string v = "0 90 180";
    const IesProfile quadrant = parsed(ies(v, "0 90", "1 2 3 4 5 6", "3 2"));
    EXPECT_NEAR(candela(quadrant, 90, 0), 2.0, 1e-4);
    EXPECT_NEAR(candela(quadrant, 90, 90), 5.0, 1e-4);
    EXPECT_NEAR(candela(quadrant, 90, 180), 2.0, 1e-4);
    EXPECT_NEAR(candela(quadrant, 90, 270), 5.0, 1e-4);
    EXPECT_NEAR(candela(quadrant, 90, 315), 3.5, 1e-4);
    const IesProfile half = parsed(ies(v, "0 180", "1 2 3 4 5 6", "3 2"));
    EXPECT_NEAR(candela(half, 90, 180), 5.0, 1e-4);
    EXPECT_NEAR(candela(half, 90, 270), 3.5, 1e-4);
    const IesProfile sideways = parsed(ies(v, "90 270", "1 2 3 4 5 6", "3 2"));
    EXPECT_NEAR(candela(sideways, 90, 90), 2.0, 1e-4);
    EXPECT_NEAR(candela(sideways, 90, 270), 5.0, 1e-4);
    EXPECT_NEAR(candela(sideways, 90, 0), 3.5, 1e-4);
    const IesProfile open = parsed(ies(v, "0 120 240", "1 2 3 4 5 6 7 8 9", "3 3"));
    EXPECT_NEAR(candela(open, 90, 300), 5.0, 1e-4); // between 8 and 2
}

TEST(IesProfiles, BrokenFilesAreRefused) {
    const std::string good = ies("0 45 90", "0", "100 50 10", "3 1");
    const auto refused = [](const std::string& text) {
        IesProfile profile;
        std::string error;
        const bool read = parseIes(file(text), profile, error);
        return !read && !error.empty();
    };
    EXPECT_FALSE(refused(good));
    EXPECT_TRUE(refused(""));
    EXPECT_TRUE(refused("no profile at all"));
    for (size_t size = 0; size + 4 < good.size(); ++size)
        EXPECT_TRUE(refused(good.substr(0, size))) << size;
    EXPECT_TRUE(refused(ies("0 45 90", "0", "100 -50 10", "3 1")));
    EXPECT_TRUE(refused(ies("0 45 90", "0", "100 nan 10", "3 1")));
    EXPECT_TRUE(refused(ies("0 90 45", "0", "100 50 10", "3 1")));
    EXPECT_TRUE(refused(ies("0 45 90", "0", "100 50 10", "3 -1")));
    EXPECT_TRUE(refused(ies("0 45 90", "0", "100 50 10", "1e9 1e9")));
    EXPECT_TRUE(refused(ies("0 45 90", "0", "100 50 10", "3 1", "2")));
}

/// The same profile with a tilt table in front of the numbers, which is skipped.
TEST(IesProfiles, TiltTablesAreSkipped) {
    std::string text = ies("0 90", "0", "8 8", "2 1");
    text.replace(text.find("NONE"), 4, "INCLUDE\r\n1\r\n3\r\n0 45 90\r\n1 0.9 0.8");
    EXPECT_NEAR(candela(parsed(text), 30, 0), 8.0, 1e-4);
}

/// Candela 100 down to 0 over 90 degrees, in plane of the axis.
TEST(LightShaping, IesProfile) {
    const auto ramp = std::pair<std::string, std::vector<unsigned char>>(
        "ramp.ies", file(ies("0 90", "0", "100 0", "2 1")));
    const auto radiance = [](double cosine, double scale) {
        const double degrees = std::acos(glm::clamp(cosine, -1.0, 1.0)) * 180.0 / Pi / scale;
        return std::max(0.0, 100.0 * (1.0 - degrees / 90.0));
    };
    for (LightDesc desc : tilted()) {
        desc.shaping.iesFile = "ramp.ies";
        expectIrradiance(desc, quadrature(desc, [&](double c) { return radiance(c, 1.0); }), {ramp});
        desc.shaping.iesAngleScale = 0.7f; // narrower
        expectIrradiance(desc, quadrature(desc, [&](double c) { return radiance(c, 0.7); }), {ramp});
        desc.shaping.iesAngleScale = 0.f;
        desc.shaping.iesNormalize = true;
        const double mean = 100.0 * (1.0 - 2.0 / Pi); // over the hemisphere
        expectIrradiance(desc, quadrature(desc, [&](double c) { return radiance(c, 1.0) / mean; }), {ramp});
    }
    // A negative scale keeps 180 degrees where it is: 90 off the axis reads the profile at 180 - 90 / 0.5 =
    // 0.
    LightDesc side =
        light(LightKind::Sphere, at(0, 0, 50) * glm::rotate(glm::dmat4(1.0), 0.5 * Pi, glm::dvec3(1, 0, 0)));
    side.shaping.iesFile = "ramp.ies";
    side.shaping.iesAngleScale = -0.5f;
    const double plain = Pi * 0.25 / 2500.0;
    EXPECT_NEAR(irradiance(LitScene({side}, {ramp}), Origin, Up).byLight.y, 100.0 * plain, 1.5 * plain);
}

/// Horizontal angle 0 is light that leaves towards local -X, 90 towards -Y.
TEST(LightShaping, IesProfilesTurnWithTheLight) {
    const std::string quarters = ies("0 90 180", "0 90 180 270 360", "1 1 1 1 2 1 1 3 1 1 4 1 1 1 1", "3 5");
    LightDesc lamp = light(LightKind::Sphere, glm::dmat4(1.0));
    lamp.radius = 0.01f;
    lamp.shaping.iesFile = "quarters.ies";
    const LitScene scene({lamp}, {{"quarters.ies", file(quarters)}});
    const auto seenFrom = [&](const glm::vec3& point) {
        return scene.run(point, Up, 1, {-glm::normalize(point)})[0].seen.y;
    };
    EXPECT_NEAR(seenFrom({-5, 0, 0}), 1.f, 0.02f);
    EXPECT_NEAR(seenFrom({0, -5, 0}), 2.f, 0.02f);
    EXPECT_NEAR(seenFrom({5, 0, 0}), 3.f, 0.02f);
    EXPECT_NEAR(seenFrom({0, 5, 0}), 4.f, 0.02f);
}

TEST(LightShaping, ABrokenProfileIsToldOnceAndLeavesTheLightAlone) {
    LightDesc rect = light(LightKind::Rect, at(0, 0, 1));
    const double plain = irradiance(LitScene({rect}), Origin, Up).combined.y;
    for (const char* name : {"missing.ies", "broken.ies"}) {
        messageLog().entries.clear();
        rect.shaping.iesFile = name;
        LightDesc other = rect;
        other.name = "/other";
        other.transform = at(0, 0, -5);
        const LitScene scene({rect, other}, {{"broken.ies", file("TILT=NONE 1 2 3")}});
        EXPECT_NEAR(irradiance(scene, Origin, Up).combined.y, plain, 0.01 * plain);
        EXPECT_EQ(messageLog().count("/light", std::string(name) + " "), 1);
        EXPECT_EQ(messageLog().entries.size(), 1u);
    }
    messageLog().entries.clear();
}

} // namespace
} // namespace hipr::test
