// Carrying a picture to another camera: the kernels against the definition, on made-up pictures.
#include <gtest/gtest.h>

#include <random>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/hipr/staleness.h"
#include "renderer/scene/camera.h"
#include "renderer/trace/reprojection.h"
#include "testenv/unit/sampling/gpu.h"

using namespace hipr;
using namespace hipr::test;

namespace {

constexpr uint32_t Width = 75, Height = 50, Pixels = Width * Height; // no multiples of the tile size
const TileGrid Grid(Width, Height, 8);

enum class View { Perspective, Orthographic };

gpu::CameraRecord cameraAt(View view, glm::dvec3 eye, glm::dvec3 target) {
    CameraDesc desc;
    desc.worldToView = glm::lookAt(eye, target, glm::dvec3(0, 1, 0));
    const double aspect = double(Width) / Height;
    desc.projection = view == View::Perspective ? glm::perspective(glm::radians(50.0), aspect, 0.5, 100.0)
                                                : glm::ortho(-2 * aspect, 2 * aspect, -2.0, 2.0, 0.5, 100.0);
    return *cameraRecord(desc);
}

/// The ray through a pixel's centre, as trace/camera.glsl makes it.
struct CentreRay {
    glm::vec3 origin, direction;
    CentreRay(const gpu::CameraRecord& camera, uint32_t x, uint32_t y) {
        const glm::vec2 ndc = 2.f * (glm::vec2(x, y) + 0.5f) / glm::vec2(Width, Height) - 1.f;
        direction = glm::normalize(camera.direction + ndc.x * camera.directionX + ndc.y * camera.directionY);
        origin = camera.origin + ndc.x * camera.originX + ndc.y * camera.originY;
    }
};

/// A picture and what it shows.
struct Shown {
    std::vector<gpu::FilmPixel> film{Pixels};
    std::vector<gpu::OldPixel> old{Pixels};
    std::vector<gpu::SeenPoint> seen{Pixels};

    glm::vec4 mean(uint32_t pixel) const {
        return film[pixel].color / float(std::max(film[pixel].count, 1u));
    }
};

/// `seen(x, y)`: distance along the centre ray and look, distance 0 for the sky.
template <class Seen> Shown shownBy(const gpu::CameraRecord& camera, Seen&& seen) {
    Shown shown;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> light(0.25f, 1.f);
    for (uint32_t y = 0; y < Height; ++y)
        for (uint32_t x = 0; x < Width; ++x) {
            const uint32_t pixel = x + y * Width;
            const CentreRay ray(camera, x, y);
            const std::pair<float, uint32_t> at = seen(x, y);
            const bool sky = at.second == gpu::SEEN_SKY;
            shown.seen[pixel] = {sky ? ray.direction : ray.origin + at.first * ray.direction, at.second};
            const glm::vec4 color(light(random), light(random), light(random), 1.f);
            shown.film[pixel] = {2.f * color, glm::vec3(2.f * color), 2, {}, {}};
        }
    return shown;
}

/// Distance along a centre ray to the plane z = 0.
float toPlane(const gpu::CameraRecord& camera, uint32_t x, uint32_t y) {
    const CentreRay ray(camera, x, y);
    return -ray.origin.z / ray.direction.z;
}

const uint32_t Matte = gpu::packLook(0.f, 1.f, 0.f);

/// A schedule that has shown a picture.
TileSchedule settled() {
    TileSchedule schedule;
    schedule.reset(Grid);
    while (!schedule.next(1000, 2).empty())
        schedule.advance();
    return schedule;
}

struct Carried {
    bool done;
    Shown shown;
    std::vector<float> depths;
    std::vector<gpu::CarriedStrip> strips;

