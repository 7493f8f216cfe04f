#include "testenv/unit/shading/surface_scene.h"

#include "hipr_shading_test_kernels.h"
#include "testenv/unit/sampling/gpu.h"

namespace hipr::test {

namespace {

struct Push {
    VkDeviceAddress scene, hits, rays, outcomes;
    uint32_t count;
    float width, levelShare;
    uint32_t sampled;
};

const Kernel& kernel() {
    static const Kernel made(testDevice(), spirv::surface_spv, spirv::surface_spv_size, sizeof(Push),
                             "surface test");
    return made;
}

/// Primvars on the device; `storage` keeps the values.
Buffer uploadPrimvars(const std::vector<TestPrimvar>& primvars, NameTable& names,
                      std::vector<Buffer>& storage) {
    std::vector<gpu::PrimvarRecord> records;
    for (const TestPrimvar& p : primvars) {
        storage.push_back(toDevice(p.values));
        records.push_back({storage.back().address(), names.intern(p.name), p.interpolation, p.components, 0});
    }
    return toDevice(records);
}

struct Tables {
    explicit Tables(const SurfaceScene& scene)
        : textures(testDevice(), serve(scene.files), ColorManager::create(testDevice().messages())),
          materials(testDevice(), names, textures) {
        for (size_t i = 0; i < scene.materials.size(); ++i)
            materials.set(MaterialId(i + 1), scene.materials[i]);
        textures.commit();
        materials.commit();
    }
    NameTable names;
    TextureStore textures;
    MaterialTable materials;
};

} // namespace

std::vector<SurfaceOutcome> SurfaceScene::look(const std::vector<glm::vec2>& points, bool fromBack) const {
    Tables tables(*this);
    std::vector<Buffer> storage;
    const Buffer positions = toDevice(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const Buffer triangles = toDevice(std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}});
    const Buffer normalBuffer = toDevice(normals), slotBuffer = toDevice(slots);
    const Buffer primvarBuffer = uploadPrimvars(primvars, tables.names, storage);
    const Buffer instancePrimvarBuffer = uploadPrimvars(instancePrimvars, tables.names, storage);

    gpu::GeometryRecord geometry{};
    geometry.positions = positions.address();
    geometry.triangles = triangles.address();
    geometry.normals = normals.empty() ? 0 : normalBuffer.address();
    geometry.triangleSlot = slots.empty() ? 0 : slotBuffer.address();
    geometry.primvars = primvarBuffer.address();
    geometry.primvarCount = uint32_t(primvars.size());
    gpu::InstanceRecord instance{};
    instance.objectToWorld = glm::mat4x3(objectToWorld);
    instance.worldToObject = glm::mat4x3(glm::inverse(objectToWorld));
    instance.materialCount = uint32_t(materials.size());
    instance.flags = glm::determinant(glm::mat3(objectToWorld)) < 0.f ? gpu::INSTANCE_MIRRORED : 0;
    instance.primvars = instancePrimvarBuffer.address();
    instance.primvarCount = uint32_t(instancePrimvars.size());
    std::vector<uint32_t> indices;
    for (size_t i = 0; i < materials.size(); ++i)
        indices.push_back(tables.materials.index(MaterialId(i + 1)));

    const Buffer geometries = testDevice().createFrom(&geometry, 1, "test");
    const Buffer instances = testDevice().createFrom(&instance, 1, "test");
    const Buffer indexBuffer = toDevice(indices);
    gpu::SceneRecord scene{};
    scene.geometries = geometries.address();
    scene.instances = instances.address();
    scene.materialIndices = indexBuffer.address();
    tables.textures.describe(scene);
    tables.materials.describe(scene);
    const Buffer sceneBuffer = testDevice().createFrom(&scene, 1, "test");

    const glm::vec3 down = glm::normalize(glm::vec3(objectToWorld * glm::vec4(0, 0, fromBack ? 1 : -1, 0)));
    std::vector<gpu::Hit> hits;
    std::vector<gpu::Ray> rays(points.size(), {glm::vec3(0.f), 0.f, down, 1e30f, 0.f, 0u});
    for (const glm::vec2& p : points) // u weighs the triangle's second vertex, v its third
        hits.push_back(p.x >= p.y ? gpu::Hit{0, 0, 1.f, p.x - p.y, p.y}
                                  : gpu::Hit{0, 1, 1.f, p.x, p.y - p.x});
    const Buffer hitBuffer = toDevice(hits), rayBuffer = toDevice(rays);
    const Buffer outcomes = emptyBuffer<SurfaceOutcome>(points.size());
    dispatch(kernel(),
             Push{sceneBuffer.address(), hitBuffer.address(), rayBuffer.address(), outcomes.address(),
                  uint32_t(points.size()), footprint, levelShare, sampled},
             points.size());
    return toHost<SurfaceOutcome>(outcomes, points.size());
}

bool SurfaceScene::nonOpaque(size_t i) const {
    const Tables tables(*this);
    return tables.materials.nonOpaque(MaterialId(i + 1));
}

SurfaceScene sceneWith(const MaterialDesc& material, Files files) {
    SurfaceScene scene;
    scene.materials = {material};
    scene.files = std::move(files);
    return scene;
}

MaterialDesc matte(const MaterialInput& color) {
    MaterialDesc desc;
    desc.name = "/matte";
    desc.diffuseColor = color;
    desc.useSpecularWorkflow = true;
    return desc;
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance, const ::testing::Message& where) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(a[c], b[c], tolerance) << where << " component " << c;
}

MaterialInput textureInput(const std::string& path, Channel channel, const std::string& space) {
    MaterialInput input;
    input.source = MaterialInput::Source::Texture;
    input.channel = channel;
    input.texture.path = path;
    input.texture.colorSpace = space;
    return input;
}

MaterialInput constantInput(float value) {
    return {MaterialInput::Source::Constant, glm::vec4(value), Channel::R, {}, {}};
}

MaterialInput constantInput(const glm::vec3& value) {
    return {MaterialInput::Source::Constant, glm::vec4(value, 1.f), Channel::Rgb, {}, {}};
}

} // namespace hipr::test
