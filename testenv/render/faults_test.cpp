// The device and the memory give out at every point of a small render and an edit, one after the other: the
// renderer says so once, ends its work, and the next renderer draws what it always did.
#include <chrono>
#include <iostream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/volumes/field_builder.h"
#include "testenv/common/allocation_faults.h"
#include "testenv/common/vulkan_faults.h"
#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

struct Outcome {
    std::string error; ///< of creating the renderer
    std::vector<Message> complaints;
    bool created = false, converged = false, failed = false, hung = false;
    std::vector<glm::vec4> picture;
};

/// A host with a small scene that an edit changes everywhere: geometry, instances, material, light and film.
class Performance {
public:
    explicit Performance(const Settings& settings, const char* validation = "0") {
        setenv("HIPR_VALIDATION", validation, 1);
        _options.messages = [this](Severity severity, const std::string& subject, const std::string& text) {
            const NotAllocating host;
            std::lock_guard<std::mutex> lock(_mutex);
            if (severity != Severity::Info) _outcome.complaints.push_back({severity, subject, text});
        };
        call([&] { _renderer = createRenderer(_options, {}, &_outcome.error); });
        _outcome.created = bool(_renderer);
        if (!_renderer) return;
        call([&] { _renderer->setSettings(settings); });
        fill(quadMesh(), 12);
        render(20, 10);
        fill(sphereMesh(6), 14);
        render(24, 16);
        read(24, 16);
        const Progress progress = _renderer->progress();
        _outcome.converged = progress.converged;
        _outcome.failed = progress.failed;
        call([&] { _renderer.reset(); });
    }
    const Outcome& outcome() const { return _outcome; }

private:
    /// Only the renderer's own allocations fail, not those of this host.
    template <class F> void call(F&& f) {
        const Allocating renderer;
        f();
    }

    void fill(std::shared_ptr<const TriangleMesh> mesh, int copies) {
        MaterialDesc textured = matte(glm::vec3(0.5f)), veil = matte(glm::vec3(0.2f));
        textured.diffuseColor.source = MaterialInput::Source::Texture;
        textured.diffuseColor.texture.path = HIPR_SOURCE_DIR "/testenv/scenes/textures/ramp.png";
        veil.opacity = constantValue(0.5f);
        veil.opacityMode = OpacityMode::Presence;
        InstancesDesc places;
        for (int i = 0; i < copies; ++i)
            places.transforms.push_back(
                translation(0.3f * float(i) - 2.f, 0.2f * float(i % 3), -0.4f * float(i)));
        Primvar tint;
        tint.name = "tint";
        tint.components = 1;
        tint.values.assign(size_t(copies), 0.5f);
        places.primvars.push_back(tint);
        LightDesc lamp;
        lamp.kind = LightKind::Disk;
        lamp.intensity = float(copies);
        lamp.transform = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 4));

        _edit.setGeometry(GeometryId(1), std::move(mesh));
        _edit.setMaterial(MaterialId(2), textured);
        _edit.setMaterial(MaterialId(3), veil);
        _edit.setObject(ObjectId(4), {"/many", GeometryId(1), {MaterialId(2)}, true, 4});
        _edit.setObject(ObjectId(5), {"/veil", GeometryId(1), {MaterialId(3)}, true, 5});
        _edit.setInstances(ObjectId(4), std::move(places));
        _edit.setInstances(ObjectId(5), {{translation(0, 0, 1)}, {}, {}});
        _edit.setLight(LightId(6), lamp);
        _edit.setCamera(lookAt({0, 1, 6}, {0, 0, 0}));
    }

    void render(uint32_t width, uint32_t height) {
        const FilmDesc film{
            width, height, {{AovKind::Color, {}}, {AovKind::Depth, {}}, {AovKind::PrimId, {}}}};
        call([&] { _renderer->setFilm(film); });
        call([&] { _renderer->commit(_edit); });
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
        for (bool more = true; more && !_outcome.hung;) {
            call([&] { more = _renderer->renderBatch(); });
            _outcome.hung = std::chrono::steady_clock::now() > deadline;
        }
    }

    void read(uint32_t width, uint32_t height) {
        std::vector<glm::vec4> pixels(size_t(width) * height);
        bool found = false;
        call([&] { found = _renderer->readAov({AovKind::Color, {}}, pixels.data(), pixels.size() * 4); });
        if (found) _outcome.picture = std::move(pixels);
    }

    RendererOptions _options;
    std::mutex _mutex;
    Outcome _outcome;
    std::unique_ptr<RendererImpl> _renderer;
    SceneEdit _edit;
};

