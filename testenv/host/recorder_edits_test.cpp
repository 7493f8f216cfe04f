/// hiprrecord --edits, --edit-frames and --dump-scene: edits of a live scene, and what the renderer holds
/// after them.
#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "testenv/host/recorder.h"

namespace hipr::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

const char* const redUp = R"(over \"World\" { over \"Red\" { double3 xformOp:translate = (-1, 1.2, 0) } })";

std::string readText(const std::string& path) {
    std::ifstream file(path);
    EXPECT_TRUE(file.is_open()) << path;
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::set<std::string> linesOf(const std::string& text) {
    std::istringstream stream(text);
    std::set<std::string> lines;
    for (std::string line; std::getline(stream, line);)
        lines.insert(line);
    return lines;
}

/// The names of the elements that two dumps tell differently.
std::set<std::string> differences(const std::string& a, const std::string& b) {
    const std::set<std::string> linesA = linesOf(a), linesB = linesOf(b);
    std::vector<std::string> different;
    std::set_symmetric_difference(linesA.begin(), linesA.end(), linesB.begin(), linesB.end(),
                                  std::back_inserter(different));
    std::set<std::string> names;
    for (const std::string& line : different) {
        std::istringstream words(line);
        std::string kind, name;
        words >> kind >> name;
        names.insert(name);
    }
    return names;
}

class RecorderEdits : public RecorderTest {
protected:
    void SetUp() override {
        if (rendererUnderTest() != "HiPR") GTEST_SKIP() << "scene dumps and batches are HiPR's";
    }
    /// Plays edits on the scene of squares, as EXR files "a.<n>...exr".
    Outcome play(const std::string& edits, std::vector<std::string> arguments = {},
                 const std::string& samples = "4") const {
        write("edits.json", "{\"edits\": [" + edits + "]}");
        arguments.insert(arguments.end(), {scene(), "--edits", file("edits.json"), "-o", file("a.exr"),
                                           "--size", "64x64", "--samples", samples});
        return run(command(arguments));
    }
    /// A scene of the squares with stronger opinions on top, as if it had been edited before it was opened.
    std::string editedScene(const std::string& opinions) const {
        write("edited.usda", "#usda 1.0\n(\n subLayers = [@" + scene() +
                                 "@]\n startTimeCode = 1\n endTimeCode = 3\n)\n" + opinions);
        return file("edited.usda");
    }
    std::vector<std::string> filesNamed(const std::string& beginning) const {
        std::vector<std::string> names;
        for (const std::string& name : files())
            if (name.rfind(beginning, 0) == 0) names.push_back(name);
        return names;
    }
};

std::string usda(const std::string& text) {
    return "{\"name\": \"Move red, up!\", \"usda\": \"" + text + "\"}";
}

TEST_F(RecorderEdits, EachEditHasItsPicture) {
    const Outcome outcome = play(usda(redUp) + R"(,
        {"name": "noon", "time": 3}, {"deactivate": ["/World/Blue"]}, {"camera": "Side"})");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(filesNamed("a."),
                ElementsAre("a.0.exr", "a.1.Move-red-up.exr", "a.2.noon.exr", "a.3.exr", "a.4.exr"));
    const ImageFile before(file("a.0.exr")), moved(file("a.1.Move-red-up.exr")), later(file("a.2.noon.exr")),
        without(file("a.3.exr"));
    const Spot redUpSpot{0.25, 0.2}, greenDownSpot{0.75, 0.95};
    EXPECT_EQ(colourAt(before, redSpot), "red");
    EXPECT_EQ(colourAt(moved, redSpot), "none");
    EXPECT_EQ(colourAt(moved, redUpSpot), "red");
    EXPECT_EQ(colourAt(moved, greenSpot), "green");
    EXPECT_EQ(colourAt(later, greenSpot), "none");
    EXPECT_EQ(colourAt(later, greenDownSpot), "green");
    EXPECT_EQ(colourAt(later, blueSpot), "blue");
    EXPECT_EQ(colourAt(without, blueSpot), "none");
    EXPECT_EQ(ImageFile(file("a.4.exr")).spec().get_string_attribute("hipr:camera"), "/World/Side");
}

