#include <cmath>

#include <gtest/gtest.h>

#include "testenv/unit/shading/bsdf_survey.h"

namespace hipr::test {
namespace {

constexpr double Pi = 3.14159265358979323846;

std::vector<NamedSurface> allSurfaces() {
    std::vector<NamedSurface> all = opaqueSurfaces();
    for (const NamedSurface& g : glassSurfaces())
        all.push_back(g);
    return all;
}

constexpr double ViewCosines[] = {0.98, 0.6, 0.25};

TEST(Bsdf, SamplesFollowThePdf) {
    for (const NamedSurface& surface : allSurfaces())
        for (const double cosine : ViewCosines)
            expectSamplesFollowThePdf(surface, cosine);
}

TEST(Bsdf, ReflectsAtMostWhatArrives) {
    for (const NamedSurface& surface : allSurfaces())
        for (const double cosine : ViewCosines) {
            SurfaceParameters p = surface.parameters;
            p.diffuseColor = glm::vec3(1.f);
            const Survey s = survey(p, direction(cosine, 0.2));
            for (int c = 0; c < 3; ++c) {
                const auto where = ::testing::Message()
                                   << surface.name << ", cosine " << cosine << ", channel " << c;
                const double variance = s.weightSquares[c] - s.sampledAlbedo[c] * s.sampledAlbedo[c];
                const double noise = 4.5 * std::sqrt(std::max(variance, 0.0) / double(s.samples));
                EXPECT_LT(s.sampledAlbedo[c], 1.0 + noise + 3e-3) << where;
                EXPECT_NEAR(s.sampledAlbedo[c], s.albedo[c], noise + 5e-3)
                    << where; // the quadrature's own error
            }
        }
}

/// Nothing is lost either: a white dielectric without coat returns everything, at any roughness.
TEST(Bsdf, WhiteFurnace) {
    for (const float roughness : {0.05f, 0.2f, 0.5f, 0.8f, 1.f})
        for (const double cosine : {0.99, 0.7, 0.3, 0.05}) {
            SurfaceParameters p;
            p.diffuseColor = glm::vec3(1.f);
            p.roughness = roughness;
            const Survey s = survey(p, direction(cosine, 1.0));
            EXPECT_NEAR(s.sampledAlbedo.x, 1.0, 6e-3) << "roughness " << roughness << ", cosine " << cosine;
        }
}

/// Clear glass gives back all light: reflected and refracted parts add up, on both sides.
TEST(Bsdf, GlassKeepsEnergy) {
    for (const uint32_t front : {0u, 1u})
        for (const double cosine : {0.99, 0.7, 0.3}) {
            SurfaceParameters p;
            p.flags = gpu::MATERIAL_REFRACTIVE;
            p.opacity = 0.f;
            p.roughness = 0.05f;
            p.frontFacing = front;
            const Survey s = survey(p, direction(cosine, 1.0));
            EXPECT_GT(s.sampledAlbedo.x, 0.985) << "front " << front << ", cosine " << cosine;
            EXPECT_LT(s.sampledAlbedo.x, 1.0 + 1e-4) << "front " << front << ", cosine " << cosine;
        }
}

TEST(Bsdf, ReflectionIsReciprocal) {
    for (const NamedSurface& surface : allSurfaces())
        expectReciprocalReflection(surface);
}

TEST(Bsdf, RefractionIsReciprocal) {
    SurfaceParameters glass;
    glass.flags = gpu::MATERIAL_REFRACTIVE;
    glass.opacity = 0.f;
    glass.roughness = 0.5f;
    expectReciprocalRefraction(glass, 1.5);
}

/// The mirror limit: roughness 0 reflects along the mirror direction with Schlick's reflectance, refracts by
/// Snell's law.
TEST(Bsdf, SmoothSurfacesObeyMirrorAndSnell) {
    SurfaceParameters p;
    p.flags = gpu::MATERIAL_REFRACTIVE;
    p.opacity = 0.f;
    p.roughness = 0.f;
    const glm::vec3 wo = direction(0.6, 0.0);
    int near = 0;
    for (const Outcome& o : runBsdf(p, wo, std::vector<glm::vec3>(1000, wo))) {
        ASSERT_FALSE(o.failed());
        const double sine = std::sqrt(1.0 - double(o.sampled.z) * o.sampled.z);
        near += std::abs(sine - (o.sampled.z > 0.f ? 0.8 : 0.8 / 1.5)) < 5e-3;
        ASSERT_LT(o.sampled.x, 0.f);
        ASSERT_NEAR(o.weight.x, 1.0, 2e-3);
    }
    EXPECT_GE(near, 990); // the tails of GGX hold the rest: (2e-4 / 5e-3)^2 of all microfacets are steeper
}

/// Shading normals far off the geometric normal: no NaN, no gain, nothing leaves through the surface.
TEST(Bsdf, TiltedShadingNormalsLoseButNeverGain) {
    for (const NamedSurface& surface : allSurfaces())
        for (const double tilt : {0.5, 1.4})
            for (const double cosine : {0.9, 0.05}) {
                SurfaceParameters p = surface.parameters;
                p.diffuseColor = glm::vec3(1.f);
                p.ns = direction(std::cos(tilt), Pi);
                const glm::vec3 wo = direction(cosine, 0.0);
                const Survey s = survey(p, wo);
                const auto where = ::testing::Message()
                                   << surface.name << ", tilt " << tilt << ", cosine " << cosine;
                EXPECT_TRUE(s.finite) << where;
                const double noise = 5.0 * std::sqrt(s.weightSquares.x / double(s.samples));
                EXPECT_LT(s.sampledAlbedo.x, 1.0 + noise + 3e-3) << where;
                EXPECT_LT(s.pdfIntegral, 1.0 + 5e-3) << where;
            }
}

} // namespace
} // namespace hipr::test
