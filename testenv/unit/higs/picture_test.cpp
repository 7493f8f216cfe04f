// Pictures of every mode against the oracle's.
#include <cmath>
#include <cstring>

#include <glm/gtc/matrix_transform.hpp>

#include "testenv/unit/higs/oracle.h"
#include "testenv/unit/higs/scenes.h"
#include "testenv/unit/sampling/gpu.h"

namespace hipr::test {
namespace {

struct Form {
    SplatMode mode;
    SplatKernels kernels;
    bool half;
};

std::string formName(const ::testing::TestParamInfo<Form>& info) {
    std::string name = splatModeName(info.param.mode);
    for (char& c : name)
        if (c == '-') c = '_';
    return name + (info.param.kernels == SplatKernels::Lanes ? "_lanes" : "_workgroups") +
           (info.param.half ? "_half" : "");
}

struct Error {
    double largest = 0;  ///< of colours and transmittance, where no splat just reaches 1/255
    double psnr = 0;     ///< of colours, against 1
    size_t wrongIds = 0; ///< pixels that tell another splat than a certain oracle
};

Error compare(const std::vector<gpu::SplatPixel>& pixels, const std::vector<OraclePixel>& oracle) {
    Error error;
    double squares = 0;
    for (size_t i = 0; i < pixels.size(); ++i) {
        const OraclePixel& o = oracle[i];
        const glm::dvec3 d = glm::dvec3(pixels[i].color) - o.color;
        squares += glm::dot(d, d);
        const double t = std::abs(double(pixels[i].transmittance) - o.transmittance);
        // Colours go to about 2, so that a splat more or less counts for twice its alpha.
        const double most = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z), t}) - 2 * o.flips;
        error.largest = std::max(error.largest, most);
        const bool same = pixels[i].splat == o.splat &&
                          pixels[i].primId == (o.cloud < 0 ? -1 : 10 + o.cloud) &&
                          pixels[i].instanceId == (o.cloud < 0 ? -1 : 100 + o.cloud) &&
                          std::abs(pixels[i].depth - o.depth) < 1e-4;
        if (o.certain && !same) ++error.wrongIds;
    }
    error.psnr = -10 * std::log10(std::max(squares / (3.0 * double(pixels.size())), 1e-20));
    return error;
}

class SplatPictures : public ::testing::TestWithParam<Form> {
protected:
    SplatPictures() : pass(clearedPass({GetParam().kernels, GetParam().mode, GetParam().half})) {}

    std::vector<gpu::SplatPixel> draw(const SplatScene& scene) {
        pass.setView(viewOf(scene));
        pass.setInstances(instancesOf(scene));
        const Buffer limits = toDevice(scene.limits);
        pass.setDepthLimit(scene.limits.empty() ? 0 : limits.address());
        EXPECT_TRUE(pass.render());
        const auto pixels = pixelsOf(pass, scene);
        pass.setDepthLimit(0);
        return pixels;
    }

    /// Holds a picture against the oracle's.
    Error hold(const SplatScene& scene) {
        const bool boxes = GetParam().mode == SplatMode::Flat16Aabb;
        const Error error = compare(draw(scene), oraclePicture(scene, binSizeOf(GetParam().mode), boxes));
        EXPECT_GE(error.psnr, GetParam().half ? 55 : 60);
        EXPECT_LE(error.largest, GetParam().half ? 1e-2 : 2e-3);
        EXPECT_LE(error.wrongIds, size_t(scene.width) * scene.height / (GetParam().half ? 100 : 400));
        std::printf("%s: PSNR %.1f dB, largest error %.2g, other splat in %zu pixels\n",
                    ::testing::UnitTest::GetInstance()->current_test_info()->name(), error.psnr,
                    error.largest, error.wrongIds);
        return error;
    }

    static glm::uvec2 binSizeOf(SplatMode mode) {
        return mode == SplatMode::Flat8Exact                                     ? glm::uvec2(8)
               : mode == SplatMode::Flat16Aabb || mode == SplatMode::Flat16Exact ? glm::uvec2(16)
                                                                                 : glm::uvec2(64, 32);
    }

    SplatPass& pass;
};

/// Seen under 110 degrees from within, most of it far from the middle; one cloud is turned and scaled.
SplatScene wideScene(SplatProjection projection) {
    CloudRecipe recipe;
    recipe.lo = {-3.f, -2.f, 1.f};
    recipe.hi = {3.f, 2.f, 3.5f};
    recipe.count = 60;
    recipe.smallest = 0.05f;
    recipe.strongest = 0.7f;
    SplatScene scene = sceneOf(randomCloud(recipe));
    recipe.seed = 5;
    scene.clouds.push_back(randomCloud(recipe));
    scene.transforms = {glm::dmat4(1), glm::scale(glm::rotate(glm::dmat4(1), 0.2, glm::dvec3(1, 2, 3)),
                                                  glm::dvec3(1.2, 0.6, 0.9))};
    for (SplatCloud& cloud : scene.clouds)
        cloud.projection = projection;
    scene.camera.projection =
        glm::perspective(glm::radians(110.0), double(scene.width) / scene.height, 0.1, 50.0);
    return scene;
}