TEST_F(RecorderEdits, TheLiveSceneIsTheSceneOpenedAfresh) {
    const Outcome live = play(usda(redUp), {"--dump-scene", file("dump.txt")});
    ASSERT_EQ(live.code, 0) << live.text;
    const std::string opinions =
        "over \"World\"\n{\n over \"Red\"\n {\n double3 xformOp:translate = (-1, 1.2, 0)\n }\n}\n";
    const Outcome fresh =
        recordStage(editedScene(opinions), {"-o", file("fresh.exr"), "--dump-scene", file("fresh.txt"),
                                            "--set", "enableInteractive=true"}); // as with edits
    ASSERT_EQ(fresh.code, 0) << fresh.text;
    const std::string before = readText(file("dump.0.txt")), after = readText(file("dump.1.Move-red-up.txt"));
    EXPECT_EQ(after, readText(file("fresh.txt")));
    EXPECT_THAT(differences(before, after), ElementsAre("/World/Red"));
    for (const char* channel : {"R", "G", "B", "A"})
        EXPECT_EQ(ImageFile(file("a.1.Move-red-up.exr")).values(channel),
                  ImageFile(file("fresh.exr")).values(channel));
}

TEST_F(RecorderEdits, TheDumpForgetsWhatCameAndWent) {
    const auto red = [](const std::string& colour) {
        return R"("usda": "over \"World\" { over \"Looks\" { over \"Red\" { over \"Surface\" { color3f inputs:emissiveColor = )" +
               colour + "} } } }\"";
    };
    const Outcome outcome =
        play(usda(R"(over \"World\" { def Sphere \"Aside\" { double radius = 0.1 } })") + ", {" +
                 red("(0, 1, 0)") + "}, {\"remove\": [\"/World/Aside\"], " + red("(1, 0, 0)") + "}",
             {"--dump-scene", file("dump.txt")});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const std::string start = readText(file("dump.0.txt")), middle = readText(file("dump.2.txt"));
    EXPECT_THAT(differences(start, middle), ElementsAre("/World/Aside", "/World/Looks/Red"));
    EXPECT_EQ(readText(file("dump.3.txt")), start);
}

TEST_F(RecorderEdits, TheDumpTellsFactsByName) {
    const Outcome outcome = run(command({scene(), "--dump-scene", "-", "--size", "64x64"}));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(linesOf(outcome.text),
                IsSupersetOf({"object /World/Red visible true", "object /World/Red rendered true",
                              "object /World/Red geometry /World/Red",
                              "object /World/Red slot 0 bound /World/Looks/Red",
                              "object /World/Red slot 0 shown /World/Looks/Red", "setting hipr:maxDepth 8",
                              "material /World/Looks/Red emissiveColor constant 0x1p+0 0x0p+0 0x0p+0 0x0p+0",
                              "material /World/Looks/Red useSpecularWorkflow true"}));
    EXPECT_THAT(outcome.text, Not(HasSubstr("object /World/Guide rendered true"))) << "guides are not shown";
    EXPECT_THAT(outcome.text, HasSubstr("geometry /World/Red triangles 2 "));
    EXPECT_THAT(outcome.text, HasSubstr("camera view projection 0x"));
    EXPECT_THAT(files(), ElementsAre()) << "nothing is rendered without -o";
}

TEST_F(RecorderEdits, EveryBatchHasAPicture) {
    const Outcome outcome = play(usda(redUp),
                                 {"--edit-frames", file("frames"), "-o", file("a.png"), "--set",
                                  "hipr:maxDepth=2", "--stats", file("stats.json")},
                                 "16");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    std::ifstream list(file("frames") + "/frames.jsonl");
    std::vector<nlohmann::json> frames;
    for (std::string line; std::getline(list, line);)
        frames.push_back(nlohmann::json::parse(line));
    ASSERT_GE(frames.size(), 2u);
    for (size_t i = 0; i < frames.size(); ++i) {
        const bool first = i == 0 || frames[i]["edit"] != frames[i - 1]["edit"];
        EXPECT_EQ(frames[i]["batch"], first ? 1 : int(frames[i - 1]["batch"]) + 1);
        EXPECT_GT(frames[i]["paths"], first ? 0 : int(frames[i - 1]["paths"]));
        EXPECT_EQ(ImageFile(file("frames/") + frames[i]["file"].get<std::string>()).spec().width, 64);
    }
    EXPECT_EQ(frames.front()["edit"], 0);
    EXPECT_EQ(frames.back()["edit"], 1);
    EXPECT_EQ(frames.back()["name"], "Move red, up!");
    EXPECT_EQ(frames.back()["samples"], 16);
    const ImageFile last(file("frames/") + frames.back()["file"].get<std::string>()),
        final(file("a.1.Move-red-up.png"));
    EXPECT_EQ(last.values("R"), final.values("R"));
    const nlohmann::json stats = nlohmann::json::parse(readText(file("stats.json")));
    EXPECT_EQ(stats["frames"][1]["name"], "Move red, up!");
}

