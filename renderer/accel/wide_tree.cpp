#include "renderer/accel/wide_tree.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include <tbb/parallel_for.h>

#include "renderer/accel/geometry_bounds.h"

namespace hipr {
namespace {

constexpr uint32_t NODE_UNITS = sizeof(WideNode) / sizeof(WideUnit);
constexpr uint32_t LEAF_UNITS = sizeof(WideLeaf) / sizeof(WideUnit);
/// A refitted tree whose boxes grew by this much is built anew.
constexpr double WORN_OUT = 1.4;
constexpr uint32_t PARALLEL_DEPTH = 2; ///< levels of a refit that fan out to threads

WideNode& nodeAt(std::vector<WideUnit>& units, uint32_t index) {
    return reinterpret_cast<WideNode&>(units[index]);
}
WideLeaf& leafAt(std::vector<WideUnit>& units, uint32_t index) {
    return reinterpret_cast<WideLeaf&>(units[index]);
}

void setBox(WideNode& node, uint32_t lane, const Bounds& b) {
    for (int axis = 0; axis < 3; ++axis) {
        node.plane[2 * axis][lane] = b.lo[axis];
        node.plane[2 * axis + 1][lane] = b.hi[axis];
    }
}

WideNode emptyNode() {
    constexpr float inf = std::numeric_limits<float>::infinity();
    WideNode node{};
    for (uint32_t lane = 0; lane < WIDE_CHILDREN; ++lane) {
        setBox(node, lane, {glm::vec3(inf), glm::vec3(-inf)});
        node.child[lane] = WIDE_NOTHING;
    }
    return node;
}

/// Copies corners of a leaf's triangles or segments, for all keys; their box.
Bounds fillLeaf(WideLeaf* leaf, const GeometryView& view, uint32_t count) {
    Bounds box;
    for (uint32_t key = 0; key < view.keys; ++key)
        for (uint32_t lane = 0; lane < count; ++lane) {
            const Corners corners = cornersOf(view, leaf[key].primitive[lane], key);
            box.add(cornersBox(view, corners));
            for (int k = 0; k < 3; ++k)
                for (int axis = 0; axis < 3; ++axis)
                    leaf[key].corner[k][axis][lane] = corners[k][axis];
        }
    return box;
}

constexpr uint32_t NO_PRIMITIVE = ~0u;

WideLeaf emptyLeaf() {
    WideLeaf leaf;
    for (auto& corner : leaf.corner)
        for (auto& axis : corner)
            for (float& lane : axis)
                lane = std::numeric_limits<float>::quiet_NaN();
    for (uint32_t& p : leaf.primitive)
        p = NO_PRIMITIVE;
    return leaf;
}

uint32_t trianglesOf(const WideLeaf& leaf) {
    uint32_t n = 0;
    while (n < WideLeaf::TRIANGLES && leaf.primitive[n] != NO_PRIMITIVE)
        ++n;
    return n;
}

/// A child of a binary tree with its box.
struct Branch {
    uint32_t child;
    Bounds box;
    bool inner() const { return !(child & gpu::BVH_LEAF); }
};

/// Up to eight descendants that together hold everything below a binary node: the largest is opened until
/// there are enough.
struct Branches {
    std::array<Branch, WIDE_CHILDREN> all;
    uint32_t count = 0;

    Branches(const Bvh& bvh, uint32_t node) {
        open(bvh.nodes[node]);
        while (count < WIDE_CHILDREN) {
            uint32_t widest = count;
            for (uint32_t i = 0; i < count; ++i)
                if (all[i].inner() && (widest == count || all[i].box.halfArea() > all[widest].box.halfArea()))
                    widest = i;
            if (widest == count) return;
            const uint32_t opened = all[widest].child;
            all[widest] = all[--count];
            open(bvh.nodes[opened]);
        }
    }
    void open(const gpu::BvhNode& n) {
        all[count++] = {n.child0, {n.lo0, n.hi0}};
        if (n.child1 != gpu::BVH_EMPTY) all[count++] = {n.child1, {n.lo1, n.hi1}};
    }
};

/// Writes the wide form of a binary tree; `leaf(first, count)` returns the reference of a leaf.
template <class MakeLeaf> class Widening {
public:
    Widening(const Bvh& bvh, std::vector<WideUnit>& units, const MakeLeaf& makeLeaf)
        : _bvh(bvh), _units(units), _makeLeaf(makeLeaf) {}

    /// Returns the index of the node; adds the areas of its children to `area`.
    uint32_t widen(uint32_t node, double& area) {
        const uint32_t index = uint32_t(_units.size());
        _units.resize(_units.size() + NODE_UNITS);
        const Branches branches(_bvh, node);
        WideNode wide = emptyNode();
        for (uint32_t lane = 0; lane < branches.count; ++lane) {
            const Branch& b = branches.all[lane];
            setBox(wide, lane, b.box);
            area += b.box.halfArea();
            if (!b.inner())
                wide.child[lane] = _makeLeaf(b.child & gpu::BVH_FIRST_MASK,
                                             b.child >> gpu::BVH_COUNT_SHIFT & gpu::BVH_COUNT_MASK);
        }
        for (uint32_t lane = 0; lane < branches.count; ++lane)
            if (branches.all[lane].inner()) wide.child[lane] = widen(branches.all[lane].child, area);
        nodeAt(_units, index) = wide;
        return index;
    }

private:
    const Bvh& _bvh;
    std::vector<WideUnit>& _units;
    const MakeLeaf& _makeLeaf;
};

struct Refit {
    std::vector<WideUnit>& units;
    const GeometryView& view;

