#include "plugin/record/report.h"

#include <gmock/gmock.h>

#include "pxr/base/vt/value.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {
namespace {

using testing::HasSubstr;

TEST(Report, NumbersOfAnyType) {
    const VtDictionary stats{
        {"i", VtValue(3)}, {"f", VtValue(2.5f)}, {"u", VtValue(uint64_t(7))}, {"s", VtValue("x")}};
    EXPECT_EQ(statNumber(stats, "i", 0), 3.0);
    EXPECT_EQ(statNumber(stats, "f", 0), 2.5);
    EXPECT_EQ(statNumber(stats, "u", 0), 7.0);
    EXPECT_EQ(statNumber(stats, "s", -1), -1.0);
    EXPECT_EQ(statNumber(stats, "absent", -1), -1.0);
}

TEST(Report, MemoryIsSortedBySize) {
    const VtDictionary stats{{"hipr:memory:Host: textures", VtValue(uint64_t(3) << 20)},
                             {"hipr:memory:geometry", VtValue(uint64_t(5) << 30)},
                             {"peakMemory", VtValue(uint64_t(100))},
                             {"percentDone", VtValue(1.0)}};
    const std::string table = memoryTable(stats);
    EXPECT_LT(table.find("geometry"), table.find("Host: textures"));
    EXPECT_LT(table.find("Host: textures"), table.find("peakMemory"));
    EXPECT_THAT(table, HasSubstr("5.0 GiB"));
    EXPECT_THAT(table, HasSubstr("3.0 MiB"));
    EXPECT_EQ(table.find("percentDone"), std::string::npos);
    EXPECT_THAT(memoryTable({}), HasSubstr("no memory"));
}

TEST(Report, JsonHoldsFramesAndStatistics) {
    RecordingReport report;
    report.scene = "a \"quoted\" scene";
    FrameReport frame;
    frame.frame = 7;
    frame.samples = 16;
    frame.files = {"a.exr"};
    frame.stats = {{"big", VtValue(uint64_t(1) << 40)}, {"name", VtValue(std::string("lavapipe"))}};
    report.frames.push_back(frame);
    const std::string json = reportJson(report);
    EXPECT_THAT(json, HasSubstr(R"("scene": "a \"quoted\" scene")"));
    EXPECT_THAT(json, HasSubstr(R"("big": 1099511627776)"));
    EXPECT_THAT(json, HasSubstr(R"("name": "lavapipe")"));
    EXPECT_EQ(json.find("firstSampleSeconds"), std::string::npos) << "the renderer did not tell";
}

} // namespace
} // namespace hipr::record
