// Which elements and instances a commit names, and the places where they were and are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/scene/gpu_scene.h"
#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

constexpr GeometryId quad{1};
constexpr MaterialId grey{2};
constexpr ObjectId object{3};
constexpr LightId lamp{4};
constexpr SplatsId splats{5};
constexpr uint32_t All = ChangedElement::AllInstances;

using Named = std::vector<std::pair<Change, uint32_t>>;

/// What one commit does.
struct Outcome {
    Named named;                       ///< of `object`
    std::vector<float> left, occupied; ///< x of the centres of the boxes
    bool traced = false;               ///< paths notice
};

std::shared_ptr<const SplatCloud> oneSplat(float x) {
    SplatCloud cloud;
    cloud.name = "/object";
    cloud.positions = {{x, 0, 0}};
    cloud.scales = {glm::vec3(0)}; // the centres of the boxes are exact
    return std::make_shared<SplatCloud>(cloud);
}

/// A scene on a device, without anything that renders it. The object is a row of squares along x.
class Committed {
public:
    Committed() {
        std::string error;
        _device = Device::create(RendererOptions(), &error);
        if (!_device) throw std::runtime_error(error);
        _scene = std::make_unique<GpuScene>(*_device, AssetReader());
        _scene->setTraversal(createTraversal(defaultTraversal(*_device), *_device));
        edit.setGeometry(quad, quadMesh());
        edit.setMaterial(grey, matte(glm::vec3(0.5f)));
        edit.setObject(object, desc());
        edit.setInstances(object, row({0, 10, 20, 30}));
        commit();
    }
    static ObjectDesc desc() { return {"/object", quad, {grey}, true, 0}; }
    static InstancesDesc row(const std::vector<float>& places) {
        InstancesDesc instances;
        for (float x : places)
            instances.transforms.push_back(translation(x, 0, 0));
        return instances;
    }
    Outcome commit() {
        const ChangedSet changed = _scene->apply(edit.take());
        const bool traced = _scene->tracedChanged();
        std::vector<WorldBox> regions = _scene->takeVacated();
        Outcome outcome;
        outcome.traced = traced;
        outcome.left = centres(regions);
        regions.clear();
        _scene->commit();
        _scene->addOccupied(changed, regions);
        outcome.occupied = centres(regions);
        for (const ChangedElement& element : changed.elements)
            if (element.element == decltype(element.element)(object))
                outcome.named.push_back({element.change, element.instance});
        return outcome;
    }

    /// Stands for the object of the row from now on.
    void showSplats(std::shared_ptr<const SplatCloud> cloud) {
        ObjectDesc shown = desc();
        shown.geometry = GeometryId::None;
        shown.splats = splats;
        edit.setSplats(splats, std::move(cloud));
        edit.setObject(object, shown);
    }
    std::vector<SplatPlacement> placements() const { return _scene->splatPlacements(); }
    /// Commits. Whether splats, or where they stand, count as changed.
    bool placesSplats() {
        const uint64_t before = _scene->splatRevision();
        commit();
        return _scene->splatRevision() != before;
    }

    SceneEdit edit;

private:
    static std::vector<float> centres(const std::vector<WorldBox>& boxes) {
        std::vector<float> result;
        for (const WorldBox& box : boxes)
            result.push_back(0.5f * (box.min.x + box.max.x));
        return result;
    }
    std::unique_ptr<Device> _device;
    std::unique_ptr<GpuScene> _scene;
};

using Places = std::vector<float>;

} // namespace

TEST(ChangedSet, NamesTheInstanceThatMovedAndWhere) {
    Committed scene;
    scene.edit.setInstances(object, Committed::row({0, 10, 25, 30}));
    const Outcome outcome = scene.commit();
    EXPECT_EQ(outcome.named, (Named{{Change::Transform, 2}}));
    EXPECT_EQ(outcome.left, Places{20});
    EXPECT_EQ(outcome.occupied, Places{25});
}

TEST(ChangedSet, NamesInstancesThatComeAndGo) {
    Committed scene;
    scene.edit.setInstances(object, Committed::row({0, 20, 30})); // 20 and 30 are numbered anew
    const Outcome gone = scene.commit();
    EXPECT_EQ(gone.named, (Named{{Change::Removed, 1}}));
    EXPECT_EQ(gone.left, Places{10});
    EXPECT_EQ(gone.occupied, Places{});
    scene.edit.setInstances(object, Committed::row({-10, 0, 20, 30, 40}));
    const Outcome come = scene.commit();
    EXPECT_EQ(come.named, (Named{{Change::Added, 0}, {Change::Added, 4}}));
    EXPECT_EQ(come.left, Places{});
    EXPECT_EQ(come.occupied, (Places{-10, 40}));
}

