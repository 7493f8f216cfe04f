// OpenPBR Surface: white materials return all light (the white furnace).
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "testenv/unit/shading/bsdf_survey.h"

namespace hipr::test {
namespace {

using In = OpenPbrInput;

/// White all over, so that nothing is absorbed.
SurfaceParameters white(OpenPbrValues values) {
    return with(openPbr({{In::BaseColor, grey(1)}, {In::SubsurfaceColor, grey(1)}}), values);
}

void expectWhite(const SurfaceParameters& parameters, const ::testing::Message& what,
                 const std::vector<double>& azimuths = {0.7}) {
    for (const double cosine : {0.98, 0.6, 0.3, 0.1})
        for (const double azimuth : azimuths) {
            const glm::dvec3 albedo = sampledAlbedo(parameters, direction(cosine, azimuth), 1 << 14);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(albedo[c], 1.0, 0.01)
                    << what << ", cosine " << cosine << ", azimuth " << azimuth << ", channel " << c;
        }
}

const std::vector<double> AllAround = {0.0, 0.4, 0.8, 1.2, 1.5};

TEST(OpenPbr, WhiteDiffuseKeepsAllLight) {
    for (const double roughness : {0.05, 0.3, 0.6, 1.0})
        for (const double ior : {1.1, 1.5, 2.5})
            for (const double rough : {0.0, 0.4, 1.0})
                expectWhite(white({{In::SpecularRoughness, grey(roughness)},
                                   {In::SpecularIor, grey(ior)},
                                   {In::BaseDiffuseRoughness, grey(rough)}}),
                            ::testing::Message() << "roughness " << roughness << ", ior " << ior
                                                 << ", diffuse roughness " << rough);
}

TEST(OpenPbr, WhiteMetalKeepsAllLight) {
    for (const double roughness : {0.05, 0.1, 0.13, 0.16, 0.2, 0.3, 0.6, 1.0})
        for (const double metalness : {0.5, 1.0})
            expectWhite(
                white({{In::SpecularRoughness, grey(roughness)}, {In::BaseMetalness, grey(metalness)}}),
                ::testing::Message() << "roughness " << roughness << ", metalness " << metalness);
}

TEST(OpenPbr, StretchedHighlightsKeepAllLight) {
    for (const double roughness : {0.3, 0.6, 1.0})
        for (const double anisotropy : {0.5, 0.9})
            for (const double metalness : {0.0, 1.0})
                expectWhite(white({{In::SpecularRoughness, grey(roughness)},
                                   {In::SpecularRoughnessAnisotropy, grey(anisotropy)},
                                   {In::BaseMetalness, grey(metalness)}}),
                            ::testing::Message() << "roughness " << roughness << ", anisotropy " << anisotropy
                                                 << ", metalness " << metalness,
                            AllAround);
}

/// The edge of total reflection is sharper than the table where glass is seen at a grazing angle from inside.
TEST(OpenPbr, StretchedGlassKeepsAllLight) {
    std::vector<double> errors;
    for (const double roughness : {0.3, 0.6, 1.0})
        for (const double anisotropy : {0.5, 0.9})
            for (const double ior : {1.1, 1.5, 2.5})
                for (const uint32_t front : {1u, 0u})
                    for (const double cosine : {0.6, 0.3, 0.1})
                        for (const double azimuth : {0.0, 0.5, 1.0, 1.5}) {
                            SurfaceParameters p = white({{In::TransmissionWeight, grey(1)},
                                                         {In::SpecularRoughness, grey(roughness)},
                                                         {In::SpecularRoughnessAnisotropy, grey(anisotropy)},
                                                         {In::SpecularIor, grey(ior)}});
                            p.frontFacing = front;
                            const glm::vec3 wo = direction(cosine, azimuth);
                            errors.push_back(std::abs(sampledAlbedo(p, wo, 1 << 16).y - 1.0));
                            EXPECT_LT(errors.back(), front ? 0.01 : 0.025)
                                << "roughness " << roughness << ", anisotropy " << anisotropy << ", ior "
                                << ior << ", front " << front << ", cosine " << cosine << ", azimuth "
                                << azimuth;
                        }
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() * 99 / 100], 0.01);
}

TEST(OpenPbr, StretchedSheetsAndCoatsKeepAllLight) {
    for (const double roughness : {0.1, 0.5, 1.0})
        for (const double anisotropy : {0.5, 0.9}) {
            const auto where = [&](const char* what) {
                return ::testing::Message()
                       << what << ", roughness " << roughness << ", anisotropy " << anisotropy;
            };
            expectWhite(white({{In::GeometryThinWalled, grey(1)},
                               {In::TransmissionWeight, grey(1)},
                               {In::SpecularRoughness, grey(roughness)},
                               {In::SpecularRoughnessAnisotropy, grey(anisotropy)}}),
                        where("sheet"), AllAround);
            expectWhite(white({{In::CoatWeight, grey(1)},
                               {In::CoatRoughness, grey(roughness)},
                               {In::CoatRoughnessAnisotropy, grey(anisotropy)}}),
                        where("coat"), AllAround);
        }
}

TEST(OpenPbr, GlassKeepsAllLight) {
    for (const double roughness : {0.05, 0.3, 0.6, 1.0})
        for (const double ior : {1.1, 1.5, 2.5})
            for (const uint32_t front : {1u, 0u}) {
                SurfaceParameters p = white({{In::TransmissionWeight, grey(1)},
                                             {In::SpecularRoughness, grey(roughness)},
                                             {In::SpecularIor, grey(ior)}});
                p.frontFacing = front;
                expectWhite(p, ::testing::Message()
                                   << "roughness " << roughness << ", ior " << ior << ", front " << front);
            }
}

