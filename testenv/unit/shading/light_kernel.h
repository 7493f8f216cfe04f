/// @file light_kernel.h
/// The host's side of light.comp.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "renderer/shading/lights.h"

namespace hipr::test {

struct LightOutcome {
    glm::vec3 wi;
    float pdf;
    glm::vec3 byLight;
    float atSample;
    glm::vec3 byMeeting;
    float distance;
    glm::vec3 combined;
    uint32_t chosen;
    float chance, chanceOf;
    glm::vec3 seen, weighted;
};

/// Lights on the device, with their textures. Textures come from `files` by path.
class LitScene {
public:
    explicit LitScene(const std::vector<LightDesc>& lights,
                      std::vector<std::pair<std::string, std::vector<unsigned char>>> files = {});

    /// `directions` may be empty: then `count` outcomes without them.
    std::vector<LightOutcome> run(const glm::vec3& point, const glm::vec3& normal, size_t count,
                                  std::vector<glm::vec3> directions = {}) const;
    const gpu::SceneRecord& record() const { return _scene; }

private:
    TextureStore _textures;
    CategoryTable _categories;
    LightTable _lights;
    gpu::SceneRecord _scene{};
    Buffer _sceneBuffer;
};

/// Means of the three estimates of irradiance.
struct Irradiance {
    glm::dvec3 byLight{0.0}, byMeeting{0.0}, combined{0.0};
};
Irradiance irradiance(const LitScene& scene, const glm::vec3& point, const glm::vec3& normal);

} // namespace hipr::test
