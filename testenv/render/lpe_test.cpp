// Light path expressions: parts of the picture against pictures in which only these paths exist, and their
// sum.
#include <gtest/gtest.h>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

constexpr uint32_t Size = 24;

std::vector<AovRequest> withColor(const std::vector<std::string>& expressions) {
    std::vector<AovRequest> aovs{{AovKind::Color, {}}};
    for (const std::string& expression : expressions)
        aovs.push_back({AovKind::Lpe, expression});
    return aovs;
}

using Part = Picture<glm::vec3>;

Part part(Stage& stage, const std::string& expression) {
    return stage.read<glm::vec3>(AovKind::Lpe, expression);
}

glm::dvec3 mean(const Part& picture) {
    glm::dvec3 sum(0);
    for (const glm::vec3& value : picture.values)
        sum += glm::dvec3(value);
    return sum / double(picture.values.size());
}

/// The largest difference of the sum of parts from the color, over the color (or 1 where that is less).
double sumError(Stage& stage, const std::vector<std::string>& expressions) {
    const ColorPicture color = stage.color();
    std::vector<glm::dvec3> sums(color.values.size());
    for (const std::string& expression : expressions) {
        const Part picture = part(stage, expression);
        for (size_t i = 0; i < sums.size(); ++i)
            sums[i] += glm::dvec3(picture.values.at(i));
    }
    double worst = 0;
    for (size_t i = 0; i < sums.size(); ++i)
        for (int c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(sums[i][c] - double(color.values[i][c])) /
                                        std::max(1.0, double(color.values[i][c])));
    return worst;
}

void expectSame(const Part& a, const Part& b, double tolerance, const char* what) {
    ASSERT_EQ(a.values.size(), b.values.size());
    for (size_t i = 0; i < a.values.size(); ++i)
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(a.values[i][c], b.values[i][c], tolerance * std::max(1.f, b.values[i][c]))
                << what << " " << i;
}

bool sameBits(const Part& a, const Part& b) {
    return a.values.size() == b.values.size() &&
           std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(glm::vec3)) == 0;
}

Settings settingsOf(int samples, int depth = 4) {
    Settings settings;
    settings.samples = samples;
    settings.maxDepth = depth;
    settings.rouletteDepth = 16;
    return settings;
}

/// A red plastic: a tinted diffuse lobe below a rough white one and a coat.
MaterialDesc plastic() {
    MaterialDesc material;
    material.diffuseColor = constantColor({0.8f, 0.1f, 0.05f});
    material.roughness = constantValue(0.4f);
    material.clearcoat = constantValue(1.f);
    material.clearcoatRoughness = constantValue(0.2f);
    return material;
}

MaterialDesc glowing(glm::vec3 color) {
    MaterialDesc material = matte({0, 0, 0});
    material.emissiveColor = constantColor(color);
    return material;
}

LightDesc sphereLight(const std::string& group, glm::dvec3 at, glm::vec3 color) {
    LightDesc light;
    light.name = "/light " + group;
    light.kind = LightKind::Sphere;
    light.radius = 0.4f;
    light.transform = glm::translate(glm::dmat4(1), at);
    light.intensity = 8;
    light.color = color;
    light.group = group;
    return light;
}

/// Plastic, a mirror, glass and a lamp of cloth on a floor; lights of two groups, one of none and a sky.
void addRoom(Stage& stage, bool key = true, bool fill = true, bool lamp = true, bool sky = true) {
    addFloor(stage);
    stage.add(sphereMesh(), plastic(), {placed(scaling(0.8f, 0.8f, 0.8f), -1, 0, 0)});
    stage.add(sphereMesh(), mirror(), {placed(scaling(0.6f, 0.6f, 0.6f), 1, -0.3f, 0)});
    MaterialDesc glass;
    glass.diffuseColor = constantColor({0, 0, 0});
    glass.opacity = constantValue(0.f);
    glass.roughness = constantValue(0.05f);
    stage.add(sphereMesh(), glass, {placed(scaling(0.4f, 0.4f, 0.4f), 0.2f, -0.6f, 1.5f)});
    stage.add(quadMesh(), glowing(lamp ? glm::vec3(2, 1.5f, 1) : glm::vec3(0)),
              {placed(scaling(1, 1, 1), 0, 1.2f, -1)});
    if (key) stage.add(sphereLight("key", {3, 3, 3}, {1, 1, 0.5f}));
    if (fill) stage.add(sphereLight("fill", {-3, 2, 2}, {0.2f, 0.4f, 1}));
    LightDesc dome;
    dome.name = "/sky";
    dome.kind = LightKind::Dome;
    dome.intensity = sky ? 0.2f : 0.f;
    stage.add(dome);
    stage.edit.setCamera(lookAt({0, 1, 6}, {0, 0, 0}));
}

