#include "testenv/unit/shading/bsdf_kernel.h"

#include <cmath>
#include <random>

#include "hipr_shading_test_kernels.h"
#include "renderer/shading/albedo.h"
#include "testenv/unit/sampling/gpu.h"

namespace hipr::test {

namespace {

struct Push {
    VkDeviceAddress parameters, wo, wi, u, outcomes;
    uint32_t count, pad = 0;
};

const Kernel& kernel() {
    static const Kernel made(testDevice(), spirv::bsdf_spv, spirv::bsdf_spv_size, sizeof(Push), "bsdf test");
    return made;
}

VkDeviceAddress albedoTable() {
    static const Buffer table = toDevice(specularAlbedoTable());
    return table.address();
}

} // namespace

std::vector<Outcome> runBsdf(const SurfaceParameters& parameters, const std::vector<glm::vec3>& wo,
                             const std::vector<glm::vec3>& wi, const std::vector<glm::vec4>& u) {
    SurfaceParameters p = parameters;
    p.albedoTable = albedoTable();
    const Buffer parameterBuffer = testDevice().createFrom(&p, 1, "test");
    const Buffer woBuffer = toDevice(wo), wiBuffer = toDevice(wi), uBuffer = toDevice(u);
    const Buffer outcomes = emptyBuffer<Outcome>(wi.size());
    const Push push{parameterBuffer.address(), woBuffer.address(), wiBuffer.address(),
                    uBuffer.address(),         outcomes.address(), uint32_t(wi.size())};
    dispatch(kernel(), push, wi.size());
    return toHost<Outcome>(outcomes, wi.size());
}

std::vector<Outcome> runBsdf(const SurfaceParameters& parameters, const glm::vec3& wo,
                             const std::vector<glm::vec3>& wi) {
    static std::mt19937 random(11);
    std::vector<glm::vec4> u(wi.size());
    for (glm::vec4& v : u)
        for (int c = 0; c < 4; ++c)
            v[c] = float(random() >> 8) / 16777216.f;
    return runBsdf(parameters, std::vector<glm::vec3>(wi.size(), wo), wi, u);
}

std::vector<NamedSurface> opaqueSurfaces() {
    std::vector<NamedSurface> all;
    const auto add = [&](const char* name, auto change) {
        SurfaceParameters p;
        p.diffuseColor = glm::vec3(0.8f, 0.5f, 0.2f);
        change(p);
        all.push_back({name, p});
    };
    add("plastic 0.5", [](auto&) {});
    add("plastic 0.2", [](auto& p) { p.roughness = 0.2f; });
    add("plastic 1", [](auto& p) { p.roughness = 1.f; });
    add("metal 0.3", [](auto& p) { p.metallic = 1.f, p.roughness = 0.3f; });
    add("metal 0.9", [](auto& p) { p.metallic = 1.f, p.roughness = 0.9f; });
    add("half metal 0.4", [](auto& p) { p.metallic = 0.5f, p.roughness = 0.4f; });
    add("coated 0.25 on 0.7",
        [](auto& p) { p.clearcoat = 1.f, p.clearcoatRoughness = 0.25f, p.roughness = 0.7f; });
    add("coated metal", [](auto& p) { p.clearcoat = 0.6f, p.clearcoatRoughness = 0.4f, p.metallic = 1.f; });
    add("black diffuse", [](auto& p) { p.diffuseColor = glm::vec3(0.f); });
    add("dense, ior 2.4", [](auto& p) { p.ior = 2.4f, p.roughness = 0.35f; });
    add("specular workflow", [](auto& p) {
        p.flags = gpu::MATERIAL_SPECULAR_WORKFLOW;
        p.specularColor = glm::vec3(0.7f, 0.4f, 0.1f);
    });
    return all;
}

std::vector<NamedSurface> glassSurfaces() {
    std::vector<NamedSurface> all;
    const auto add = [&](const char* name, auto change) {
        SurfaceParameters p;
        p.diffuseColor = glm::vec3(0.8f, 0.5f, 0.2f);
        p.flags = gpu::MATERIAL_REFRACTIVE;
        p.opacity = 0.f;
        p.roughness = 0.3f;
        change(p);
        all.push_back({name, p});
    };
    add("glass 0.3 from outside", [](auto&) {});
    add("glass 0.3 from inside", [](auto& p) { p.frontFacing = 0; });
    add("glass 0.7 from outside", [](auto& p) { p.roughness = 0.7f; });
    add("glass 0.7 from inside", [](auto& p) { p.roughness = 0.7f, p.frontFacing = 0; });
    add("water 0.4", [](auto& p) { p.ior = 1.33f, p.roughness = 0.4f; });
    add("ior below 1", [](auto& p) { p.ior = 0.75f, p.roughness = 0.4f; });
    add("half opaque glass", [](auto& p) { p.opacity = 0.5f; });
    add("half opaque glass from inside", [](auto& p) { p.opacity = 0.5f, p.frontFacing = 0; });
    add("coated glass", [](auto& p) { p.clearcoat = 1.f, p.clearcoatRoughness = 0.3f, p.roughness = 0.5f; });
    return all;
}

} // namespace hipr::test
