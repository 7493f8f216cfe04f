// Renders a ball on a floor under a rectangular light, without USD, and writes example.ppm.
//
// Build it with the renderer's CMake target: target_link_libraries(example PRIVATE hipr)
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/api/renderer.h"

int main(int argc, char** argv) {
    const std::string output = argc > 1 ? argv[1] : "example.ppm";
    std::string error;
    const auto renderer = hipr::Renderer::create({}, &error);
    if (!renderer) {
        std::cerr << "No renderer: " << error << "\n";
        return 1;
    }
    const hipr::MessageSink messages = [](hipr::Severity, const std::string& subject,
                                          const std::string& text) {
        std::cerr << subject << ": " << text << "\n";
    };
    hipr::SceneEdit edit;

    // Adds a polygon mesh with a diffuse colour, placed once.
    const auto addObject = [&](const hipr::MeshDesc& mesh, const glm::vec3& color,
                               const glm::mat4x3& placement) {
        const auto geometry = renderer->newId<hipr::GeometryId>();
        edit.setGeometry(geometry, hipr::buildTriangleMesh(mesh, messages));

        const auto material = renderer->newId<hipr::MaterialId>();
        hipr::MaterialDesc look;
        look.diffuseColor.constant = glm::vec4(color, 1.f);
        edit.setMaterial(material, look);

        const auto object = renderer->newId<hipr::ObjectId>();
        hipr::ObjectDesc description;
        description.name = mesh.name;
        description.geometry = geometry;
        description.materials = {material};
        edit.setObject(object, description);
        hipr::InstancesDesc instances;
        instances.transforms = {placement};
        edit.setInstances(object, instances);
    };

    hipr::MeshDesc floor;
    floor.name = "floor";
    floor.points = {{-8, 0, -8}, {-8, 0, 8}, {8, 0, 8}, {8, 0, -8}};
    floor.faceVertexCounts = {4};
    floor.faceVertexIndices = {0, 1, 2, 3};
    addObject(floor, {0.5f, 0.5f, 0.5f}, glm::mat4x3(1.f));

    hipr::MeshDesc ball; // a cube whose subdivision surface is round
    ball.name = "ball";
    ball.points = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                   {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    ball.faceVertexCounts = {4, 4, 4, 4, 4, 4};
    ball.faceVertexIndices = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 2, 3, 7, 6, 0, 4, 7, 3, 1, 2, 6, 5};
    ball.scheme = hipr::SubdivisionScheme::CatmullClark;
    ball.refineLevel = 4;
    addObject(ball, {0.7f, 0.1f, 0.05f}, glm::mat4x3(glm::translate(glm::mat4(1.f), {0.f, 0.7f, 0.f})));

    hipr::LightDesc light; // shines along its own -Z, so turn it to face down
    light.kind = hipr::LightKind::Rect;
    light.transform = glm::translate(glm::dmat4(1.0), {2.0, 4.0, 2.0}) *
                      glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), {1.0, 0.0, 0.0});
    light.width = light.height = 2.f;
    light.intensity = 12.f;
    edit.setLight(renderer->newId<hipr::LightId>(), light);

    const hipr::FilmDesc film{320, 240, {{hipr::AovKind::Color, {}}}};
    hipr::CameraDesc camera;
    camera.worldToView = glm::lookAt(glm::dvec3(0, 2.5, 6), glm::dvec3(0, 0.6, 0), glm::dvec3(0, 1, 0));
    camera.projection = glm::perspective(glm::radians(35.0), double(film.width) / film.height, 0.1, 100.0);
    edit.setCamera(camera);

    hipr::Settings settings;
    settings.samples = 32;
    renderer->setSettings(settings);
    renderer->setFilm(film);
    renderer->commit(edit);
    while (renderer->renderBatch()) {
    }

    std::vector<glm::vec4> pixels(size_t(film.width) * film.height);
    if (!renderer->readAov(film.aovs[0], pixels.data(), pixels.size() * 4)) return 1;
    std::ofstream file(output, std::ios::binary);
    file << "P6\n" << film.width << " " << film.height << "\n255\n";
    for (uint32_t y = film.height; y-- > 0;) // the film's first row is the bottom of the picture
        for (uint32_t x = 0; x < film.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float value = std::clamp(pixels[y * film.width + x][c], 0.f, 1.f);
                file.put(char(std::lround(255.f * std::pow(value, 1.f / 2.2f))));
            }
    return file.flush() ? 0 : 1;
}
