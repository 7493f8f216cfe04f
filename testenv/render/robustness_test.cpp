// Bad input gives one message that names its element; the rest renders.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

TEST(Robustness, NothingToRender) {
    Stage stage;
    EXPECT_FALSE(stage.renderer->renderBatch()); // no film, no camera
    EXPECT_TRUE(stage.renderer->progress().converged);
    stage.film(0, 0);
    stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}));
    stage.render();
    float none;
    EXPECT_TRUE(stage.renderer->readAov({AovKind::Color, {}}, &none, 0));
    EXPECT_TRUE(stage.renderer->progress().converged);
    stage.film(8, 8); // an empty scene is a picture too
    stage.render();
    EXPECT_TRUE(stage.renderer->progress().converged);
    EXPECT_EQ(mean(stage.color()), glm::vec4(0.f));
}

TEST(Robustness, ACameraThatCannotBeInverted) {
    Stage stage;
    stage.film(8, 8);
    CameraDesc camera = lookAt({0, 0, 4}, {0, 0, 0});
    camera.projection = glm::dmat4(0);
    stage.edit.setCamera(camera);
    stage.render();
    stage.render();
    EXPECT_TRUE(stage.renderer->progress().converged); // or hosts would wait forever
    const std::vector<Message> messages = stage.messages();
    EXPECT_EQ(std::count_if(messages.begin(), messages.end(),
                            [](const Message& m) { return m.severity == Severity::Error; }),
              1);
    stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}));
    stage.render();
    EXPECT_TRUE(stage.renderer->progress().converged);
}

TEST(Robustness, BrokenTransformsAndMissingGeometry) {
    Stage stage;
    stage.film(8, 8, {{AovKind::PrimId, {}}});
    stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}));
    stage.add(skyLight());
    glm::mat4x3 nan(1.f);
    nan[1].y = std::nanf("");
    const ObjectId broken = stage.add(quadMesh(), matte(glm::vec3(0.5f)),
                                      {nan, scaling(0, 1, 1), scaling(4, 4, 1), scaling(1, 1, 0)});
    ObjectDesc lost;
    lost.name = "/lost";
    lost.geometry = GeometryId(12345);
    stage.edit.setObject(stage.renderer->newId<ObjectId>(), lost);
    stage.render();
    std::vector<std::string> subjects;
    for (const Message& message : stage.messages())
        subjects.push_back(message.subject);
    EXPECT_THAT(subjects,
                testing::UnorderedElementsAre("/object" + std::to_string(uint32_t(broken)), "/lost"));
    EXPECT_EQ(stage.read<int>(AovKind::PrimId).at(4, 4), int(broken)); // the good instance is there
    stage.edit.setCamera(lookAt({0, 0, 5}, {0, 0, 0}));
    stage.render();
    EXPECT_EQ(stage.messages().size(), 2u); // said once
}

TEST(Robustness, NotANumberIsDropped) {
    Stage stage;
    stage.film(8, 8);
    stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}));
    stage.add(skyLight());
    MaterialDesc glow;
    glow.emissiveColor.source = MaterialInput::Source::Primvar;
    glow.emissiveColor.primvar = "glow";
    const float inf = std::numeric_limits<float>::infinity();
    stage.add(quadMesh({{"glow", Interpolation::Vertex, 3, {inf, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}}}), glow,
              {scaling(9, 9, 1)});
    stage.render();
    for (const glm::vec4& value : stage.color().values)
        EXPECT_TRUE(std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z));
    ASSERT_EQ(stage.messages().size(), 1u);
    EXPECT_THAT(stage.messages()[0].text, testing::HasSubstr("NaN"));
}

TEST(Robustness, APictureTooLarge) {
    Stage stage;
    stage.film(70000, 1);
    stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}));
    stage.render();
    ASSERT_GE(stage.messages().size(), 1u);
    EXPECT_EQ(stage.messages()[0].severity, Severity::Error);
}

TEST(Robustness, UnknownTraversalFallsBack) {
    Settings settings;
    settings.samples = 1;
    settings.traversal = "none of these";
    Stage stage(settings);
    stage.film(8, 8);
    stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}));
    stage.render();
    EXPECT_TRUE(stage.renderer->progress().converged);
}