    uint32_t uncovered() const {
        uint32_t sum = 0;
        for (const gpu::CarriedStrip& strip : strips)
            sum += strip.uncovered;
        return sum;
    }
    std::vector<float> errors() const { return staleness(Grid, strips).errors; }
};

Reprojection& reprojection() {
    static Reprojection made(testDevice());
    while (!made.ready(std::chrono::seconds(1))) {
    }
    return made;
}

Carried carry(const Shown& shown, const gpu::CameraRecord& before, const gpu::CameraRecord& after,
              const TileSchedule& schedule = settled()) {
    Buffer film = toDevice(shown.film), old = toDevice(shown.old), seen = toDevice(shown.seen),
           carried = emptyBuffer<gpu::OldPixel>(Pixels), seenAfter = emptyBuffer<gpu::SeenPoint>(Pixels),
           lists = emptyBuffer<uint32_t>(gpu::CARRIED_LISTS * Pixels), depths = emptyBuffer<float>(Pixels);
    Carried result;
    result.done = reprojection().carry({film, old, carried, seen, seenAfter, lists, depths.address()},
                                       schedule, before, after, result.strips);
    result.depths = toHost<float>(depths, Pixels);
    result.shown.film = toHost<gpu::FilmPixel>(film, Pixels);
    if (result.done) { // as means of one sample
        const auto pixels = toHost<gpu::OldPixel>(carried, Pixels);
        for (uint32_t i = 0; i < Pixels; ++i)
            result.shown.film[i] = {pixels[i].color, pixels[i].albedo, 1, {}, {}};
    }
    result.shown.old = toHost<gpu::OldPixel>(old, Pixels);
    result.shown.seen = toHost<gpu::SeenPoint>(result.done ? seenAfter : seen, Pixels);
    return result;
}

/// Where pixels of the old picture go, by definition.
struct Oracle {
    std::vector<uint32_t> source{std::vector<uint32_t>(Pixels, gpu::NO_INDEX)};
    std::vector<float> depth{std::vector<float>(Pixels, std::numeric_limits<float>::infinity())};
    std::vector<bool> unsure{std::vector<bool>(Pixels)}; ///< rounding may decide

    Oracle(const Shown& shown, const gpu::CameraRecord& after) {
        std::vector<gpu::CarriedPixel> to;
        for (uint32_t i = 0; i < Pixels; ++i) {
            to.push_back(gpu::carryPixel(after, shown.seen[i], i % Width, i / Width, Width, Height));
            markBorders(after, shown.seen[i]);
            if (to[i].inside) depth[at(to[i])] = std::min(depth[at(to[i])], to[i].depth);
        }
        for (uint32_t i = 0; i < Pixels; ++i) {
            if (!to[i].inside) continue;
            const float least = depth[at(to[i])];
            const float share = (to[i].depth - least) / (gpu::SURFACE_TOLERANCE * least);
            if (std::abs(share - 1.f) < 0.01f) unsure[at(to[i])] = true;
            if (gpu::oneSurface(to[i].depth, least)) source[at(to[i])] = std::min(source[at(to[i])], i);
        }
    }

private:
    static uint32_t at(const gpu::CarriedPixel& p) { return p.x + p.y * Width; }

    /// A point that falls on the border of pixels may go to any of them.
    void markBorders(const gpu::CameraRecord& after, const gpu::SeenPoint& seen) {
        const glm::vec4 clip =
            after.worldToClip * glm::vec4(seen.point, seen.look == gpu::SEEN_SKY ? 0.f : 1.f);
        const float u = (0.5f * clip.x / clip.w + 0.5f) * Width, v = (0.5f * clip.y / clip.w + 0.5f) * Height;
        if (!(clip.w > 0.f && std::abs(u) < 1e6f && std::abs(v) < 1e6f)) return;
        for (float x : {u - 1e-3f, u + 1e-3f})
            for (float y : {v - 1e-3f, v + 1e-3f})
                if (std::floor(x) != std::floor(u) || std::floor(y) != std::floor(v))
                    for (const glm::vec2 p :
                         {glm::vec2(x, y), glm::vec2(u, v), glm::vec2(x, v), glm::vec2(u, y)})
                        if (p.x >= 0 && p.y >= 0 && p.x < Width && p.y < Height)
                            unsure[uint32_t(p.x) + uint32_t(p.y) * Width] = true;
    }
};

/// Something at every depth: a wall, boxes before it, sky, gaps, and a point that is none.
std::pair<float, uint32_t> motley(uint32_t x, uint32_t y) {
    if (x == 33 && y == 20) return {std::numeric_limits<float>::quiet_NaN(), Matte};
    if (y > 40 && x % 9 > 5) return {1.f, gpu::SEEN_SKY};
    if (x > 60 && y < 6) return {0.f, gpu::SEEN_NOTHING};
    if (x / 8 % 3 == 1 && y / 7 % 2 == 0) return {2.5f + 0.01f * float(x), gpu::packLook(0.6f, 0.2f, 0.1f)};
    return {6.f + 0.03f * float(y), Matte};
}

} // namespace

