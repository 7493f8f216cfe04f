/// Render buffers, convergence and the life of a delegate.
#include <cstdlib>

#include <gtest/gtest.h>

#include "testenv/unit/delegate/test_host.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

const SdfPath square("/square"), dome("/dome");

void addScene(TestHost& host) {
    host.setViewSize(2.0);
    host.scene().addDome(dome);
    host.scene().addSquare(square, GfVec3f(0.5f));
}

TEST(Buffers, holdTheLastSampleWhenConverged) {
    TestHost host({"color", "sampleCount"}, 6);
    addScene(host);
    ASSERT_TRUE(host.render());
    EXPECT_TRUE(host.buffer("color").IsConverged());
    EXPECT_TRUE(host.buffer("sampleCount").IsConverged());
    host.buffer("sampleCount").Resolve();
    const int* counts = static_cast<const int*>(host.buffer("sampleCount").Map());
    for (int i = 0; i < TestHost::width * TestHost::height; ++i) {
        ASSERT_EQ(counts[i], 6);
    }
    host.buffer("sampleCount").Unmap();
}

TEST(Buffers, convertToEveryFormatAHostMayAskFor) {
    TestHost host({"color"}, 4);
    addScene(host);
    ASSERT_TRUE(host.render());
    const GfVec4f exact = host.readColor(0, 0);
    for (HdFormat format :
         {HdFormatUNorm8Vec4, HdFormatFloat16Vec4, HdFormatFloat32Vec3, HdFormatSNorm8Vec4}) {
        ASSERT_TRUE(
            host.buffer("color").Allocate(GfVec3i(TestHost::width, TestHost::height, 1), format, false));
        EXPECT_FALSE(host.buffer("color").IsConverged());
        ASSERT_TRUE(host.render());
        const size_t pixel = size_t(TestHost::height / 2 * TestHost::width + TestHost::width / 2);
        const uint8_t* bytes =
            static_cast<const uint8_t*>(host.buffer("color").Map()) + pixel * HdDataSizeOfFormat(format);
        float value = 0;
        switch (format) {
        case HdFormatUNorm8Vec4:
            value = bytes[0] / 255.f;
            break;
        case HdFormatSNorm8Vec4:
            value = reinterpret_cast<const int8_t*>(bytes)[0] / 127.f;
            break;
        case HdFormatFloat16Vec4:
            value = reinterpret_cast<const GfHalf*>(bytes)[0];
            break;
        default:
            value = reinterpret_cast<const float*>(bytes)[0];
        }
        host.buffer("color").Unmap();
        EXPECT_NEAR(value, std::min(exact[0], 1.f), 0.005f) << "format " << format;
    }
}

TEST(Buffers, ofNoOrForeignShapeAreRefusedOrEmpty) {
    TestHost host({"color"});
    HdHiprRenderBuffer& buffer = host.buffer("color");
    EXPECT_FALSE(buffer.Allocate(GfVec3i(4, 4, 2), HdFormatFloat32Vec4, false));
    EXPECT_FALSE(buffer.Allocate(GfVec3i(4, 4, 1), HdFormatInvalid, false));
    EXPECT_TRUE(buffer.Allocate(GfVec3i(0, 0, 1), HdFormatFloat32Vec4, false));
    buffer.Map();
    EXPECT_TRUE(buffer.IsMapped());
    buffer.Unmap();
    EXPECT_FALSE(buffer.IsMapped());
    addScene(host);
    EXPECT_TRUE(host.render()); // no pixels to write, and no crash
}

TEST(Buffers, ofUnknownAovsAreClearAndConverge) {
    TestHost host({"color", "shader:fog", "edgeId"});
    addScene(host);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(host.readInt("edgeId", 0, 0), -1);
    EXPECT_TRUE(host.buffer("shader:fog").IsConverged());
}

TEST(Buffers, clearColourShowsWhereNothingIs) {
    TestHost host({"color"});
    host.setViewSize(4.0);
    host.delegate().SetRenderSetting(TfToken("domeLightCameraVisibility"), VtValue(false));
    host.scene().addDome(dome);
    host.scene().addSquare(square, GfVec3f(0.5f));
    host.setClearColor(GfVec4f(0.1f, 0.2f, 0.3f, 1.f));
    ASSERT_TRUE(host.render());
    EXPECT_NEAR(host.readColor(0.4, 0.4)[1], 0.2f, 1e-4f);
    EXPECT_GT(host.readColor(0, 0)[1], 0.25f);
}

TEST(Delegate, diesWhileRendering) {
    for (int i = 0; i < 4; ++i) {
        TestHost host({"color", "primId"}, 1 << 20);
        addScene(host);
        for (int t = 0; t < i; ++t) {
            host.tick();
        }
    }
}

TEST(Delegate, withoutADeviceShowsTheClearColour) {
    setenv("HIPR_DEVICE", "no such device", 1);
    TestHost host({"color", "primId"});
    unsetenv("HIPR_DEVICE");
    addScene(host);
    host.setClearColor(GfVec4f(0.25f));
    ASSERT_TRUE(host.render());
    EXPECT_EQ(host.readColor(0, 0), GfVec4f(0.25f));
    EXPECT_EQ(host.readInt("primId", 0, 0), -1);
    EXPECT_FALSE(host.delegate().Pause());
    EXPECT_TRUE(host.delegate().GetRenderStats().empty());
}

TEST(Delegate, twoAtOnceRenderTheirOwnScenes) {
    TestHost a({"color", "primId"}), b({"color", "primId"});
    addScene(a);
    addScene(b);
    b.scene().prim(square).visible = false;
    a.tick();
    b.tick();
    ASSERT_TRUE(a.render());
    ASSERT_TRUE(b.render());
    EXPECT_GE(a.readInt("primId", 0, 0), 0);
    EXPECT_EQ(b.readInt("primId", 0, 0), -1);
}

TEST(Delegate, pausesStopsAndGoesOn) {
    TestHost host({"color"}, 64);
    addScene(host);
    host.tick();
    ASSERT_TRUE(host.delegate().Pause());
    host.tick();
    ASSERT_TRUE(host.delegate().Resume());
    ASSERT_TRUE(host.delegate().Stop());
    host.tick();
    EXPECT_FALSE(host.pass().IsConverged());
    ASSERT_TRUE(host.delegate().Restart());
    EXPECT_TRUE(host.render());
    const VtDictionary stats = host.delegate().GetRenderStats();
    EXPECT_EQ(VtDictionaryGet<double>(stats, "percentDone"), 100.0);
    EXPECT_EQ(VtDictionaryGet<int>(stats, "numCompletedSamples"), 64);
    EXPECT_GT(VtDictionaryGet<uint64_t>(stats, "peakMemory"), 0u);
}

} // namespace