    /// The box of a node, after all below it have theirs; adds to `area`.
    Bounds node(uint32_t index, uint32_t depth, double& area) const {
        WideNode& n = nodeAt(units, index);
        std::array<Bounds, WIDE_CHILDREN> boxes;
        std::array<double, WIDE_CHILDREN> areas{};
        auto child = [&](uint32_t lane) {
            const uint32_t c = n.child[lane];
            if (c == WIDE_NOTHING) return;
            boxes[lane] = c & WIDE_LEAF ? leaf(c & ~WIDE_LEAF) : node(c, depth + 1, areas[lane]);
            areas[lane] += boxes[lane].halfArea();
        };
        if (depth < PARALLEL_DEPTH) {
            tbb::parallel_for(0u, WIDE_CHILDREN, child);
        } else {
            for (uint32_t lane = 0; lane < WIDE_CHILDREN; ++lane)
                child(lane);
        }
        Bounds all;
        for (uint32_t lane = 0; lane < WIDE_CHILDREN; ++lane) {
            if (n.child[lane] == WIDE_NOTHING) continue;
            setBox(n, lane, boxes[lane]);
            all.add(boxes[lane]);
            area += areas[lane];
        }
        return all;
    }
    Bounds leaf(uint32_t index) const {
        WideLeaf& l = leafAt(units, index);
        return fillLeaf(&l, view, trianglesOf(l));
    }
};

double relative(double area, const Bounds& root) {
    const double whole = root.halfArea();
    return whole > 0.0 ? area / whole : 0.0;
}

} // namespace

void WideTree::clear() {
    _units = {};
    _bounds = {};
}

void WideTree::build(const GeometryView& view) {
    clear();
    if (view.triangleCount == 0) return;
    BvhOptions options;
    options.maxLeaf = options.block = WideLeaf::TRIANGLES;
    const Bvh bvh = buildBvh(primitiveBoxes(view), options);
    _bounds = bvh.bounds;
    _keys = view.keys;
    _units.reserve(bvh.nodes.size() * (_keys * LEAF_UNITS + 3));
    auto makeLeaf = [&](uint32_t first, uint32_t count) {
        const uint32_t index = uint32_t(_units.size());
        _units.resize(_units.size() + _keys * LEAF_UNITS);
        WideLeaf leaf = emptyLeaf();
        for (uint32_t i = 0; i < count; ++i)
            leaf.primitive[i] = bvh.order[first + i];
        std::fill_n(&leafAt(_units, index), _keys, leaf);
        fillLeaf(&leafAt(_units, index), view, count);
        return index | WIDE_LEAF;
    };
    double area = 0.0;
    Widening(bvh, _units, makeLeaf).widen(0, area);
    if (_units.size() >= WIDE_LEAF) throw std::runtime_error("a mesh has too many triangles for one tree");
    _units.shrink_to_fit();
    _builtArea = relative(area, _bounds);
}

void WideTree::build(const std::vector<Bounds>& boxes, const std::vector<uint32_t>& ids) {
    clear();
    if (boxes.empty()) return;
    const Bvh bvh = buildBvh(boxes, {1, gpu::BVH_MAX_INSTANCE_DEPTH, 1.0f});
    _bounds = bvh.bounds;
    auto makeLeaf = [&](uint32_t first, uint32_t) { return ids[bvh.order[first]] | WIDE_LEAF; };
    double area = 0.0;
    Widening(bvh, _units, makeLeaf).widen(0, area);
}

bool WideTree::refit(const GeometryView& view) {
    if (_units.empty()) return view.triangleCount == 0;
    if (view.keys != _keys) return false;
    double area = 0.0;
    _bounds = Refit{_units, view}.node(0, 0, area);
    return relative(area, _bounds) <= WORN_OUT * _builtArea;
}

} // namespace hipr