TEST_F(RecorderEdits, EditsComeWhenTheyAreDue) {
    // So many samples that waiting for convergence would run into the time limit of the test.
    const Outcome outcome = play(R"({"at": {"samples": 3}, "deactivate": ["/World/Red"]},
                                    {"at": {"seconds": 0.2}, "setting": {"convergedSamplesPerPixel": 4}})",
                                 {"--stats", file("stats.json")}, "1000000");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const nlohmann::json frames = nlohmann::json::parse(readText(file("stats.json")))["frames"];
    EXPECT_GE(frames[0]["samples"], 3);
    EXPECT_FALSE(frames[0]["converged"]);
    EXPECT_GE(frames[1]["seconds"], 0.2);
    EXPECT_TRUE(frames[2]["converged"]);
    EXPECT_EQ(ImageFile(file("a.2.exr")).at("R", redSpot.x, redSpot.y), 0.f);
}

TEST_F(RecorderEdits, WhatCannotBeDoneIsSaid) {
    const auto expect = [&](int code, const char* why, const Outcome& outcome) {
        EXPECT_EQ(outcome.code, code) << outcome.text;
        EXPECT_THAT(outcome.text, HasSubstr(why));
    };
    expect(1, "cannot read the edits", record({"-o", file("b.exr"), "--edits", file("none.json")}));
    expect(1, "no JSON", play("{"));
    expect(1, "edit 1: there is no field 'move'", play(R"({"move": 1})"));
    EXPECT_THAT(filesNamed("a."), ElementsAre()) << "a script is read before anything is rendered";
    expect(1, "edit 2 'gone': there is no prim </Nothing>",
           play(R"({}, {"name": "gone", "remove": ["/Nothing"]})"));
    expect(1, "edit 1: the renderer has no setting 'hipr:depth'", play(R"({"setting": {"hipr:depth": 3}})"));
    expect(1, "edit 1: setting 'hipr:maxDepth'", play(R"({"setting": {"hipr:maxDepth": -3}})"));
    expect(3, "edit 1: no camera 'Frnot'", play(R"({"camera": "Frnot"})"));
    expect(3, "the camera /World/Front is gone", play(R"({"remove": ["/World/Front"]})"));
    expect(1, "one frame",
           record({"--frames", "1:2", "-o", file("b.##.exr"), "--edits", file("edits.json")}));
    expect(4, "frames.jsonl", play("{}", {"--edit-frames", scene()}));
}

TEST_F(RecorderEdits, AnEditThatChangesNothingIsNoted) {
    const Outcome outcome = play(R"({"name": "idle"}, {"deactivate": ["/World/Red"]})");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(outcome.text,
                AllOf(HasSubstr("edit 1 'idle' changes nothing"), Not(HasSubstr("edit 2 changes"))));
}

TEST_F(RecorderEdits, TheExampleOfTheGuideWorks) {
    const std::string guide = readText(HIPR_SOURCE_DIR "/docs/guide.md"), fence = "```json\n";
    const size_t begin = guide.find(fence) + fence.size();
    ASSERT_LT(begin, guide.size());
    write("edits.json", guide.substr(begin, guide.find("```", begin) - begin));
    const Outcome outcome =
        run(command({HIPR_SOURCE_DIR "/testenv/scenes/still_life.usda", "-o", file("a.exr"), "--edits",
                     file("edits.json"), "--size", "64x36", "--samples", "4"}));
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(outcome.text, Not(HasSubstr("changes nothing")));
    EXPECT_EQ(filesNamed("a.").size(), 4u);
}

} // namespace
} // namespace hipr::test
