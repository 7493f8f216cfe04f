#include "renderer/accel/instance_table.h"

#include <cmath>

#include "shaders/shared/intersect.h"
#include "shaders/shared/queue.h"

namespace hipr {
namespace {

struct Placement {
    glm::dmat3 linear;
    glm::dvec3 offset;
};

Placement placement(const glm::mat4x3& m) {
    return {glm::dmat3(m[0], m[1], m[2]), glm::dvec3(m[3])};
}

glm::dmat3 absolute(const glm::dmat3& m) {
    return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

bool finite(const glm::mat4x3& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}

/// Largest float not above, or smallest not below: rounding outwards.
glm::vec3 roundedDown(const glm::dvec3& v) {
    glm::vec3 f(v);
    for (int a = 0; a < 3; ++a)
        if (double(f[a]) > v[a]) f[a] = std::nextafter(f[a], std::numeric_limits<float>::lowest());
    return f;
}

struct WorldBox {
    glm::dvec3 centre, half;
};

WorldBox worldBox(const Placement& p, const Bounds& b) {
    const glm::dvec3 lo(b.lo), hi(b.hi);
    return {p.linear * ((lo + hi) * 0.5) + p.offset, absolute(p.linear) * ((hi - lo) * 0.5)};
}

/// Rounding of the inverse of a placement applied to a ray of world size `extent`, brought back to world
/// space.
glm::dvec3 margin(const Placement& out, const Placement& in, const Bounds& b, double extent) {
    const glm::dvec3 moved =
        absolute(in.linear) * glm::dvec3(extent) + glm::abs(in.offset) + double(b.extent());
    return double(gpu::BOX_ALLOWANCE) * (absolute(out.linear) * moved + glm::abs(out.offset));
}

Placement inverse(const Placement& p) {
    const glm::dmat3 linear = glm::inverse(p.linear);
    return {linear, -(linear * p.offset)};
}

bool usable(const gpu::InstanceRecord& i) {
    return finite(i.objectToWorld) && finite(i.worldToObject) &&
           glm::determinant(placement(i.worldToObject).linear) != 0.0;
}

/// Inverses of placements between keys are made for every ray, of rounded numbers: this much rounds more.
constexpr double MovingMargin = 4.0;

/// Calls visit(placement, its inverse, factor of its margin) for every place an instance has a key for.
template <class Visit>
void forPlaces(const gpu::InstanceRecord& instance, const std::vector<glm::mat4x3>& keys,
               const Visit& visit) {
    if (instance.keyCount == 0)
        return visit(placement(instance.objectToWorld), placement(instance.worldToObject), 1.0);
    for (uint32_t k = 0; k < instance.keyCount; ++k) {
        const Placement out = placement(keys[instance.firstKey + k]);
        visit(out, inverse(out), MovingMargin);
    }
}

} // namespace

InstanceTable makeInstanceTable(const InstanceView& view,
                                const std::function<SlotShape(uint32_t slot)>& shapeOf) {
    const std::vector<gpu::InstanceRecord>& instances = view.records;
    InstanceTable table;
    table.keys = view.keys;
    table.records.resize(instances.size());
    double extent = 0.0;
    for (size_t i = 0; i < instances.size(); ++i) {
        const gpu::InstanceRecord& instance = instances[i];
        gpu::BvhInstance& record = table.records[i];
        record = {};
        record.worldToObject = instance.worldToObject;
        const SlotShape shape = shapeOf(instance.geometry);
        const Bounds& b = shape.bounds;
        if (b.empty() || !usable(instance)) continue;
        record.extent = b.extent();
        record.mask =
            instance.flags & gpu::INSTANCE_NON_OPAQUE ? gpu::RAY_MASK_NON_OPAQUE : gpu::RAY_MASK_OPAQUE;
        record.firstKey = instance.firstKey;
        record.keyCount = instance.keyCount;
        record.geometryKeys = shape.keys;
        record.triangleCount = shape.triangleCount;
        record.segments = shape.segments ? 1 : 0;
        record.culled = instance.flags & gpu::INSTANCE_CULLS;
        table.culls |= record.culled != 0;
        forPlaces(instance, view.keys, [&](const Placement& place, const Placement&, double) {
            const WorldBox w = worldBox(place, b);
            const glm::dvec3 reach = glm::abs(w.centre) + w.half;
            extent = std::max(extent, std::max(reach.x, std::max(reach.y, reach.z)));
        });
    }
    for (size_t i = 0; i < instances.size(); ++i) {
        gpu::BvhInstance& record = table.records[i];
        if (!record.mask) continue;
        const Bounds b = shapeOf(instances[i].geometry).bounds;
        Bounds box;
        forPlaces(instances[i], view.keys, [&](const Placement& place, const Placement& back, double factor) {
            const WorldBox w = worldBox(place, b);
            const glm::dvec3 half = w.half + factor * margin(place, back, b, extent);
            box.add(Bounds{roundedDown(w.centre - half), -roundedDown(-(w.centre + half))});
        });
        record.lo = box.lo;
        record.hi = box.hi;
        table.bounds.add(box);
    }
    table.extent = table.bounds.extent();
    return table;
}

} // namespace hipr
