// HiPR after edits: where each mode looks first, and that the finished picture knows nothing of it.
#include <gtest/gtest.h>

#include <cstdlib>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

constexpr uint32_t Size = 96, Tile = 8, Columns = Size / Tile, Tiles = Columns * Columns;

/// A matte floor with a mirror at its end, and balls: one in view, one behind the camera that only the mirror
/// shows, and one above the picture of which only the shadow falls into it. Edits move one of them.
class Scene {
public:
    explicit Scene(Stage& stage) : _stage(stage) {
        addFloor(stage);
        mirrorId = stage.add(quadMesh(), mirror(), {placed(scaling(4, 2.4f, 1), 0.f, 0.2f, -2.5f)});
        inView = stage.add(sphereMesh(12), matte({0.8f, 0.2f, 0.1f}), {inViewAt(0.f)});
        inMirror = stage.add(sphereMesh(12), matte({0.2f, 0.3f, 0.8f}), {inMirrorAt(0.f)});
        above = stage.add(sphereMesh(12), matte({0.3f, 0.8f, 0.3f}), {aboveAt(0.f)});
        LightDesc lamp;
        lamp.kind = LightKind::Sphere;
        lamp.radius = 0.1f;
        lamp.intensity = 400.f;
        lamp.transform = glm::translate(glm::dmat4(1), glm::dvec3(1.5, 6, 0.5));
        lampId = stage.add(lamp);
        _lamp = lamp;
        stage.add(skyLight(0.1f));
        stage.edit.setCamera(lookAt({0, 0.3, 5}, {0, -0.1, 0}, 45));
        stage.film(Size, Size,
                   {{AovKind::Color, {}},
                    {AovKind::PrimId, {}},
                    {AovKind::Priority, {}},
                    {AovKind::Discovered, {}},
                    {AovKind::Age, {}},
                    {AovKind::SampleCount, {}}});
    }

    static glm::mat4x3 inViewAt(float x) { return placed(scaling(0.4f, 0.4f, 0.4f), x - 0.8f, -0.6f, 0.5f); }
    static glm::mat4x3 inMirrorAt(float x) { return placed(glm::mat4x3(1.f), 1.2f + x, 0.9f, 7.f); }
    static glm::mat4x3 aboveAt(float x) { return placed(scaling(0.3f, 0.3f, 0.3f), 1.3f + x, 3.5f, 0.5f); }

    void place(ObjectId object, glm::mat4x3 transform) {
        _stage.edit.setInstances(object, {{transform}, {}, {}});
    }
    void dim(float intensity) {
        _lamp.intensity = intensity;
        _stage.edit.setLight(lampId, _lamp);
    }

    ObjectId mirrorId, inView, inMirror, above;
    LightId lampId;

private:
    Stage& _stage;
    LightDesc _lamp;
};

struct Edit {
    const char* name;
    std::function<void(Scene&)> apply, undo;
};

const Edit MovesInView{"in view", [](Scene& s) { s.place(s.inView, Scene::inViewAt(0.7f)); },
                       [](Scene& s) { s.place(s.inView, Scene::inViewAt(0.f)); }};
const Edit MovesInMirror{"in the mirror", [](Scene& s) { s.place(s.inMirror, Scene::inMirrorAt(-1.5f)); },
                         [](Scene& s) { s.place(s.inMirror, Scene::inMirrorAt(0.f)); }};
const Edit MovesAbove{"above the picture", [](Scene& s) { s.place(s.above, Scene::aboveAt(-0.8f)); },
                      [](Scene& s) { s.place(s.above, Scene::aboveAt(0.f)); }};
const Edit DimsTheLamp{"light", [](Scene& s) { s.dim(200.f); }, [](Scene& s) { s.dim(400.f); }};

/// Without scouts: their lattice misses a picture this small.
Settings withoutScouts() {
    Settings settings = smallTiles("paper");
    settings.scoutRate = 0.0001f;
    settings.floorShare = 0.f;
    return settings;
}

/// Applies an edit and renders until the tiles are in their order; in delta mode, until every tile has been
/// looked at.
void discover(Stage& stage) {
    stage.renderer->commit(stage.edit);
    const bool delta = stage.renderer->settings().mode == "delta";
    while (stage.renderer->progress().tilesDiscovered == 0 ||
           (delta && stage.renderer->progress().samplesDone == 0))
        ASSERT_TRUE(stage.renderer->renderBatch());
}