std::vector<Form> allForms() {
    std::vector<Form> forms;
    for (const SplatMode mode : {SplatMode::Flat16Aabb, SplatMode::Flat16Exact, SplatMode::Flat8Exact,
                                 SplatMode::Higs8, SplatMode::Higs8Carry})
        for (const SplatKernels kernels : {SplatKernels::Lanes, SplatKernels::Workgroups})
            forms.push_back({mode, kernels, false});
    forms.push_back({SplatMode::Higs8, SplatKernels::Workgroups, true});
    forms.push_back({SplatMode::Higs8Carry, SplatKernels::Lanes, true});
    forms.push_back({SplatMode::Flat8Exact, SplatKernels::Lanes, true});
    return forms;
}

INSTANTIATE_TEST_SUITE_P(, SplatPictures, ::testing::ValuesIn(allForms()), formName);

TEST_P(SplatPictures, HarmonicsOfDegrees) {
    for (uint32_t degree = 0; degree <= 3; ++degree) {
        CloudRecipe recipe;
        recipe.degree = degree;
        recipe.seed = degree + 1;
        hold(sceneOf(randomCloud(recipe)));
    }
}

TEST_P(SplatPictures, TurnedAndScaledInstancesSortedAsOne) {
    CloudRecipe recipe;
    recipe.degree = 3;
    recipe.count = 200;
    SplatScene scene = sceneOf(randomCloud(recipe));
    recipe.seed = 7;
    recipe.degree = 1;
    scene.clouds.push_back(randomCloud(recipe));
    scene.transforms.push_back(
        glm::scale(glm::rotate(glm::dmat4(1), 1.1, glm::dvec3(1, 2, 3)), glm::dvec3(0.7, 1.2, 0.9)));
    scene.transforms.push_back(
        glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(0.3, 0, -0.2)), -2.0, glm::dvec3(0, 1, 0.2)));
    hold(scene);
}

TEST_P(SplatPictures, NearPlaneAndBehindTheCamera) {
    CloudRecipe recipe;
    recipe.lo = {-1, -1, -2};
    recipe.hi = {1, 1, 8};
    recipe.count = 200;
    recipe.largest = 0.1f;
    recipe.strongest = 0.6f;
    hold(sceneOf(randomCloud(recipe)));
}

TEST_P(SplatPictures, HugeAndTiny) {
    CloudRecipe recipe;
    recipe.smallest = 1e-5f;
    recipe.largest = 5.f;
    recipe.strongest = 0.3f;
    hold(sceneOf(randomCloud(recipe)));
}

TEST_P(SplatPictures, Degenerate) {
    SplatScene scene = sceneOf(randomCloud({}));
    for (size_t i = 0; i < scene.clouds[0].size(); ++i)
        scene.clouds[0].scales[i][int(i % 3)] = 0.f;
    for (size_t i = 0; i < scene.clouds[0].size(); i += 5)
        scene.clouds[0].scales[i] = glm::vec3(0.f);
    hold(scene);
}

TEST_P(SplatPictures, EqualDepthsInOrderOfIndex) {
    SplatScene scene = sceneOf(randomCloud({}));
    for (glm::vec3& p : scene.clouds[0].positions)
        p.z = 0.25f;
    scene.clouds.push_back(scene.clouds[0]);
    hold(scene);
}

TEST_P(SplatPictures, FaintSplatsDoNotCount) {
    SplatScene scene = sceneOf(randomCloud({}));
    for (size_t i = 0; i < scene.clouds[0].size(); ++i)
        scene.clouds[0].opacities[i] = i % 2 ? 0.9f / 255 : 1.2f / 255;
    hold(scene);
}

TEST_P(SplatPictures, BrokenSplatsAreToldAndLeftOut) {
    const float nan = std::nanf("");
    SplatScene scene = sceneOf(randomCloud({}));
    const std::vector<gpu::SplatPixel> without = draw(scene);
    SplatCloud& cloud = scene.clouds[0];
    const SplatCloud good = cloud;
    for (int kind = 0; kind < 6; ++kind) {
        cloud.positions.push_back(kind == 0 ? glm::vec3(nan) : glm::vec3(0));
        cloud.orientations.push_back(kind == 1 ? glm::quat(0, 0, 0, 0) : glm::quat(1, 0, 0, 0));
        cloud.scales.push_back(kind == 2 ? glm::vec3(-1) : kind == 3 ? glm::vec3(INFINITY) : glm::vec3(0.5f));
        cloud.opacities.push_back(kind == 4 ? nan : 1.f);
        cloud.coefficients.push_back(kind == 5 ? glm::vec3(1e6f) : glm::vec3(0));
    }
    messageLog().entries.clear();
    const std::vector<gpu::SplatPixel> pixels = draw(scene);
    EXPECT_EQ(messageLog().count("/cloud", "6 of 306 splats are broken"), 1);
    EXPECT_EQ(std::memcmp(pixels.data(), without.data(), pixels.size() * sizeof(pixels[0])), 0);
}