Settings settingsFor(const std::string& traversal) {
    Settings settings;
    settings.samples = 2;
    settings.maxDepth = 3;
    settings.traversal = traversal;
    return settings;
}

const std::vector<glm::vec4>& reference() {
    static const std::vector<glm::vec4> picture = Performance(settingsFor("auto")).outcome().picture;
    return picture;
}

/// Whatever failed, a host sees one of three things: no renderer and why; a renderer that tells what gave out
/// and wants no more calls; or the right picture.
/// `lasting`: the fault goes on, so that several things may fail, each of which is told once.
void expectGoodEnd(const Outcome& outcome, bool lasting = false) {
    EXPECT_FALSE(outcome.hung);
    if (!outcome.created) {
        EXPECT_NE(outcome.error, "");
        EXPECT_EQ(outcome.complaints.size(), 0u);
        return;
    }
    EXPECT_TRUE(outcome.converged);
    std::set<std::string> texts;
    for (const Message& message : outcome.complaints) {
        SCOPED_TRACE(message.subject + ": " + message.text);
        EXPECT_TRUE(texts.insert(message.subject + message.text).second) << "told twice";
        EXPECT_TRUE(lasting || texts.size() == 1) << "one of several messages";
        EXPECT_THAT(message.text, testing::AnyOf(testing::HasSubstr("memory"), testing::HasSubstr("lost")));
        EXPECT_NE(message.subject, "Vulkan validation");
    }
    if (outcome.complaints.empty()) {
        EXPECT_FALSE(outcome.failed);
        EXPECT_TRUE(outcome.picture == reference());
    }
    if (outcome.failed) {
        EXPECT_GE(outcome.complaints.size(), 1u);
        EXPECT_TRUE(outcome.picture.empty());
    }
}

/// Every how many-th point is tried; HIPR_TEST_FAULTS=1 tries all.
uint64_t strideOf(uint64_t points, uint64_t most) {
    const char* all = std::getenv("HIPR_TEST_FAULTS");
    return all && *all == '1' ? 1 : std::max<uint64_t>(1, (points + most - 1) / most);
}

struct FaultCase {
    Fault fault;
    const char* traversal;
    const char* memoryOfItsOwn; ///< HIPR_NO_HOST_MEMORY
};

class VulkanFaults : public testing::TestWithParam<FaultCase> {};

std::string caseName(const testing::TestParamInfo<FaultCase>& info) {
    const char* faults[] = {"OutOfMemory", "NoMemory", "DeviceLost"};
    return std::string(faults[int(info.param.fault)]) + "_" + info.param.traversal +
           (*info.param.memoryOfItsOwn == '1' ? "_staged" : "");
}

TEST_P(VulkanFaults, EveryCall) {
    const Settings settings = settingsFor(GetParam().traversal);
    ASSERT_FALSE(reference().empty());
    setenv("HIPR_NO_HOST_MEMORY", GetParam().memoryOfItsOwn, 1);
    uint64_t points = 0;
    {
        const VulkanFault nothing(GetParam().fault, 0);
        const Outcome outcome = Performance(settings, "1").outcome();
        points = nothing.calls();
        expectGoodEnd(outcome);
        if (!outcome.complaints.empty()) GTEST_SKIP() << outcome.complaints[0].text; // no such traversal here
    }
    ASSERT_GT(points, 10u);
    const uint64_t stride = strideOf(points, 10);
    uint64_t stops = 0;
    for (uint64_t n = 1; n <= points; n += stride) {
        const VulkanFault fault(GetParam().fault, n);
        const Outcome outcome = Performance(settings, "1").outcome();
        SCOPED_TRACE("call " + std::to_string(n) + ", " + (fault.failed() ? fault.failed() : "none failed"));
        expectGoodEnd(outcome, GetParam().fault == Fault::NoMemory);
        stops += outcome.failed || !outcome.created;
        if (HasFailure()) break;
    }
    std::cout << points << " calls, every " << stride << ". tried, " << stops << " ended the renderer\n";
    EXPECT_GT(stops, 0u);
    setenv("HIPR_NO_HOST_MEMORY", "0", 1);
    EXPECT_TRUE(Performance(settings).outcome().picture == reference());
}

INSTANTIATE_TEST_SUITE_P(
    , VulkanFaults,
    testing::Values(FaultCase{Fault::OutOfMemory, "embree", "0"}, FaultCase{Fault::OutOfMemory, "bvh", "1"},
                    FaultCase{Fault::OutOfMemory, "rayquery", "0"}, FaultCase{Fault::NoMemory, "host", "0"},
                    FaultCase{Fault::DeviceLost, "embree", "0"}, FaultCase{Fault::DeviceLost, "bvh", "1"},
                    FaultCase{Fault::DeviceLost, "rayquery", "0"}),
    caseName);