/// One value a tile.
template <class T> std::vector<T> byTile(Stage& stage, AovKind kind) {
    const Picture<T> picture = stage.read<T>(kind);
    std::vector<T> values;
    for (uint32_t tile = 0; tile < Tiles; ++tile)
        values.push_back(picture.at(tile % Columns * Tile, tile / Columns * Tile));
    return values;
}

uint32_t tileOf(size_t pixel) {
    return uint32_t(pixel % Size / Tile + pixel / Size / Tile * Columns);
}

/// Sum of |a - b| over the pixels of tiles that are marked.
double errorIn(const std::vector<int>& tiles, const ColorPicture& a, const ColorPicture& b) {
    double sum = 0;
    for (size_t i = 0; i < a.values.size(); ++i) {
        const glm::vec4 d = glm::abs(a.values[i] - b.values[i]);
        if (tiles[tileOf(i)]) sum += d.x + d.y + d.z;
    }
    return sum;
}

/// |a - b| by tile: of the tile's means, in which the noise of single pixels cancels.
std::vector<float> changeByTile(const ColorPicture& a, const ColorPicture& b) {
    std::vector<glm::vec4> sums(Tiles);
    for (size_t i = 0; i < a.values.size(); ++i)
        sums[tileOf(i)] += a.values[i] - b.values[i];
    std::vector<float> changes;
    for (const glm::vec4& sum : sums)
        changes.push_back(std::abs(sum.x) + std::abs(sum.y) + std::abs(sum.z));
    return changes;
}

/// Marks tiles that show an object.
void markTiles(Stage& stage, ObjectId object, std::vector<int>& tiles) {
    const Picture<int> ids = stage.read<int>(AovKind::PrimId);
    for (size_t i = 0; i < ids.values.size(); ++i)
        if (ids.values[i] == int(object)) tiles[tileOf(i)] = 1;
}

/// Of the change that an edit made to the picture where it shows most, the share that lies in tiles which
/// discovery found.
double shareFound(const Settings& settings, const Edit& edit, std::vector<float>* priorities = nullptr) {
    Settings many = settings;
    many.samples = 16;
    Stage stage(many);
    Scene scene(stage);
    stage.render();
    const ColorPicture before = stage.color();
    edit.apply(scene);
    discover(stage);
    const std::vector<int> found = byTile<int>(stage, AovKind::Discovered);
    if (priorities) *priorities = byTile<float>(stage, AovKind::Priority);
    stage.render();
    save(before, "hipr before");
    save(stage.color(), std::string("hipr ") + edit.name);
    const std::vector<float> change = changeByTile(before, stage.color());
    const float least = 0.1f * *std::max_element(change.begin(), change.end());
    double all = 0, inFound = 0;
    for (uint32_t tile = 0; tile < Tiles; ++tile) {
        if (change[tile] < least) continue; // indirect light, mostly noise at so few samples
        all += change[tile], inFound += found[tile] ? change[tile] : 0.f;
    }
    EXPECT_GT(all, 0.0);
    if (std::getenv("HIPR_TEST_OUT"))
        for (uint32_t row = Columns; row-- > 0; puts(""))
            for (uint32_t column = 0; column < Columns; ++column)
                printf(" %6.2f%c", change[column + row * Columns], found[column + row * Columns] ? '*' : ' ');
    return inFound / all;
}

std::vector<float> prioritiesAfter(const Settings& settings, const RendererInternals& internals) {
    Stage stage(settings, internals);
    Scene scene(stage);
    stage.render();
    MovesInView.apply(scene);
    discover(stage);
    return byTile<float>(stage, AovKind::Priority);
}

} // namespace

