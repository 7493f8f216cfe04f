#include "testenv/bench/bare_embree.h"

#include <immintrin.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "testenv/bench/statistics.h"

namespace hipr::bench {

namespace {

template <class Trace> void forEachRay(const std::vector<gpu::Ray>& rays, const Trace& trace) {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, rays.size(), 256), [&](const auto& range) {
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON); // as Embree's manual asks for
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
        for (size_t i = range.begin(); i < range.end(); ++i)
            trace(i, rays[i]);
    });
}

RTCRay embreeRay(const gpu::Ray& r) {
    return {r.origin.x, r.origin.y, r.origin.z, r.tMin, r.direction.x, r.direction.y, r.direction.z, 0.f,
            r.tMax,     ~0u,        0,          0};
}

} // namespace

BareEmbree::BareEmbree(const TriangleMesh& mesh)
    : _device(rtcNewDevice(nullptr)), _scene(rtcNewScene(_device)) {
    const RTCGeometry geometry = rtcNewGeometry(_device, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree loads 16 bytes per point, so it gets a copy with padding.
    auto* points = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
    std::copy(mesh.positions.begin(), mesh.positions.end(), points);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                               sizeof(glm::uvec3), mesh.triangles.size());
    _buildSeconds = timed([&] {
                        rtcCommitGeometry(geometry);
                        rtcAttachGeometry(_scene, geometry);
                        rtcCommitScene(_scene);
                    }).clock;
    rtcReleaseGeometry(geometry);
}

BareEmbree::~BareEmbree() {
    rtcReleaseScene(_scene);
    rtcReleaseDevice(_device);
}

void BareEmbree::nearest(const std::vector<gpu::Ray>& rays, std::vector<gpu::Hit>& hits) const {
    forEachRay(rays, [&](size_t i, const gpu::Ray& ray) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit rh;
        rh.ray = embreeRay(ray);
        rh.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(_scene, &context, &rh);
        const bool hit = rh.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        hits[i] = {hit ? 0u : gpu::NO_INDEX, rh.hit.primID, rh.ray.tfar, rh.hit.u, rh.hit.v};
    });
}

void BareEmbree::occluded(const std::vector<gpu::Ray>& rays, std::vector<uint32_t>& blocked) const {
    forEachRay(rays, [&](size_t i, const gpu::Ray& ray) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRay r = embreeRay(ray);
        rtcOccluded1(_scene, &context, &r);
        blocked[i] = r.tfar < 0.f ? 1 : 0;
    });
}

} // namespace hipr::bench
