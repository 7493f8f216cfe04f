// Fields on the device against OpenVDB's own interpolation, and the phase function against its integral.
#include <cmath>
#include <random>

#include <glm/gtc/constants.hpp>

#include "hipr_volumes_test_kernels.h"
#include "renderer/scene/volume_table.h"
#include "renderer/volumes/vdb_reader.h"
#include "testenv/common/vdb_kit.h"
#include "testenv/unit/sampling/gpu.h"
#include "testenv/unit/sampling/statistics.h"

namespace hipr::test {
namespace {

struct Push {
    VkDeviceAddress volumes, points, result;
    uint32_t count;
    float anisotropy;
    uint32_t what;
};

const Kernel& kernel() {
    static const Kernel made(testDevice(), spirv::field_spv, spirv::field_spv_size, sizeof(Push),
                             "field test");
    return made;
}

/// What a volume of one field shows at points of the world.
std::vector<glm::vec4> valuesAt(const std::shared_ptr<const FieldGrid>& grid,
                                const std::vector<glm::vec3>& points) {
    VolumeTable table(testDevice());
    table.setField(FieldId(1), grid);
    VolumeDesc desc;
    desc.density = FieldId(1);
    table.setVolume(VolumeId(2), desc);
    VolumePlacement placement;
    placement.volume = VolumeId(2);
    table.commit({placement});
    gpu::SceneRecord scene{};
    table.describe(scene);
    const Buffer in = toDevice(points), out = emptyBuffer<glm::vec4>(points.size());
    dispatch(kernel(), Push{scene.volumes, in.address(), out.address(), uint32_t(points.size()), 0.f, 0},
             points.size());
    return toHost<glm::vec4>(out, points.size());
}

double wavy(glm::ivec3 p) {
    return std::abs(std::sin(0.3 * p.x) + std::cos(0.21 * p.y * p.z)) + 0.01 * std::abs(p.x);
}

/// Turned, moved, with different spacings, across many bricks and across 0.
TEST(Field, IsInterpolatedAsByOpenVdb) {
    const std::string path = ::testing::TempDir() + "interpolated.vdb";
    VdbGrid from;
    from.lo = {-13, -9, -20};
    from.hi = {18, 8, 15};
    from.value = wavy;
    from.spacing = {0.1, 0.07, 0.2};
    from.offset = {1, -2, 0.5};
    from.degrees = 35;
    writeVdb(path, {from});
    const FieldFile file = readVdbFile(path, {});
    ASSERT_TRUE(file.grid) << file.error;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(0, 1);
    std::vector<glm::dvec3> points;
    const double c = std::cos(glm::radians(from.degrees)), s = std::sin(glm::radians(from.degrees));
    for (int i = 0; i < 20000; ++i) { // within the box and somewhat beyond
        const glm::dvec3 at = glm::mix(glm::dvec3(from.lo) - 3.0, glm::dvec3(from.hi) + 3.0,
                                       glm::dvec3(u(random), u(random), u(random)));
        const glm::dvec3 p = at * from.spacing;
        points.push_back(glm::dvec3(c * p.x + s * p.z, p.y, -s * p.x + c * p.z) + from.offset);
    }
    const std::vector<float> expected = sampleVdb(path, points);
    const std::vector<glm::vec4> seen = valuesAt(file.grid, {points.begin(), points.end()});
    int within = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        EXPECT_NEAR(seen[i].x, expected[i], 2e-4) << i;
        within += expected[i] > 0.f;
    }
    EXPECT_GT(within, 8000);
}

TEST(Field, TriplesKeepTheirChannels) {
    const std::string path = ::testing::TempDir() + "triples.vdb";
    VdbGrid from;
    from.kind = VdbGrid::Kind::Vec3;
    writeVdb(path, {from});
    const FieldFile file = readVdbFile(path, {});
    ASSERT_TRUE(file.grid) << file.error;
    const glm::vec4 seen = valuesAt(file.grid, {glm::vec3(0.33f)})[0];
    EXPECT_NEAR(seen.x, 1.f, 1e-5);
    EXPECT_NEAR(seen.y, 2.f, 1e-5);
    EXPECT_NEAR(seen.z, 3.f, 1e-5);
}

/// Directions come as often as the phase function says, by rings of equal chance under an even phase
/// function.
TEST(Field, PhaseFunctionIsSampledAsItIsEvaluated) {
    constexpr size_t Count = 1 << 17;
    constexpr int Rings = 40, Steps = 200;
    for (const float g : {0.f, 0.5f, -0.8f, 0.95f}) {
        const Buffer out = emptyBuffer<glm::vec4>(Count);
        dispatch(kernel(), Push{0, 0, out.address(), uint32_t(Count), g, 1}, Count);
        std::vector<double> counts(Rings, 0.0), expected(Rings, 0.0);
        const double hg = double(g);
        for (const glm::vec4& sample : toHost<glm::vec4>(out, Count)) {
            ++counts[size_t(glm::clamp((sample.z + 1.f) / 2.f * Rings, 0.f, Rings - 1.f))];
            const double d = 1 + hg * hg - 2 * hg * double(sample.z);
            const double density = (1 - hg * hg) / (4 * glm::pi<double>() * d * std::sqrt(d));
            ASSERT_NEAR(sample.w, density, 2e-3 * density);
        }
        for (int i = 0; i < Rings * Steps; ++i) {
            const double cosine = -1 + 2 * (i + 0.5) / (Rings * Steps), d = 1 + hg * hg - 2 * hg * cosine;
            expected[size_t(i / Steps)] +=
                double(Count) * (1 - hg * hg) / (2 * d * std::sqrt(d)) * 2 / (Rings * Steps);
        }
        EXPECT_GT(chiSquareProbability(counts, expected), 1e-4) << g;
    }
}

} // namespace
} // namespace hipr::test