TEST(Hipr, FinishedPicturesAreTheSameInAllModes) {
    const std::vector<Edit> edits = {MovesInView, MovesInMirror, MovesAbove, DimsTheLamp};
    std::vector<ColorPicture> expected;
    for (const char* mode : {"uniform", "delta", "paper"})
        for (const RendererInternals& internals :
             {RendererInternals{8, 500}, {16, 3000}, {32, 1 << 16}, {8, 1 << 14}}) {
            Stage stage(smallTiles(mode), internals);
            Scene scene(stage);
            stage.render();
            std::vector<ColorPicture> pictures{stage.color()};
            for (const Edit& edit : edits) {
                edit.apply(scene);
                stage.render();
                pictures.push_back(stage.color());
            }
            if (expected.empty()) expected = pictures;
            for (size_t i = 0; i < pictures.size(); ++i)
                EXPECT_TRUE(sameBits(pictures[i], expected[i]))
                    << mode << " " << internals.tileSize << " " << internals.batchPaths << " edit " << i;
        }
    for (size_t i = 1; i < expected.size(); ++i)
        EXPECT_FALSE(sameBits(expected[i], expected[i - 1])) << edits[i - 1].name;
}

// An edit that comes while the one before is being looked for, at any stage of that, costs nothing either.
TEST(Hipr, InterruptedDiscoveryLosesNothing) {
    Stage stage(smallTiles("paper"), {8, 1000});
    Scene scene(stage);
    stage.render();
    const ColorPicture expected = stage.color();
    for (int batches = 0; batches < 30; ++batches) {
        MovesInView.apply(scene);
        stage.renderer->commit(stage.edit);
        for (int i = 0; i < batches; ++i)
            stage.renderer->renderBatch();
        MovesInView.undo(scene);
        if (batches % 3 == 1) stage.settings(smallTiles("delta"));
        if (batches % 3 == 2) stage.settings(smallTiles("paper"));
        stage.renderer->commit(stage.edit);
        if (batches % 5 == 0) {
            stage.render();
            ASSERT_TRUE(sameBits(stage.color(), expected)) << batches;
        }
    }
}

TEST(Hipr, ActiveTilesAreThoseThatSeeTheEditNowOrBefore) {
    Stage stage(withoutScouts());
    Scene scene(stage);
    stage.render();
    std::vector<int> expected(Tiles);
    markTiles(stage, scene.inView, expected);
    const std::vector<int> before = expected;
    MovesInView.apply(scene);
    stage.renderer->commit(stage.edit);
    std::vector<int> active(Tiles);
    while (std::count(active.begin(), active.end(), 1) == 0) { // those come into the order first
        ASSERT_TRUE(stage.renderer->renderBatch());
        active = byTile<int>(stage, AovKind::Discovered);
    }
    for (int count : byTile<int>(stage, AovKind::SampleCount))
        EXPECT_EQ(count, 0);
    stage.render();
    markTiles(stage, scene.inView, expected);
    EXPECT_EQ(active, expected);
    EXPECT_NE(active, before);
}

TEST(Hipr, PathsFindMirrorImagesAndShadows) {
    Stage stage(withoutScouts());
    Scene scene(stage);
    stage.render();
    std::vector<int> mirror(Tiles), own(Tiles);
    markTiles(stage, scene.mirrorId, mirror);
    markTiles(stage, scene.inView, own);
    MovesInView.apply(scene);
    discover(stage);
    const std::vector<float> priority = byTile<float>(stage, AovKind::Priority);
    stage.render();
    markTiles(stage, scene.inView, own);
    float leastOwn = 1e30f, mostOther = 0.f;
    uint32_t inMirror = 0, mirrored = 0;
    for (uint32_t tile = 0; tile < Tiles; ++tile) {
        if (own[tile])
            leastOwn = std::min(leastOwn, priority[tile]);
        else
            mostOther = std::max(mostOther, priority[tile]);
        if (!mirror[tile] || own[tile]) continue;
        ++inMirror;
        mirrored += priority[tile] > 0.f;
    }
    EXPECT_GT(leastOwn, mostOther); // where it is seen itself comes first
    EXPECT_GT(inMirror, 4u);
    EXPECT_GT(mirrored, inMirror / 2);
    EXPECT_GT(shareFound(withoutScouts(), MovesInView), 0.95);
}

TEST(Hipr, ScoutsFindWhatNoPixelSees) {
    for (const Edit& edit : {MovesInMirror, MovesAbove})
        EXPECT_GT(shareFound(smallTiles("delta"), edit), 0.9) << edit.name;
    for (const Edit& edit : {MovesAbove, DimsTheLamp})
        EXPECT_GT(shareFound(smallTiles("paper"), edit), 0.9) << edit.name;
    // Paper mode has scouts to begin with, and few of its paths lead from them to the rest of the mirror.
    EXPECT_GT(shareFound(smallTiles("paper"), MovesInMirror), 0.4);
}

