#include "testenv/bench/traversal_bench.h"

#include <algorithm>
#include <iostream>

#include "renderer/accel/traversal.h"
#include "testenv/bench/ray_sets.h"
#include "testenv/bench/room.h"

namespace hipr::bench {

namespace {

constexpr uint32_t PictureSize = 512;

void toStandardError(Severity, const std::string& subject, const std::string& text) {
    std::cerr << subject << ": " << text << "\n";
}

const char* nameOf(TraversalKind kind) {
    switch (kind) {
    case TraversalKind::Host:
        return "host";
    case TraversalKind::Embree:
        return "embree";
    case TraversalKind::Bvh:
        return "bvh";
    case TraversalKind::RayQuery:
        return "rayquery";
    }
    return "";
}

/// The mesh on the device, as one instance of one geometry.
struct DeviceMesh {
    DeviceMesh(Device& device, const TriangleMesh& mesh) : points(mesh.positions) {
        points.push_back(glm::vec3(0.f)); // the readable padding that traversals ask for
        positions = device.createFrom(points.data(), points.size(), "positions");
        triangles = device.createFrom(mesh.triangles.data(), mesh.triangles.size(), "triangles");
        view = {points.data(),
                uint32_t(mesh.positions.size()),
                mesh.triangles.data(),
                uint32_t(mesh.triangles.size()),
                positions.address(),
                triangles.address(),
                false};
        instance.objectToWorld = instance.worldToObject = glm::mat4x3(1.f);
        gpu::GeometryRecord geometry{};
        geometry.positions = positions.address();
        geometry.triangles = triangles.address();
        geometry.vertexCount = view.vertexCount;
        geometry.triangleCount = view.triangleCount;
        geometries = device.createFrom(&geometry, 1, "scene");
        instances = device.createFrom(&instance, 1, "scene");
    }
    std::vector<glm::vec3> points;
    Buffer positions, triangles, geometries, instances;
    GeometryView view;
    gpu::InstanceRecord instance{};
};

uint64_t bytesHeld(const Device& device, const Traversal& traversal) {
    return device.memory().total() + traversal.hostBytes();
}

/// One traversal, ready to trace one ray set.
class Contender {
public:
    Contender(Device& device, TraversalKind kind, DeviceMesh& mesh)
        : _device(device), _traversal(createTraversal(kind, device)) {
        const uint64_t before = bytesHeld(device, *_traversal);
        build.traversal = name = nameOf(kind);
        build.triangles = mesh.view.triangleCount;
        build.seconds = timed([&] {
                            _traversal->setGeometry(0, &mesh.view);
                            _traversal->setInstances({{mesh.instance}, {}});
                            _traversal->commit();
                        }).clock;
        build.bytes = bytesHeld(device, *_traversal) - before;
        gpu::SceneRecord record{};
        record.geometries = mesh.geometries.address();
        record.instances = mesh.instances.address();
        record.instanceCount = 1;
        record.bvh = _traversal->sceneAddress();
        _scene = device.createFrom(&record, 1, "scene");
    }

    void setRays(const RaySet& set) {
        const uint32_t count = uint32_t(set.rays.size());
        const gpu::QueueHeader header = gpu::queueHeader(count);
        _occlusion = set.occlusion;
        _header = _device.createFrom(&header, 1, "queue");
        _rays = _device.createFrom(set.rays.data(), count, "queue");
        _results = _device.createBuffer(count * sizeof(gpu::Hit), MemoryUse::Device, "queue");
    }

    void trace() {
        const TraceQueue queue{&_header, 0, &_rays, &_results, gpu::RAY_MASK_ALL};
        if (_traversal->onHost()) {
            _occlusion ? _traversal->occluded(queue) : _traversal->nearest(queue);
            return;
        }
        _device.run([&](VkCommandBuffer cmd) {
            _occlusion ? _traversal->recordOccluded(cmd, _scene.address(), queue)
                       : _traversal->recordNearest(cmd, _scene.address(), queue);
        });
    }

    template <class T> std::vector<T> results(size_t count) const {
        std::vector<T> values(count);
        _device.download(_results, values.data(), count * sizeof(T));
        return values;
    }

