// Light inside objects: OpenPBR materials whose pictures are known.
#include <cmath>

#include <gtest/gtest.h>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

using In = OpenPbrInput;

MaterialDesc openPbr(const std::vector<std::pair<In, glm::vec3>>& values) {
    MaterialDesc desc;
    desc.name = "/openpbr";
    desc.model = MaterialModel::OpenPbr;
    for (const auto& [input, value] : values) {
        desc.openPbr[input] = openPbrDefault(input);
        desc.openPbr[input].constant = glm::vec4(value, 1.f);
    }
    return desc;
}

glm::vec3 grey(float value) {
    return glm::vec3(value);
}

/// A ball of radius 1 in a white sky, seen so close that it fills most of the picture.
ColorPicture ball(const MaterialDesc& material, uint32_t samples, double degrees = 30) {
    Settings settings;
    settings.samples = samples;
    settings.maxDepth = 256;
    settings.rouletteDepth = 64;
    Stage stage(settings);
    stage.add(sphereMesh(64), material);
    stage.add(skyLight());
    stage.edit.setCamera(lookAt({0, 0, 4.2}, {0, 0, 0}, degrees));
    stage.film(24, 24);
    stage.render();
    return stage.color();
}

} // namespace

/// White balls vanish before a white sky, whatever light does inside them.
TEST(OpenPbrPicture, WhiteFurnace) {
    const std::pair<const char*, MaterialDesc> materials[] = {
        {"standard", openPbr({{In::BaseColor, grey(1)}})},
        {"rough glass", openPbr({{In::TransmissionWeight, grey(1)}, {In::SpecularRoughness, grey(0.7f)}})},
        {"milky glass", openPbr({{In::TransmissionWeight, grey(1)},
                                 {In::TransmissionDepth, grey(1)},
                                 {In::TransmissionScatter, grey(1)},
                                 {In::TransmissionScatterAnisotropy, grey(0.5f)}})},
        {"dispersing glass",
         openPbr({{In::TransmissionWeight, grey(1)}, {In::TransmissionDispersionScale, grey(1)}})},
        {"subsurface", openPbr({{In::SubsurfaceWeight, grey(1)},
                                {In::SubsurfaceColor, grey(1)},
                                {In::SubsurfaceRadius, grey(0.2f)}})},
        {"sheet", openPbr({{In::GeometryThinWalled, grey(1)},
                           {In::TransmissionWeight, grey(0.5f)},
                           {In::SubsurfaceWeight, grey(1)},
                           {In::SubsurfaceColor, grey(1)}})},
    };
    for (const auto& [name, material] : materials) {
        const glm::vec4 seen = mean(ball(material, 128));
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen[c], 1.f, 0.012f) << name << " channel " << c;
    }
}

/// Through the middle of a ball that hardly refracts: Beer's law over its diameter.
TEST(OpenPbrPicture, GlassAbsorbsAlongTheWay) {
    const glm::vec3 color(0.8f, 0.5f, 0.2f);
    const ColorPicture picture = ball(openPbr({{In::TransmissionWeight, grey(1)},
                                               {In::SpecularWeight, grey(0)},
                                               {In::SpecularRoughness, grey(0)},
                                               {In::TransmissionDepth, grey(1.6f)},
                                               {In::TransmissionColor, color}}),
                                      16, 2);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean(picture)[c], std::pow(color[c], 2.f / 1.6f), 0.01f) << "channel " << c;
}

/// A dense ball reflects the colour asked for; its interface is made to vanish.
TEST(OpenPbrPicture, SubsurfaceHasTheColourAskedFor) {
    const glm::vec3 color(0.8f, 0.5f, 0.2f);
    const glm::vec4 seen = mean(ball(openPbr({{In::SubsurfaceWeight, grey(1)},
                                              {In::SpecularWeight, grey(0)},
                                              {In::SubsurfaceColor, color},
                                              {In::SubsurfaceRadius, grey(0.02f)},
                                              {In::SubsurfaceRadiusScale, grey(1)}}),
                                     64, 5));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen[c], color[c], 0.03f) << "channel " << c;
}

/// A wall whose coat looks another way reflects what is there, and follows edits of the graph that says so.
TEST(OpenPbrPicture, CoatsHaveANormalOfTheirOwn) {
    const auto coated = [](float degrees) {
        MaterialDesc desc =
            openPbr({{In::BaseWeight, grey(0)}, {In::SpecularWeight, grey(0)}, {In::CoatWeight, grey(1)}});
        GraphBuilder build;
        const GraphValue normal = build.geometry(gpu::GRAPH_NORMAL, gpu::GRAPH_WORLD);
        const GraphValue turned =
            build.op(gpu::GRAPH_ROTATE, normal, GraphValue(degrees), GraphValue(glm::vec4(0, 1, 0, 0)));
        desc.openPbr[In::GeometryCoatNormal] = build.input(turned, openPbrDefault(In::GeometryCoatNormal));
        desc.graph = build.graph();
        return desc;
    };
    Settings settings;
    settings.samples = 16;
    Stage stage(settings);
    const auto wall = uint32_t(stage.add(quadMesh(), coated(-30.f)));
    LightDesc lamp; // at 60 degrees to the right of the wall's middle
    lamp.kind = LightKind::Sphere;
    lamp.radius = 2.f;
    lamp.transform = glm::translate(glm::dmat4(1.0), glm::dvec3(8.66, 0, 5));
    stage.add(lamp);
    stage.edit.setCamera(lookAt({0, 0, 20}, {0, 0, 0}, 1));
    stage.film(8, 8);
    stage.render();
    // Fresnel's equations at 30 degrees for an index of 1.6, and a radiance of 1.
    EXPECT_NEAR(mean(stage.color()).y, 0.05495f, 0.0005f);
    stage.edit.setMaterial(MaterialId(wall - 1), coated(30.f)); // the id that was made before
    stage.render();
    EXPECT_LT(mean(stage.color()).y, 1e-4f);
}

/// A primvar gives the same medium as a constant, and a dense one is another.
TEST(OpenPbrPicture, SubsurfaceRadiusMayVary) {
    const auto material = [](float radius) {
        return openPbr({{In::SubsurfaceWeight, grey(1)},
                        {In::SpecularWeight, grey(0)},
                        {In::SubsurfaceColor, grey(0.7f)},
                        {In::SubsurfaceRadius, grey(radius)},
                        {In::SubsurfaceRadiusScale, grey(1)}});
    };
    MaterialDesc driven = material(0.02f);
    MaterialInput& radius = driven.openPbr[In::SubsurfaceRadius];
    radius.source = MaterialInput::Source::Primvar;
    radius.primvar = "radius"; // which the ball has not: the constant
    MaterialDesc scaled = material(1.f);
    scaled.openPbr[In::SubsurfaceRadiusScale].source = MaterialInput::Source::Primvar;
    scaled.openPbr[In::SubsurfaceRadiusScale].primvar = "scale";
    const float dense = mean(ball(material(0.02f), 64)).y, thin = mean(ball(material(1.f), 64)).y;
    EXPECT_GT(std::abs(dense - thin), 0.05f);
    EXPECT_NEAR(mean(ball(driven, 64)).y, dense, 0.01f);
    EXPECT_NEAR(mean(ball(scaled, 64)).y, thin, 0.01f);
}
