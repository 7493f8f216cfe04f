#include "plugin/record/options.h"

#include <gmock/gmock.h>

#include "plugin/record/failure.h"

namespace hipr::record {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

Options parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "hiprrecord");
    const std::optional<Options> options = parseOptions(int(arguments.size()), arguments.data());
    return options.value_or(Options());
}

std::string usageError(const std::vector<const char*>& arguments) {
    try {
        parse(arguments);
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitUsage);
        return failure.what();
    }
    return "(no error)";
}

TEST(Options, Defaults) {
    const Options options = parse({"a.usda", "-o", "a.png"});
    EXPECT_EQ(options.scene, "a.usda");
    EXPECT_THAT(options.outputs, ElementsAre("a.png"));
    EXPECT_THAT(options.aovs, ElementsAre("color"));
    EXPECT_THAT(options.purposes, ElementsAre("default", "render"));
    EXPECT_EQ(options.renderer, "HiPR");
    EXPECT_EQ(options.refineLevel, 0);
}

TEST(Options, AovsMayHaveLayersOfOtherNames) {
    const Options options = parse({"a.usda", "-o", "a.exr", "--half", "--aovs",
                                   "color,key=lpe:C.{1,2}<L.'a=b'>,ids=CryptoObject,lpe:C<L.'c=d'>"});
    EXPECT_THAT(options.aovs, ElementsAre("color", "lpe:C.{1,2}<L.'a=b'>", "CryptoObject00", "CryptoObject01",
                                          "CryptoObject02", "lpe:C<L.'c=d'>"));
    EXPECT_THAT(options.layerNames,
                ElementsAre(Pair("CryptoObject00", "ids00"), Pair("CryptoObject01", "ids01"),
                            Pair("CryptoObject02", "ids02"), Pair("lpe:C.{1,2}<L.'a=b'>", "key")));
    EXPECT_TRUE(options.half);
}

TEST(Options, OutputDoesNotSwallowTheScene) {
    const Options options = parse({"-o", "a.png", "-o", "b.exr", "a.usda"});
    EXPECT_THAT(options.outputs, ElementsAre("a.png", "b.exr"));
    EXPECT_EQ(options.scene, "a.usda");
}

TEST(Options, Size) {
    const Options both = parse({"a.usda", "-o", "a.png", "--size", "640x480"});
    EXPECT_EQ(both.width, 640);
    EXPECT_EQ(both.height, 480);
    const Options width = parse({"a.usda", "-o", "a.png", "--size", "640"});
    EXPECT_EQ(width.width, 640);
    EXPECT_EQ(width.height, 0);
    for (const char* bad : {"0", "640x", "x480", "640x0", "640x480x2", "-3", "99999", "640x480 ", "1.5"})
        EXPECT_THAT(usageError({"a.usda", "-o", "a.png", "--size", bad}), HasSubstr("size")) << bad;
}

TEST(Options, Complexity) {
    EXPECT_EQ(parse({"a.usda", "-o", "a.png", "--complexity", "veryhigh"}).refineLevel, 3);
    EXPECT_EQ(parse({"a.usda", "-o", "a.png", "--complexity", "1.2"}).refineLevel, 2);
    EXPECT_THAT(usageError({"a.usda", "-o", "a.png", "--complexity", "2.0"}), HasSubstr("--complexity"));
}

TEST(Options, ListsAndSettings) {
    const Options options = parse({"a.usda", "-o", "a.exr", "--aovs", "color,depth, depth", "--purposes",
                                   "guide", "--set", "a:b=1", "--set", "name=x=y", "--mask", "/A,/B"});
    EXPECT_THAT(options.aovs, ElementsAre("color", "depth"));
    EXPECT_THAT(options.purposes, ElementsAre("default", "guide"));
    EXPECT_THAT(options.settings, ElementsAre(Pair("a:b", "1"), Pair("name", "x=y")));
    EXPECT_THAT(options.mask, ElementsAre("/A", "/B"));
}

TEST(Options, EmptyPurposesShowDefaultAlone) {
    EXPECT_THAT(parse({"a.usda", "-o", "a.png", "--purposes", ""}).purposes, ElementsAre("default"));
}

TEST(Options, UsageErrorsNameTheirCause) {
    EXPECT_THAT(usageError({"-o", "a.png"}), HasSubstr("no scene"));
    EXPECT_TRUE(parse({"a.usda"}).asksForProducts());
    EXPECT_THAT(usageError({"a.usda", "-o", "a.tga"}), HasSubstr("a.tga"));
    EXPECT_THAT(usageError({"a.usda", "-o", "a.png", "--aovs", "depth"}), HasSubstr("color"));
    EXPECT_THAT(usageError({"a.usda", "-o", "a.png", "--frames", "1:3"}), HasSubstr("####"));
    EXPECT_THAT(usageError({"a.usda", "-o", "a.##.png", "--frames", "1:2x0.5"}), HasSubstr("####.##"));
    EXPECT_THAT(usageError({"a.usda", "-o", "a.png", "--purposes", "gudie"}), HasSubstr("gudie"));
    EXPECT_THAT(usageError({"a.usda", "-o", "a.png", "--set", "x"}), HasSubstr("key=value"));
    EXPECT_THAT(usageError({"a.usda", "-o", "a.png", "--samples", "0"}), HasSubstr("--samples"));
    EXPECT_THAT(usageError({"a.usda", "-o", "a.png", "--sampels", "4"}), HasSubstr("--sampels"));
    EXPECT_THAT(usageError({"a.usda", "-o", "a.png", "--renderer", "GL", "--device", "0"}),
                HasSubstr("--device"));
}

} // namespace
} // namespace hipr::record
