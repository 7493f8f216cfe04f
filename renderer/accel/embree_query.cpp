#include "renderer/accel/embree_query.h"

#include <cmath>
#include <limits>

#include "shaders/shared/intersect.h"

namespace hipr {
namespace {

/// Embree's distances differ from canonical ones by rounding; its interval is kept this much longer.
constexpr float LOOSENED = 1.0f + 8.0f * gpu::BOX_ALLOWANCE;
/// Radius in which neighbours are looked for, in allowances.
constexpr float NEIGHBOURHOOD = 2.0f * gpu::EDGE_RADIUS;

/// One ray on its way; Embree hands the context through to every callback.
struct Query {
    RTCIntersectContext context; // first: callbacks cast back
    const EmbreeScene* scene;
    gpu::Ray ray;
    gpu::BoxRay worldBox;
    uint32_t mask;
    gpu::Hit best;
    bool besideEdge = false; ///< of `best`: another triangle may share the point
    float turnedDown =
        std::numeric_limits<float>::infinity(); ///< nearest candidate the canonical test did not confirm

    // The instance being traversed, and the ray in its space.
    uint32_t instance = gpu::NO_INDEX;
    glm::vec3 direction;
    gpu::TriangleRay triangleRay;
    gpu::BoxRay box;
    float allowance;
    float entry, exit;

    Query(const EmbreeScene& s, const gpu::Ray& r, uint32_t m)
        : scene(&s), ray(r), worldBox(gpu::boxRay(r.origin, r.direction, s.table().extent)),
          mask(m), best{gpu::NO_INDEX, gpu::NO_INDEX, r.tMax, 0.0f, 0.0f} {
        rtcInitIntersectContext(&context);
    }