const std::vector<std::string> byFirstEvent = {"C[LO]", "C<RD>.*", "C<RS[^'coat']>.*", "C<RS'coat'>.*",
                                               "CT.*"};

} // namespace

TEST(LightPaths, PartsAddUpToThePicture) {
    Stage stage(settingsOf(16));
    addRoom(stage);
    std::vector<std::string> all = byFirstEvent;
    const std::vector<std::string> groups = {"C.*<L.'key'>", "C.*<L.'fill'>", "C.*B", "C.*O"};
    const std::vector<std::string> byLength = {"C.", "C..", "C...", "C.{4,}"};
    all.insert(all.end(), groups.begin(), groups.end());
    all.insert(all.end(), byLength.begin(), byLength.end());
    all.push_back("C.*");
    stage.film(Size, Size, withColor(all));
    stage.render();
    EXPECT_LT(sumError(stage, byFirstEvent), 2e-5);
    EXPECT_LT(sumError(stage, groups), 2e-5);
    EXPECT_LT(sumError(stage, byLength), 2e-5);
    EXPECT_LT(sumError(stage, {"C.*"}), 2e-5);
    for (const std::string& expression : all)
        EXPECT_GT(glm::length(mean(part(stage, expression))), 1e-3) << expression << " has something";
    EXPECT_TRUE(stage.messages().empty());
}

// A group is the picture in which its lights alone shine; light of others is not in it.
TEST(LightPaths, GroupsAreThePicturesOfTheirLights) {
    constexpr int Samples = 256;
    Stage all(settingsOf(Samples));
    addRoom(all);
    all.film(Size, Size, withColor({"C.*<L.'key'>", "C.*<L.'fill'>", "C.*B", "C.*O"}));
    all.render();
    const std::pair<const char*, std::array<bool, 4>> alone[] = {
        {"C.*<L.'key'>", {true, false, false, false}},
        {"C.*<L.'fill'>", {false, true, false, false}},
        {"C.*B", {false, false, false, true}},
        {"C.*O", {false, false, true, false}}};
    for (const auto& [expression, on] : alone) {
        Stage one(settingsOf(Samples));
        addRoom(one, on[0], on[1], on[2], on[3]);
        one.film(Size, Size, withColor({"C.*"}));
        one.render();
        const glm::dvec3 expected = mean(part(one, "C.*")), found = mean(part(all, expression));
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c], expected[c], 0.03 * glm::length(expected)) << expression << " " << c;
    }
}

// Direct and indirect light against pictures that end after so many bounces.
TEST(LightPaths, LengthsAreThoseOfBounces) {
    Part shorter;
    for (const int depth : {1, 2}) {
        Stage stage(settingsOf(16, depth));
        addRoom(stage);
        stage.film(Size, Size, withColor({"C.", "C..", "C..."}));
        stage.render();
        if (depth == 1) {
            EXPECT_LT(sumError(stage, {"C.", "C.."}), 2e-5);
            EXPECT_EQ(mean(part(stage, "C...")), glm::dvec3(0)) << "there is one bounce";
            shorter = part(stage, "C..");
        } else {
            expectSame(part(stage, "C.."), shorter, 1e-5, "direct light does not depend on what follows");
            EXPECT_GT(mean(part(stage, "C...")).x, 0.01);
        }
    }
}

// The lobes of a bounce are split in proportion to what each scatters: the diffuse part is that of the
// diffuse lobe, by light samples, by the BSDF's and by both, and keeps its colour where the others are white.
TEST(LightPaths, LobesAreSplitExactly) {
    const auto render = [](float radius, bool lobes) {
        auto stage = std::make_unique<Stage>(settingsOf(512, 1));
        MaterialDesc material = plastic();
        material.diffuseColor = constantColor({0.8f, 0, 0});
        if (!lobes) material.clearcoat = constantValue(0.f);
        stage->add(quadMesh(), material, {scaling(4, 4, 1)});
        LightDesc light = sphereLight("", {0, 0, 3}, {1, 1, 1});
        light.radius = radius;
        light.normalize = true;
        light.intensity = 40;
        stage->add(light);
        stage->edit.setCamera(lookAt({0, 0.5, 5}, {0, 0, 0}));
        stage->film(8, 8, withColor({"C<RD>L", "C<RS'specular'>L", "C<RS'coat'>L", "C<RS>L", "C.*"}));
        stage->render();
        return stage;
    };
    for (const float radius : {0.01f, 0.5f, 2.f}) {
        auto stage = render(radius, true);
        const glm::dvec3 diffuse = mean(part(*stage, "C<RD>L")), shiny = mean(part(*stage, "C<RS>L"));
        EXPECT_GT(diffuse.x, 0.1);
        EXPECT_NEAR(diffuse.y, 0, 1e-6) << "nothing of the white highlight is in it, radius " << radius;
        EXPECT_NEAR(shiny.x / shiny.y, 1, 0.05) << "nothing red is in the highlight, radius " << radius;
        const glm::dvec3 sum = mean(part(*stage, "C<RS'specular'>L")) + mean(part(*stage, "C<RS'coat'>L"));
        EXPECT_LT(glm::length(sum - shiny), 1e-5);
        EXPECT_LT(sumError(*stage,
                           {
                               "C<RD>L",
                               "C<RS>L",
                           }),
                  1.1)
            << "but for what the camera sees of the light";
    }
    auto bare = render(0.5f, false);
    EXPECT_EQ(mean(part(*bare, "C<RS'coat'>L")), glm::dvec3(0));
}

