#include "renderer/geometry/refiner.h"

#include <algorithm>

namespace hipr::geometry {

namespace {

constexpr int EndOfList = -1;

/// Whether two authored corners at one vertex carry the same value.
bool shareValue(const PrimvarView& view, uint32_t corner, uint32_t other) {
    if (view.indices) return view.indices[corner] == view.indices[other];
    return std::equal(view.at(corner), view.at(corner) + view.components, view.at(other));
}

} // namespace

FaceVaryingTopology connectFaceVarying(const Cage& cage, const PrimvarView& view) {
    FaceVaryingTopology topology;
    topology.cornerValue.resize(cage.polygons.vertex.size());
    // A linked list per vertex of the values met there so far: short, as it has one entry per seam side.
    const uint32_t vertices =
        cage.polygons.vertex.empty()
            ? 0
            : 1 + *std::max_element(cage.polygons.vertex.begin(), cage.polygons.vertex.end());
    std::vector<int> firstValue(vertices, EndOfList), nextValue;
    for (uint32_t corner = 0; corner < topology.cornerValue.size(); ++corner) {
        int& first = firstValue[cage.polygons.vertex[corner]];
        int value = first;
        while (value != EndOfList &&
               !shareValue(view, cage.cornerSource[topology.representative[size_t(value)]],
                           cage.cornerSource[corner])) {
            value = nextValue[size_t(value)];
        }
        if (value == EndOfList) {
            value = int(topology.representative.size());
            topology.representative.push_back(corner);
            nextValue.push_back(first);
            first = value;
        }
        topology.cornerValue[corner] = value;
    }
    return topology;
}

} // namespace hipr::geometry