TEST(Reprojection, CarriesWhatIsNearestAsTheOracleSays) {
    for (View view : {View::Perspective, View::Orthographic})
        for (glm::dvec3 eye :
             {glm::dvec3(0.4, 0.1, 5), glm::dvec3(-0.3, 0.5, 5.8), glm::dvec3(0.2, -0.2, 4.5)}) {
            const gpu::CameraRecord before = cameraAt(view, {0, 0, 5}, {0, 0, 0}),
                                    after = cameraAt(view, eye, {0.1, 0, 0});
            const Shown shown = shownBy(before, motley);
            const Oracle oracle(shown, after);
            const Carried carried = carry(shown, before, after);
            ASSERT_TRUE(carried.done);
            uint32_t same = 0, empty = 0, known = 0;
            for (uint32_t i = 0; i < Pixels; ++i) {
                if (oracle.unsure[i]) continue;
                if (oracle.source[i] == gpu::NO_INDEX) {
                    ++empty;
                    continue;
                }
                ++known; // all but those through whose surroundings something behind shows
                const uint32_t from = oracle.source[i];
                same += carried.shown.film[i].color == shown.mean(from) &&
                        carried.shown.seen[i].point == shown.seen[from].point;
            }
            EXPECT_GT(known, Pixels / 2);
            EXPECT_GT(empty, 20u);
            EXPECT_GE(same, known - known / 20);
            EXPECT_LE(carried.uncovered(),
                      empty + std::count(oracle.unsure.begin(), oracle.unsure.end(), true));
        }
}

TEST(Reprojection, ShiftsAPlaneByWholePixels) {
    for (View view : {View::Perspective, View::Orthographic}) {
        const gpu::CameraRecord before = cameraAt(view, {0, 0, 5}, {0, 0, 0});
        // A pixel of the plane, in world units.
        const double pixel =
            view == View::Perspective ? 2 * 5 * std::tan(glm::radians(25.0)) / Height : 4.0 / Height;
        const glm::dvec3 move(3 * pixel, -2 * pixel, 0);
        const gpu::CameraRecord after = cameraAt(view, glm::dvec3(0, 0, 5) + move, move);
        const Shown shown =
            shownBy(before, [&](uint32_t x, uint32_t y) { return std::pair(toPlane(before, x, y), Matte); });
        const Carried carried = carry(shown, before, after);
        ASSERT_TRUE(carried.done);
        for (uint32_t y = 0; y < Height; ++y)
            for (uint32_t x = 0; x < Width; ++x) {
                const bool inSight = x + 3 < Width && y >= 2;
                const uint32_t i = x + y * Width;
                EXPECT_EQ(carried.shown.seen[i].look == gpu::SEEN_NOTHING, !inSight) << x << " " << y;
                if (!inSight) continue;
                EXPECT_EQ(carried.shown.film[i].color, shown.mean(x + 3 + (y - 2) * Width));
            }
        EXPECT_EQ(carried.uncovered(), 3 * Height + 2 * (Width - 3));
    }
}

TEST(Reprojection, TellsTheCameraDepthsOfWhatItCarried) {
    for (View view : {View::Perspective, View::Orthographic}) {
        const gpu::CameraRecord before = cameraAt(view, {0, 0, 5}, {0, 0, 0}),
                                after = cameraAt(view, {0.4, 0.1, 4.6}, {0.1, 0, 0});
        // A slope, and the sky in a corner.
        const Carried carried = carry(shownBy(before,
                                              [](uint32_t x, uint32_t y) {
                                                  return x < 20 && y < 20
                                                             ? std::pair(0.f, gpu::SEEN_SKY)
                                                             : std::pair(4.f + 0.02f * float(x), Matte);
                                              }),
                                      before, after);
        ASSERT_TRUE(carried.done);
        uint32_t surfaces = 0, none = 0;
        for (uint32_t i = 0; i < Pixels; ++i) {
            const gpu::SeenPoint& seen = carried.shown.seen[i];
            if (seen.look >= gpu::SEEN_SKY) {
                ++none;
                EXPECT_EQ(carried.depths[i], 0.f);
                continue;
            }
            ++surfaces;
            EXPECT_NEAR(carried.depths[i], gpu::projectToFilm(after, seen.point, Width, Height).depth, 1e-4f)
                << i;
        }
        EXPECT_GT(surfaces, Pixels / 2);
        EXPECT_GT(none, 200u);
    }
}

