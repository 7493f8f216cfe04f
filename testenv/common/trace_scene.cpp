#include "testenv/common/trace_scene.h"

#include <chrono>
#include <stdexcept>

#include <tbb/parallel_for.h>

#include "renderer/accel/denormals.h"
#include "renderer/accel/geometry_bounds.h"
#include "renderer/accel/instance_table.h"
#include "shaders/shared/segment.h"

namespace hipr::test {

Device& device() {
    static std::unique_ptr<Device> instance = [] {
        std::string error;
        RendererOptions options;
        options.validation = true;
        auto d = Device::create(options, &error);
        if (!d) throw std::runtime_error(error);
        return d;
    }();
    return *instance;
}

std::string kindName(TraversalKind kind) {
    switch (kind) {
    case TraversalKind::Host:
        return "Host";
    case TraversalKind::Embree:
        return "Embree";
    case TraversalKind::Bvh:
        return "Bvh";
    case TraversalKind::RayQuery:
        return "RayQuery";
    }
    return "";
}

GeometryView viewOf(const TriangleMesh& mesh) {
    GeometryView view{};
    view.positions = mesh.positions.data();
    view.vertexCount = mesh.vertexCount();
    view.triangles = mesh.triangles.data();
    view.triangleCount = mesh.size();
    view.keys = mesh.keys;
    if (!mesh.segments.empty()) view.segments = mesh.segments.data(), view.radii = mesh.radii.data();
    return view;
}

TraceScene::TraceScene(TraversalKind kind, Device& device)
    : _device(device), _traversal(createTraversal(kind, device)) {}

TraceScene::TraceScene(TraversalKind kind, const RayScene& scene, Device& device) : TraceScene(kind, device) {
    for (uint32_t i = 0; i < scene.meshes.size(); ++i)
        setMesh(i, scene.meshes[i]);
    setInstances(scene.instances, scene.keys);
    commit();
}

void TraceScene::setMesh(uint32_t slot, const TriangleMesh& mesh) {
    Slot& s = _slots[slot];
    s.mesh = mesh;
    s.mesh.positions.push_back(glm::vec3(0.0f)); // readable padding behind the last vertex
    s.triangles = mesh.segments.empty()
                      ? _device.createFrom(mesh.triangles.data(), mesh.triangles.size(), "test")
                      : _device.createFrom(mesh.segments.data(), mesh.segments.size(), "test");
    if (!mesh.radii.empty()) s.radii = _device.createFrom(mesh.radii.data(), mesh.radii.size(), "test");
    send(slot, false);
}

void TraceScene::movePoints(uint32_t slot, const std::vector<glm::vec3>& positions) {
    Slot& s = _slots.at(slot);
    std::copy(positions.begin(), positions.end(), s.mesh.positions.begin());
    send(slot, true);
}

void TraceScene::send(uint32_t slot, bool sameTopology) {
    Slot& s = _slots.at(slot);
    s.positions = _device.createFrom(s.mesh.positions.data(), s.mesh.positions.size(), "test");
    GeometryView view = viewOf(s.mesh);
    view.vertexCount = uint32_t(s.mesh.positions.size() - 1) / s.mesh.keys; // without the padding
    view.positionsAddress = s.positions.address();
    view.trianglesAddress = s.triangles.address();
    view.sameTopology = sameTopology;
    _traversal->setGeometry(slot, &view);
}

void TraceScene::removeMesh(uint32_t slot) {
    _traversal->setGeometry(slot, nullptr);
    _slots.erase(slot);
}

void TraceScene::setInstances(const std::vector<gpu::InstanceRecord>& instances,
                              const std::vector<glm::mat4x3>& keys) {
    _instances = instances;
    _keyBuffer = _device.createFrom(keys.data(), keys.size(), "test");
    _traversal->setInstances({instances, keys, _keyBuffer.address()});
}

void TraceScene::commit() {
    _traversal->commit();
    std::vector<gpu::GeometryRecord> geometries(_slots.empty() ? 0 : _slots.rbegin()->first + 1);
    for (const auto& [slot, s] : _slots) {
        geometries[slot].positions = s.positions.address();
        geometries[slot].triangles = s.triangles.address();
        geometries[slot].radii = s.mesh.segments.empty() ? 0 : s.radii.address();
    }
    _geometryBuffer = _device.createFrom(geometries.data(), geometries.size(), "test");
    _instanceBuffer = _device.createFrom(_instances.data(), _instances.size(), "test");
    gpu::SceneRecord record{};
    record.geometries = _geometryBuffer.address();
    record.instances = _instanceBuffer.address();
    record.bvh = _traversal->sceneAddress();
    _scene = _device.createFrom(&record, 1, "test");
}

void TraceScene::trace(const std::vector<gpu::Ray>& rays, uint32_t mask, bool nearest,
                       const Buffer& results) {
    const uint32_t count = uint32_t(rays.size());
    const gpu::QueueHeader header = gpu::queueHeader(count);
    const gpu::QueueHeader headers[2] = {{}, header}; // the second one: offsets are honoured
    const Buffer headerBuffer = _device.createFrom(headers, 2, "test");
    const Buffer rayBuffer = _device.createFrom(rays.data(), rays.size(), "test");
    const TraceQueue queue{&headerBuffer, sizeof(gpu::QueueHeader), &rayBuffer, &results, mask};
    const auto start = std::chrono::steady_clock::now();
    if (_traversal->onHost()) {
        nearest ? _traversal->nearest(queue) : _traversal->occluded(queue);
    } else {
        _device.run([&](VkCommandBuffer cmd) {
            nearest ? _traversal->recordNearest(cmd, _scene.address(), queue)
                    : _traversal->recordOccluded(cmd, _scene.address(), queue);
        });
    }
    _seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<gpu::Hit> TraceScene::nearest(const std::vector<gpu::Ray>& rays, uint32_t mask) {
    std::vector<gpu::Hit> hits(rays.size());
    const Buffer results = _device.createBuffer(hits.size() * sizeof(gpu::Hit), MemoryUse::Device, "test");
    trace(rays, mask, true, results);
    _device.download(results, hits.data(), hits.size() * sizeof(gpu::Hit));
    return hits;
}

std::vector<uint32_t> TraceScene::occluded(const std::vector<gpu::Ray>& rays, uint32_t mask) {
    std::vector<uint32_t> blocked(rays.size());
    const Buffer results = _device.createBuffer(blocked.size() * sizeof(uint32_t), MemoryUse::Device, "test");
    trace(rays, mask, false, results);
    _device.download(results, blocked.data(), blocked.size() * sizeof(uint32_t));
    return blocked;
}

namespace {

Corners cornersAt(const TriangleMesh& mesh, uint32_t primitive, float time) {
    const GeometryView view = viewOf(mesh);
    if (mesh.keys == 1) return cornersOf(view, primitive, 0);
    const gpu::KeyTime at = gpu::keyTime(time, mesh.keys);
    const Corners from = cornersOf(view, primitive, at.first), to = cornersOf(view, primitive, at.first + 1);
    return {gpu::mixKeys(from[0], to[0], at.weight), gpu::mixKeys(from[1], to[1], at.weight),
            gpu::mixKeys(from[2], to[2], at.weight)};
}

gpu::Hit bruteForceRay(const RayScene& scene, const InstanceTable& table, const gpu::Ray& ray,
                       uint32_t mask) {
    gpu::Hit best{gpu::NO_INDEX, gpu::NO_INDEX, ray.tMax, 0.0f, 0.0f};
    if (!gpu::traceable(ray.origin, ray.direction, ray.tMin, ray.tMax)) return best;
    const gpu::BoxRay world = gpu::boxRay(ray.origin, ray.direction, table.extent);
    for (uint32_t i = 0; i < table.records.size(); ++i) {
        const gpu::BvhInstance& record = table.records[i];
        if (!(record.mask & mask)) continue;
        float entry, exit;
        gpu::boxInterval(world, record.lo, record.hi, entry, exit);
        const glm::mat4x3 toObject = worldToObject(record, table.keys.data(), ray.time);
        const glm::vec3 origin = gpu::mapPoint(toObject, ray.origin);
        const glm::vec3 direction = gpu::mapDirection(toObject, ray.direction);
        const gpu::TriangleRay triangleRay = gpu::triangleRay(origin, direction);
        const gpu::BoxRay box = gpu::boxRay(origin, direction, record.extent);
        const TriangleMesh& mesh = scene.meshes[scene.instances[i].geometry];
        const uint32_t passed = gpu::passedSides(record.culled, ray.flags);
        const gpu::SegmentRay segmentRay = gpu::segmentRay(origin, direction);
        for (uint32_t p = 0; p < mesh.size(); ++p) {
            const auto [a, b, c] = cornersAt(mesh, p, ray.time);
            float t, u, v;
            bool front = true;
            const bool met =
                mesh.segments.empty()
                    ? gpu::canonicalHit(triangleRay, box, a, b, c, entry, exit, t, u, v, front)
                    : gpu::canonicalSegmentHit(segmentRay, box, a, b, c.x, c.y, entry, exit, t, u, v);
            if (met && !gpu::passesSide(passed, front) && t > ray.tMin &&
                gpu::before(t, i, p, best.t, best.instance, best.primitive))
                best = {i, p, t, u, v};
        }
    }
    return best;
}

} // namespace

std::vector<gpu::Hit> bruteForce(const RayScene& scene, const std::vector<gpu::Ray>& rays, uint32_t mask) {
    const InstanceTable table = makeInstanceTable({scene.instances, scene.keys}, [&](uint32_t slot) {
        const TriangleMesh& mesh = scene.meshes[slot];
        return slotShape(viewOf(mesh), geometryBounds(viewOf(mesh)));
    });
    std::vector<gpu::Hit> hits(rays.size());
    tbb::parallel_for(tbb::blocked_range<size_t>(0, rays.size(), 256), [&](const auto& range) {
        const FlushDenormals flush;
        for (size_t i = range.begin(); i < range.end(); ++i)
            hits[i] = bruteForceRay(scene, table, rays[i], mask);
    });
    return hits;
}

Difference compare(const std::vector<gpu::Hit>& a, const std::vector<gpu::Hit>& b) {
    Difference d;
    for (uint32_t i = 0; i < a.size(); ++i) {
        const bool sameHit = a[i].instance == b[i].instance && a[i].primitive == b[i].primitive;
        const bool sameBits = a[i].t == b[i].t && a[i].u == b[i].u && a[i].v == b[i].v;
        if (!sameHit) ++d.hits;
        if (sameHit && !sameBits) ++d.distances;
        if (!(sameHit && sameBits) && d.first == ~0u) d.first = i;
    }
    return d;
}

} // namespace hipr::test