    std::string name;
    BuildRow build;

private:
    Device& _device;
    std::unique_ptr<Traversal> _traversal;
    Buffer _scene, _header, _rays, _results;
    bool _occlusion = false;
};

/// The yardstick, holding the same rays.
struct Yardstick {
    const BareEmbree& embree;
    const RaySet& set;
    std::vector<gpu::Hit> hits = std::vector<gpu::Hit>(set.rays.size());
    std::vector<uint32_t> blocked = std::vector<uint32_t>(set.rays.size());

    void trace() { set.occlusion ? embree.occluded(set.rays, blocked) : embree.nearest(set.rays, hits); }

    double disagreement(const Contender& c) const {
        size_t differing = 0;
        if (set.occlusion) {
            const auto theirs = c.results<uint32_t>(blocked.size());
            for (size_t i = 0; i < blocked.size(); ++i)
                differing += blocked[i] != theirs[i];
        } else {
            const auto theirs = c.results<gpu::Hit>(hits.size());
            for (size_t i = 0; i < hits.size(); ++i)
                differing += hits[i].instance != theirs[i].instance ||
                             (hits[i].instance != gpu::NO_INDEX && hits[i].primitive != theirs[i].primitive);
        }
        return double(differing) / double(set.rays.size());
    }
};

TraversalRow compare(Contender& contender, Yardstick& yardstick, int repetitions) {
    contender.setRays(yardstick.set);
    yardstick.trace(); // once each before the clock runs: pages, shaders, caches
    contender.trace();
    std::vector<double> ours, theirs, ratios, processorRatios;
    const double mrays = double(yardstick.set.rays.size()) / 1e6;
    for (int i = 0; i < repetitions; ++i) {
        const Timing a = timed([&] { yardstick.trace(); }), b = timed([&] { contender.trace(); });
        theirs.push_back(mrays / a.clock);
        ours.push_back(mrays / b.clock);
        ratios.push_back(a.clock / b.clock);
        processorRatios.push_back(a.processor / b.processor);
    }
    TraversalRow row;
    row.traversal = contender.name;
    row.rays = yardstick.set.kind;
    row.triangles = contender.build.triangles;
    row.mraysPerSecond = spread(ours);
    row.bareMraysPerSecond = spread(theirs);
    row.ratio = spread(ratios);
    row.processorRatio = spread(processorRatios);
    row.disagreeing = yardstick.disagreement(contender);
    return row;
}

} // namespace

TraversalReport benchTraversals(uint32_t triangles, int repetitions, const std::vector<std::string>& names) {
    std::string error;
    RendererOptions options;
    options.messages = toStandardError;
    const auto device = Device::create(options, &error);
    if (!device) throw std::runtime_error(error);
    const auto mesh = buildTriangleMesh(room(triangles), toStandardError);
    const BareEmbree embree(*mesh);
    const std::vector<RaySet> sets = raySets(embree, *mesh, PictureSize);
    DeviceMesh deviceMesh(*device, *mesh);

    TraversalReport report;
    report.builds.push_back({"bare embree", mesh->triangles.size(), embree.buildSeconds(), 0});
    for (const TraversalKind kind :
         {TraversalKind::Host, TraversalKind::Embree, TraversalKind::Bvh, TraversalKind::RayQuery}) {
        if (!names.empty() && std::find(names.begin(), names.end(), nameOf(kind)) == names.end()) continue;
        const bool onHost = kind == TraversalKind::Host || kind == TraversalKind::Embree;
        if (onHost && !device->hostMemory()) continue;
        if (kind == TraversalKind::RayQuery && !device->info().rayQuery) continue;
        Contender contender(*device, kind, deviceMesh);
        report.builds.push_back(contender.build);
        for (const RaySet& set : sets) {
            std::cerr << "timing " << contender.name << ", " << set.kind << " rays, "
                      << contender.build.triangles << " triangles\n";
            Yardstick yardstick{embree, set};
            report.rows.push_back(compare(contender, yardstick, repetitions));
        }
    }
    return report;
}

} // namespace hipr::bench
