#include "renderer/accel/embree_query.h"

#include <cmath>
#include <limits>
#include <vector>

#include "renderer/accel/geometry_bounds.h"
#include "shaders/shared/segment.h"

namespace hipr {
namespace {

/// Embree's distances differ from canonical ones by rounding of the distance and of the origin: intervals are
/// kept this much longer, and by an allowance.
constexpr float LOOSENED = 1.0f + 8.0f * gpu::BOX_ALLOWANCE;
/// Radius in which neighbours are looked for, in allowances.
constexpr float NEIGHBOURHOOD = 4.0f;

struct Proposal {
    uint32_t instance, primitive;
    float t; ///< Embree's
};

/// Proposals at Embree's nearest distance, give or take rounding.
struct Proposals {
    static constexpr uint32_t CAPACITY = 8;
    Proposal all[CAPACITY];
    uint32_t count = 0;
    bool overflow = false;
    float nearest = std::numeric_limits<float>::infinity();

    void add(const Proposal& p, float slack) {
        if (p.t * LOOSENED + slack < nearest) count = 0, overflow = false; // all others are behind
        nearest = std::min(nearest, p.t);
        if (count < CAPACITY)
            all[count++] = p;
        else
            overflow = true;
    }
};

/// One ray on its way; Embree hands the context through to every callback.
struct Query {
    RTCIntersectContext context; // first: callbacks cast back
    const EmbreeScene* scene;
    gpu::Ray ray;
    uint32_t mask;
    float slack; ///< see loosened()
    gpu::Hit best;
    bool onEdge = false; ///< of `best`
    float turnedDown =
        std::numeric_limits<float>::infinity(); ///< nearest proposal the canonical test did not confirm
    bool passedOne = false; ///< a proposal was on a side that the ray passes: it may hide others
    bool collecting = true; ///< proposals are tested at the end, not on the way
    Proposals proposals;

    // The instance being traversed, and the ray in its space.
    uint32_t instance = gpu::NO_INDEX;
    glm::vec3 origin, direction;

    // What canonical tests need; only made for instances with something to test.
    uint32_t prepared = gpu::NO_INDEX;
    gpu::TriangleRay triangleRay;
    gpu::SegmentRay segmentRay;
    gpu::BoxRay box;
    float entry, exit;
    uint32_t passed; ///< sides of faces, see gpu::passedSides()

    Query(const EmbreeScene& s, const gpu::Ray& r, uint32_t m)
        : scene(&s), ray(r), mask(m),
          slack(gpu::rayAllowance(r.origin, s.table().extent)), best{gpu::NO_INDEX, gpu::NO_INDEX, r.tMax,
                                                                     0.0f, 0.0f} {
        rtcInitIntersectContext(&context);
    }