TEST(LightPaths, NoOrderOfWorkShows) {
    std::vector<Part> parts;
    for (const char* mode : {"uniform", "delta"})
        for (const uint32_t batch : {100u, 8192u}) {
            Settings settings = settingsOf(8);
            settings.mode = mode;
            Stage stage(settings, {8, batch});
            addRoom(stage);
            stage.film(Size, Size, withColor({"C<RD>.*", "C.*<L.'key'>"}));
            stage.render();
            parts.push_back(part(stage, "C.*<L.'key'>"));
        }
    for (const Part& picture : parts)
        EXPECT_TRUE(sameBits(picture, parts.front()));
}

TEST(LightPaths, FollowEdits) {
    const auto fresh = [](const std::string& group) {
        auto stage = std::make_unique<Stage>(settingsOf(8));
        addRoom(*stage, false);
        stage->add(sphereLight(group, {3, 3, 3}, {1, 1, 0.5f}));
        stage->film(Size, Size, withColor({"C.*<L.'key'>", "C.*<L.'rim'>"}));
        stage->render();
        return stage;
    };
    auto stage = std::make_unique<Stage>(settingsOf(8));
    addRoom(*stage, false);
    LightDesc light = sphereLight("key", {3, 3, 3}, {1, 1, 0.5f});
    const LightId id = stage->add(light);
    stage->film(Size, Size);
    stage->render();
    stage->film(Size, Size, withColor({"C.*<L.'key'>", "C.*<L.'rim'>"}));
    stage->render();
    EXPECT_TRUE(sameBits(part(*stage, "C.*<L.'key'>"), part(*fresh("key"), "C.*<L.'key'>")));
    EXPECT_EQ(mean(part(*stage, "C.*<L.'rim'>")), glm::dvec3(0));
    light.group = "rim";
    light.name = "/light rim";
    stage->edit.setLight(id, light);
    stage->render();
    auto rim = fresh("rim");
    EXPECT_TRUE(sameBits(part(*stage, "C.*<L.'rim'>"), part(*rim, "C.*<L.'rim'>")));
    EXPECT_EQ(mean(part(*stage, "C.*<L.'key'>")), glm::dvec3(0));
}

TEST(LightPaths, TellOnceOfWhatTheyCannotDo) {
    Stage stage(settingsOf(2));
    addRoom(stage);
    stage.film(8, 8, withColor({"unoccluded;C<RD>L", "C.*"}));
    stage.render();
    stage.film(9, 9, withColor({"unoccluded;C<RD>L", "C.*"}));
    stage.render();
    ASSERT_EQ(stage.messages().size(), 1u);
    EXPECT_EQ(stage.messages()[0].subject, "lpe:unoccluded;C<RD>L");
    EXPECT_EQ(stage.messages()[0].text, "the prefix 'unoccluded;' is not supported; this AOV stays black");
    EXPECT_EQ(mean(part(stage, "unoccluded;C<RD>L")), glm::dvec3(0));
    EXPECT_LT(sumError(stage, {"C.*"}), 2e-5);
}

TEST(LightPaths, LeaveThePictureAsItIs) {
    const auto render = [](const std::vector<std::string>& expressions) {
        Stage stage(settingsOf(8));
        addRoom(stage);
        stage.film(Size, Size, withColor(expressions));
        stage.render();
        return stage.color();
    };
    const ColorPicture without = render({}), with = render({"C<RD>.*"});
    for (size_t i = 0; i < without.values.size(); ++i)
        ASSERT_LT(glm::length(without.values[i] - with.values[i]),
                  1e-4f * (1 + glm::length(without.values[i])));
}