// Small moves, each far below a pixel, add up to what one great move does.
TEST(Reprojection, DoesNotDrift) {
    gpu::CameraRecord camera = cameraAt(View::Perspective, {0, 0, 5}, {0, 0, 0});
    Shown shown =
        shownBy(camera, [&](uint32_t x, uint32_t y) { return std::pair(toPlane(camera, x, y), Matte); });
    const Shown first = shown;
    const double pixel = 2 * 5 * std::tan(glm::radians(25.0)) / Height;
    for (int step = 1; step <= 50; ++step) {
        const double x = 0.12 * step * pixel; // never half a pixel
        const gpu::CameraRecord next = cameraAt(View::Perspective, {x, 0, 5}, {x, 0, 0});
        shown = carry(shown, camera, next).shown;
        camera = next;
    }
    uint32_t same = 0;
    for (uint32_t y = 0; y < Height; ++y)
        for (uint32_t x = 0; x + 6 < Width; ++x)
            same += shown.film[x + y * Width].color == first.mean(x + 6 + y * Width);
    EXPECT_EQ(same, (Width - 6) * Height);
}

TEST(Reprojection, GuessesGapsFromTheBackgroundAndPutsThemFirst) {
    const gpu::CameraRecord before = cameraAt(View::Perspective, {0, 0, 5}, {0, 0, 0}),
                            after = cameraAt(View::Perspective, {0.5, 0, 5}, {0.5, 0, 0});
    const auto near = [](uint32_t x, uint32_t y) { return x >= 30 && x < 45 && y >= 15 && y < 35; };
    Shown shown = shownBy(before, [&](uint32_t x, uint32_t y) {
        return std::pair((near(x, y) ? 0.3f : 1.f) * toPlane(before, x, y), Matte);
    });
    for (uint32_t i = 0; i < Pixels; ++i)
        shown.film[i].color = near(i % Width, i / Width) ? glm::vec4(2, 0, 0, 2) : glm::vec4(0, 1, 0, 2);
    const Carried carried = carry(shown, before, after);
    ASSERT_TRUE(carried.done);
    const std::vector<float> errors = carried.errors();
    uint32_t gap = 0;
    for (uint32_t y = 18; y < 32; ++y) // what was in front of the gap has moved to the left
        for (uint32_t x = 20; x < 45; ++x) {
            const uint32_t i = x + y * Width;
            if (carried.shown.seen[i].look != gpu::SEEN_NOTHING) continue;
            ++gap;
            EXPECT_EQ(carried.shown.film[i].color, glm::vec4(0, 0.5f, 0, 1)) << x << " " << y;
            EXPECT_GT(errors[Grid.at(x, y)], 0.f);
        }
    EXPECT_GT(gap, 50u);
    EXPECT_EQ(errors[Grid.at(5, 10)], 0.f); // covered, and matte
}

TEST(Reprojection, ClosesTheCracksOfASurfaceThatComesCloser) {
    const gpu::CameraRecord before = cameraAt(View::Perspective, {0, 0, 5}, {0, 0, 0}),
                            after = cameraAt(View::Perspective, {0, 0, 3.13}, {0, 0, 0});
    const auto near = [](uint32_t x, uint32_t y) { return x >= 25 && x < 50 && y >= 15 && y < 35; };
    Shown shown = shownBy(before, [&](uint32_t x, uint32_t y) { // with something behind
        return std::pair((near(x, y) ? 0.8f : 1.f) * toPlane(before, x, y), Matte);
    });
    for (uint32_t i = 0; i < Pixels; ++i)
        shown.film[i].color = near(i % Width, i / Width) ? glm::vec4(2, 0, 0, 2) : glm::vec4(0, 2, 0, 2);
    const Carried carried = carry(shown, before, after);
    ASSERT_TRUE(carried.done);
    for (uint32_t y = 12; y < 38; ++y)
        for (uint32_t x = 22; x < 53; ++x)
            EXPECT_EQ(carried.shown.film[x + y * Width].color, glm::vec4(1, 0, 0, 1)) << x << " " << y;
    EXPECT_EQ(carried.uncovered(), 0u);
}

