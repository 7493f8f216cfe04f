#include "renderer/accel/geometry_bounds.h"

#include "shaders/shared/segment.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace hipr {
namespace {

constexpr size_t GRAIN = 32768;

Bounds primitiveBounds(const GeometryView& view, uint32_t primitive) {
    Bounds b;
    for (uint32_t key = 0; key < view.keys; ++key)
        b.add(cornersBox(view, cornersOf(view, primitive, key)));
    return b;
}

} // namespace

Corners cornersOf(const GeometryView& view, uint32_t primitive, uint32_t key) {
    const glm::vec3* positions = view.positions + key * size_t(view.vertexCount);
    if (view.segments) {
        const uint32_t i = view.segments[primitive];
        return {positions[i], positions[i + 1], {view.radii[i], view.radii[i + 1], 0.0f}};
    }
    const glm::uvec3& t = view.triangles[primitive];
    return {positions[t.x], positions[t.y], positions[t.z]};
}

Bounds cornersBox(const GeometryView& view, const Corners& corners) {
    const auto& [a, b, c] = corners;
    if (view.segments) return {gpu::segmentLo(a, b, c.x, c.y), gpu::segmentHi(a, b, c.x, c.y)};
    Bounds box;
    for (const glm::vec3& corner : corners)
        box.add(corner);
    return box;
}

std::vector<Bounds> primitiveBoxes(const GeometryView& view) {
    std::vector<Bounds> boxes(view.triangleCount);
    tbb::parallel_for(tbb::blocked_range<uint32_t>(0, view.triangleCount, GRAIN), [&](const auto& range) {
        for (uint32_t i = range.begin(); i < range.end(); ++i)
            boxes[i] = primitiveBounds(view, i);
    });
    return boxes;
}

Bounds geometryBounds(const GeometryView& view) {
    return tbb::parallel_reduce(
        tbb::blocked_range<uint32_t>(0, view.triangleCount, GRAIN), Bounds{},
        [&](const auto& range, Bounds b) {
            for (uint32_t i = range.begin(); i < range.end(); ++i)
                b.add(primitiveBounds(view, i));
            return b;
        },
        [](Bounds a, const Bounds& b) {
            a.add(b);
            return a;
        });
}

} // namespace hipr
