#include <cmath>

#include <gtest/gtest.h>

#include "testenv/unit/sampling/statistics.h"
#include "testenv/unit/shading/bsdf_kernel.h"
#include "testenv/unit/shading/sphere_grid.h"

namespace hipr::test {
namespace {

constexpr double Pi = 3.14159265358979323846;

const SphereGrid& sphere() {
    static const SphereGrid grid(16, 24, 20);
    return grid;
}

/// Everything the tests want to know about one surface from one direction.
struct Survey {
    double pdfIntegral = 0, acceptedPart = 0, largestPdf = 0;
    glm::dvec3 albedo{0.0}, sampledAlbedo{0.0}, weightSquares{0.0};
    double probability = 0; ///< of the chi-square test
    double worstMismatch = 0;
    size_t samples = 0;
    bool finite = true;
};

Survey survey(const SurfaceParameters& parameters, const glm::vec3& wo) {
    const SphereGrid& grid = sphere();
    const std::vector<Outcome> outcomes = runBsdf(parameters, wo, grid.points());
    Survey s;
    s.samples = outcomes.size();
    std::vector<double> counts(size_t(grid.bins())), expected(size_t(grid.bins()));
    const double n = double(s.samples);
    for (size_t i = 0; i < outcomes.size(); ++i) {
        const Outcome& o = outcomes[i];
        expected[grid.binOfPoint(i)] += double(o.pdf) * grid.area(i) * n;
        s.pdfIntegral += double(o.pdf) * grid.area(i);
        s.albedo += glm::dvec3(o.f) * grid.area(i);
        s.finite = s.finite && std::isfinite(o.f.x + o.f.y + o.f.z + o.pdf + o.sampledPdf + o.weight.x);
        if (o.sampledPdf > 0.f) {
            ++counts[grid.binOf(o.sampled)];
            s.acceptedPart += 1.0 / n;
        }
        if (o.failed()) continue;
        s.sampledAlbedo += glm::dvec3(o.weight) / n;
        s.weightSquares += glm::dvec3(o.weight) * glm::dvec3(o.weight) / n;
        for (int c = 0; c < 3; ++c) {
            const double product = double(o.weight[c]) * o.sampledPdf;
            s.worstMismatch = std::max(s.worstMismatch, std::abs(product - o.sampledF[c]) / (product + 1e-6));
        }
        s.worstMismatch = std::max(s.worstMismatch, std::abs(double(o.sampledPdf) / o.sampledEvalPdf - 1.0));
    }
    s.probability = chiSquareProbability(counts, expected);
    return s;
}

std::vector<NamedSurface> allSurfaces() {
    std::vector<NamedSurface> all = opaqueSurfaces();
    for (const NamedSurface& g : glassSurfaces())
        all.push_back(g);
    return all;
}

constexpr double ViewCosines[] = {0.98, 0.6, 0.25};

TEST(Bsdf, SamplesFollowThePdf) {
    for (const NamedSurface& surface : allSurfaces())
        for (const double cosine : ViewCosines) {
            const Survey s = survey(surface.parameters, direction(cosine, 0.7));
            const auto where = ::testing::Message() << surface.name << ", cosine " << cosine;
            EXPECT_TRUE(s.finite) << where;
            // 60 tests: one in 600 runs of a right sampler would fall below; the numbers are fixed, so none
            // does.
            EXPECT_GT(s.probability, 3e-5) << where;
            EXPECT_LT(s.worstMismatch, 1e-4) << where;
            const double noise =
                4.5 * std::sqrt(std::max(1e-6, s.acceptedPart * (1 - s.acceptedPart)) / double(s.samples));
            EXPECT_NEAR(s.pdfIntegral, s.acceptedPart, noise + 4e-3) << where;
        }
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
    std::vector<glm::vec3> a, b;
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j) {
            a.push_back(direction(0.03 + 0.96 * i / 39.0, 0.3));
            b.push_back(direction(0.03 + 0.96 * j / 39.0, 0.3 + 0.157 * ((i * 7 + j) % 40)));
        }
    const std::vector<glm::vec4> u(a.size(), glm::vec4(0.5f));
    for (const NamedSurface& surface : allSurfaces()) {
        const std::vector<Outcome> there = runBsdf(surface.parameters, a, b, u);
        const std::vector<Outcome> back = runBsdf(surface.parameters, b, a, u);
        for (size_t i = 0; i < a.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double f = there[i].f[c] / b[i].z, g = back[i].f[c] / a[i].z;
                ASSERT_NEAR(f, g, 2e-4 * std::max(f, g) + 1e-6)
                    << surface.name << " " << a[i].z << " " << b[i].z;
            }
    }
}

/// Refraction in basic radiance is reciprocal too: f over eta^2 of the side the light is on (Walter,
/// section 5.1 and E. Veach's thesis, section 5.2).
TEST(Bsdf, RefractionIsReciprocal) {
    SurfaceParameters outside;
    outside.flags = gpu::MATERIAL_REFRACTIVE;
    outside.opacity = 0.f;
    outside.roughness = 0.5f;
    SurfaceParameters inside = outside;
    inside.frontFacing = 0;
    std::vector<glm::vec3> a, b, flippedA, flippedB;
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j) {
            a.push_back(direction(0.1 + 0.88 * i / 19.0, 0.3));
            b.push_back(direction(-0.1 - 0.88 * j / 19.0, 3.5 + 0.02 * i));
            // Seen from the inside the surface's frame is turned over: the viewer is always above.
            flippedA.push_back(-a.back());
            flippedB.push_back(-b.back());
        }
    const std::vector<glm::vec4> u(a.size(), glm::vec4(0.5f));
    const std::vector<Outcome> in = runBsdf(outside, a, b, u), out = runBsdf(inside, flippedB, flippedA, u);
    int positive = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        const double f = in[i].f.x / std::abs(b[i].z) / (1.5 * 1.5), g = out[i].f.x / a[i].z;
        ASSERT_NEAR(f, g, 1e-3 * std::max(f, g) + 1e-6);
        positive += f > 0.0;
    }
    EXPECT_GT(positive, 100);
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
