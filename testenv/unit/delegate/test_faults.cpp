/// A renderer that fails leaves the host alone: it says so, everything converges, and the host goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pxr/base/gf/frustum.h"
#include "testenv/common/allocation_faults.h"
#include "testenv/common/vulkan_faults.h"
#include "testenv/unit/delegate/test_host.h"
#include "testenv/unit/delegate/test_warnings.h"

PXR_NAMESPACE_USING_DIRECTIVE

using hipr::test::Fault;
using hipr::test::VulkanFault;

namespace {

const SdfPath square("/square");

/// What a user does in a session; true if every step came to an end.
bool playSession(TestHost& host) {
    host.setViewSize(3.0);
    host.scene().addDome(SdfPath("/dome"));
    host.scene().addSquare(square, GfVec3f(0.5f));
    if (!host.render()) {
        return false;
    }
    host.scene().prim(square).transform.SetTranslate(GfVec3d(1, 0, 0));
    host.scene().tracker().MarkRprimDirty(square, HdChangeTracker::DirtyTransform);
    if (!host.render()) {
        return false;
    }
    host.delegate().SetRenderSetting(TfToken("convergedSamplesPerPixel"), VtValue(3));
    host.buffer("primId").Allocate(GfVec3i(TestHost::width, TestHost::height, 1), HdFormatInt32, false);
    return host.render();
}

bool failed(TestHost& host) {
    const VtDictionary stats = host.delegate().GetRenderStats();
    return stats.empty() || VtDictionaryGet<int>(stats, "hipr:failed") != 0;
}

void expectAHealthyHost() {
    TestHost host({"color", "primId"}, 2);
    ASSERT_TRUE(playSession(host));
    EXPECT_FALSE(failed(host));
    EXPECT_GE(host.readInt("primId", 0.3, 0), 0);
    EXPECT_EQ(host.readInt("primId", 0, 0), -1);
}

struct DelegateFaults : testing::TestWithParam<Fault> {};

TEST_P(DelegateFaults, endRenderingNotTheHost) {
    uint64_t calls = 0;
    {
        const VulkanFault nothing(GetParam(), 0);
        expectAHealthyHost();
        calls = nothing.calls();
    }
    ASSERT_GT(calls, 10u);
    TestWarnings warnings;
    int stopped = 0;
    for (uint64_t n = 1; n <= calls; n += 1 + calls / 12) {
        SCOPED_TRACE(n);
        const VulkanFault fault(GetParam(), n);
        TestHost host({"color", "primId"}, 2);
        ASSERT_TRUE(playSession(host));
        stopped += failed(host);
        const int id = host.readInt("primId", 0.3, 0);
        EXPECT_GE(id, -1);
    }
    EXPECT_GT(stopped, 0);
    const std::vector<std::string> texts = warnings.texts();
    EXPECT_GE(texts.size(), 1u);
    EXPECT_EQ(std::set<std::string>(texts.begin(), texts.end()).size(), texts.size()) << "said once";
    for (std::string const& text : texts) {
        EXPECT_THAT(text, testing::AnyOf(testing::HasSubstr("memory"), testing::HasSubstr("lost"),
                                         testing::HasSubstr("OUT_OF"), testing::HasSubstr("no Vulkan")));
    }
    expectAHealthyHost();
}

std::string faultName(testing::TestParamInfo<Fault> const& info) {
    char const* names[] = {"OutOfMemory", "NoMemory", "DeviceLost"};
    return names[int(info.param)];
}

INSTANTIATE_TEST_SUITE_P(, DelegateFaults,
                         testing::Values(Fault::OutOfMemory, Fault::NoMemory, Fault::DeviceLost), faultName);

TEST(Buffers, thatDoNotFitAreRefused) {
    TestHost host({"color"}, 1);
    TestWarnings warnings;
    HdHiprRenderBuffer& buffer = host.buffer("color");
    EXPECT_FALSE(buffer.Allocate(GfVec3i(1 << 22, 1 << 22, 1), HdFormatFloat32Vec4, false));
    EXPECT_EQ(buffer.GetWidth(), 0u);
    ASSERT_EQ(warnings.texts().size(), 1u);
    EXPECT_THAT(warnings.texts()[0], testing::HasSubstr("4194304 x 4194304"));
    EXPECT_TRUE(host.render());
    EXPECT_TRUE(buffer.Allocate(GfVec3i(TestHost::width, TestHost::height, 1), HdFormatFloat32Vec4, false));
    EXPECT_TRUE(host.render());
}

/// A viewport far larger than its buffer costs a message, not memory that is not there.
TEST(Viewports, thatAreTooLargeAreRefused) {
    TestHost host({"color", "depth"}, 1);
    host.scene().addDome(SdfPath("/dome"));
    TestWarnings warnings;
    host.setViewport(60000, 60000);
    ASSERT_TRUE(host.render());
    ASSERT_EQ(warnings.texts().size(), 1u);
    EXPECT_THAT(warnings.texts()[0], testing::HasSubstr("60000 x 60000 is too large"));
    host.setViewport(TestHost::width, TestHost::height);
    ASSERT_TRUE(host.render());
    EXPECT_GT(host.readColor(0, 0)[0], 0.5f);
}

} // namespace
