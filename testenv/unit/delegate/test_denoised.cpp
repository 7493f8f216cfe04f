/// The AOV denoised. Where Open Image Denoise is not installed, only what happens then is tested.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <thread>

#include <gtest/gtest.h>

#include "pxr/imaging/hd/light.h"
#include "renderer/api/denoise.h"
#include "testenv/unit/delegate/test_host.h"
#include "testenv/unit/delegate/test_warnings.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

const SdfPath square("/square"), lamp("/lamp");

class Denoised : public testing::Test {
protected:
    void SetUp() override {
        const std::string missing = hipr::Denoiser::missing();
        if (!missing.empty()) {
            GTEST_SKIP() << missing;
        }
    }
};

/// A grey square and a large lamp beside what the camera sees: noisy for long.
void addScene(TestHost& host) {
    host.setViewSize(2.0);
    host.scene().addSquare(square, GfVec3f(0.5f));
    TestScene::Prim& light = host.scene().addSphereLightFarAway(lamp);
    light.transform.SetTranslate(GfVec3d(2.5, 0, 1.5));
    light.params[HdLightTokens->radius] = VtValue(1.f);
    light.params[HdLightTokens->intensity] = VtValue(6.f);
}

std::vector<GfVec4f> pixels(TestHost& host, std::string const& aov) {
    HdHiprRenderBuffer& buffer = host.buffer(aov);
    auto const* first = static_cast<GfVec4f const*>(buffer.Map());
    std::vector<GfVec4f> values(first, first + size_t(buffer.GetWidth()) * buffer.GetHeight());
    buffer.Unmap();
    return values;
}

/// Mean square of the differences of neighbours on a smoothly lit square.
double roughness(std::vector<GfVec4f> const& picture) {
    double sum = 0;
    for (int y = 10; y < 22; ++y) {
        for (int x = 10; x < 22; ++x) {
            const size_t i = size_t(y) * TestHost::width + size_t(x);
            sum += std::pow(double(picture[i + 1][0] - picture[i][0]), 2);
        }
    }
    return sum / 144;
}

bool equal(std::vector<GfVec4f> const& a, std::vector<GfVec4f> const& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(GfVec4f)) == 0;
}

TEST_F(Denoised, HasLessNoiseAndTheSameAlpha) {
    TestHost host({"color", "denoised"}, 2);
    addScene(host);
    ASSERT_TRUE(host.render());
    EXPECT_TRUE(host.buffer("denoised").IsConverged());
    const auto raw = pixels(host, "color"), clean = pixels(host, "denoised");
    EXPECT_LT(roughness(clean), 0.1 * roughness(raw));
    for (size_t i = 0; i < raw.size(); ++i) {
        ASSERT_EQ(clean[i][3], raw[i][3]) << "pixel " << i;
    }
    EXPECT_GT(VtDictionaryGet<double>(host.delegate().GetRenderStats(), "hipr:denoiseTime"), 0.0);
}

TEST_F(Denoised, LeavesTheColourAsItIs) {
    TestHost with({"color", "denoised"}, 3), without({"color"}, 3);
    addScene(with);
    addScene(without);
    ASSERT_TRUE(with.render());
    ASSERT_TRUE(without.render());
    EXPECT_TRUE(equal(pixels(with, "color"), pixels(without, "color")));
}

TEST_F(Denoised, OfAnEditedSceneIsThatOfAFreshOne) {
    TestHost edited({"denoised"}, 2), fresh({"denoised"}, 2);
    addScene(edited);
    ASSERT_TRUE(edited.render());
    const auto before = pixels(edited, "denoised");
    for (TestHost* host : {&edited, &fresh}) {
        if (host == &fresh) {
            addScene(fresh);
        }
        host->scene().prim(square).transform.SetTranslate(GfVec3d(0.25, 0, 0));
        if (host == &edited) {
            host->scene().tracker().MarkRprimDirty(square, HdChangeTracker::DirtyTransform);
        }
        ASSERT_TRUE(host->render());
    }
    EXPECT_FALSE(equal(before, pixels(edited, "denoised")));
    EXPECT_TRUE(equal(pixels(fresh, "denoised"), pixels(edited, "denoised")));
}

