#include "testenv/unit/shading/bsdf_kernel.h"

#include <cmath>
#include <random>

#include "hipr_shading_test_kernels.h"
#include "renderer/shading/albedo.h"
#include "renderer/shading/material_inputs.h"
#include "renderer/shading/openpbr_albedo.h"
#include "renderer/shading/stretched_albedo.h"
#include "testenv/unit/sampling/gpu.h"
#include "testenv/unit/shading/picture.h"

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

/// SurfaceParameters as bsdf.comp has them.
struct KernelParameters {
    VkDeviceAddress constants, albedoTable, openPbrTable, stretchedTable;
    glm::vec3 ng, ns, coatNormal, tangent;
    uint32_t flags, frontFacing;
};

std::vector<glm::vec4> previewRow(const SurfaceParameters& p) {
    std::vector<glm::vec4> row(gpu::PREVIEW_INPUT_COUNT, glm::vec4(0.f));
    row[gpu::INPUT_BASE_COLOR] = glm::vec4(p.diffuseColor, 1.f);
    row[gpu::INPUT_SPECULAR_COLOR] = glm::vec4(p.specularColor, 1.f);
    row[gpu::INPUT_BASE_METALNESS] = glm::vec4(p.metallic);
    row[gpu::INPUT_SPECULAR_ROUGHNESS] = glm::vec4(p.roughness);
    row[gpu::INPUT_COAT_WEIGHT] = glm::vec4(p.clearcoat);
    row[gpu::INPUT_COAT_ROUGHNESS] = glm::vec4(p.clearcoatRoughness);
    row[gpu::INPUT_OPACITY] = glm::vec4(p.opacity);
    row[gpu::INPUT_SPECULAR_IOR] = glm::vec4(p.ior);
    return row;
}

/// What the renderer makes of a material with constants alone.
MaterialRow openPbrRow(const MaterialDesc& desc) {
    NameTable names;
    TextureStore textures(testDevice(), serve({}), ColorManager::create({}));
    return describeMaterial(resolveMaterial(desc, names, textures, {}), textures);
}

} // namespace

std::vector<Outcome> runBsdf(const SurfaceParameters& parameters, const std::vector<glm::vec3>& wo,
                             const std::vector<glm::vec3>& wi, const std::vector<glm::vec4>& u) {
    static const Buffer albedo = toDevice(specularAlbedoTable()),
                        openPbrAlbedo = toDevice(openPbrAlbedoTable()),
                        stretchedAlbedo = stretchedAlbedoTable(testDevice());
    MaterialRow row;
    if (parameters.openPbr)
        row = openPbrRow(*parameters.openPbr);
    else
        row.constants = previewRow(parameters), row.flags = parameters.flags;
    const Buffer constants = toDevice(row.constants);
    const KernelParameters p{constants.address(),       albedo.address(),   openPbrAlbedo.address(),
                             stretchedAlbedo.address(), parameters.ng,      parameters.ns,
                             parameters.coatNormal,     parameters.tangent, row.flags,
                             parameters.frontFacing};
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

SurfaceParameters openPbr(OpenPbrValues values) {
    SurfaceParameters p;
    p.openPbr.emplace();
    p.openPbr->name = "/openpbr";
    p.openPbr->model = MaterialModel::OpenPbr;
    return with(p, values);
}

SurfaceParameters with(SurfaceParameters parameters, OpenPbrValues values) {
    for (const auto& [input, value] : values) {
        MaterialInput set = openPbrDefault(input);
        set.constant = glm::vec4(value, 1.f);
        parameters.openPbr->openPbr[input] = set;
    }
    return parameters;
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