TEST(OpenPbr, SheetsKeepAllLight) {
    for (const double roughness : {0.05, 0.5, 1.0})
        for (const double transmission : {0.0, 1.0})
            for (const double subsurface : {0.0, 1.0})
                expectWhite(white({{In::GeometryThinWalled, grey(1)},
                                   {In::TransmissionWeight, grey(transmission)},
                                   {In::SubsurfaceWeight, grey(subsurface)},
                                   {In::SubsurfaceScatterAnisotropy, grey(0.5)},
                                   {In::SpecularRoughness, grey(roughness)}}),
                            ::testing::Message() << "roughness " << roughness << ", transmission "
                                                 << transmission << ", subsurface " << subsurface);
}

TEST(OpenPbr, CoatAndFuzzKeepAllLight) {
    for (const double metalness : {0.0, 1.0})
        for (const double transmission : {0.0, 1.0})
            for (const double coat : {0.0, 1.0})
                for (const double fuzz : {0.0, 1.0})
                    for (const double roughness : {0.1, 0.8})
                        expectWhite(white({{In::BaseMetalness, grey(metalness)},
                                           {In::TransmissionWeight, grey(transmission)},
                                           {In::CoatWeight, grey(coat)},
                                           {In::CoatRoughness, grey(roughness)},
                                           {In::FuzzWeight, grey(fuzz)},
                                           {In::FuzzRoughness, grey(roughness)}}),
                                    ::testing::Message() << "metalness " << metalness << ", transmission "
                                                         << transmission << ", coat " << coat << ", fuzz "
                                                         << fuzz << ", roughness " << roughness);
}

TEST(OpenPbr, FilmsKeepAllLight) {
    for (const double thickness : {0.1, 0.4})
        for (const double ior : {1.3, 2.0})
            for (const double metalness : {0.0, 1.0})
                for (const double roughness : {0.05, 0.3, 0.8})
                    for (const auto& [transmission, front] : {std::pair(0.0, 1u), {1.0, 1u}, {1.0, 0u}}) {
                        SurfaceParameters p = white({{In::ThinFilmWeight, grey(1)},
                                                     {In::ThinFilmThickness, grey(thickness)},
                                                     {In::ThinFilmIor, grey(ior)},
                                                     {In::BaseMetalness, grey(metalness)},
                                                     {In::TransmissionWeight, grey(transmission)},
                                                     {In::SpecularRoughness, grey(roughness)}});
                        p.frontFacing = front;
                        expectWhite(p, ::testing::Message()
                                           << "thickness " << thickness << ", ior " << ior << ", metalness "
                                           << metalness << ", roughness " << roughness << ", transmission "
                                           << transmission << ", front " << front);
                    }
}

/// Anything of the model at once: a part of the weights is 0 or 1, everything else is drawn from all of its
/// range.
SurfaceParameters randomWhite(std::mt19937& random) {
    const auto any = [&] { return std::uniform_real_distribution<>(0.0, 1.0)(random); };
    const auto weight = [&] { return std::clamp(1.6 * any() - 0.3, 0.0, 1.0); };
    const bool sheet = any() < 0.3;
    SurfaceParameters p = white({{In::BaseMetalness, grey(weight())},
                                 {In::BaseDiffuseRoughness, grey(any())},
                                 {In::SpecularRoughness, grey(any())},
                                 {In::SpecularRoughnessAnisotropy, grey(weight())},
                                 {In::SpecularIor, grey(1.05 + 1.8 * any())},
                                 {In::TransmissionWeight, grey(weight())},
                                 {In::CoatWeight, grey(weight())},
                                 {In::CoatRoughness, grey(any())},
                                 {In::CoatRoughnessAnisotropy, grey(weight())},
                                 {In::CoatIor, grey(1.05 + any())},
                                 {In::FuzzWeight, grey(weight())},
                                 {In::FuzzRoughness, grey(any())},
                                 {In::ThinFilmWeight, grey(weight())},
                                 {In::ThinFilmThickness, grey(any())},
                                 {In::ThinFilmIor, grey(1.1 + any())},
                                 {In::GeometryThinWalled, grey(sheet)},
                                 {In::SubsurfaceWeight, grey(sheet ? weight() : 0.0)}});
    p.frontFacing = any() < 0.75;
    return p;
}

/// Two of a thousand are beyond 1 %, seen at grazing angles: stretched glass from inside, where the table is
/// not as sharp as the edge of total reflection, and a film under a coat.
TEST(OpenPbr, RandomWhiteMaterialsKeepAllLight) {
    std::mt19937 random(5);
    std::vector<double> errors;
    for (int i = 0; i < 300; ++i) {
        const SurfaceParameters p = randomWhite(random);
        const double cosine = std::uniform_real_distribution<>(0.06, 1.0)(random);
        const double azimuth = std::uniform_real_distribution<>(0.0, 6.28)(random);
        const glm::dvec3 albedo = sampledAlbedo(p, direction(cosine, azimuth), 1 << 15);
        errors.push_back(0.0);
        for (int c = 0; c < 3; ++c)
            errors.back() = std::max(errors.back(), std::abs(albedo[c] - 1.0));
        EXPECT_LT(errors.back(), 0.02) << "material " << i << ", cosine " << cosine;
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() * 99 / 100], 0.01);
}

} // namespace
} // namespace hipr::test