TEST(ChangedSet, ComparesWithTheCommittedInstancesOnly) {
    Committed scene;
    scene.edit.setInstances(object, Committed::row({10, 20, 30}));
    scene.edit.setInstances(object, Committed::row({10, 25, 30}));
    scene.edit.setInstances(object, Committed::row({0, 10, 25, 30}));
    const Outcome moved = scene.commit();
    EXPECT_EQ(moved.named, (Named{{Change::Transform, 2}}));
    EXPECT_EQ(moved.left, Places{20});
    scene.edit.setInstances(object, {});
    scene.edit.setInstances(object, Committed::row({0, 10, 25, 30}));
    EXPECT_EQ(scene.commit().named, Named());
}

TEST(ChangedSet, KnowsTheBoxesOfInstancesThatCannotBeRendered) {
    Committed scene;
    scene.edit.setInstances(object, Committed::row({0, NAN, 20, 30}));
    EXPECT_EQ(scene.commit().left, Places{10});
    scene.edit.setInstances(object, Committed::row({0, NAN, 20, 30}));
    EXPECT_EQ(scene.commit().named, Named());
    scene.edit.setInstances(object, Committed::row({0, NAN, 25, 30}));
    const Outcome moved = scene.commit();
    EXPECT_EQ(moved.named, (Named{{Change::Transform, 2}}));
    EXPECT_EQ(moved.left, Places{20});
    EXPECT_EQ(moved.occupied, Places{25});
}

TEST(ChangedSet, NamesTheInstanceOfAPrimvarEdit) {
    Committed scene;
    InstancesDesc instances = Committed::row({0, 10, 20, 30});
    Primvar color;
    color.name = "displayColor";
    color.values = {1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0};
    instances.primvars = {color};
    scene.edit.setInstances(object, instances);
    EXPECT_EQ(scene.commit().named, (Named{{Change::Primvar, All}}));
    instances.primvars[0].values[10] = 1; // green of instance 3
    scene.edit.setInstances(object, instances);
    const Outcome outcome = scene.commit();
    EXPECT_EQ(outcome.named, (Named{{Change::Primvar, 3}}));
    EXPECT_EQ(outcome.left, Places{30});
    EXPECT_EQ(outcome.occupied, Places{30});
}

TEST(ChangedSet, NamesAnObjectOnce) {
    Committed scene;
    ObjectDesc other = Committed::desc();
    other.materials.clear();
    other.primId = 7;
    scene.edit.setObject(object, other);
    scene.edit.setGeometry(quad, sphereMesh(5));
    scene.edit.setInstances(object, Committed::row({0, 10, 20, 31}));
    EXPECT_EQ(scene.commit().named,
              (Named{{Change::Geometry | Change::Material | Change::Primvar, All}, {Change::Transform, 3}}));
    // A new object under the old id: whatever else is said of it, it is new.
    scene.edit.removeObject(object);
    scene.edit.setObject(object, Committed::desc());
    scene.edit.setInstances(object, Committed::row({50, 60}));
    scene.edit.setGeometry(quad, quadMesh());
    const Outcome renewed = scene.commit();
    EXPECT_EQ(renewed.named, (Named{{Change::Removed | Change::Added, All}}));
    EXPECT_EQ(renewed.left, Places{15.5f}); // the box around all of them
    EXPECT_EQ(renewed.occupied, Places{55});
}

TEST(ChangedSet, OfAMaterialIsWhereItIsSeen) {
    Committed scene;
    scene.edit.removeMaterial(grey);
    const Outcome outcome = scene.commit();
    EXPECT_EQ(outcome.named, Named()); // the object itself is as before
    EXPECT_EQ(outcome.occupied, Places{15});
}

TEST(ChangedSet, TellsKindsInWords) {
    EXPECT_EQ(toString(Change::None), "");
    EXPECT_EQ(toString(Change::Transform | Change::Material), "transform, material");
    EXPECT_EQ(toString(Change::Setting), "setting");
    ChangedSet changed;
    EXPECT_EQ(changed.kinds(), Change::None);
    changed.elements = {{object, Change::Added}, {lamp, Change::Emission}};
    EXPECT_EQ(changed.kinds(), Change::Added | Change::Emission);
}