TEST_P(SplatPictures, Orthographic) {
    CloudRecipe recipe;
    recipe.degree = 2;
    SplatScene scene = sceneOf(randomCloud(recipe));
    scene.camera = orthographicCamera(double(scene.width) / scene.height);
    hold(scene);
}

TEST_P(SplatPictures, OffCenterProjection) {
    SplatScene scene = sceneOf(randomCloud({}));
    scene.camera.projection = glm::frustum(-0.01, 0.05, -0.03, 0.02, 0.1, 100.0);
    hold(scene);
}

TEST_P(SplatPictures, Tangential) {
    SplatScene scene = wideScene(SplatProjection::Tangential);
    hold(scene);
    scene.camera = orthographicCamera(double(scene.width) / scene.height);
    hold(scene);
}

TEST_P(SplatPictures, Antialiased) {
    CloudRecipe recipe;
    recipe.smallest = 1e-3f;
    recipe.largest = 0.05f;
    SplatScene scene = sceneOf(randomCloud(recipe));
    scene.antialiased = true;
    hold(scene);
}

TEST_P(SplatPictures, SortedByDistanceAndByRay) {
    for (const SplatSorting sorting : {SplatSorting::CameraDistance, SplatSorting::RayHitDistance}) {
        SplatScene scene = sceneOf(randomCloud({}));
        scene.clouds[0].sorting = sorting;
        hold(scene);
        scene.camera = orthographicCamera(double(scene.width) / scene.height);
        hold(scene);
    }
}

// The definition is a Gaussian on each splat's own tangent plane, which is none in the picture.
TEST_P(SplatPictures, TangentialIsNearerToTangentPlanesThanPerspectiveIs) {
    SplatScene truth = wideScene(SplatProjection::Tangential);
    truth.exactTangents = true;
    const std::vector<OraclePixel> oracle = oraclePicture(truth, binSizeOf(GetParam().mode));
    const auto error = [&](SplatProjection projection) {
        const SplatScene scene = wideScene(projection);
        const auto pixels = draw(scene);
        double sum = 0;
        for (size_t i = 0; i < pixels.size(); ++i) {
            const glm::dvec3 d = glm::abs(glm::dvec3(pixels[i].color) - oracle[i].color);
            sum += (d.x + d.y + d.z) / (3.0 * double(pixels.size()));
        }
        return sum;
    };
    const double tangential = error(SplatProjection::Tangential),
                 perspective = error(SplatProjection::Perspective);
    EXPECT_LT(tangential, 0.8 * perspective);
    std::printf("mean error %.4f tangential, %.4f perspective\n", tangential, perspective);
}

TEST_P(SplatPictures, OpaqueThingsHideWhatIsBehind) {
    SplatScene scene = sceneOf(randomCloud({}));
    for (uint32_t i = 0; i < scene.width * scene.height; ++i)
        scene.limits.push_back(i % 3 == 0 ? 0.f : 3.f + float(i % scene.width) / float(scene.width) * 2.f);
    hold(scene);
}

TEST_P(SplatPictures, ManyInOnePlace) {
    CloudRecipe recipe; // lists of several batches
    recipe.count = 9000;
    recipe.lo = {-0.2f, -0.2f, -1.f};
    recipe.hi = {0.2f, 0.2f, 1.f};
    recipe.faintest = 0.004f;
    recipe.strongest = 0.01f;
    SplatScene scene = sceneOf(randomCloud(recipe));
    scene.width = 40;
    scene.height = 24;
    scene.camera = perspectiveCamera(40.0 / 24);
    hold(scene);
}

TEST_P(SplatPictures, SameBitsAgain) {
    CloudRecipe recipe;
    recipe.count = 20000;
    recipe.largest = 0.05f;
    SplatScene scene = sceneOf(randomCloud(recipe));
    const std::vector<gpu::SplatPixel> first = draw(scene);
    SplatPass other(testDevice(), {GetParam().kernels, GetParam().mode, GetParam().half});
    other.setView(viewOf(scene));
    other.setInstances(instancesOf(scene));
    for (int i = 0; i < 3; ++i) {
        other.setDepthLimit(0);
        ASSERT_TRUE(other.render());
        const std::vector<gpu::SplatPixel> again = pixelsOf(other, scene);
        EXPECT_EQ(std::memcmp(first.data(), again.data(), first.size() * sizeof(first[0])), 0);
    }
}

TEST_P(SplatPictures, Nothing) {
    SplatScene scene = sceneOf({});
    for (const gpu::SplatPixel& pixel : draw(scene)) {
        ASSERT_EQ(pixel.color, glm::vec3(0));
        ASSERT_EQ(pixel.transmittance, 1.f);
        ASSERT_EQ(pixel.splat, gpu::NO_SPLAT);
    }
}

} // namespace
} // namespace hipr::test
