#include "testenv/unit/higs/scenes.h"

#include <cmath>
#include <map>
#include <tuple>

#include <glm/gtc/matrix_transform.hpp>

#include "testenv/unit/sampling/gpu.h"

namespace hipr::test {

SplatCloud randomCloud(const CloudRecipe& r) {
    Numbers random(r.seed);
    SplatCloud cloud;
    cloud.name = "/cloud";
    cloud.shDegree = r.degree;
    const auto between = [&](float lo, float hi) {
        return glm::vec3(random(lo, hi), random(lo, hi), random(lo, hi));
    };
    for (size_t i = 0; i < r.count; ++i) {
        cloud.positions.push_back(r.lo + (r.hi - r.lo) * between(0.f, 1.f));
        glm::quat q;
        do
            q = glm::quat(random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1));
        while (glm::length(q) < 0.1f || glm::length(q) > 1.f);
        cloud.orientations.push_back(glm::normalize(q));
        cloud.scales.push_back(glm::exp(between(std::log(r.smallest), std::log(r.largest))));
        cloud.opacities.push_back(random(r.faintest, r.strongest));
        for (uint32_t k = 0; k < shCoefficients(r.degree); ++k)
            cloud.coefficients.push_back(k == 0 ? between(-1.5f, 1.5f) : between(-0.3f, 0.3f));
    }
    return cloud;
}

CameraDesc perspectiveCamera(double aspect) {
    CameraDesc camera;
    camera.worldToView = glm::lookAt(glm::dvec3(0, 0, 4), glm::dvec3(0), glm::dvec3(0, 1, 0));
    camera.projection = glm::perspective(glm::radians(40.0), aspect, 0.1, 100.0);
    return camera;
}

CameraDesc orthographicCamera(double aspect) {
    CameraDesc camera = perspectiveCamera(aspect);
    camera.projection = glm::ortho(-1.2 * aspect, 1.2 * aspect, -1.2, 1.2, 0.1, 100.0);
    return camera;
}

SplatScene sceneOf(SplatCloud cloud) {
    SplatScene scene;
    scene.clouds.push_back(std::move(cloud));
    scene.camera = perspectiveCamera(double(scene.width) / scene.height);
    return scene;
}

std::vector<SplatInstance> instancesOf(const SplatScene& scene) {
    std::vector<SplatInstance> instances;
    for (size_t i = 0; i < scene.clouds.size(); ++i)
        instances.push_back({std::make_shared<SplatStore>(testDevice(), scene.clouds[i]),
                             glm::mat4x3(scene.transform(i)), int(10 + i), int(100 + i), true});
    return instances;
}

SplatView viewOf(const SplatScene& scene) {
    SplatView view;
    view.camera = *cameraRecord(scene.camera);
    view.width = scene.width;
    view.height = scene.height;
    view.antialiased = scene.antialiased;
    return view;
}

SplatPass& clearedPass(const SplatPassOptions& options) {
    Device& device = testDevice(); // goes after the passes
    static std::map<std::tuple<SplatKernels, SplatMode, bool>, std::unique_ptr<SplatPass>> passes;
    auto& pass = passes[{options.kernels, options.mode, options.halfRecords}];
    if (!pass) pass = std::make_unique<SplatPass>(device, options);
    SplatScene nothing;
    nothing.width = nothing.height = 8;
    nothing.camera = perspectiveCamera(1);
    pass->setInstances({});
    pass->setView(viewOf(nothing));
    pass->setDepthLimit(0);
    pass->setProfiling(false);
    EXPECT_TRUE(pass->render());
    return *pass;
}

std::vector<gpu::SplatPixel> pixelsOf(const SplatPass& pass, const SplatScene& scene) {
    return toHost<gpu::SplatPixel>(pass.pixels(), size_t(scene.width) * scene.height);
}

} // namespace hipr::test
