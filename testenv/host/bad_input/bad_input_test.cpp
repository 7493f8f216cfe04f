// Every scene of testenv/scenes/bad_input: the recorder ends well, says exactly one thing, names the prim it
// is about, and everything else is in the picture.
#include <gmock/gmock.h>
#include <set>
#include <sstream>

#include "testenv/host/features/colours.h"
#include "testenv/host/recorder.h"

namespace hipr::test {
namespace {

/// A scene is 6 x 2 units: a good red square on the left, then what is left of the broken prim.
struct BadInput {
    const char* folder;
    const char* prim;   ///< the message names it
    const char* text;   ///< and says this
    const char* middle; ///< colour in the middle of the picture
    const char* right;  ///< colour on the right
    const char* complexity = "low";
};

std::ostream& operator<<(std::ostream& out, const BadInput& input) {
    return out << input.folder;
}

class BadInputTest : public RecorderTest, public testing::WithParamInterface<BadInput> {};

/// The different things the recorder said; what it repeats counts once.
std::set<std::string> complaints(const std::string& text) {
    std::set<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        if (line.find("hiprrecord: warning: ") != std::string::npos ||
            line.find("hiprrecord: error: ") != std::string::npos)
            lines.insert(line);
    }
    return lines;
}

TEST_P(BadInputTest, OneMessageAndTheRestIsRendered) {
    if (rendererUnderTest() != "HiPR") GTEST_SKIP() << "the messages are HiPR's";
    const BadInput& input = GetParam();
    const std::string stage =
        std::string(HIPR_SOURCE_DIR "/testenv/scenes/bad_input/") + input.folder + "/scene.usda";
    const Outcome outcome = run(command(
        {stage, "-o", file("a.exr"), "--size", "96x32", "--samples", "4", "--complexity", input.complexity}));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const std::set<std::string> said = complaints(outcome.text);
    ASSERT_EQ(said.size(), 1u) << outcome.text;
    EXPECT_THAT(*said.begin(), testing::HasSubstr(input.prim));
    EXPECT_THAT(*said.begin(), testing::HasSubstr(input.text));
    const ImageFile image(file("a.exr"));
    EXPECT_EQ(colourName(image, 1.0 / 6.0, 0.5), "red");
    EXPECT_EQ(colourName(image, 0.5, 0.5), input.middle);
    EXPECT_EQ(colourName(image, 5.0 / 6.0, 0.5), input.right);
}

constexpr const char* Mesh = "</World/Broken>";
constexpr const char* Material = "/World/Looks/Broken";

INSTANTIATE_TEST_SUITE_P(
    Meshes, BadInputTest,
    testing::Values(BadInput{"nan_points", Mesh, "points that are NaN or infinite", "blue", "black"},
                    BadInput{"wrong_counts", Mesh, "faceVertexCounts add up to 12", "blue", "blue"},
                    BadInput{"too_many_indices", Mesh, "faceVertexCounts add up to 4", "blue", "black"},
                    BadInput{"negative_count", Mesh, "negative faceVertexCounts", "blue", "blue"},
                    BadInput{"two_vertex_face", Mesh, "fewer than 3 vertices", "blue", "black"},
                    BadInput{"out_of_range_indices", Mesh, "faceVertexIndices outside the points array",
                             "blue", "black"},
                    BadInput{"bad_indices_subdivided", Mesh, "faceVertexIndices outside the points array",
                             "blue", "black", "high"},
                    BadInput{"short_primvar", Mesh, "primvar 'st' dropped", "blue", "blue"},
                    BadInput{"long_primvar", Mesh, "primvar 'st' truncated", "blue", "blue"},
                    BadInput{"bad_primvar_indices", Mesh, "indices", "blue", "blue"},
                    BadInput{"nan_primvar", Mesh, "primvar 'st' has 1 NaN", "blue", "blue"},
                    BadInput{"holes_out_of_range", Mesh, "hole indices ignored", "blue", "black"},
                    BadInput{"creases_do_not_fit", Mesh, "creases ignored", "blue", "blue", "high"},
                    BadInput{"subset_out_of_range", Mesh, "subset face indices ignored", "blue", "red"},
                    BadInput{"empty_mesh", Mesh, "mesh is empty", "black", "black"},
                    BadInput{"mesh_without_points", Mesh, "mesh is empty", "black", "black"},
                    BadInput{"zero_scale", Mesh, "transform", "blue", "black"},
                    BadInput{"nan_transform", Mesh, "transform", "blue", "black"}));

INSTANTIATE_TEST_SUITE_P(
    Instancers, BadInputTest,
    testing::Values(BadInput{"instancer_nan_position", "/World/Broken", "not finite", "blue", "black"},
                    BadInput{"instancer_short_scales", Mesh, "'scale' has fewer values", "blue", "blue"}));

INSTANTIATE_TEST_SUITE_P(
    Materials, BadInputTest,
    testing::Values(BadInput{"missing_texture", Material, "no_such_file.png", "blue", "green"},
                    BadInput{"corrupt_texture", Material, "broken.png", "blue", "green"},
                    BadInput{"cyclic_material", Material, "feed each other", "blue", "red"},
                    BadInput{"broken_mtlx", "broken.mtlx:5", "no valid XML", "blue", "white"},
                    BadInput{"unknown_shader", Material, "NoSuchSurface", "blue", "white"}));

INSTANTIATE_TEST_SUITE_P(Volumes, BadInputTest,
                         testing::Values(BadInput{"volume_missing_file", "/World/Broken",
                                                  "no_such_file.vdb", "blue", "black"},
                                         BadInput{"volume_corrupt_file", "</World/Broken/density>",
                                                  "broken.vdb", "blue", "black"}));

INSTANTIATE_TEST_SUITE_P(Lights, BadInputTest,
                         testing::Values(BadInput{"nan_light", Mesh, "not finite", "blue", "black"},
                                         BadInput{"negative_light_size", Mesh, "no area", "blue", "black"},
                                         BadInput{"missing_dome_texture", Mesh, "no_such_sky.exr", "blue",
                                                  "white"}));

} // namespace
} // namespace hipr::test