    bool enter(uint32_t index);
    void prepare();
    bool consider(uint32_t primitive, float proposed);
    Corners cornersNow(const GeometryView& view, uint32_t primitive) const;
    bool found() const { return best.instance != gpu::NO_INDEX; }
    /// Start of Embree's interval; it does not take negative ones.
    float start() const { return std::max(0.0f, ray.tMin - slack); }
    float loosened(float t) const { return t * LOOSENED + slack; }
    bool doubtful() const {
        return onEdge || passedOne || turnedDown <= loosened(best.t) || proposals.overflow;
    }
};

/// Moves to an instance; false when the ray does not see it.
bool Query::enter(uint32_t index) {
    if (instance == index) return true;
    const gpu::BvhInstance& record = scene->table().records[index];
    if (!(record.mask & mask)) return false;
    instance = index;
    const glm::mat4x3 toObject = worldToObject(record, scene->table().keys.data(), ray.time);
    origin = gpu::mapPoint(toObject, ray.origin);
    direction = gpu::mapDirection(toObject, ray.direction);
    return true;
}

void Query::prepare() {
    if (prepared == instance) return;
    prepared = instance;
    const gpu::BvhInstance& record = scene->table().records[instance];
    gpu::boxInterval(gpu::boxRay(ray.origin, ray.direction, scene->table().extent), record.lo, record.hi,
                     entry, exit);
    if (record.segments)
        segmentRay = gpu::segmentRay(origin, direction);
    else
        triangleRay = gpu::triangleRay(origin, direction);
    box = gpu::boxRay(origin, direction, record.extent);
    passed = gpu::passedSides(record.culled, ray.flags);
}

/// A triangle or segment at the time of the ray.
Corners Query::cornersNow(const GeometryView& view, uint32_t primitive) const {
    if (view.keys == 1) return cornersOf(view, primitive, 0);
    const gpu::KeyTime at = gpu::keyTime(ray.time, view.keys);
    Corners corners = cornersOf(view, primitive, at.first);
    const Corners next = cornersOf(view, primitive, at.first + 1);
    for (size_t k = 0; k < corners.size(); ++k)
        corners[k] = gpu::mixKeys(corners[k], next[k], at.weight);
    return corners;
}

/// Tests one triangle or segment of the current instance; true when it is the best hit so far. `proposed` is
/// Embree's distance.
bool Query::consider(uint32_t primitive, float proposed) {
    prepare();
    const GeometryView& g = scene->geometryOf(instance).view;
    const auto [a, b, c] = cornersNow(g, primitive);
    float t, u, v;
    bool front = true;
    const bool met = g.segments
                         ? gpu::canonicalSegmentHit(segmentRay, box, a, b, c.x, c.y, entry, exit, t, u, v)
                         : gpu::canonicalHit(triangleRay, box, a, b, c, entry, exit, t, u, v, front);
    if (met && gpu::passesSide(passed, front)) {
        passedOne = true;
        return false;
    }
    if (!met) {
        turnedDown = std::min(turnedDown, proposed);
        return false;
    }
    if (!(t > ray.tMin) || !gpu::before(t, instance, primitive, best.t, best.instance, best.primitive))
        return false;
    best = {instance, primitive, t, u, v};
    onEdge = !g.segments && gpu::onEdge(u, v);
    return true;
}

RTCRay embreeRay(const glm::vec3& o, const glm::vec3& d, float tMin, float tMax, float time) {
    return {o.x, o.y, o.z, tMin, d.x, d.y, d.z, time, tMax, ~0u, 0, 0};
}

// Callbacks see packets of one, because only rtcIntersect1 and rtcOccluded1 are used.

void filterIntersect(const RTCFilterFunctionNArguments* args) {
    Query& q = *reinterpret_cast<Query*>(args->context);
    RTCRay& ray = *reinterpret_cast<RTCRay*>(args->ray);
    const uint32_t primitive = reinterpret_cast<const RTCHit*>(args->hit)->primID;
    if (q.collecting) {
        q.proposals.add({q.instance, primitive, ray.tfar}, q.slack);
        ray.tfar = q.loosened(q.proposals.nearest);
    } else if (q.consider(primitive, ray.tfar)) {
        ray.tfar = q.loosened(q.best.t);
    } else {
        args->valid[0] = 0;
    }
}

void filterOccluded(const RTCFilterFunctionNArguments* args) {
    Query& q = *reinterpret_cast<Query*>(args->context);
    const float t = reinterpret_cast<const RTCRay*>(args->ray)->tfar;
    const uint32_t primitive = reinterpret_cast<const RTCHit*>(args->hit)->primID;
    if (q.collecting)
        q.proposals.add({q.instance, primitive, t}, q.slack);
    else if (!q.consider(primitive, t))
        args->valid[0] = 0;
}

// Segments are tested at once, with nothing left to doubt: Embree only finds their boxes.

void intersectSegment(const RTCIntersectFunctionNArguments* args) {
    if (!args->valid[0]) return;
    Query& q = *reinterpret_cast<Query*>(args->context);
    float& tFar = reinterpret_cast<RTCRayHit*>(args->rayhit)->ray.tfar;
    if (q.consider(args->primID, std::numeric_limits<float>::infinity()))
        tFar = std::min(tFar, q.loosened(q.best.t));
}

void occludedSegment(const RTCOccludedFunctionNArguments* args) {
    if (!args->valid[0]) return;
    Query& q = *reinterpret_cast<Query*>(args->context);
    if (q.consider(args->primID, std::numeric_limits<float>::infinity()))
        reinterpret_cast<RTCRay*>(args->ray)->tfar = -std::numeric_limits<float>::infinity();
}

/// Traces the ray through one instance; `tFar` is Embree's interval, updated.
void intersectOne(Query& q, uint32_t instance, float& tFar) {
    if (!q.enter(instance)) return;
    RTCRayHit inner;
    inner.ray = embreeRay(q.origin, q.direction, q.start(), tFar, q.ray.time);
    inner.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(q.scene->geometryOf(instance).scene, &q.context, &inner);
    tFar = inner.ray.tfar;
}

void occludedOne(Query& q, uint32_t instance, float& tFar) {
    if (!q.enter(instance)) return;
    RTCRay inner = embreeRay(q.origin, q.direction, q.start(), tFar, q.ray.time);
    rtcOccluded1(q.scene->geometryOf(instance).scene, &q.context, &inner);
    tFar = inner.tfar;
}

void intersectInstance(const RTCIntersectFunctionNArguments* args) {
    if (!args->valid[0]) return;
    intersectOne(*reinterpret_cast<Query*>(args->context), args->primID,
                 reinterpret_cast<RTCRayHit*>(args->rayhit)->ray.tfar);
}

void occludedInstance(const RTCOccludedFunctionNArguments* args) {
    if (!args->valid[0]) return;
    occludedOne(*reinterpret_cast<Query*>(args->context), args->primID,
                reinterpret_cast<RTCRay*>(args->ray)->tfar);
}

/// Walks the whole scene; the top level only when there is something to choose from.
void intersectAll(Query& q) {
    RTCRayHit outer;
    outer.ray = embreeRay(q.ray.origin, q.ray.direction, q.start(), q.loosened(q.ray.tMax), q.ray.time);
    outer.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    if (q.scene->table().records.size() == 1)
        intersectOne(q, 0, outer.ray.tfar);
    else
        rtcIntersect1(q.scene->top(), &q.context, &outer);
}

void occludedAll(Query& q) {
    RTCRay outer = embreeRay(q.ray.origin, q.ray.direction, q.start(), q.loosened(q.ray.tMax), q.ray.time);
    if (q.scene->table().records.size() == 1)
        occludedOne(q, 0, outer.tfar);
    else
        rtcOccluded1(q.scene->top(), &q.context, &outer);
}

RTCPointQuery around(const glm::vec3& p, float radius, float time) {
    return {p.x, p.y, p.z, time, radius};
}

bool nearTriangle(RTCPointQueryFunctionArguments* args) {
    Query& q = *static_cast<Query*>(args->userPtr);
    q.consider(args->primID, std::numeric_limits<float>::infinity());
    return false;
}

struct Neighbourhood {
    Query* query;
    float t;
};

bool nearInstance(RTCPointQueryFunctionArguments* args) {
    const auto& n = *static_cast<Neighbourhood*>(args->userPtr);
    Query& q = *n.query;
    if (!q.enter(args->primID)) return false;
    const glm::vec3& origin = q.origin;
    const float radius =
        NEIGHBOURHOOD * gpu::rayAllowance(origin, q.scene->table().records[args->primID].extent);
    RTCPointQuery point = around(q.origin + n.t * q.direction, radius, q.ray.time);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(q.scene->geometryOf(args->primID).scene, &point, &context, nearTriangle, &q);
    return false;
}

/// Considers every triangle around distance t.
void considerAround(Query& q, float t) {
    const float radius = NEIGHBOURHOOD * gpu::rayAllowance(q.ray.origin, q.scene->table().extent);
    RTCPointQuery point = around(q.ray.origin + t * q.ray.direction, radius, q.ray.time);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    Neighbourhood n{&q, t};
    rtcPointQuery(q.scene->top(), &point, &context, nearInstance, &n);
}

/// Tests what was collected.
void considerProposals(Query& q) {
    for (uint32_t i = 0; i < q.proposals.count; ++i) {
        const Proposal& p = q.proposals.all[i];
        if (p.t <= q.loosened(q.proposals.nearest) && q.enter(p.instance)) q.consider(p.primitive, p.t);
    }
    q.collecting = false;
}

gpu::Hit decideNearest(Query& q) {
    if (q.proposals.count == 0) return q.best;
    considerProposals(q);
    if (q.found() && !q.doubtful()) return q.best;
    intersectAll(q);
    if (q.turnedDown <= q.loosened(q.best.t) && std::isfinite(q.turnedDown)) considerAround(q, q.turnedDown);
    if (q.onEdge) considerAround(q, q.best.t);
    return q.best;
}

bool decideOccluded(Query& q) {
    if (q.proposals.count == 0) return q.found();
    considerProposals(q);
    if (q.found()) return true;
    occludedAll(q);
    if (!q.found() && std::isfinite(q.turnedDown)) considerAround(q, q.turnedDown);
    return q.found();
}

void prefetchTriangle(const Query& q) {
    for (uint32_t i = 0; i < q.proposals.count; ++i) {
        const Proposal& p = q.proposals.all[i];
        __builtin_prefetch(&q.scene->geometryOf(p.instance).view.triangles[p.primitive]);
    }
}

void prefetchCorners(const Query& q) {
    for (uint32_t i = 0; i < q.proposals.count; ++i) {
        const Proposal& p = q.proposals.all[i];
        const GeometryView& g = q.scene->geometryOf(p.instance).view;
        for (int k = 0; k < 3; ++k)
            __builtin_prefetch(&g.positions[g.triangles[p.primitive][k]]);
    }
}

/// Collects proposals for some rays with `walk`, then lets `decide` test them.
template <class Walk, class Decide>
void inBatches(const EmbreeScene& scene, uint32_t mask, const gpu::Ray* rays, uint32_t count,
               const Walk& walk, const Decide& decide) {
    constexpr uint32_t BATCH = 32;
    constexpr size_t LEAD = 2; // rays until the second prefetch may read what the first one fetched
    std::vector<Query> batch;
    batch.reserve(BATCH);
    for (uint32_t first = 0; first < count; first += BATCH) {
        batch.clear();
        for (uint32_t i = first; i < std::min(first + BATCH, count); ++i) {
            Query& q = batch.emplace_back(scene, rays[i], mask);
            if (gpu::traceable(q.ray.origin, q.ray.direction, q.start(), q.ray.tMax)) walk(q);
            prefetchTriangle(q);
            if (batch.size() > LEAD) prefetchCorners(batch[batch.size() - 1 - LEAD]);
        }
        for (uint32_t i = 0; i < batch.size(); ++i)
            decide(first + i, batch[i]);
    }
}

} // namespace

EmbreeCallbacks embreeCallbacks() {
    return {intersectInstance, occludedInstance, filterIntersect,
            filterOccluded,    intersectSegment, occludedSegment};
}

void embreeNearest(const EmbreeScene& scene, uint32_t mask, const gpu::Ray* rays, uint32_t count,
                   gpu::Hit* hits) {
    inBatches(scene, mask, rays, count, intersectAll,
              [&](uint32_t i, Query& q) { hits[i] = decideNearest(q); });
}

void embreeOccluded(const EmbreeScene& scene, uint32_t mask, const gpu::Ray* rays, uint32_t count,
                    uint32_t* blocked) {
    inBatches(scene, mask, rays, count, occludedAll,
              [&](uint32_t i, Query& q) { blocked[i] = decideOccluded(q) ? 1u : 0u; });
}

} // namespace hipr
