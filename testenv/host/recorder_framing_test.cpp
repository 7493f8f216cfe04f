/// Data windows, overscan and pixel aspects of hiprrecord.
#include <gmock/gmock.h>

#include "testenv/host/recorder.h"

namespace hipr::test {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

/// What pixels see, and where they lie.
struct Seen {
    OIIO::ImageSpec spec;
    std::vector<uint32_t> ids;
    std::vector<float> depths;
};

class RecorderFraming : public RecorderTest {
protected:
    Seen recorded(std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), {"-o", file("a.exr"), "--aovs", "color,cameraDepth,primId"});
        const Outcome outcome = record(std::move(arguments));
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        const ImageFile image(file("a.exr"));
        return {image.spec(), image.ids("primId.I"), image.values("cameraDepth.Z")};
    }
};

/// Pixels of `part` see what those of `whole` see; (x, y) is the first one that they share, in either.
void expectSame(const Seen& part, int partX, int partY, const Seen& whole, int wholeX, int wholeY, int width,
                int height) {
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const size_t a = size_t((partY + y) * part.spec.width + partX + x);
            const size_t b = size_t((wholeY + y) * whole.spec.width + wholeX + x);
            EXPECT_EQ(part.ids[a], whole.ids[b]) << x << ", " << y;
            EXPECT_NEAR(part.depths[a], whole.depths[b], 1e-4) << x << ", " << y;
        }
}

// The part looks like that part of the whole, and the file says where it belongs.
TEST_F(RecorderFraming, ACropIsAPartOfThePicture) {
    const Seen whole = recorded({});
    const Seen part = recorded({"--crop", "0.125,0.25,0.5,0.875"});
    EXPECT_EQ(part.spec.width, 24);
    EXPECT_EQ(part.spec.height, 40);
    EXPECT_EQ(part.spec.x, 8);
    EXPECT_EQ(part.spec.y, 8);
    EXPECT_EQ(part.spec.full_width, 64);
    EXPECT_EQ(part.spec.full_height, 64);
    expectSame(part, 0, 0, whole, 8, 8, 24, 40);
}

TEST_F(RecorderFraming, OverscanGoesBeyondThePicture) {
    const Seen whole = recorded({});
    const Seen more = recorded({"--crop", "-0.25,-0.125,1.25,1.125"});
    EXPECT_EQ(more.spec.width, 96);
    EXPECT_EQ(more.spec.height, 80);
    EXPECT_EQ(more.spec.x, -16);
    EXPECT_EQ(more.spec.y, -8);
    expectSame(more, 16, 8, whole, 0, 0, 64, 64);
}

// The data window in pixels: bounds are rounded up, so that windows which touch share no pixel.
TEST_F(RecorderFraming, NeighboursShareNoPixel) {
    const Seen left = recorded({"--crop", "0,0,0.3,1"});
    const Seen right = recorded({"--crop", "0.3,0,1,1"});
    EXPECT_EQ(left.spec.width, 20); // ceil(19.2)
    EXPECT_EQ(right.spec.x, 20);
    EXPECT_EQ(right.spec.width, 44);
}

TEST_F(RecorderFraming, WindowsWithoutPixelsAreRefused) {
    for (const char* const window :
         {"0,0,0,1", "0.5,0.5,0.2,1", "0,0,nan,1", "0,0,1", "0,0,1,1x", "0,0,1e9,1"}) {
        const Outcome outcome = record({"-o", file("b.exr"), "--crop", window});
        EXPECT_EQ(outcome.code, 1) << window;
        EXPECT_THAT(outcome.text, AnyOf(HasSubstr("--crop"), HasSubstr("data window"))) << window;
    }
}

} // namespace
} // namespace hipr::test
