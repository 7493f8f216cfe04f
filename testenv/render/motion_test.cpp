// Camera moves: what is on display at once, what is refreshed first, and that nothing of it is left at the
// end.
#include <gtest/gtest.h>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

constexpr uint32_t Size = 96, Tile = 8, Columns = Size / Tile, Tiles = Columns * Columns;

CameraDesc orthographic(double x, double y) {
    return {glm::lookAt(glm::dvec3(x, y, 5), glm::dvec3(x, y, 0), glm::dvec3(0, 1, 0)),
            glm::ortho(-2.0, 2.0, -2.0, 2.0, 0.1, 100.0)};
}
constexpr double OrthographicPixel = 4.0 / Size;

/// A wall of quads of all colours.
void addWall(Stage& stage) {
    for (int y = -8; y < 8; ++y)
        for (int x = -8; x < 8; ++x)
            stage.add(quadMesh(), matte({x & 1 ? 0.9f : 0.1f, y & 1 ? 0.9f : 0.1f, 0.5f}),
                      {placed(scaling(0.5f, 0.5f, 1), 0.5f * float(x) + 0.25f, 0.5f * float(y) + 0.25f, 0)});
}

/// A glossy ball, a matte one and a mirror on a floor, before the sky.
class Room {
public:
    explicit Room(Stage& stage) : _stage(stage) {
        addFloor(stage);
        mirrorId = stage.add(quadMesh(), mirror(), {placed(scaling(2, 2, 1), 1.2f, 0, -2.f)});
        _ball = stage.add(sphereMesh(12), matte({0.8f, 0.2f, 0.1f}), {ballAt(0)});
        stage.add(skyLight());
        _lamp.kind = LightKind::Sphere;
        _lamp.radius = 0.2f;
        _lamp.transform = glm::translate(glm::dmat4(1), glm::dvec3(1.5, 3, 1.5));
        _lampId = stage.add(_lamp);
        dim(40);
        view(0);
        stage.film(Size, Size,
                   {{AovKind::Color, {}},
                    {AovKind::PrimId, {}},
                    {AovKind::Priority, {}},
                    {AovKind::SampleCount, {}}});
    }

    void view(double angle) {
        _stage.edit.setCamera(lookAt({5 * std::sin(angle), 0.5, 5 * std::cos(angle)}, {0, -0.2, 0}, 45));
    }
    void dolly(double distance) { _stage.edit.setCamera(lookAt({0, 0.5, distance}, {0, -0.2, 0}, 45)); }
    void moveBall(float x) { _stage.edit.setInstances(_ball, {{ballAt(x)}, {}, {}}); }
    void dim(float intensity) {
        _lamp.intensity = intensity;
        _stage.edit.setLight(_lampId, _lamp);
    }

    ObjectId mirrorId;

private:
    static glm::mat4x3 ballAt(float x) { return placed(scaling(0.5f, 0.5f, 0.5f), x - 0.8f, -0.5f, 0.5f); }

    Stage& _stage;
    ObjectId _ball;
    LightId _lampId;
    LightDesc _lamp;
};

/// One value a tile.
template <class T> std::vector<T> byTile(Stage& stage, AovKind kind) {
    const Picture<T> picture = stage.read<T>(kind);
    std::vector<T> values;
    for (uint32_t tile = 0; tile < Tiles; ++tile)
        values.push_back(picture.at(tile % Columns * Tile, tile / Columns * Tile));
    return values;
}

double error(const ColorPicture& a, const ColorPicture& b) {
    double sum = 0;
    for (size_t i = 0; i < a.values.size(); ++i)
        for (int c = 0; c < 3; ++c)
            sum += std::abs(double(a.values[i][c]) - double(b.values[i][c]));
    return sum / double(3 * a.values.size());
}

/// What is done to the scene, one after another; half of it comes while the one before is under way.
std::vector<std::function<void(Room&)>> moves() {
    return {[](Room& r) { r.view(0.02); },
            [](Room& r) { r.view(0.1); },
            [](Room& r) { r.moveBall(0.3f); }, // in the middle of a move
            [](Room& r) { r.view(0.12), r.moveBall(0.1f); },
            [](Room& r) { r.dolly(4.4); },
            [](Room& r) { r.dim(20); },
            [](Room& r) { r.view(0.14); },
            [](Room& r) { r.view(3.0); }, // a cut
            [](Room& r) { r.view(0.2); }};
}

} // namespace

