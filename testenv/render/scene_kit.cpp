#include "testenv/render/scene_kit.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace hipr::test {
namespace {

std::shared_ptr<TriangleMesh> finish(std::shared_ptr<TriangleMesh> mesh) {
    mesh->boundsMin = mesh->boundsMax = mesh->positions[0];
    for (const glm::vec3& p : mesh->positions) {
        mesh->boundsMin = glm::min(mesh->boundsMin, p);
        mesh->boundsMax = glm::max(mesh->boundsMax, p);
    }
    return mesh;
}

} // namespace

std::shared_ptr<const TriangleMesh> quadMesh(std::vector<TrianglePrimvar> primvars) {
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->name = "quad";
    mesh->positions = {{-0.5f, -0.5f, 0.f}, {0.5f, -0.5f, 0.f}, {0.5f, 0.5f, 0.f}, {-0.5f, 0.5f, 0.f}};
    mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh->triangleFace = {0, 0};
    mesh->primvars = std::move(primvars);
    return finish(mesh);
}

std::shared_ptr<const TriangleMesh> sphereMesh(uint32_t rings) {
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->name = "sphere";
    const uint32_t columns = 2 * rings;
    for (uint32_t r = 0; r <= rings; ++r)
        for (uint32_t c = 0; c <= columns; ++c) {
            const float theta = glm::pi<float>() * float(r) / float(rings);
            const float phi = 2.f * glm::pi<float>() * float(c) / float(columns);
            mesh->positions.push_back(
                {std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)});
        }
    mesh->normals = mesh->positions;
    for (uint32_t r = 0; r < rings; ++r)
        for (uint32_t c = 0; c < columns; ++c) {
            const uint32_t a = r * (columns + 1) + c, b = a + columns + 1;
            if (r > 0) mesh->triangles.push_back({a, b, a + 1});
            if (r + 1 < rings) mesh->triangles.push_back({a + 1, b, b + 1});
        }
    for (uint32_t i = 0; i < mesh->triangles.size(); ++i)
        mesh->triangleFace.push_back(i / 2);
    return finish(mesh);
}

MaterialInput constantColor(glm::vec3 color) {
    MaterialInput input;
    input.constant = glm::vec4(color, 1.f);
    return input;
}

MaterialInput constantValue(float value) {
    MaterialInput input;
    input.constant = glm::vec4(value);
    input.channel = Channel::R;
    return input;
}

MaterialDesc matte(glm::vec3 color) {
    MaterialDesc desc;
    desc.name = "matte";
    desc.diffuseColor = constantColor(color);
    desc.useSpecularWorkflow = true;
    desc.specularColor = constantColor(glm::vec3(0.f));
    return desc;
}

LightDesc skyLight(float intensity) {
    LightDesc light;
    light.name = "/sky";
    light.kind = LightKind::Dome;
    light.intensity = intensity;
    return light;
}

LightDesc lampAbove(glm::dvec3 at, float size, float intensity) {
    LightDesc light;
    light.name = "/lamp";
    light.kind = LightKind::Rect;
    light.transform =
        glm::rotate(glm::translate(glm::dmat4(1), at), glm::radians(-90.0), glm::dvec3(1, 0, 0));
    light.width = light.height = size;
    light.intensity = intensity;
    return light;
}

Settings withSamples(int samples) {
    Settings settings;
    settings.samples = samples;
    return settings;
}

Settings boxFiltered(int samples, const std::string& mode) {
    Settings settings = withSamples(samples);
    settings.pixelFilter = "box";
    settings.filterWidth = 1.f;
    settings.mode = mode;
    return settings;
}

Settings smallTiles(const std::string& mode, int samples) {
    Settings settings = withSamples(samples);
    settings.mode = mode;
    settings.tileSize = "8";
    return settings;
}

CameraDesc lookAt(glm::dvec3 eye, glm::dvec3 target, double verticalDegrees, double aspect) {
    return {glm::lookAt(eye, target, glm::dvec3(0, 1, 0)),
            glm::perspective(glm::radians(verticalDegrees), aspect, 0.1, 1000.0)};
}

glm::mat4x3 translation(float x, float y, float z) {
    glm::mat4x3 m(1.f);
    m[3] = {x, y, z};
    return m;
}

