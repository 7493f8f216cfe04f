#include "renderer/geometry/primvars.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace hipr::geometry {

namespace {

constexpr size_t ElementsPerTask = 16384;

/// Copies element elementOf(i) of the view to place i, for i < count.
template <typename ElementOf>
std::vector<float> gather(const PrimvarView& view, size_t count, const ElementOf& elementOf) {
    const size_t n = view.components;
    std::vector<float> values(count * n);
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, ElementsPerTask), [&](const auto& range) {
        for (size_t i = range.begin(); i < range.end(); ++i) {
            std::copy_n(view.at(elementOf(i)), n, values.data() + i * n);
        }
    });
    return values;
}

} // namespace

TrianglePrimvar expandPrimvar(const PrimvarView& view, const Triangulation& triangulation,
                              const std::vector<uint32_t>& cornerElement,
                              const std::vector<uint32_t>& faceElement, size_t vertexCount) {
    TrianglePrimvar out{view.name, view.interpolation, view.components, {}};
    switch (view.interpolation) {
    case Interpolation::Constant:
        out.values = gather(view, 1, [](size_t) { return 0; });
        break;
    case Interpolation::Uniform:
        out.values = gather(view, faceElement.size(), [&](size_t t) { return faceElement[t]; });
        break;
    case Interpolation::Vertex:
        out.values = gather(view, vertexCount, [](size_t v) { return v; });
        break;
    case Interpolation::FaceVarying:
        out.values = gather(view, triangulation.corners.size() * 3, [&](size_t i) {
            const uint32_t corner = triangulation.corners[i / 3][int(i % 3)];
            return cornerElement.empty() ? corner : cornerElement[corner];
        });
        break;
    }
    return out;
}

} // namespace hipr::geometry