TEST(CameraMotion, APanShowsThePictureShiftedAtOnce) {
    Stage stage(smallTiles("delta", 16));
    addWall(stage);
    stage.add(skyLight());
    stage.edit.setCamera(orthographic(0, 0));
    stage.film(Size, Size);
    stage.render();
    const ColorPicture before = stage.color();
    stage.edit.setCamera(orthographic(5 * OrthographicPixel, -3 * OrthographicPixel));
    stage.renderer->commit(stage.edit);
    const ColorPicture shown = stage.color();
    for (uint32_t y = 3; y < Size; ++y)
        for (uint32_t x = 0; x + 5 < Size; ++x)
            EXPECT_EQ(shown.at(x, y), before.at(x + 5, y - 3)) << x << " " << y;
    save(shown, "pan");
    stage.render();
    save(stage.color(), "pan after");
    EXPECT_LT(error(shown, stage.color()), 0.25 * error(before, stage.color()));
}

TEST(CameraMotion, UniformModeKeepsThePictureWhereItWas) {
    Stage stage(smallTiles("uniform"));
    Room room(stage);
    stage.render();
    const ColorPicture before = stage.color();
    room.view(0.05);
    stage.renderer->commit(stage.edit);
    EXPECT_TRUE(sameBits(stage.color(), before));
    EXPECT_EQ(stage.renderer->progress().tilesDiscovered, 0u);
    const auto bytes = [](Stage& s) {
        uint64_t film = 0;
        for (const MemoryReport::Row& row : s.renderer->memory().rows)
            if (row.kind == std::string("Film")) film += row.bytes;
        return film;
    };
    Stage other(smallTiles("delta"));
    Room same(other);
    other.render();
    EXPECT_GT(bytes(other), bytes(stage) + Size * Size * 2 * sizeof(gpu::SeenPoint));
}

TEST(CameraMotion, WhatComesIntoSightIsRefreshedFirst) {
    Stage stage(smallTiles("delta", 8), {Tile, 512});
    addWall(stage);
    const ObjectId near =
        stage.add(quadMesh(), matte(glm::vec3(0.9f)), {placed(scaling(0.8f, 0.8f, 1), 0, 0, 2.5f)});
    stage.add(skyLight());
    stage.edit.setCamera(lookAt({0, 0, 5}, {0, 0, 0}, 45));
    stage.film(
        Size, Size,
        {{AovKind::Color, {}}, {AovKind::PrimId, {}}, {AovKind::Priority, {}}, {AovKind::SampleCount, {}}});
    stage.render();
    const Picture<int> before = stage.read<int>(AovKind::PrimId);
    stage.edit.setCamera(
        lookAt({0.25, 0, 5}, {0.25, 0, 0}, 45)); // the wall moves by 6 pixels, the near one by 12
    stage.renderer->commit(stage.edit);
    const std::vector<float> priority = byTile<float>(stage, AovKind::Priority);
    stage.renderer->renderBatch();
    const std::vector<int> refreshed = byTile<int>(stage, AovKind::SampleCount);
    stage.render();
    const Picture<int> after = stage.read<int>(AovKind::PrimId);
    uint32_t gaps = 0;
    float least = 1e30f, most = 0.f;
    for (uint32_t tile = 0; tile < Tiles; ++tile) {
        uint32_t gap = 0;
        for (uint32_t i = 0; i < Tile * Tile; ++i) {
            const uint32_t x = tile % Columns * Tile + i % Tile, y = tile / Columns * Tile + i / Tile;
            if (x + 6 >= Size)
                ++gap; // new in the picture
            else
                gap += before.at(x + 6, y) == int(near) && after.at(x, y) != int(near);
        }
        if (gap > 16) ++gaps, least = std::min(least, priority[tile]);
        if (gap == 0 && tile % Columns < Columns - 2) most = std::max(most, priority[tile]);
    }
    EXPECT_GE(gaps, Columns + 4);
    EXPECT_GT(least, most);
    for (uint32_t tile = 0; tile < Tiles; ++tile) {
        if (refreshed[tile] == 0) continue;
        EXPECT_GT(priority[tile], 0.f) << tile;
    }
}