TEST(AllocationFaults, EveryPlace) {
    ASSERT_FALSE(reference().empty());
    std::vector<AllocationSite> sites;
    {
        const AllocationFault nothing;
        expectGoodEnd(Performance(settingsFor("auto")).outcome());
        sites = nothing.sites();
    }
    ASSERT_GT(sites.size(), 50u);
    const uint64_t stride = strideOf(sites.size(), 30);
    uint64_t failures = 0;
    for (size_t i = 0; i < sites.size(); i += stride) {
        const uint64_t n = i % 2 ? (sites[i].count + 1) / 2 : 1;
        const AllocationFault fault(sites[i].address, n);
        const Outcome outcome = Performance(settingsFor("auto")).outcome();
        std::ostringstream place;
        place << "allocation " << n << " at 0x" << std::hex << sites[i].address;
        SCOPED_TRACE(place.str());
        expectGoodEnd(outcome);
        failures += fault.failed();
        if (HasFailure()) break;
    }
    std::cout << sites.size() << " places, every " << stride << ". tried, " << failures
              << " allocations failed\n";
    EXPECT_GT(failures, 0u);
    EXPECT_TRUE(Performance(settingsFor("auto")).outcome().picture == reference());
}

/// A picture for which there is no memory does not end the renderer: the host may ask for a smaller one.
TEST(Films, OneThatDoesNotFitIsRefused) {
    Settings settings = settingsFor("auto");
    Stage stage(settings);
    stage.add(quadMesh(), matte(glm::vec3(0.5f)), {scaling(9, 9, 1)});
    stage.add(LightDesc());
    stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}));
    {
        const VulkanFault full(Fault::NoMemory, 1);
        stage.film(640, 480, {{AovKind::Color, {}}, {AovKind::Depth, {}}});
    }
    stage.render();
    EXPECT_TRUE(stage.renderer->progress().converged);
    EXPECT_FALSE(stage.renderer->progress().failed);
    ASSERT_EQ(stage.messages().size(), 1u) << stage.messages().back().text;
    EXPECT_THAT(stage.messages()[0].text, testing::HasSubstr("640 x 480 is too large (out of "));
    float pixel[4];
    EXPECT_FALSE(stage.renderer->readAov({AovKind::Color, {}}, pixel, 4));
    stage.film(8, 8);
    stage.render();
    EXPECT_EQ(stage.renderer->progress().samplesDone, 2u);
    EXPECT_GT(mean(stage.color()).w, 0.99f);
    EXPECT_EQ(stage.messages().size(), 1u);
}

/// Dense fog around the camera.
void addFog(Stage& stage) {
    FieldBuilder fog("fog", 1, glm::dmat4x3(1.0));
    for (int i = 0; i < 8; ++i) {
        std::vector<float> values(FieldGrid::BrickPoints, 100.f);
        fog.add({i % 2 - 1, i / 2 % 2 - 1, i / 4 - 1}, values);
    }
    VolumeDesc desc;
    desc.name = "/fog";
    desc.density = FieldId(900);
    stage.edit.setField(FieldId(900), fog.finish());
    stage.edit.setVolume(VolumeId(901), desc);
    ObjectDesc object;
    object.name = "/fog";
    object.volume = VolumeId(901);
    stage.edit.setObject(ObjectId(902), object);
    stage.edit.setInstances(ObjectId(902), {{glm::mat4x3(1.f)}, {}, {}, {}});
}

/// A field for which there is no memory is told with its volume, and the rest renders.
TEST(Volumes, AFieldThatDoesNotFitIsLeftOut) {
    Stage stage(settingsFor("auto"));
    stage.add(quadMesh(), matte(glm::vec3(0.5f)), {scaling(9, 9, 1)});
    stage.add(LightDesc());
    stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}));
    stage.film(8, 8);
    stage.render();
    const ColorPicture clear = stage.color();
    addFog(stage);
    {
        const VulkanFault full(Fault::OutOfMemory, 1); // the buffer of the field is the first
        stage.renderer->commit(stage.edit);
    }
    stage.render();
    EXPECT_FALSE(stage.renderer->progress().failed);
    ASSERT_EQ(stage.messages().size(), 1u);
    EXPECT_EQ(stage.messages()[0].subject, "/fog");
    EXPECT_THAT(stage.messages()[0].text, testing::HasSubstr("it has no fog"));
    EXPECT_TRUE(sameBits(stage.color(), clear));
    addFog(stage); // with as much memory as it needs
    stage.render();
    EXPECT_FALSE(sameBits(stage.color(), clear));
    EXPECT_EQ(stage.messages().size(), 1u);
}

} // namespace
