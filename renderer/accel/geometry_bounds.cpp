#include "renderer/accel/geometry_bounds.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace hipr {
namespace {

constexpr size_t GRAIN = 32768;

} // namespace

Bounds triangleBounds(const GeometryView& view, uint32_t triangle) {
    Bounds b;
    for (uint32_t key = 0; key < view.keys; ++key)
        for (int k = 0; k < 3; ++k)
            b.add(view.positions[key * size_t(view.vertexCount) + view.triangles[triangle][k]]);
    return b;
}

std::vector<Bounds> triangleBoxes(const GeometryView& view) {
    std::vector<Bounds> boxes(view.triangleCount);
    tbb::parallel_for(tbb::blocked_range<uint32_t>(0, view.triangleCount, GRAIN), [&](const auto& range) {
        for (uint32_t i = range.begin(); i < range.end(); ++i)
            boxes[i] = triangleBounds(view, i);
    });
    return boxes;
}

Bounds geometryBounds(const GeometryView& view) {
    return tbb::parallel_reduce(
        tbb::blocked_range<uint32_t>(0, view.triangleCount, GRAIN), Bounds{},
        [&](const auto& range, Bounds b) {
            for (uint32_t i = range.begin(); i < range.end(); ++i)
                b.add(triangleBounds(view, i));
            return b;
        },
        [](Bounds a, const Bounds& b) {
            a.add(b);
            return a;
        });
}

} // namespace hipr
