// Renders a ball on a floor under a rectangular light, without USD, and writes example.ppm.
// Build it with the renderer's CMake target: target_link_libraries(example PRIVATE hipr)
#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <iostream>

#include "renderer/api/renderer.h"

int main(int argc, char** argv) {
    std::string error;
    const auto renderer = hipr::Renderer::create({}, &error);
    if (!renderer) return std::cerr << "No renderer: " << error << "\n", 1;
    const auto say = [](auto, auto& subject, auto& text) { std::cerr << subject << ": " << text << "\n"; };
    hipr::SceneEdit edit; // collects what changes; elements are named by ids
    const auto add = [&](const hipr::MeshDesc& mesh, const glm::vec3& color, const glm::vec3& position) {
        hipr::MaterialDesc material;
        material.diffuseColor.constant = glm::vec4(color, 1.f);
        const auto geometryId = renderer->newId<hipr::GeometryId>();
        const auto materialId = renderer->newId<hipr::MaterialId>();
        const auto objectId = renderer->newId<hipr::ObjectId>();
        edit.setGeometry(geometryId, hipr::buildTriangleMesh(mesh, say));
        edit.setMaterial(materialId, material);
        edit.setObject(objectId, {mesh.name, geometryId, {materialId}});
        edit.setInstances(objectId, {{glm::mat4x3(glm::translate(glm::mat4(1.f), position))}, {}, {}});
    };
    hipr::MeshDesc floor, ball;
    floor.points = {{-8, 0, -8}, {-8, 0, 8}, {8, 0, 8}, {8, 0, -8}};
    floor.faceVertexCounts = {4};
    floor.faceVertexIndices = {0, 1, 2, 3};
    add(floor, {0.5f, 0.5f, 0.5f}, {0, 0, 0});
    for (float z : {-1.f, 1.f})
        ball.points.insert(ball.points.end(), {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}});
    ball.faceVertexCounts = {4, 4, 4, 4, 4, 4};
    ball.faceVertexIndices = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 2, 3, 7, 6, 0, 4, 7, 3, 1, 2, 6, 5};
    ball.scheme = hipr::SubdivisionScheme::CatmullClark; // the limit surface of this cube is round
    ball.refineLevel = 4;
    add(ball, {0.7f, 0.1f, 0.05f}, {0, 0.7f, 0});
    hipr::LightDesc light; // shines along its own -Z: turned to face down
    light.kind = hipr::LightKind::Rect;
    light.transform = glm::rotate(glm::translate(glm::dmat4(1), {2, 4, 2}), glm::radians(-90.0), {1, 0, 0});
    light.width = light.height = 2;
    light.intensity = 12;
    edit.setLight(renderer->newId<hipr::LightId>(), light);
    edit.setCamera({glm::lookAt(glm::dvec3(0, 2.5, 6), glm::dvec3(0, 0.6, 0), glm::dvec3(0, 1, 0)),
                    glm::perspective(glm::radians(35.0), 320.0 / 240.0, 0.1, 100.0)});
    renderer->setFilm({320, 240, {{hipr::AovKind::Color, {}}}});
    renderer->commit(edit);
    while (renderer->progress().samplesDone < 32 && renderer->renderBatch()) {
    }
    std::vector<glm::vec4> pixels(320 * 240); // the first row is the bottom of the picture
    if (!renderer->readAov({hipr::AovKind::Color, {}}, pixels.data(), pixels.size() * 4)) return 1;
    std::ofstream file(argc > 1 ? argv[1] : "example.ppm", std::ios::binary);
    file << "P6\n320 240\n255\n";
    const auto byte = [](float linear) { return 255.f * std::pow(std::clamp(linear, 0.f, 1.f), 1 / 2.2f); };
    for (int i = 0; i < 3 * 320 * 240; ++i)
        file.put(char(byte(pixels[320 * (239 - i / 960) + i / 3 % 320][i % 3])));
    return file.flush() ? 0 : 1;
}