// Where indirect light changes by less than the noise of a sample, the old picture is the better one; where
// the edit is seen, it shows.
TEST(Hipr, OldPicturesStayWhereTheyAreBetter) {
    Stage stage(smallTiles("delta", 32)), onceStage(smallTiles("uniform", 1));
    Scene scene(stage), onceScene(onceStage);
    stage.render();
    std::vector<int> own(Tiles), kept(Tiles);
    markTiles(stage, scene.inView, own);
    MovesInView.apply(scene);
    discover(stage);
    const ColorPicture shown = stage.color();
    const std::vector<int> age = byTile<int>(stage, AovKind::Age);
    const std::vector<float> change = byTile<float>(stage, AovKind::Priority);
    stage.render();
    markTiles(stage, scene.inView, own);
    for (uint32_t tile = 0; tile < Tiles; ++tile) {
        kept[tile] = age[tile] == 1 && change[tile] > 0.f;
        EXPECT_TRUE(!own[tile] || age[tile] == 0) << tile;
    }
    EXPECT_GT(std::count(kept.begin(), kept.end(), 1), int(Tiles) / 10);
    for (int tile : byTile<int>(stage, AovKind::Age))
        EXPECT_EQ(tile, 0);

    MovesInView.apply(onceScene);
    onceStage.render();
    EXPECT_LT(errorIn(kept, shown, stage.color()), 0.5 * errorIn(kept, onceStage.color(), stage.color()));
}

// The first batches are small, so that the edit shows soon; small batches are no way to render much.
TEST(Hipr, BatchesAfterALocalEditGrow) {
    Stage stage(smallTiles("delta", 1));
    Scene scene(stage);
    stage.film(256, 256, {{AovKind::Color, {}}});
    stage.render();
    MovesInView.apply(scene);
    stage.renderer->commit(stage.edit);
    std::vector<uint64_t> batches;
    for (uint64_t before = 0; batches.size() < 4; before = stage.renderer->progress().pathsTraced) {
        ASSERT_TRUE(stage.renderer->renderBatch());
        const uint64_t paths = stage.renderer->progress().pathsTraced - before;
        if (paths > 0) batches.push_back(paths); // others look for the edit
    }
    EXPECT_LE(batches[0], 2048u);
    EXPECT_LE(batches[1], 2048u);
    EXPECT_GT(batches[2], 2048u);
    EXPECT_LE(batches[2], 4096u);
    EXPECT_GT(batches[3], 4096u);
    EXPECT_LE(batches[3], 8192u);
}

TEST(Hipr, WeightsAreTheSameInEveryRun) {
    const std::vector<float> expected = prioritiesAfter(smallTiles("paper"), {Tile, 0});
    uint32_t discovered = 0;
    for (float priority : expected)
        discovered += priority > 0.f;
    EXPECT_GT(discovered, 10u);
    EXPECT_LT(discovered, Tiles);
    for (uint32_t batch : {0u, 300u, 3000u, 1u << 16})
        EXPECT_EQ(prioritiesAfter(smallTiles("paper"), {Tile, batch}), expected) << batch;
    Settings bvh = smallTiles("paper");
    bvh.traversal = "bvh"; // runs on the device, several rounds a submission
    EXPECT_EQ(prioritiesAfter(bvh, {Tile, 1000}), expected);
    setenv("HIPR_NO_HOST_MEMORY", "1", 1);
    EXPECT_EQ(prioritiesAfter(bvh, {Tile, 3000}), expected);
    unsetenv("HIPR_NO_HOST_MEMORY");
}

// Weights of 0 take part of the tiles out of the order, and another tolerance accepts other vertices.
TEST(Hipr, SettingsSteerDiscovery) {
    const auto sum = [](const Settings& settings) {
        double total = 0;
        for (float priority : prioritiesAfter(settings, {Tile, 0}))
            total += priority;
        return total;
    };
    Settings settings = withoutScouts();
    const double usual = sum(settings);
    settings.weightDiffuse = 0.f; // all is matte but the mirror; shadows count as diffuse too
    EXPECT_LT(sum(settings), 0.8 * usual);
    settings = withoutScouts();
    settings.eps = 1.f;
    EXPECT_GE(sum(settings), usual);
}