glm::mat4x3 scaling(float x, float y, float z) {
    glm::mat4x3 m(0.f);
    m[0].x = x, m[1].y = y, m[2].z = z;
    return m;
}

glm::mat4x3 placed(glm::mat4x3 m, float x, float y, float z) {
    m[3] = {x, y, z};
    return m;
}

MaterialDesc mirror() {
    MaterialDesc material;
    material.diffuseColor = constantColor(glm::vec3(0.9f));
    material.metallic = constantValue(1.f);
    material.roughness = constantValue(0.f);
    return material;
}

Stage::Stage(Settings settings, RendererInternals internals) {
    RendererOptions options;
    options.messages = [this](Severity severity, const std::string& subject, const std::string& text) {
        std::lock_guard<std::mutex> lock(_mutex);
        _messages.push_back({severity, subject, text});
    };
    std::string error;
    renderer = createRenderer(options, internals, &error);
    if (!renderer) throw std::runtime_error(error);
    renderer->setSettings(settings);
}

Stage::~Stage() {
    EXPECT_EQ(renderer->validationErrors(), 0u);
    renderer.reset(); // the layer names what was not destroyed
    for (const Message& message : messages())
        EXPECT_FALSE(message.severity == Severity::Error && message.subject == "Vulkan validation")
            << message.text;
}

ObjectId Stage::add(std::shared_ptr<const TriangleMesh> mesh, MaterialDesc material,
                    std::vector<glm::mat4x3> transforms, ObjectDesc desc) {
    const auto geometry = renderer->newId<GeometryId>();
    const auto materialId = renderer->newId<MaterialId>();
    const auto object = renderer->newId<ObjectId>();
    edit.setGeometry(geometry, std::move(mesh));
    edit.setMaterial(materialId, std::move(material));
    desc.name = "/object" + std::to_string(uint32_t(object));
    desc.geometry = geometry;
    desc.materials = {materialId};
    desc.primId = int(object);
    edit.setObject(object, desc);
    edit.setInstances(object, {std::move(transforms), {}, {}});
    return object;
}

LightId Stage::add(LightDesc light) {
    const auto id = renderer->newId<LightId>();
    edit.setLight(id, std::move(light));
    return id;
}

void Stage::film(uint32_t width, uint32_t height, std::vector<AovRequest> aovs) {
    _film = {width, height, std::move(aovs)};
    renderer->setFilm(_film);
}

void Stage::settings(const Settings& settings) {
    renderer->setSettings(settings);
}

void Stage::render() {
    renderer->commit(edit);
    while (renderer->renderBatch()) {
    }
}

ColorPicture Stage::color() {
    return read<glm::vec4>(AovKind::Color);
}

std::vector<Message> Stage::messages() {
    std::lock_guard<std::mutex> lock(_mutex);
    return _messages;
}

void addFloor(Stage& stage) {
    stage.add(quadMesh(), matte(glm::vec3(0.6f)),
              {glm::mat4x3({9, 0, 0}, {0, 0, -9}, {0, 9, 0}, {0, -1, 0})});
}

bool sameBits(const ColorPicture& a, const ColorPicture& b) {
    return a.values.size() == b.values.size() && !a.values.empty() &&
           std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(glm::vec4)) == 0;
}

glm::vec4 mean(const ColorPicture& picture) {
    glm::dvec4 sum(0);
    for (const glm::vec4& value : picture.values)
        sum += value;
    return sum / double(picture.values.size());
}

void save(const ColorPicture& picture, const std::string& name) {
    const char* folder = std::getenv("HIPR_TEST_OUT");
    if (!folder) return;
    FILE* file = std::fopen((std::string(folder) + "/" + name + ".ppm").c_str(), "wb");
    if (!file) return;
    std::fprintf(file, "P6 %u %u 255\n", picture.width, picture.height);
    for (uint32_t y = picture.height; y-- > 0;)
        for (uint32_t x = 0; x < picture.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float v = glm::clamp(picture.at(x, y)[c], 0.f, 1.f);
                std::fputc(
                    int(255.f * (v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f) +
                        0.5f),
                    file);
            }
    std::fclose(file);
}

} // namespace hipr::test