TEST(CameraMotion, MirrorsAreRefreshedBeforeMatteSurfaces) {
    Stage stage(smallTiles("delta", 8), {Tile, 512});
    Room room(stage);
    stage.render();
    room.view(0.004); // less than a pixel
    stage.renderer->commit(stage.edit);
    const std::vector<float> priority = byTile<float>(stage, AovKind::Priority);
    stage.render();
    const Picture<int> ids = stage.read<int>(AovKind::PrimId);
    float leastMirror = 1e30f, mostMatte = 0.f;
    for (uint32_t row = 1; row + 1 < Columns; ++row) // nothing comes into sight there
        for (uint32_t column = 1; column + 1 < Columns; ++column) {
            const uint32_t tile = column + row * Columns;
            uint32_t mirror = 0, sphere = 0;
            for (uint32_t i = 0; i < Tile * Tile; ++i) {
                const int id = ids.at(column * Tile + i % Tile, row * Tile + i / Tile);
                mirror += id == int(room.mirrorId);
                sphere += id > int(room.mirrorId);
            }
            if (mirror == Tile * Tile) leastMirror = std::min(leastMirror, priority[tile]);
            if (mirror == 0 && sphere == 0) mostMatte = std::max(mostMatte, priority[tile]);
        }
    EXPECT_LT(leastMirror, 1e30f);
    EXPECT_GT(leastMirror, 2.f * mostMatte);
}

// One new sample a pixel is noisier than a picture of many that was carried along.
TEST(CameraMotion, ACarriedPictureStaysUntilTheNewOneIsBetter) {
    double errors[2];
    for (int mode = 0; mode < 2; ++mode) {
        Stage stage(smallTiles(mode ? "delta" : "uniform", 32), {Tile, 3000});
        addWall(stage);
        stage.add(skyLight());
        stage.edit.setCamera(lookAt({0, 0, 5}, {0, 0, 0}, 45));
        stage.film(Size, Size);
        stage.render();
        stage.edit.setCamera(lookAt({0.2, 0.1, 4.9}, {0.2, 0.1, 0}, 45));
        stage.renderer->commit(stage.edit);
        while (stage.renderer->progress().samplesDone < 1)
            stage.renderer->renderBatch();
        const ColorPicture shown = stage.color();
        stage.render();
        errors[mode] = error(shown, stage.color());
    }
    EXPECT_LT(errors[1], 0.6 * errors[0]);
}

// Drags, moves in the middle of edits, edits in the middle of moves and both at once: no trace of it is left.
TEST(CameraMotion, LeavesNoTraceInTheFinishedPicture) {
    std::vector<ColorPicture> expected;
    for (const char* mode : {"uniform", "delta", "paper"})
        for (const RendererInternals& internals : {RendererInternals{8, 1000}, {16, 3000}, {32, 1 << 16}})
            for (int between : {0, 2}) { // batches after each move but every third
                Stage stage(smallTiles(mode), internals);
                Room room(stage);
                stage.render();
                std::vector<ColorPicture> pictures;
                int index = 0;
                for (const auto& move : moves()) {
                    move(room);
                    stage.renderer->commit(stage.edit);
                    for (int i = 0; i < between && stage.renderer->renderBatch(); ++i) {
                    }
                    if (++index % 3) continue;
                    stage.render();
                    pictures.push_back(stage.color());
                }
                if (expected.empty()) expected = pictures;
                for (size_t i = 0; i < pictures.size(); ++i)
                    EXPECT_TRUE(sameBits(pictures[i], expected[i]))
                        << mode << " " << internals.tileSize << " " << internals.batchPaths << " " << between;
            }
}

TEST(CameraMotion, WhatIsOnDisplayIsTheSameWhateverTheTraversalAndMemory) {
    const auto shown = [](const char* traversal) {
        Settings settings = smallTiles("delta", 4);
        settings.traversal = traversal;
        Stage stage(settings);
        Room room(stage);
        stage.render();
        room.view(0.03);
        stage.renderer->commit(stage.edit);
        const ColorPicture picture = stage.color();
        save(picture, "motion");
        return picture;
    };
    const ColorPicture expected = shown("host");
    EXPECT_TRUE(sameBits(shown("bvh"), expected));
    setenv("HIPR_NO_HOST_MEMORY", "1", 1);
    EXPECT_TRUE(sameBits(shown("host"), expected));
    unsetenv("HIPR_NO_HOST_MEMORY");
}

TEST(CameraMotion, ADragFollowsTheCameraWithoutANewSample) {
    Stage stage(smallTiles("delta", 64));
    Room room(stage);
    stage.render();
    const ColorPicture first = stage.color();
    for (int i = 1; i <= 20; ++i) {
        room.dolly(5 - 0.05 * i);
        stage.renderer->commit(stage.edit);
    }
    const ColorPicture dragged = stage.color();
    for (const glm::vec4& value : dragged.values)
        EXPECT_GT(value.x + value.y + value.z, 0.f);
    stage.render();
    save(dragged, "dragged");
    save(stage.color(), "dragged after");
    EXPECT_LT(error(dragged, stage.color()), 0.65 * error(first, stage.color()));
}
