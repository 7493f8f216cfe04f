/// Pictures without noise. Where Open Image Denoise is not installed, only what happens then is tested.
#include <cmath>
#include <cstdlib>
#include <cstring>

#include <gmock/gmock.h>

#include "renderer/api/denoise.h"
#include "testenv/host/recorder.h"

namespace hipr::test {
namespace {

using testing::HasSubstr;

class RecorderDenoise : public RecorderTest {
protected:
    void SetUp() override {
        const std::string missing = Denoiser::missing();
        if (!missing.empty()) GTEST_SKIP() << missing;
    }
    /// Records a scene of glass, metal and plastic, small.
    Outcome recordStillLife(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(),
                         {HIPR_SOURCE_DIR "/testenv/scenes/still_life.usda", "--size", "128"});
        return run(command(std::move(arguments)));
    }
};

/// Mean square error of what differs, relative to how bright it is.
double errorOf(const ImageFile& image, const std::string& layer, const ImageFile& reference) {
    double sum = 0;
    size_t count = 0;
    for (const char* channel : {"R", "G", "B"}) {
        const std::vector<float> values = image.values(layer + channel), truth = reference.values(channel);
        count += truth.size();
        for (size_t i = 0; i < truth.size(); ++i)
            sum += std::pow(double(values[i]) - truth[i], 2) / (std::pow(double(truth[i]), 2) + 0.01);
    }
    return sum / double(count);
}

bool equal(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST_F(RecorderDenoise, IsNearerToTheConvergedPictureAndKeepsTheRawOne) {
    ASSERT_EQ(recordStillLife({"-o", file("reference.exr"), "-n", "512", "--set", "hipr:seed=1"}).code, 0);
    ASSERT_EQ(recordStillLife({"-o", file("raw.exr"), "-n", "16"}).code, 0);
    const Outcome outcome =
        recordStillLife({"-o", file("clean.exr"), "-o", file("clean.png"), "-n", "16", "--denoise"});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const ImageFile reference(file("reference.exr")), raw(file("raw.exr")), clean(file("clean.exr"));
    const double rawError = errorOf(raw, "", reference), cleanError = errorOf(clean, "", reference);
    EXPECT_LT(cleanError, rawError / 3) << "raw " << rawError;
    for (const char* channel : {"R", "G", "B", "A"})
        EXPECT_TRUE(equal(clean.values(std::string("noisy.") + channel), raw.values(channel))) << channel;
    EXPECT_TRUE(equal(clean.values("A"), raw.values("A")));
}

TEST_F(RecorderDenoise, WorksWhereTimeEndsThePicture) {
    const Outcome outcome = recordStillLife({"-o", file("a.exr"), "--aovs", "color,denoised", "--time", "1"});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const ImageFile picture(file("a.exr"));
    const std::vector<float> raw = picture.values("G"), clean = picture.values("denoised.G");
    EXPECT_FALSE(equal(raw, clean));
    double rawSum = 0, cleanSum = 0; // of the same samples
    for (size_t i = 0; i < raw.size(); ++i) {
        rawSum += raw[i];
        cleanSum += clean[i];
    }
    EXPECT_NEAR(cleanSum / rawSum, 1.0, 0.05);
}

TEST_F(RecorderDenoise, IsARenderVar) {
    write("shot.usda", "#usda 1.0\n(\n    subLayers = [@" + scene() +
                           "@]\n    renderSettingsPrimPath = \"/Render/Settings\"\n)\n"
                           R"(def Scope "Render"
{
    def RenderVar "clean"
    {
        string sourceName = "denoised"
    }
    def RenderProduct "Product"
    {
        token productName = ")" +
                           file("product.png") + R"("
        rel orderedVars = [</Render/clean>]
    }
    def RenderSettings "Settings"
    {
        rel camera = </World/Front>
        uniform int2 resolution = (40, 40)
        int convergedSamplesPerPixel = 4
        rel products = [</Render/Product>]
    }
}
)");
    const Outcome outcome = run(command({file("shot.usda")}));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(colourAt(ImageFile(file("product.png")), redSpot), "red");
}

TEST(RecorderDenoiseWithoutTheLibrary, IsRefusedBeforeAnythingIsRendered) {
    const char* given = std::getenv("HIPR_OIDN_LIBRARY");
    const std::string before = given ? given : "";
    setenv("HIPR_OIDN_LIBRARY", "/no/such/library.so", 1);
    const Outcome outcome = run({HIPR_RECORD_PROGRAM, HIPR_SOURCE_DIR "/testenv/host/scenes/squares.usda",
                                 "-o", "/tmp/hipr_never_written.png", "--denoise"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.text, HasSubstr("HIPR_OIDN_LIBRARY"));
    if (given)
        setenv("HIPR_OIDN_LIBRARY", before.c_str(), 1);
    else
        unsetenv("HIPR_OIDN_LIBRARY");
}

} // namespace
} // namespace hipr::test
