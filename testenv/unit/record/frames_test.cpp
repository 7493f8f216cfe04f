#include "plugin/record/frames.h"

#include <gmock/gmock.h>
#include <stdexcept>

namespace hipr::record {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

TEST(Frames, SingleFrame) {
    EXPECT_THAT(parseFrames("7"), ElementsAre(7.0));
    EXPECT_THAT(parseFrames("-3.5"), ElementsAre(-3.5));
}

TEST(Frames, RangeIncludesBothEnds) {
    EXPECT_THAT(parseFrames("1:4"), ElementsAre(1, 2, 3, 4));
}

TEST(Frames, BackwardRangeStepsDown) {
    EXPECT_THAT(parseFrames("3:1"), ElementsAre(3, 2, 1));
}

TEST(Frames, StepThatMissesTheEndStopsBeforeIt) {
    EXPECT_THAT(parseFrames("1:10x4"), ElementsAre(1, 5, 9));
    EXPECT_THAT(parseFrames("10:1x-4"), ElementsAre(10, 6, 2));
}

TEST(Frames, FractionalStepReachesTheEndInSpiteOfRounding) {
    const std::vector<double> frames = parseFrames("0:1x0.1");
    ASSERT_EQ(frames.size(), 11u);
    EXPECT_DOUBLE_EQ(frames.back(), 1.0);
}

TEST(Frames, ListKeepsTheOrderWritten) {
    EXPECT_THAT(parseFrames("5,1:3,2"), ElementsAre(5, 1, 2, 3, 2));
}

TEST(Frames, RejectsWhatIsNoRange) {
    for (const char* text : {"", "a", "1:", ":2", "1:2x0", "1:5x-1", "5:1x1", "1,,2", "1,", "1:2:3", "nan",
                             "inf", "1:2x", "0:1e9"})
        EXPECT_THROW(parseFrames(text), std::invalid_argument) << text;
}

TEST(FramePattern, NameWithoutPlaceholderStays) {
    const FramePattern pattern("out/picture.exr");
    EXPECT_FALSE(pattern.hasPlaceholder());
    EXPECT_EQ(pattern.path(12), "out/picture.exr");
}

TEST(FramePattern, PadsWithZeros) {
    const FramePattern pattern("out/p.####.exr");
    EXPECT_TRUE(pattern.hasPlaceholder());
    EXPECT_EQ(pattern.path(7), "out/p.0007.exr");
    EXPECT_EQ(pattern.path(12345), "out/p.12345.exr");
    EXPECT_EQ(pattern.path(-7), "out/p.-0007.exr");
}

TEST(FramePattern, SecondGroupIsTheFraction) {
    const FramePattern pattern("p.###.##.png");
    EXPECT_TRUE(pattern.hasFraction());
    EXPECT_EQ(pattern.path(1.25), "p.001.25.png");
    EXPECT_EQ(pattern.path(12), "p.012.00.png");
}

TEST(FramePattern, HashesInFolderNamesAreNotPlaceholders) {
    EXPECT_FALSE(FramePattern("a#b/p.exr").hasPlaceholder());
}

TEST(FramePattern, RejectsTwoPlaceholders) {
    EXPECT_THROW(FramePattern("p##_##.exr"), std::invalid_argument);
}

} // namespace
} // namespace hipr::record
