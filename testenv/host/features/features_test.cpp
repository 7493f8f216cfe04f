// The scenes of testenv/scenes, each of one feature: no message, and known colours at known places.
#include <cmath>
#include <gmock/gmock.h>

#include "testenv/host/features/colours.h"
#include "testenv/host/recorder.h"

namespace hipr::test {
namespace {

/// A place in units of the scene's board, whose middle is the middle of the picture.
struct Place {
    double x, y;
    const char* colour;
};

struct Feature {
    const char* name;
    const char* scene;
    double width, height; ///< of the board
    std::vector<std::string> arguments;
    std::vector<Place> places;
};

std::ostream& operator<<(std::ostream& out, const Feature& feature) {
    return out << feature.name;
}

class FeatureTest : public RecorderTest, public testing::WithParamInterface<Feature> {
protected:
    /// Records one of our scenes with at least 20 pixels per unit of its board; no message may appear.
    ImageFile recordScene(const std::string& name, double width, double height,
                          std::vector<std::string> arguments) const {
        const std::string size = std::to_string(int(std::lround(20 * width))) + "x" +
                                 std::to_string(int(std::lround(20 * height)));
        arguments.insert(arguments.begin(),
                         {HIPR_SOURCE_DIR "/testenv/scenes/" + name, "-o", file("a.exr"), "--size", size});
        if (std::find(arguments.begin(), arguments.end(), "--samples") == arguments.end())
            arguments.insert(arguments.end(), {"--samples", "16"});
        const Outcome outcome = run(command(std::move(arguments)));
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        EXPECT_THAT(outcome.text, testing::Not(testing::HasSubstr("warning"))) << outcome.text;
        EXPECT_THAT(outcome.text, testing::Not(testing::HasSubstr("error"))) << outcome.text;
        return ImageFile(file("a.exr"));
    }
};

TEST_P(FeatureTest, KnownColoursAtKnownPlaces) {
    const Feature& feature = GetParam();
    const ImageFile image = recordScene(feature.scene, feature.width, feature.height, feature.arguments);
    for (const Place& place : feature.places) {
        EXPECT_EQ(colourName(image, 0.5 + place.x / feature.width, 0.5 - place.y / feature.height),
                  place.colour)
            << "at " << place.x << ", " << place.y;
    }
}

std::string nameOf(const testing::TestParamInfo<Feature>& info) {
    return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    Geometry, FeatureTest,
    testing::Values(
        Feature{"GeomSubsets",
                "geom_subsets.usda",
                6,
                2,
                {},
                {{-2, 0, "red"}, {-1, 0, "green"}, {0, 0, "blue"}, {1, 0, "green"}, {2, 0, "blue"}}},
        Feature{"Primvars",
                "primvars.usda",
                8,
                3,
                {},
                {{-3.125, 0.8, "blue"},
                 {-3.125, -0.8, "blue"},
                 {-1.875, 0.1, "green"},
                 {-1.875, -0.1, "red"},
                 {-0.625, 0.8, "green"},
                 {-0.625, 0, "yellow"},
                 {-0.625, -0.8, "red"},
                 {0.625, 0.8, "green"},
                 {0.625, -0.8, "red"},
                 {1.875, 0.8, "green"},
                 {1.875, 0, "yellow"},
                 {1.875, -0.8, "red"},
                 {3.125, 0.8, "green"},
                 {3.125, 0, "yellow"},
                 {3.125, -0.8, "red"}}},
        Feature{"SkinningAtRest",
                "skinning.usda",
                4,
                4,
                {"--frames", "1"},
                {{0, 0.8, "red"}, {0, -0.8, "red"}, {0.8, 0, "black"}}},
        Feature{"SkinningBent",
                "skinning.usda",
                4,
                4,
                {"--frames", "10"},
                {{0, 0.8, "black"}, {0, -0.8, "red"}, {0.8, 0, "red"}}},
        Feature{"BlendShapeAtRest",
                "blend_shapes.usda",
                4,
                4,
                {"--frames", "1"},
                {{0, 0.9, "red"}, {1.1, 0.9, "black"}, {-1.1, 0.9, "black"}, {0, -0.8, "red"}}},
        Feature{"BlendShapeInbetween",
                "blend_shapes.usda",
                4,
                4,
                {"--frames", "5.5"},
                {{0, 0.9, "black"}, {1.1, 0.9, "black"}, {-1.1, 0.9, "red"}, {0, -0.8, "red"}}},
        Feature{"BlendShape",
                "blend_shapes.usda",
                4,
                4,
                {"--frames", "10"},
                {{0, 0.9, "black"}, {1.1, 0.9, "red"}, {-1.1, 0.9, "black"}, {0, -0.8, "red"}}}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(DrawModes, FeatureTest,
                         testing::Values(Feature{"Cards",
                                                 "cards.usda",
                                                 14,
                                                 2,
                                                 {},
                                                 {{-4.7, -0.7, "red"},
                                                  {-4.3, -0.7, "green"},
                                                  {-3.7, -0.7, "blue"},
                                                  {-3.3, -0.7, "white"},
                                                  {-2.4, 0.3, "red"},
                                                  {-1.4, -0.3, "red"},
                                                  {-0.4, 0.3, "blue"},
                                                  {0.6, -0.3, "blue"},
                                                  {1.3, -0.7, "red"},
                                                  {1.7, -0.7, "green"},
                                                  {2.3, -0.7, "blue"},
                                                  {2.7, -0.7, "white"},
                                                  {3.6, 0.3, "green"},
                                                  {4.4, -0.3, "green"},
                                                  {3, 0, "black"},
                                                  {5.2, 0, "green"},
                                                  {6, 0, "black"}}}),
                         nameOf);

INSTANTIATE_TEST_SUITE_P(Instancing, FeatureTest,
                         testing::Values(Feature{
                             "Instancing",
                             "instancing.usda",
                             8,
                             8,
                             {},
                             {{-3, 3, "red"},     {-1, 3.4, "green"},   {-0.65, 3, "black"}, {1, 3, "black"},
                              {3, 3.4, "green"},  {3.4, 3, "black"}, // point instancer
                              {-2.3, 1, "green"}, {-1.7, 1, "blue"},    {-0.3, 1, "green"},  {0.3, 1, "blue"},
                              {1.7, 1, "green"},  {2.3, 1, "blue"},     {1, 1, "black"}, // native
                              {-2.5, -1, "red"},  {-2.25, -1, "black"}, {-2, -1, "red"},     {1.5, -1, "red"},
                              {2.5, -1, "red"},   {0, -1, "black"}, // point in point
                              {-2.5, -3, "red"},  {-2.25, -3, "black"}, {2, -3, "red"},      {2.5, -3, "red"},
                              {0, -3, "black"}}}), // point in native
                         nameOf);

INSTANTIATE_TEST_SUITE_P(
    Cameras, FeatureTest,
    testing::Values(Feature{"Perspective",
                            "cameras.usda",
                            4,
                            4,
                            {"--camera", "Perspective"},
                            {{0, 0, "red"}, {1.25, 0, "green"}, {0, 1.25, "blue"}, {-1.25, -1.25, "white"}}},
                    Feature{"Orthographic",
                            "cameras.usda",
                            4,
                            4,
                            {"--camera", "Orthographic"},
                            {{0, 0, "red"}, {1.25, 0, "green"}, {0, 1.25, "blue"}, {-1.25, -1.25, "black"}}},
                    Feature{"Offset",
                            "cameras.usda",
                            4,
                            4,
                            {"--camera", "Offset"},
                            {{-1, 0, "red"}, {0.25, 0, "green"}, {-1, 1.25, "blue"}}},
                    Feature{"Clipped",
                            "cameras.usda",
                            4,
                            4,
                            {"--camera", "Clipped"},
                            {{0, 0, "red"}, {-1.25, -1.25, "black"}}}),
    nameOf);

/// Squares of textures.usda, one unit wide, by column and row; u and v within the square.
Place inSquare(int column, int row, double u, double v, const char* colour) {
    return {-2.6 + 1.4 * column + u, 0.2 - 1.4 * row + v, colour};
}

INSTANTIATE_TEST_SUITE_P(
    Materials, FeatureTest,
    testing::Values(
        Feature{"WrapModes",
                "textures.usda",
                6,
                3,
                {},
                {inSquare(0, 0, 0.3125, 0.3125, "red"), inSquare(0, 0, 0.9375, 0.3125, "green"),
                 inSquare(1, 0, 0.0625, 0.3125, "red"), inSquare(1, 0, 0.9375, 0.3125, "white"),
                 inSquare(2, 0, 0.8125, 0.3125, "white"), inSquare(2, 0, 0.9375, 0.3125, "blue"),
                 inSquare(3, 0, 0.3125, 0.3125, "red"), inSquare(3, 0, 0.9375, 0.3125, "black"),
                 inSquare(3, 0, 0.3125, 0.0625, "black")}},
        Feature{"TransformsAndChannels",
                "textures.usda",
                6,
                3,
                {},
                {inSquare(0, 1, 0.25, 0.25, "green"), inSquare(0, 1, 0.25, 0.75, "red"),
                 inSquare(1, 1, 0.125, 0.125, "red"), inSquare(2, 1, 0.25, 0.5, "red"),
                 inSquare(2, 1, 0.75, 0.5, "blue"), inSquare(3, 1, 0.375, 0.125, "red"),
                 inSquare(3, 1, 0.125, 0.125, "black"), inSquare(3, 1, 0.875, 0.125, "red")}},
        Feature{"Opacity",
                "opacity.usda",
                6,
                2,
                {"--samples", "64"},
                {{-2.25, 0, "green"},
                 {-1, 0, "green"},
                 {-0.5, 0, "red"},
                 {0.75, 0, "green"},
                 {2.5, 0.15, "green"}}},
        Feature{"MaterialXFile",
                "mtlx_file.usda",
                8,
                2,
                {},
                {{-3, 0, "red"}, {-1.5, 0, "yellow"}, {0, 0, "green"}, {1.5, 0, "blue"}, {3, 0, "white"}}}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(Visibility, FeatureTest,
                         testing::Values(Feature{"ProxyPurpose",
                                                 "visibility.usda",
                                                 6,
                                                 3,
                                                 {"--purposes", "proxy"}, // the sky behind is white
                                                 {{-2.1, 0.7, "red"},
                                                  {-0.7, 0.7, "white"},
                                                  {0.7, 0.7, "blue"},
                                                  {2.1, 0.7, "white"},
                                                  {-2.1, -0.7, "white"},
                                                  {-0.7, -0.7, "white"},
                                                  {2.1, -0.7, "blue"}}},
                                         Feature{"OtherPurposesAndFrame",
                                                 "visibility.usda",
                                                 6,
                                                 3,
                                                 {"--purposes", "render,guide", "--frames", "2"},
                                                 {{-2.1, 0.7, "red"},
                                                  {-0.7, 0.7, "green"},
                                                  {0.7, 0.7, "white"},
                                                  {2.1, 0.7, "yellow"},
                                                  {-0.7, -0.7, "green"}}}),
                         nameOf);

class Scenes : public FeatureTest {};

/// Scale, bias and raw colour space: red (1, 0, 0) becomes (0.75, 0.25, 0.25).
TEST_F(Scenes, TextureScaleAndBiasAreExact) {
    const ImageFile image = recordScene("textures.usda", 6, 3, {});
    const Place place = inSquare(1, 1, 0.125, 0.125, "");
    const double x = 0.5 + place.x / 6, y = 0.5 - place.y / 3;
    EXPECT_NEAR(image.at("R", x, y), 0.75f, 1e-4f);
    EXPECT_NEAR(image.at("G", x, y), 0.25f, 1e-4f);
}

/// A mesh without displayColor is grey, not white and not absent.
TEST_F(Scenes, PlainMeshIsGrey) {
    const ImageFile image = recordScene("visibility.usda", 6, 3, {"--samples", "64"});
    const float plain = image.at("G", 0.5 + 0.7 / 6, 0.5 + 0.7 / 3);
    EXPECT_GT(plain, 0.1f);
    EXPECT_LT(plain, 0.7f);
    EXPECT_NEAR(image.at("R", 0.5 + 0.7 / 6, 0.5 + 0.7 / 3), plain, 0.02f);
}

/// Half of the wall's radiance 1 goes through; the black surface in front adds what it mirrors.
TEST_F(Scenes, DisplayOpacityLetsItsShareThrough) {
    const ImageFile image = recordScene("opacity.usda", 6, 2, {"--samples", "256"});
    EXPECT_NEAR(image.at("G", 0.5 - 2.25 / 6, 0.5), 0.5f, 0.12f);
}

/// Mean of a channel over a square of a tenth of the picture: single pixels are noisy.
float meanAround(const ImageFile& image, const std::string& channel, double x, double y) {
    float sum = 0.f;
    for (int i = 0; i < 64; ++i)
        sum += image.at(channel, x + 0.0125 * (i % 8 - 3.5), y + 0.0125 * (i / 8 - 3.5));
    return sum / 64.f;
}

TEST_F(Scenes, CornellBoxHasItsColoursAndLight) {
    const ImageFile image = recordScene("cornell_box.usda", 4, 4, {"--samples", "64"});
    EXPECT_GT(meanAround(image, "R", 0.08, 0.5), 3.f * meanAround(image, "G", 0.08, 0.5)) << "left wall";
    EXPECT_GT(meanAround(image, "G", 0.92, 0.5), 1.5f * meanAround(image, "R", 0.92, 0.5)) << "right wall";
    EXPECT_GT(meanAround(image, "R", 0.25, 0.92), 0.05f) << "floor";
    EXPECT_GT(meanAround(image, "R", 0.2, 0.06), 0.01f) << "the ceiling has indirect light only";
}

/// Pictures without exact places: finite, lit, and not all alike.
TEST_F(Scenes, LitScenesAreFiniteAndVaried) {
    for (const char* name : {"still_life.usda", "lights.usda", "subdivision.usda", "cornell_box.usda"}) {
        SCOPED_TRACE(name);
        const ImageFile image = recordScene(name, 6, 3.375, {"--complexity", "medium"});
        double sum = 0.0, squares = 0.0;
        const std::vector<float> green = image.values("G");
        for (const float g : green) {
            ASSERT_TRUE(std::isfinite(g));
            ASSERT_GE(g, 0.f);
            sum += std::min(g, 1.f);
            squares += std::min(g, 1.f) * std::min(g, 1.f);
        }
        const double mean = sum / double(green.size());
        EXPECT_GT(mean, 0.02);
        EXPECT_LT(mean, 0.8);
        EXPECT_GT(squares / double(green.size()) - mean * mean, 0.002);
    }
}

} // namespace
} // namespace hipr::test
