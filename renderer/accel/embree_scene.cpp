#include "renderer/accel/embree_scene.h"

#include <stdexcept>
#include <string>

#include <tbb/parallel_for.h>

#include "renderer/accel/denormals.h"
#include "renderer/accel/geometry_bounds.h"
#include "shaders/shared/intersect.h"

namespace hipr {
namespace {

bool countMemory(void* counter, ssize_t bytes, bool) {
    static_cast<std::atomic<int64_t>*>(counter)->fetch_add(bytes, std::memory_order_relaxed);
    return true;
}

/// Embree's box test does not know the allowance of canonical hits (boxRay), so its boxes get it built in,
/// four times over for origins outside the scene. `extent`: the largest |coordinate| of all boxes.
void setBox(RTCBounds& out, const Bounds& box, float extent) {
    const float m = 4.0f * gpu::BOX_ALLOWANCE * extent;
    out = {box.lo.x - m, box.lo.y - m, box.lo.z - m, 0.0f, box.hi.x + m, box.hi.y + m, box.hi.z + m, 0.0f};
}

void instanceBounds(const RTCBoundsFunctionArguments* args) {
    const InstanceTable& table = static_cast<const EmbreeScene*>(args->geometryUserPtr)->table();
    const gpu::BvhInstance& i = table.records[args->primID];
    RTCBounds& out = *args->bounds_o;
    if (!i.mask) { // inverted: Embree leaves the primitive out
        out = {1.0f, 1.0f, 1.0f, 0.0f, -1.0f, -1.0f, -1.0f, 0.0f};
        return;
    }
    setBox(out, {i.lo, i.hi}, table.extent);
}

void segmentBounds(const RTCBoundsFunctionArguments* args) {
    const auto& g = *static_cast<const EmbreeGeometry*>(args->geometryUserPtr);
    setBox(*args->bounds_o, cornersBox(g.view, cornersOf(g.view, args->primID, args->timeStep)),
           g.bounds.extent());
}

} // namespace

EmbreeScene::EmbreeScene(const EmbreeCallbacks& callbacks) : _callbacks(callbacks) {
    const FlushDenormals flush;
    _device = rtcNewDevice(nullptr);
    if (!_device)
        throw std::runtime_error("Embree does not start: error " +
                                 std::to_string(rtcGetDeviceError(nullptr)));
    rtcSetDeviceMemoryMonitorFunction(_device, countMemory, &_bytes);
    _top = rtcNewScene(_device);
    rtcSetSceneFlags(_top, RTC_SCENE_FLAG_ROBUST);
    _instanceGeometry = rtcNewGeometry(_device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserData(_instanceGeometry, this);
    rtcSetGeometryBoundsFunction(_instanceGeometry, instanceBounds, nullptr);
    rtcSetGeometryIntersectFunction(_instanceGeometry, _callbacks.intersect);
    rtcSetGeometryOccludedFunction(_instanceGeometry, _callbacks.occluded);
    rtcAttachGeometry(_top, _instanceGeometry);
    check("setting up the top level");
}

EmbreeScene::~EmbreeScene() {
    for (const auto& g : _geometries)
        if (g && g->scene) rtcReleaseScene(g->scene);
    if (_instanceGeometry) rtcReleaseGeometry(_instanceGeometry);
    if (_top) rtcReleaseScene(_top);
    rtcReleaseDevice(_device);
}

void EmbreeScene::check(const char* doing) const {
    const RTCError e = rtcGetDeviceError(_device);
    if (e == RTC_ERROR_NONE) return;
    throw std::runtime_error(std::string("Embree, ") + doing + ": " +
                             (e == RTC_ERROR_OUT_OF_MEMORY ? "out of memory" : "error " + std::to_string(e)));
}

void EmbreeScene::setGeometry(uint32_t slot, const GeometryView* view) {
    if (slot >= _geometries.size()) _geometries.resize(slot + 1);
    std::unique_ptr<EmbreeGeometry>& g = _geometries[slot];
    _instancesChanged = true; // boxes of instances follow their geometry
    if (!view) {
        if (g && g->scene) rtcReleaseScene(g->scene);
        g.reset();
        return;
    }
    if (!g) g = std::make_unique<EmbreeGeometry>();
    g->view = *view;
    g->changed = true;
}

void EmbreeScene::setInstances(const InstanceView& instances) {
    _instances = instances.records;
    _keys = instances.keys;
    _instancesChanged = true;
}

void EmbreeScene::buildGeometry(EmbreeGeometry& g) {
    const FlushDenormals flush;
    g.changed = false;
    g.bounds = geometryBounds(g.view);
    if (g.scene) rtcReleaseScene(g.scene);
    g.scene = nullptr;
    if (g.view.triangleCount == 0) return;
    g.scene = rtcNewScene(_device);
    rtcSetSceneFlags(g.scene, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = g.view.segments ? makeSegments(g) : makeTriangles(g);
    rtcSetGeometryUserData(geometry, &g);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(g.scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(g.scene);
}

RTCGeometry EmbreeScene::makeTriangles(EmbreeGeometry& g) const {
    const RTCGeometry triangles = rtcNewGeometry(_device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryTimeStepCount(triangles, g.view.keys);
    for (uint32_t key = 0; key < g.view.keys; ++key)
        rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, key, RTC_FORMAT_FLOAT3,
                                   g.view.positions + key * size_t(g.view.vertexCount), 0, sizeof(glm::vec3),
                                   g.view.vertexCount);
    rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, g.view.triangles, 0,
                               sizeof(glm::uvec3), g.view.triangleCount);
    rtcSetGeometryIntersectFilterFunction(triangles, _callbacks.intersectFilter);
    rtcSetGeometryOccludedFilterFunction(triangles, _callbacks.occludedFilter);
    return triangles;
}

RTCGeometry EmbreeScene::makeSegments(EmbreeGeometry& g) const {
    const RTCGeometry segments = rtcNewGeometry(_device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryTimeStepCount(segments, g.view.keys);
    rtcSetGeometryUserPrimitiveCount(segments, g.view.triangleCount);
    rtcSetGeometryBoundsFunction(segments, segmentBounds, nullptr);
    rtcSetGeometryIntersectFunction(segments, _callbacks.intersectSegment);
    rtcSetGeometryOccludedFunction(segments, _callbacks.occludedSegment);
    return segments;
}

void EmbreeScene::buildTop() {
    _table = makeInstanceTable({_instances, _keys}, [this](uint32_t slot) {
        const EmbreeGeometry* g = slot < _geometries.size() ? _geometries[slot].get() : nullptr;
        return g ? slotShape(g->view, g->bounds) : SlotShape{};
    });
    _geometryOf.assign(_instances.size(), nullptr);
    for (size_t i = 0; i < _instances.size(); ++i)
        if (_table.records[i].mask) _geometryOf[i] = _geometries[_instances[i].geometry].get();
    rtcSetGeometryUserPrimitiveCount(_instanceGeometry, unsigned(_instances.size()));
    rtcCommitGeometry(_instanceGeometry);
    rtcCommitScene(_top);
    _instancesChanged = false;
}

void EmbreeScene::commit() {
    const FlushDenormals flush;
    std::vector<EmbreeGeometry*> changed;
    for (const auto& g : _geometries)
        if (g && g->changed) changed.push_back(g.get());
    tbb::parallel_for(size_t(0), changed.size(), [&](size_t i) { buildGeometry(*changed[i]); });
    check("building geometry");
    if (_instancesChanged) buildTop();
    check("building the top level");
}

} // namespace hipr