TEST_F(Denoised, IsShownWhileSamplesAreStillToCome) {
    TestHost host({"color", "denoised"}, 1 << 20);
    addScene(host);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    const auto shown = [&host] { // the host looks, as viewers do
        host.tick();
        const auto raw = pixels(host, "color"), clean = pixels(host, "denoised");
        return roughness(raw) > 0 && roughness(clean) > 0 && roughness(clean) < 0.5 * roughness(raw);
    };
    bool seen = false;
    while (!seen && std::chrono::steady_clock::now() < deadline) {
        seen = shown();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_TRUE(seen);
    EXPECT_FALSE(host.pass().IsConverged());
}

TEST_F(Denoised, HasAllSamplesOnDemand) {
    TestHost host({"color", "denoised"}, 1 << 20);
    addScene(host);
    const auto samples = [&host] {
        return VtDictionaryGet<int>(host.delegate().GetRenderStats(), "numCompletedSamples");
    };
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (samples() == 0 && std::chrono::steady_clock::now() < deadline) { // kernels compile first
        host.tick();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_EQ(host.delegate().GetRenderSetting(TfToken("hipr:publishNow")), VtValue(true));
    ASSERT_TRUE(host.delegate().Stop());
    EXPECT_GT(roughness(pixels(host, "denoised")), 0.0);
    EXPECT_FALSE(host.pass().IsConverged());
}

TEST_F(Denoised, OfPicturesOfAnySize) {
    for (GfVec3i const& size : {GfVec3i(0, 0, 1), GfVec3i(1, 1, 1), GfVec3i(3, 2, 1), GfVec3i(130, 70, 1)}) {
        TestHost host({"color", "denoised"});
        for (const char* aov : {"color", "denoised"}) {
            ASSERT_TRUE(host.buffer(aov).Allocate(size, HdFormatFloat32Vec4, false));
        }
        host.setViewport(size[0], size[1]);
        addScene(host);
        EXPECT_TRUE(host.render()) << size[0] << " x " << size[1];
    }
}

TEST_F(Denoised, EndsWithTheDelegate) {
    for (int i = 0; i < 4; ++i) {
        TestHost host({"denoised"}, i < 2 ? 1 : 1 << 20);
        addScene(host);
        for (int t = 0; t < 4; ++t) {
            host.tick();
            pixels(host, "denoised");
            std::this_thread::sleep_for(std::chrono::milliseconds(10 * i));
        }
    }
}

TEST(DenoisedWithoutTheLibrary, IsTheColourAndSaysSoOnce) {
    const char* given = std::getenv("HIPR_OIDN_LIBRARY");
    const std::string before = given ? given : "";
    setenv("HIPR_OIDN_LIBRARY", "/no/such/library.so", 1);
    TestWarnings warnings;
    TestHost host({"color", "denoised"}, 2);
    EXPECT_EQ(host.delegate()
                  .GetDefaultAovDescriptor(TfToken("denoised"))
                  .aovSettings.count(TfToken("hipr:missing")),
              1u);
    addScene(host);
    EXPECT_TRUE(host.render());
    host.delegate().SetRenderSetting(TfToken("convergedSamplesPerPixel"), VtValue(3));
    EXPECT_TRUE(host.render());
    EXPECT_TRUE(equal(pixels(host, "color"), pixels(host, "denoised")));
    const std::vector<std::string> texts = warnings.texts();
    EXPECT_EQ(std::count_if(texts.begin(), texts.end(),
                            [](std::string const& text) {
                                return text.find("/no/such/library.so") != std::string::npos;
                            }),
              1);
    if (given) {
        setenv("HIPR_OIDN_LIBRARY", before.c_str(), 1);
    } else {
        unsetenv("HIPR_OIDN_LIBRARY");
    }
}

} // namespace