TEST(Reprojection, TilesThatDependOnTheViewComeFirst) {
    const gpu::CameraRecord before = cameraAt(View::Perspective, {0, 0, 5}, {0, 0, 0}),
                            after = cameraAt(View::Perspective, {0.02, 0, 5}, {0.02, 0, 0});
    Shown shown = shownBy(before, [&](uint32_t x, uint32_t y) {
        const uint32_t look = x < 24   ? Matte
                              : x < 48 ? gpu::packLook(0.5f, 0.3f, 0.f)
                                       : gpu::packLook(1.f, 0.f, 0.f);
        return std::pair(toPlane(before, x, y), look);
    });
    for (gpu::FilmPixel& pixel : shown.film)
        pixel.color = glm::vec4(2.f);
    Carried carried = carry(shown, before, after);
    ASSERT_TRUE(carried.done);
    const std::vector<float> errors = carried.errors();
    EXPECT_EQ(errors[Grid.at(10, 20)], 0.f);
    EXPECT_GT(errors[Grid.at(36, 20)], 0.f);
    EXPECT_GT(errors[Grid.at(60, 20)], 5.f * errors[Grid.at(36, 20)]);
    // What is stale stays so when the camera stands, and adds up when it goes on.
    const Carried still = carry(carried.shown, after, after);
    const Carried on = carry(carried.shown, after, cameraAt(View::Perspective, {0.04, 0, 5}, {0.04, 0, 0}));
    EXPECT_FLOAT_EQ(still.errors()[Grid.at(36, 20)], errors[Grid.at(36, 20)]);
    EXPECT_GT(on.errors()[Grid.at(36, 20)], 1.5f * errors[Grid.at(36, 20)]);
}

TEST(Reprojection, TakesWhatIsOnDisplay) {
    const gpu::CameraRecord camera = cameraAt(View::Perspective, {0, 0, 5}, {0, 0, 0});
    Shown shown =
        shownBy(camera, [&](uint32_t x, uint32_t y) { return std::pair(toPlane(camera, x, y), Matte); });
    for (gpu::OldPixel& pixel : shown.old)
        pixel = {glm::vec4(7.f), glm::vec3(3.f), 1};
    TileSchedule schedule = settled(); // an edit that does not show in tile 0: its old picture stays
    schedule.invalidate();
    schedule.next(64, 2);
    schedule.measured(0, 0.f, 1.f);
    schedule.advance();
    ASSERT_TRUE(schedule.tiles()[0].keepsOld);
    const Carried carried = carry(shown, camera, camera, schedule);
    ASSERT_TRUE(carried.done);
    for (uint32_t i = 0; i < Pixels; ++i) {
        const bool old = Grid.at(i % Width, i / Width) == 0;
        EXPECT_EQ(carried.shown.film[i].color, old ? glm::vec4(7.f) : shown.mean(i));
        EXPECT_EQ(carried.shown.film[i].albedo, old ? glm::vec3(3.f) : glm::vec3(shown.mean(i)));
    }
    EXPECT_EQ(carried.uncovered(), 0u);
}

TEST(Reprojection, LeavesThePictureOfAnotherPlace) {
    const gpu::CameraRecord before = cameraAt(View::Perspective, {0, 0, 5}, {0, 0, 0});
    const Shown shown =
        shownBy(before, [&](uint32_t x, uint32_t y) { return std::pair(toPlane(before, x, y), Matte); });
    for (glm::dvec3 target : {glm::dvec3(0, 0, 10), glm::dvec3(5, 0, 3.5)}) {
        const Carried carried = carry(shown, before, cameraAt(View::Perspective, {0, 0, 5}, target));
        EXPECT_FALSE(carried.done);
        for (uint32_t i = 0; i < Pixels; ++i)
            EXPECT_EQ(carried.shown.film[i].color, shown.film[i].color);
    }
}

TEST(StaleLook, AddsUpToTheShareThatDependsOnTheView) {
    const uint32_t look = gpu::packLook(0.4f, 0.19f, 0.f);
    EXPECT_NEAR(gpu::viewShare(look), 0.4f, 1 / 255.f);
    EXPECT_NEAR(gpu::viewAlpha(look), 0.19f, 1 / 255.f);
    const uint32_t turned = gpu::turnedLook(look, 0.05f);
    EXPECT_NEAR(gpu::staleness(turned), 0.4f * 0.05f / 0.2f, 1e-3f);
    EXPECT_EQ(gpu::turnedLook(turned, 0.f), turned);
    EXPECT_NEAR(gpu::staleness(gpu::turnedLook(turned, 3.f)), gpu::viewShare(look), 1e-4f);
    for (uint32_t special : {gpu::SEEN_SKY, gpu::SEEN_NOTHING}) {
        EXPECT_EQ(gpu::turnedLook(special, 1.f), special);
        EXPECT_EQ(gpu::staleness(special), 0.f);
    }
    EXPECT_LT(gpu::packLook(1.f, 1.f, 1.f), gpu::SEEN_SKY);
}
