#include "testenv/bench/frame_bench.h"

#include <iostream>
#include <stdexcept>

#include <glm/gtc/matrix_transform.hpp>

#include "testenv/bench/room.h"

namespace hipr::bench {

namespace {

constexpr int Samples = 4;
constexpr uint32_t Width = 480, Height = 270;

struct Contender {
    std::string traversal;
    std::unique_ptr<Renderer> renderer;
    std::vector<double> msamples, mrays;
    double raysPerSample = 0;

    /// One picture, timed from its first sample.
    void render(bool timed) {
        Settings settings;
        settings.traversal = traversal;
        settings.samples = Samples;
        settings.seed = ++_seed; // another seed starts over
        renderer->setSettings(settings);
        while (renderer->renderBatch()) {
        }
        const Progress p = renderer->progress();
        if (!p.converged) throw std::runtime_error("the picture was not finished (" + traversal + ")");
        if (!timed) return;
        msamples.push_back(double(p.pathsTraced) / p.seconds / 1e6);
        mrays.push_back(double(p.raysTraced) / p.seconds / 1e6);
        raysPerSample = double(p.raysTraced) / double(p.pathsTraced);
    }

private:
    int _seed = 0;
};

Contender contender(const std::string& traversal, uint32_t triangles) {
    Contender c;
    c.traversal = traversal;
    std::string error;
    c.renderer = Renderer::create({}, &error);
    if (!c.renderer) throw std::runtime_error(error);
    FilmDesc film;
    film.width = Width;
    film.height = Height;
    c.renderer->setFilm(film);
    Settings settings;
    settings.traversal = traversal;
    c.renderer->setSettings(settings);
    SceneEdit edit;
    fillRoom(*c.renderer, edit, triangles, double(Width) / Height);
    c.renderer->commit(edit);
    c.render(false);
    return c;
}

} // namespace

void fillRoom(Renderer& renderer, SceneEdit& edit, uint32_t triangles, double aspect) {
    const MessageSink ignore = [](Severity, const std::string&, const std::string&) {};
    const auto geometry = renderer.newId<GeometryId>();
    edit.setGeometry(geometry, buildTriangleMesh(room(triangles), ignore));
    const auto material = renderer.newId<MaterialId>();
    MaterialDesc look;
    look.diffuseColor.constant = glm::vec4(0.6f, 0.6f, 0.6f, 1.f);
    edit.setMaterial(material, look);
    const auto object = renderer.newId<ObjectId>();
    ObjectDesc description;
    description.name = "room";
    description.geometry = geometry;
    description.materials = {material};
    edit.setObject(object, description);
    InstancesDesc instances;
    instances.transforms = {glm::mat4x3(1.f)};
    edit.setInstances(object, instances);
    LightDesc light;
    light.kind = LightKind::Disk;
    light.transform = glm::translate(glm::dmat4(1.0), glm::dvec3(LightCentre)) *
                      glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), {1.0, 0.0, 0.0});
    light.radius = LightRadius;
    light.intensity = 10.f;
    edit.setLight(renderer.newId<LightId>(), light);
    CameraDesc camera;
    camera.worldToView = glm::translate(glm::dmat4(1.0), -glm::dvec3(Eye));
    camera.projection = glm::perspective(glm::radians(60.0), aspect, 0.01, 100.0);
    edit.setCamera(camera);
}

std::vector<FrameRow> benchFrames(uint32_t triangles, int repetitions) {
    std::vector<Contender> contenders;
    contenders.push_back(contender("auto", triangles));
    const DeviceInfo device = contenders[0].renderer->device();
    contenders.push_back(contender("bvh", triangles));
    if (device.rayQuery) contenders.push_back(contender("rayquery", triangles));
    for (int i = 0; i < repetitions; ++i)
        for (Contender& c : contenders) {
            std::cerr << "timing pictures by " << c.traversal << ", " << i + 1 << " of " << repetitions
                      << "\n";
            c.render(true);
        }
    std::vector<FrameRow> rows;
    for (Contender& c : contenders)
        rows.push_back({c.traversal, triangles, spread(c.msamples), spread(c.mrays), c.raysPerSample,
                        c.renderer->memory()});
    return rows;
}

} // namespace hipr::bench
