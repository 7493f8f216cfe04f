/// @file scenes.h
/// Clouds of splats for tests, the same on every machine.
#pragma once

#include "testenv/common/numbers.h"
#include "testenv/unit/higs/oracle.h"

namespace hipr::test {

struct CloudRecipe {
    size_t count = 300;
    uint32_t degree = 0;
    float smallest = 0.01f, largest = 0.3f;  ///< standard deviations
    float faintest = 0.05f, strongest = 1.f; ///< opacities
    glm::vec3 lo{-1.2f, -0.9f, -1.f}, hi{1.2f, 0.9f, 1.f};
    uint64_t seed = 1;
};
SplatCloud randomCloud(const CloudRecipe& recipe);

/// At (0, 0, 4), looking at the origin.
CameraDesc perspectiveCamera(double aspect);
CameraDesc orthographicCamera(double aspect);
/// One cloud before the perspective camera.
SplatScene sceneOf(SplatCloud cloud);

/// For the splat pass; cloud i has primId 10 + i and instanceId 100 + i.
std::vector<SplatInstance> instancesOf(const SplatScene& scene);
SplatView viewOf(const SplatScene& scene);
/// A pass that has just drawn nothing in a picture of another size, so that it has to draw everything. One
/// for each set of options, because kernels take long to compile.
SplatPass& clearedPass(const SplatPassOptions& options);
std::vector<gpu::SplatPixel> pixelsOf(const SplatPass& pass, const SplatScene& scene);

} // namespace hipr::test
