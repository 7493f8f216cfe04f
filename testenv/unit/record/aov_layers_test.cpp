#include "plugin/record/aovLayers.h"

#include <gmock/gmock.h>

namespace hipr::record {
namespace {

using testing::ElementsAre;

TEST(AovLayers, ColorIsTheMainLayer) {
    EXPECT_THAT(aovChannelNames("color", 4, false), ElementsAre("R", "G", "B", "A"));
}

TEST(AovLayers, DepthsAreZ) {
    EXPECT_THAT(aovChannelNames("depth", 1, false), ElementsAre("depth.Z"));
    EXPECT_THAT(aovChannelNames("cameraDepth", 1, false), ElementsAre("cameraDepth.Z"));
}

TEST(AovLayers, GeometricVectorsHaveAxes) {
    EXPECT_THAT(aovChannelNames("normal", 3, false), ElementsAre("normal.X", "normal.Y", "normal.Z"));
}

TEST(AovLayers, IdsAreIntegers) {
    EXPECT_THAT(aovChannelNames("primId", 1, true), ElementsAre("primId.I"));
}

TEST(AovLayers, OthersAreColoursOrValues) {
    EXPECT_THAT(aovChannelNames("albedo", 3, false), ElementsAre("albedo.R", "albedo.G", "albedo.B"));
    EXPECT_THAT(aovChannelNames("shader:fog", 1, false), ElementsAre("shader.fog.V"));
    EXPECT_THAT(aovChannelNames("primvars:st", 3, false),
                ElementsAre("primvars.st.R", "primvars.st.G", "primvars.st.B"));
}

TEST(AovLayers, LayersMayHaveOtherNames) {
    EXPECT_THAT(aovChannelNames("color", 4, false, "beauty"),
                ElementsAre("beauty.R", "beauty.G", "beauty.B", "beauty.A"));
    EXPECT_THAT(aovChannelNames("normal", 3, false, "my:n"), ElementsAre("my.n.X", "my.n.Y", "my.n.Z"));
    EXPECT_THAT(aovChannelNames("albedo", 3, false, "color"), ElementsAre("R", "G", "B"));
}

} // namespace
} // namespace hipr::record
