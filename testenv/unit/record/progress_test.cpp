#include "plugin/record/progress.h"

#include <gmock/gmock.h>

namespace hipr::record {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Progress, Durations) {
    EXPECT_EQ(durationText(8.44), "8.4 s");
    EXPECT_EQ(durationText(59.97), "0 min 59 s");
    EXPECT_EQ(durationText(200), "3 min 20 s");
    EXPECT_EQ(durationText(7500), "2 h 05 min");
}

TEST(Progress, TimeLeftFollowsFromTheFraction) {
    EXPECT_EQ(progressText({0.25, 16, 10.0}), " 25 %, 16 samples, 10.0 s, 30.0 s left");
}

TEST(Progress, NoGuessAtTheBeginningAndNoneAtTheEnd) {
    EXPECT_THAT(progressText({0.001, 1, 10.0}), Not(HasSubstr("left")));
    EXPECT_THAT(progressText({1.0, 64, 10.0}), Not(HasSubstr("left")));
}

TEST(Progress, UnknownSamplesAreLeftOut) {
    EXPECT_EQ(progressText({0.5, 0, 0.2}), " 50 %, 0.2 s");
}

} // namespace
} // namespace hipr::record
