#include "testenv/unit/shading/light_kernel.h"

#include "hipr_shading_test_kernels.h"
#include "testenv/unit/sampling/gpu.h"

namespace hipr::test {

namespace {

struct Push {
    VkDeviceAddress scene, directions, outcomes;
    glm::vec3 point, normal;
    uint32_t count, pad = 0;
};

const Kernel& kernel() {
    static const Kernel made(testDevice(), spirv::light_spv, spirv::light_spv_size, sizeof(Push),
                             "light test");
    return made;
}

} // namespace

LitScene::LitScene(const std::vector<LightDesc>& lights,
                   std::vector<std::pair<std::string, std::vector<unsigned char>>> files)
    : _textures(
          testDevice(),
          [files](const std::string& path) {
              for (const auto& [name, bytes] : files)
                  if (name == path) return bytes;
              return std::vector<unsigned char>();
          },
          ColorManager::create(testDevice().messages())),
      _categories(testDevice()), _lights(testDevice(), _textures, _categories) {
    uint32_t id = 0;
    for (const LightDesc& light : lights)
        _lights.set(LightId(++id), light);
    _textures.commit();
    _lights.commit(glm::vec3(-1.f), glm::vec3(1.f));
    _textures.describe(_scene);
    _lights.describe(_scene);
    _categories.commit();
    _categories.describe(_scene);
    _sceneBuffer = testDevice().createFrom(&_scene, 1, "test");
}

std::vector<LightOutcome> LitScene::run(const glm::vec3& point, const glm::vec3& normal, size_t count,
                                        std::vector<glm::vec3> directions) const {
    directions.resize(count, glm::vec3(0.f, 0.f, 1.f));
    const Buffer directionBuffer = toDevice(directions), outcomes = emptyBuffer<LightOutcome>(count);
    dispatch(kernel(),
             Push{_sceneBuffer.address(), directionBuffer.address(), outcomes.address(), point, normal,
                  uint32_t(count)},
             count);
    return toHost<LightOutcome>(outcomes, count);
}

Irradiance irradiance(const LitScene& scene, const glm::vec3& point, const glm::vec3& normal) {
    constexpr size_t Count = 1 << 16;
    Irradiance sum;
    for (const LightOutcome& o : scene.run(point, normal, Count)) {
        sum.byLight += glm::dvec3(o.byLight) / double(Count);
        sum.byMeeting += glm::dvec3(o.byMeeting) / double(Count);
        sum.combined += glm::dvec3(o.combined) / double(Count);
    }
    return sum;
}

} // namespace hipr::test