TEST(ChangedSet, OfSettingsAndFilmHoldsOneElement) {
    Stage stage;
    FilmDesc film;
    film.width = film.height = 8;
    const auto kinds = [](const ChangedSet& changed) { return toString(changed.kinds()); };
    EXPECT_EQ(kinds(stage.renderer->setFilm(film)), "setting");
    EXPECT_EQ(kinds(stage.renderer->setFilm(film)), "");
    Settings settings = stage.renderer->settings();
    settings.samples += 1;
    EXPECT_EQ(kinds(stage.renderer->setSettings(settings)), ""); // the picture goes on
    settings.maxDepth += 1;
    EXPECT_EQ(kinds(stage.renderer->setSettings(settings)), "setting");
    EXPECT_EQ(kinds(stage.renderer->setSettings(settings)), "");
}

TEST(ChangedSet, SplatsAreNamedLikeMeshesButTracedByNobody) {
    Committed scene;
    scene.showSplats(oneSplat(0));
    const Outcome shown = scene.commit();
    EXPECT_EQ(shown.named, (Named{{Change::Geometry, All}}));
    EXPECT_TRUE(shown.traced); // a mesh has gone
    ASSERT_EQ(scene.placements().size(), 4u);
    EXPECT_EQ(scene.placements()[2].objectToWorld[3].x, 20);

    scene.edit.setInstances(object, Committed::row({0, 10, 25, 30}));
    const Outcome moved = scene.commit();
    EXPECT_EQ(moved.named, (Named{{Change::Transform, 2}}));
    EXPECT_EQ(moved.left, Places{20});
    EXPECT_EQ(moved.occupied, Places{25});
    EXPECT_FALSE(moved.traced);
    EXPECT_EQ(scene.placements()[2].objectToWorld[3].x, 25);

    scene.edit.setSplats(splats, oneSplat(1));
    const Outcome changed = scene.commit();
    EXPECT_EQ(changed.named, (Named{{Change::Geometry, All}}));
    EXPECT_EQ(changed.left, Places{15});
    EXPECT_EQ(changed.occupied, Places{16});
    EXPECT_FALSE(changed.traced);
    scene.edit.setSplats(splats, oneSplat(1));
    EXPECT_EQ(scene.commit().named, Named());

    scene.edit.removeObject(object);
    const Outcome removed = scene.commit();
    EXPECT_FALSE(removed.traced);
    EXPECT_EQ(removed.left, Places{16});
    EXPECT_TRUE(scene.placements().empty());
}

TEST(ChangedSet, SplatsArePlacedAgainOnlyWhenTheyChanged) {
    constexpr ObjectId mesh{6};
    Committed scene;
    ObjectDesc desc = Committed::desc();
    desc.name = "/mesh";
    scene.edit.setObject(mesh, desc);
    scene.showSplats(oneSplat(0));
    EXPECT_TRUE(scene.placesSplats());

    scene.edit.setCamera(lookAt({0, 0, 5}, {0, 0, 0}));
    EXPECT_FALSE(scene.placesSplats());
    scene.edit.setInstances(mesh, Committed::row({3}));
    scene.edit.setMaterial(grey, matte(glm::vec3(0.2f)));
    EXPECT_FALSE(scene.placesSplats());
    scene.edit.setSplats(splats, oneSplat(0)); // an equal cloud
    EXPECT_FALSE(scene.placesSplats());
    scene.edit.removeObject(mesh);
    EXPECT_FALSE(scene.placesSplats());

    scene.edit.setInstances(object, Committed::row({0, 10}));
    EXPECT_TRUE(scene.placesSplats());
    scene.edit.setSplats(splats, oneSplat(1));
    EXPECT_TRUE(scene.placesSplats());
    desc.name = "/object";
    desc.geometry = GeometryId::None;
    desc.splats = splats;
    desc.visible = false;
    scene.edit.setObject(object, desc);
    EXPECT_TRUE(scene.placesSplats());
    EXPECT_TRUE(scene.placements().empty());
    scene.edit.setInstances(object, Committed::row({0, 5})); // while hidden
    EXPECT_FALSE(scene.placesSplats());
    desc.visible = true;
    scene.edit.setObject(object, desc);
    EXPECT_TRUE(scene.placesSplats());
    ASSERT_EQ(scene.placements().size(), 2u);
    EXPECT_EQ(scene.placements()[1].objectToWorld[3].x, 5);
    scene.edit.removeSplats(splats);
    EXPECT_TRUE(scene.placesSplats());
    scene.edit.setSplats(splats, oneSplat(1));
    EXPECT_TRUE(scene.placesSplats());
    scene.edit.removeObject(object);
    EXPECT_TRUE(scene.placesSplats());
}
