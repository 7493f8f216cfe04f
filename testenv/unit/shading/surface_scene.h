/// @file surface_scene.h
/// A quad of two triangles with a material, as kernels see it; the host's side of surface.comp.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/shading/materials.h"
#include "testenv/unit/shading/picture.h"

namespace hipr::test {

struct SurfaceOutcome {
    glm::vec3 position, ng, ns, tangent, emission, albedo, diffuse, f0;
    float opacity, presence, alpha, coat, coatAlpha, glass, eta;
    uint32_t frontFacing;
};

struct TestPrimvar {
    std::string name;
    uint32_t interpolation; ///< gpu::INTERPOLATION_*
    uint32_t components;
    std::vector<float> values;
};

/// The quad [0, 1]^2 in the xy plane facing +Z, triangles (0 1 2), (0 2 3), with primvar st = (x, y).
class SurfaceScene {
public:
    Files files;
    std::vector<TestPrimvar> primvars{{"st", gpu::INTERPOLATION_VERTEX, 2, {0, 0, 1, 0, 1, 1, 0, 1}}};
    std::vector<TestPrimvar> instancePrimvars;
    std::vector<glm::vec3> normals; ///< per vertex; empty: geometric
    std::vector<uint16_t> slots;    ///< per triangle; empty: all slot 0
    std::vector<MaterialDesc> materials;
    glm::mat4 objectToWorld{1.f};
    float footprint = 0.f, levelShare = 0.f; ///< RayFootprint of all looks
    bool sampled = false;

    /// Looks at points (x, y) of the quad from above (below for `fromBack`).
    std::vector<SurfaceOutcome> look(const std::vector<glm::vec2>& points, bool fromBack = false) const;
    SurfaceOutcome look(const glm::vec2& point, bool fromBack = false) const {
        return look(std::vector{point}, fromBack)[0];
    }
    /// Whether material `i` lets rays through.
    bool nonOpaque(size_t i) const;
};

/// A scene of one material.
SurfaceScene sceneWith(const MaterialDesc& material, Files files = {});
/// A diffuse material (specular workflow, no specular): Surface::diffuse is the colour read.
MaterialDesc matte(const MaterialInput& color);

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance,
                const ::testing::Message& where = {});

/// A texture input.
MaterialInput textureInput(const std::string& path, Channel channel = Channel::Rgb,
                           const std::string& space = "raw");
MaterialInput constantInput(float value);
MaterialInput constantInput(const glm::vec3& value);

} // namespace hipr::test