    bool enter(uint32_t index);
    bool consider(const GeometryView& g, uint32_t primitive, float proposed);
    bool found() const { return best.instance != gpu::NO_INDEX; }
};

/// Moves to an instance; false when the ray's mask or the canonical box rule it out.
bool Query::enter(uint32_t index) {
    const gpu::BvhInstance& record = scene->table().records[index];
    if (!(record.mask & mask)) return false;
    gpu::boxInterval(worldBox, record.lo, record.hi, entry, exit);
    if (!(std::max(entry, ray.tMin) <= std::min(exit, best.t))) return false;
    instance = index;
    const glm::vec3 origin = gpu::mapPoint(record.worldToObject, ray.origin);
    direction = gpu::mapDirection(record.worldToObject, ray.direction);
    triangleRay = gpu::triangleRay(origin, direction);
    box = gpu::boxRay(origin, direction, record.extent);
    allowance = gpu::rayAllowance(origin, record.extent);
    return true;
}

/// Tests one triangle of the current instance; true when it is the best hit so far. `proposed` is Embree's
/// distance.
bool Query::consider(const GeometryView& g, uint32_t primitive, float proposed) {
    const glm::uvec3 i = g.triangles[primitive];
    const glm::vec3 &a = g.positions[i.x], &b = g.positions[i.y], &c = g.positions[i.z];
    float t, u, v;
    if (!gpu::canonicalHit(triangleRay, box, a, b, c, entry, exit, t, u, v)) {
        turnedDown = std::min(turnedDown, proposed);
        return false;
    }
    if (!(t > ray.tMin) || !gpu::before(t, instance, primitive, best.t, best.instance, best.primitive))
        return false;
    best = {instance, primitive, t, u, v};
    besideEdge = gpu::besideEdge(direction, allowance, a, b, c, u, v);
    return true;
}

RTCRay embreeRay(const glm::vec3& o, const glm::vec3& d, float tMin, float tMax) {
    return {o.x, o.y, o.z, tMin, d.x, d.y, d.z, 0.0f, tMax, ~0u, 0, 0};
}

// Callbacks see packets of one, because only rtcIntersect1 and rtcOccluded1 are used.

void filterIntersect(const RTCFilterFunctionNArguments* args) {
    Query& q = *reinterpret_cast<Query*>(args->context);
    const auto& g = *static_cast<const EmbreeGeometry*>(args->geometryUserPtr);
    RTCRay& ray = *reinterpret_cast<RTCRay*>(args->ray);
    const auto& hit = *reinterpret_cast<const RTCHit*>(args->hit);
    if (q.consider(g.view, hit.primID, ray.tfar))
        ray.tfar = q.best.t * LOOSENED;
    else
        args->valid[0] = 0;
}

void filterOccluded(const RTCFilterFunctionNArguments* args) {
    Query& q = *reinterpret_cast<Query*>(args->context);
    const auto& g = *static_cast<const EmbreeGeometry*>(args->geometryUserPtr);
    const auto& ray = *reinterpret_cast<const RTCRay*>(args->ray);
    const auto& hit = *reinterpret_cast<const RTCHit*>(args->hit);
    if (!q.consider(g.view, hit.primID, ray.tfar)) args->valid[0] = 0;
}

void intersectInstance(const RTCIntersectFunctionNArguments* args) {
    Query& q = *reinterpret_cast<Query*>(args->context);
    if (!args->valid[0] || !q.enter(args->primID)) return;
    auto& outer = *reinterpret_cast<RTCRayHit*>(args->rayhit);
    RTCRayHit inner;
    inner.ray = embreeRay(q.triangleRay.origin, q.direction, q.ray.tMin, outer.ray.tfar);
    inner.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(q.scene->geometryOf(args->primID).scene, &q.context, &inner);
    outer.ray.tfar = inner.ray.tfar;
}

void occludedInstance(const RTCOccludedFunctionNArguments* args) {
    Query& q = *reinterpret_cast<Query*>(args->context);
    if (!args->valid[0] || !q.enter(args->primID)) return;
    auto& outer = *reinterpret_cast<RTCRay*>(args->ray);
    RTCRay inner = embreeRay(q.triangleRay.origin, q.direction, q.ray.tMin, outer.tfar);
    rtcOccluded1(q.scene->geometryOf(args->primID).scene, &q.context, &inner);
    outer.tfar = inner.tfar;
}

bool nearTriangle(RTCPointQueryFunctionArguments* args) {
    Query& q = *static_cast<Query*>(args->userPtr);
    q.consider(q.scene->geometryOf(q.instance).view, args->primID, std::numeric_limits<float>::infinity());
    return false;
}

RTCPointQuery around(const glm::vec3& p, float radius) {
    return {p.x, p.y, p.z, 0.0f, radius};
}

struct Neighbourhood {
    Query* query;
    float t;
};

bool nearInstance(RTCPointQueryFunctionArguments* args) {
    const auto& n = *static_cast<Neighbourhood*>(args->userPtr);
    Query& q = *n.query;
    if (!q.enter(args->primID)) return false;
    RTCPointQuery point = around(q.triangleRay.origin + n.t * q.direction, NEIGHBOURHOOD * q.allowance);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(q.scene->geometryOf(args->primID).scene, &point, &context, nearTriangle, &q);
    return false;
}

/// Considers every triangle around distance t.
void considerAround(Query& q, float t) {
    const glm::vec3 p = q.ray.origin + t * q.ray.direction;
    const float radius = NEIGHBOURHOOD * gpu::rayAllowance(q.ray.origin, q.scene->table().extent);
    RTCPointQuery point = around(p, radius);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    Neighbourhood n{&q, t};
    rtcPointQuery(q.scene->top(), &point, &context, nearInstance, &n);
}

} // namespace

EmbreeCallbacks embreeCallbacks() {
    return {intersectInstance, occludedInstance, filterIntersect, filterOccluded};
}

gpu::Hit embreeNearest(const EmbreeScene& scene, const gpu::Ray& ray, uint32_t mask) {
    if (!gpu::traceable(ray.origin, ray.direction, ray.tMin, ray.tMax))
        return {gpu::NO_INDEX, gpu::NO_INDEX, ray.tMax, 0.0f, 0.0f};
    Query q(scene, ray, mask);
    RTCRayHit outer;
    outer.ray = embreeRay(ray.origin, ray.direction, ray.tMin, ray.tMax * LOOSENED);
    outer.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene.top(), &q.context, &outer);
    if (q.turnedDown <= q.best.t * LOOSENED && std::isfinite(q.turnedDown)) considerAround(q, q.turnedDown);
    if (q.besideEdge) considerAround(q, q.best.t);
    return q.best;
}

bool embreeOccluded(const EmbreeScene& scene, const gpu::Ray& ray, uint32_t mask) {
    if (!gpu::traceable(ray.origin, ray.direction, ray.tMin, ray.tMax)) return false;
    Query q(scene, ray, mask);
    RTCRay outer = embreeRay(ray.origin, ray.direction, ray.tMin, ray.tMax * LOOSENED);
    rtcOccluded1(scene.top(), &q.context, &outer);
    if (!q.found() && q.turnedDown <= ray.tMax * LOOSENED && std::isfinite(q.turnedDown))
        considerAround(q, q.turnedDown);
    return q.found();
}

} // namespace hipr
