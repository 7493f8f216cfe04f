// OpenPBR Surface: what its lobes keep, and how they are sampled.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/shading/openpbr_albedo.h"
#include "testenv/unit/shading/bsdf_survey.h"

namespace hipr::test {
namespace {

using In = OpenPbrInput;

/// A smooth coat on nothing, with a normal of its own.
SurfaceParameters tiltedCoat(double roughness) {
    SurfaceParameters p = openPbr({{In::BaseWeight, grey(0)},
                                   {In::SpecularWeight, grey(0)},
                                   {In::CoatWeight, grey(1)},
                                   {In::CoatRoughness, grey(roughness)}});
    p.coatNormal = glm::normalize(glm::vec3(0.3f, -0.2f, 1.f));
    return p;
}

std::vector<NamedSurface> surfaces() {
    const auto orange = glm::vec3(0.8f, 0.5f, 0.2f);
    return {
        {"default", openPbr({})},
        {"rough diffuse", openPbr({{In::BaseDiffuseRoughness, grey(1)}, {In::BaseColor, orange}})},
        {"metal 0.3", openPbr({{In::BaseMetalness, grey(1)}, {In::BaseColor, orange}})},
        {"metal 0.9 with an edge", openPbr({{In::BaseMetalness, grey(1)},
                                            {In::BaseColor, orange},
                                            {In::SpecularColor, glm::vec3(0.2f, 0.9f, 1.f)},
                                            {In::SpecularRoughness, grey(0.9)}})},
        {"brushed metal", openPbr({{In::BaseMetalness, grey(1)},
                                   {In::SpecularRoughness, grey(0.5)},
                                   {In::SpecularRoughnessAnisotropy, grey(0.7)}})},
        {"half metal", openPbr({{In::BaseMetalness, grey(0.5)}, {In::SpecularRoughness, grey(0.6)}})},
        {"dense", openPbr({{In::SpecularIor, grey(2.4)}, {In::SpecularWeight, grey(0.7)}})},
        {"coat", openPbr({{In::CoatWeight, grey(1)},
                          {In::CoatColor, orange},
                          {In::CoatRoughness, grey(0.3)},
                          {In::SpecularRoughness, grey(0.6)}})},
        {"stretched coat on metal", openPbr({{In::CoatWeight, grey(0.7)},
                                             {In::CoatRoughness, grey(0.4)},
                                             {In::CoatRoughnessAnisotropy, grey(0.8)},
                                             {In::BaseMetalness, grey(1)}})},
        {"tilted coat", with(tiltedCoat(0.4), {{In::BaseWeight, grey(1)}, {In::SpecularWeight, grey(1)}})},
        {"tilted stretched coat", with(tiltedCoat(0.6), {{In::CoatRoughnessAnisotropy, grey(0.8)}})},
        {"fuzz 0.5", openPbr({{In::FuzzWeight, grey(1)}, {In::FuzzColor, orange}})},
        {"fuzz 0 on a coat", openPbr({{In::FuzzWeight, grey(0.8)},
                                      {In::FuzzRoughness, grey(0)},
                                      {In::CoatWeight, grey(0.5)},
                                      {In::CoatRoughness, grey(0.5)}})},
        {"thin paper", openPbr({{In::GeometryThinWalled, grey(1)},
                                {In::SubsurfaceWeight, grey(1)},
                                {In::SubsurfaceScatterAnisotropy, grey(0.4)}})},
        {"thin paper without an interface", openPbr({{In::GeometryThinWalled, grey(1)},
                                                     {In::SpecularWeight, grey(0)},
                                                     {In::SubsurfaceWeight, grey(1)}})},
        {"film on metal", openPbr({{In::ThinFilmWeight, grey(1)}, {In::BaseMetalness, grey(1)}})},
        {"thin glass", openPbr({{In::GeometryThinWalled, grey(1)},
                                {In::TransmissionWeight, grey(1)},
                                {In::TransmissionColor, orange},
                                {In::SpecularRoughness, grey(0.4)}})},
    };
}

std::vector<NamedSurface> glasses() {
    std::vector<NamedSurface> all = {
        {"glass 0.3", openPbr({{In::TransmissionWeight, grey(1)}})},
        {"bubble", openPbr({{In::TransmissionWeight, grey(1)},
                            {In::ThinFilmWeight, grey(0.8)},
                            {In::ThinFilmThickness, grey(0.3)}})},
        {"glass 0.9", openPbr({{In::TransmissionWeight, grey(1)}, {In::SpecularRoughness, grey(0.9)}})},
        {"half glass under a coat", openPbr({{In::TransmissionWeight, grey(0.5)},
                                             {In::SpecularRoughness, grey(0.6)},
                                             {In::CoatWeight, grey(1)},
                                             {In::CoatRoughness, grey(0.3)}})},
    };
    for (size_t i = 0, n = all.size(); i < n; ++i) {
        all.push_back(all[i]);
        all.back().parameters.frontFacing = 0;
    }
    return all;
}

TEST(OpenPbr, SamplesFollowThePdf) {
    for (const auto& list : {surfaces(), glasses()})
        for (const NamedSurface& surface : list)
            for (const double cosine : {0.95, 0.35})
                expectSamplesFollowThePdf(surface, cosine);
}

/// A mirror of the coat's own: where it reflects to, and how much.
TEST(OpenPbr, CoatsHaveANormalOfTheirOwn) {
    const SurfaceParameters p = tiltedCoat(0.0);
    const glm::dvec3 n(p.coatNormal);
    for (const double cosine : {0.95, 0.5}) {
        const glm::vec3 wo = direction(cosine, 0.7);
        const glm::dvec3 reflected = 2.0 * glm::dot(n, glm::dvec3(wo)) * n - glm::dvec3(wo);
        size_t found = 0, astray = 0; // of the smoothest lobe one in 600 goes further
        for (const Outcome& o : runBsdf(p, wo, std::vector<glm::vec3>(256, glm::vec3(0, 0, 1)))) {
            if (o.failed() || o.lobe != 0) continue;
            ++found;
            if (glm::length(glm::dvec3(o.sampled) - reflected) > 0.01) ++astray;
        }
        EXPECT_GT(found, 200u);
        EXPECT_LT(astray, found / 50);
        // Fresnel's equations for an index of 1.6.
        const double c = glm::dot(n, glm::dvec3(wo)), g = std::sqrt(1.6 * 1.6 - 1.0 + c * c);
        const double s = (g - c) / (g + c), t = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
        EXPECT_NEAR(sampledAlbedo(p, wo, 1 << 12).y, 0.5 * s * s * (1.0 + t * t), 2e-3) << cosine;
    }
}

/// Stretched highlights are wide across the tangent asked for.
TEST(OpenPbr, HighlightsFollowTheTangent) {
    SurfaceParameters p = openPbr({{In::BaseMetalness, grey(1)},
                                   {In::SpecularRoughness, grey(0.5)},
                                   {In::SpecularRoughnessAnisotropy, grey(0.9)}});
    const auto spread = [&](const glm::vec3& tangent) {
        p.tangent = tangent;
        glm::dvec2 sum(0.0);
        for (const Outcome& o :
             runBsdf(p, glm::vec3(0, 0, 1), std::vector<glm::vec3>(1024, glm::vec3(0, 0, 1))))
            if (!o.failed()) sum += glm::abs(glm::dvec2(o.sampled));
        return sum;
    };
    const glm::dvec2 alongX = spread({1, 0, 0.5f}), alongY = spread({0, 1, 0});
    EXPECT_GT(alongX.x, 3.0 * alongX.y);
    EXPECT_GT(alongY.y, 3.0 * alongY.x);
}

/// Base, metal and fuzz; layers below a coat or fuzz are scaled as the specification suggests, which is not
/// reciprocal.
TEST(OpenPbr, LobesAreReciprocal) {
    for (const NamedSurface& surface : surfaces()) {
        const auto& inputs = surface.parameters.openPbr->openPbr;
        if (inputs.count(In::CoatWeight) || inputs.count(In::FuzzWeight)) continue;
        expectReciprocalReflection(surface);
    }
    expectReciprocalReflection(
        {"fuzz alone",
         openPbr({{In::FuzzWeight, grey(1)}, {In::BaseWeight, grey(0)}, {In::SpecularWeight, grey(0)}})});
}

TEST(OpenPbr, RefractionIsReciprocal) {
    for (const double roughness : {0.4, 1.0})
        expectReciprocalRefraction(
            openPbr({{In::TransmissionWeight, grey(1)}, {In::SpecularRoughness, grey(roughness)}}), 1.5);
}

/// A quarter of a wave of a film whose index is the root of the glass's quenches the reflection; half a wave
/// does nothing.
TEST(OpenPbr, FilmsQuenchReflections) {
    const auto reflected = [](double thickness) {
        const double ior = std::sqrt(1.5);
        return sampledAlbedo(openPbr({{In::BaseWeight, grey(0)},
                                      {In::SpecularRoughness, grey(0.01)},
                                      {In::ThinFilmWeight, grey(1)},
                                      {In::ThinFilmIor, grey(ior)},
                                      {In::ThinFilmThickness, grey(thickness / ior)}}),
                             direction(1.0, 0.0), 1 << 10);
    };
    EXPECT_NEAR(reflected(0.0).y, 0.04, 1e-3);
    EXPECT_LT(reflected(0.550 / 4).y, 0.001);
    EXPECT_GT(reflected(0.550 / 4).z, 0.001); // green light only
    EXPECT_NEAR(reflected(0.550 / 2).y, 0.04, 0.003);
    EXPECT_NEAR(reflected(20.0).y, 0.02, 1e-3); // too thick to interfere: both sides reflect on their own
}

/// The metal's reflectance at normal incidence is base_color, and the tint is exact at 82 degrees.
TEST(OpenPbr, MetalHasTheColoursAskedFor) {
    const glm::vec3 color(0.9f, 0.6f, 0.3f), tint(0.5f, 0.8f, 1.f);
    const SurfaceParameters p = openPbr({{In::BaseMetalness, grey(1)},
                                         {In::BaseColor, color},
                                         {In::SpecularColor, tint},
                                         {In::SpecularRoughness, grey(0.01)}});
    const glm::dvec3 facing = sampledAlbedo(p, direction(1.0, 0.0), 1 << 12);
    const glm::dvec3 edge = sampledAlbedo(p, direction(1.0 / 7.0, 0.0), 1 << 12);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(facing[c], color[c], 2e-3);
        const double schlick = color[c] + (1.0 - color[c]) * std::pow(6.0 / 7.0, 5.0);
        EXPECT_NEAR(edge[c], tint[c] * schlick, 2e-3);
    }
}

/// The table against quadrature of four times the points.
TEST(OpenPbr, TableIsConverged) {
    for (const double eta : {1.5, 1.0 / 1.5})
        for (const double roughness : {0.0, 0.3, 1.0})
            for (const double cosine : {0.05, 0.4, 0.9}) {
                const double alpha = std::max(roughness * roughness, 2e-4);
                const glm::vec2 coarse = interfaceAlbedo(cosine, alpha, eta, 36),
                                fine = interfaceAlbedo(cosine, alpha, eta, 112);
                EXPECT_NEAR(coarse.x, fine.x, 8e-3) << eta << " " << roughness << " " << cosine;
                EXPECT_NEAR(coarse.y, fine.y, 8e-3) << eta << " " << roughness << " " << cosine;
            }
}

} // namespace
} // namespace hipr::test
