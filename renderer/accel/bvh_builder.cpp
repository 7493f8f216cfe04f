#include "renderer/accel/bvh_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

namespace hipr {
namespace {

constexpr int BIN_COUNT = 16;
constexpr size_t PARALLEL_SUBTREE = 4096;
constexpr size_t PARALLEL_BINNING = 1 << 17;

/// Four floats in one register; the last lane is not used.
using Vec = float __attribute__((vector_size(16)));

Vec least(Vec a, Vec b) {
    return a < b ? a : b;
}
Vec most(Vec a, Vec b) {
    return a > b ? a : b;
}
Vec load(const glm::vec3& v) {
    return Vec{v.x, v.y, v.z, 0.0f};
}
glm::vec3 store(Vec v) {
    return {v[0], v[1], v[2]};
}

struct Box {
    Vec lo, hi;
    static Box none() {
        constexpr float big = std::numeric_limits<float>::max();
        return {Vec{big, big, big, 0.0f}, Vec{-big, -big, -big, 0.0f}};
    }
    void add(const Box& b) {
        lo = least(lo, b.lo);
        hi = most(hi, b.hi);
    }
    float halfArea() const {
        const Vec d = hi - lo;
        return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
    }
};

struct Item {
    Box box;
    uint32_t primitive;
    /// Twice the centroid; the factor does not matter to binning.
    Vec centre() const { return box.lo + box.hi; }
};

struct Extents {
    Box boxes = Box::none(), centres = Box::none();
    void add(const Item& i) {
        boxes.add(i.box);
        const Vec c = i.centre();
        centres.add({c, c});
    }
    void add(const Extents& e) {
        boxes.add(e.boxes);
        centres.add(e.centres);
    }
};

struct Bin {
    Box box = Box::none();
    uint32_t count = 0;
};

/// Maps a centroid to a bin on each axis; axes without a finite positive extent have no bins.
struct BinMap {
    Vec origin, scale;

    explicit BinMap(const Box& centres) : origin(centres.lo) {
        const Vec size = centres.hi - centres.lo;
        for (int a = 0; a < 4; ++a) {
            const float s = a < 3 && size[a] > 0.0f ? BIN_COUNT / size[a] : 0.0f;
            scale[a] = std::isfinite(s) && std::isfinite(size[a]) ? s : 0.0f;
        }
    }
    bool usable(int axis) const { return scale[axis] > 0.0f; }
    int bin(Vec centre, int axis) const {
        const float b = (centre[axis] - origin[axis]) * scale[axis];
        return b < float(BIN_COUNT) ? int(std::max(b, 0.0f)) : BIN_COUNT - 1;
    }
};

struct Bins {
    std::array<std::array<Bin, BIN_COUNT>, 3> axis;
    void add(const Bins& o) {
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < BIN_COUNT; ++b) {
                axis[a][b].box.add(o.axis[a][b].box);
                axis[a][b].count += o.axis[a][b].count;
            }
    }
};

struct Split {
    float cost = std::numeric_limits<float>::infinity(); ///< sum of half area times blocks
    int axis = -1;
    int bin = 0; ///< first bin of the right side
};

uint32_t levelsFor(size_t count, uint32_t maxLeaf) {
    uint32_t levels = 0;
    for (size_t leaves = (count + maxLeaf - 1) / maxLeaf; (size_t(1) << levels) < leaves;)
        ++levels;
    return levels;
}

class Builder {
public:
    Builder(std::vector<Item> items, const BvhOptions& options)
        : _items(std::move(items)), _options(options), _nodes(std::max<size_t>(1, _items.size())) {}

    std::vector<gpu::BvhNode> run(Box* bounds) {
        const Extents e = extents(0, _items.size());
        *bounds = e.boxes;
        const uint32_t root = build(0, _items.size(), 0, _options.maxDepth, e);
        if (root & gpu::BVH_LEAF) setRootLeaf(root, e.boxes);
        return compact(root & gpu::BVH_LEAF ? 0 : root);
    }

    const std::vector<Item>& items() const { return _items; }

private:
    Extents extents(size_t first, size_t last) const {
        auto scan = [&](const tbb::blocked_range<size_t>& r, Extents e) {
            for (size_t i = r.begin(); i < r.end(); ++i)
                e.add(_items[i]);
            return e;
        };
        const tbb::blocked_range<size_t> all(first, last, PARALLEL_BINNING / 4);
        if (last - first < PARALLEL_BINNING) return scan(all, Extents{});
        return tbb::parallel_reduce(all, Extents{}, scan, [](Extents a, const Extents& b) {
            a.add(b);
            return a;
        });
    }

    Bins fillBins(size_t first, size_t last, const BinMap& map) const {
        auto scan = [&](const tbb::blocked_range<size_t>& r, Bins bins) {
            for (size_t i = r.begin(); i < r.end(); ++i) {
                const Vec c = _items[i].centre();
                for (int a = 0; a < 3; ++a) {
                    Bin& bin = bins.axis[a][map.bin(c, a)];
                    bin.box.add(_items[i].box);
                    ++bin.count;
                }
            }
            return bins;
        };
        const tbb::blocked_range<size_t> all(first, last, PARALLEL_BINNING / 4);
        if (last - first < PARALLEL_BINNING) return scan(all, Bins{});
        return tbb::parallel_reduce(all, Bins{}, scan, [](Bins a, const Bins& b) {
            a.add(b);
            return a;
        });
    }

    /// Tests that `count` primitives cost.
    float blocks(size_t count) const { return float((count + _options.block - 1) / _options.block); }

    Split bestSplit(const Bins& bins, const BinMap& map) const {
        Split best;
        for (int a = 0; a < 3; ++a) {
            if (!map.usable(a)) continue;
            std::array<float, BIN_COUNT> right{};
            Bin sum;
            for (int b = BIN_COUNT - 1; b > 0; --b) {
                sum.box.add(bins.axis[a][b].box);
                sum.count += bins.axis[a][b].count;
                right[b] = sum.count ? sum.box.halfArea() * blocks(sum.count) : -1.0f;
            }
            sum = Bin{};
            for (int b = 1; b < BIN_COUNT; ++b) {
                sum.box.add(bins.axis[a][b - 1].box);
                sum.count += bins.axis[a][b - 1].count;
                if (!sum.count || right[b] < 0.0f) continue;
                const float cost = sum.box.halfArea() * blocks(sum.count) + right[b];
                if (cost < best.cost) best = {cost, a, b};
            }
        }
        return best;
    }

    /// Halves by centroid along the widest axis; works for any input, even identical centroids.
    size_t halve(size_t first, size_t last, const Box& centres) {
        const Vec size = centres.hi - centres.lo;
        const int axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : (size[1] >= size[2] ? 1 : 2);
        const size_t middle = first + (last - first) / 2;
        std::nth_element(_items.begin() + first, _items.begin() + middle, _items.begin() + last,
                         [axis](const Item& a, const Item& b) {
                             const float ca = a.centre()[axis], cb = b.centre()[axis];
                             return ca != cb ? ca < cb : a.primitive < b.primitive;
                         });
        return middle;
    }

    /// Partitions [first, last); returns `last` when a leaf is cheaper.
    size_t partition(size_t first, size_t last, uint32_t depthLeft, const Extents& e) {
        const size_t count = last - first;
        const BinMap map(e.centres);
        const Split split = bestSplit(fillBins(first, last, map), map);
        const bool leafAllowed = count <= _options.maxLeaf;
        const float area = e.boxes.halfArea();
        if (leafAllowed && !(area * _options.nodeCost + split.cost < area * blocks(count))) return last;
        if (split.axis < 0) return halve(first, last, e.centres);
        const auto middle = std::partition(_items.begin() + first, _items.begin() + last, [&](const Item& i) {
            return map.bin(i.centre(), split.axis) < split.bin;
        });
        const size_t m = size_t(middle - _items.begin());
        const uint32_t needed = levelsFor(std::max(m - first, last - m), _options.maxLeaf);
        return needed < depthLeft ? m : halve(first, last, e.centres);
    }

    static uint32_t leaf(size_t first, size_t last) {
        return gpu::BVH_LEAF | uint32_t(last - first) << gpu::BVH_COUNT_SHIFT | uint32_t(first);
    }

    /// Builds [first, last) into node slots starting at `slot`; n primitives never need more than n - 1
    /// nodes, so subtrees own disjoint slots without talking to each other.
    uint32_t build(size_t first, size_t last, size_t slot, uint32_t depthLeft, const Extents& e) {
        const size_t count = last - first;
        if (count <= 1 || (count <= _options.maxLeaf && depthLeft == 0)) return leaf(first, last);
        const size_t middle = partition(first, last, depthLeft, e);
        if (middle == last) return leaf(first, last);
        gpu::BvhNode& node = _nodes[slot];
        const Extents left = extents(first, middle), right = extents(middle, last);
        auto buildLeft = [&] { node.child0 = build(first, middle, slot + 1, depthLeft - 1, left); };
        auto buildRight = [&] {
            node.child1 = build(middle, last, slot + (middle - first), depthLeft - 1, right);
        };
        if (count > PARALLEL_SUBTREE) {
            tbb::parallel_invoke(buildLeft, buildRight);
        } else {
            buildLeft();
            buildRight();
        }
        node.lo0 = store(left.boxes.lo), node.hi0 = store(left.boxes.hi);
        node.lo1 = store(right.boxes.lo), node.hi1 = store(right.boxes.hi);
        return uint32_t(slot);
    }

    void setRootLeaf(uint32_t root, const Box& box) {
        gpu::BvhNode& node = _nodes[0];
        node = {};
        node.child0 = root;
        node.child1 = gpu::BVH_EMPTY;
        if (!_items.empty()) node.lo0 = store(box.lo), node.hi0 = store(box.hi);
    }

    /// Drops unused slots, in depth-first order.
    std::vector<gpu::BvhNode> compact(uint32_t root) const {
        std::vector<gpu::BvhNode> out;
        out.reserve(_nodes.size() / 2 + 1);
        struct Entry {
            uint32_t node;
            uint32_t parent;
            bool second;
        };
        std::vector<Entry> stack{{root, 0, false}};
        while (!stack.empty()) {
            const Entry e = stack.back();
            stack.pop_back();
            const uint32_t index = uint32_t(out.size());
            if (index) (e.second ? out[e.parent].child1 : out[e.parent].child0) = index;
            out.push_back(_nodes[e.node]);
            if (!(out[index].child1 & gpu::BVH_LEAF)) stack.push_back({out[index].child1, index, true});
            if (!(out[index].child0 & gpu::BVH_LEAF)) stack.push_back({out[index].child0, index, false});
        }
        out.shrink_to_fit();
        return out;
    }

    std::vector<Item> _items;
    BvhOptions _options;
    std::vector<gpu::BvhNode> _nodes;
};

float childCost(uint32_t child, const Bounds& box, const BvhOptions& options) {
    if (!(child & gpu::BVH_LEAF)) return options.nodeCost * box.halfArea();
    const uint32_t count = child >> gpu::BVH_COUNT_SHIFT & gpu::BVH_COUNT_MASK;
    return box.halfArea() * float((count + options.block - 1) / options.block);
}

float treeCost(const Bvh& bvh, const BvhOptions& options) {
    double sum = 0.0;
    for (const gpu::BvhNode& n : bvh.nodes) {
        sum += childCost(n.child0, {n.lo0, n.hi0}, options);
        if (n.child1 != gpu::BVH_EMPTY) sum += childCost(n.child1, {n.lo1, n.hi1}, options);
    }
    const float area = bvh.bounds.halfArea();
    return area > 0.0f ? float(options.nodeCost + sum / area) : options.nodeCost;
}

} // namespace

Bvh buildBvh(const std::vector<Bounds>& boxes, const BvhOptions& options) {
    if (boxes.size() > gpu::BVH_FIRST_MASK || levelsFor(boxes.size(), options.maxLeaf) > options.maxDepth)
        throw std::runtime_error(std::to_string(boxes.size()) + " primitives are too many for one tree");
    std::vector<Item> items(boxes.size());
    tbb::parallel_for(tbb::blocked_range<size_t>(0, boxes.size(), 16384), [&](const auto& r) {
        for (size_t i = r.begin(); i < r.end(); ++i)
            items[i] = {{load(boxes[i].lo), load(boxes[i].hi)}, uint32_t(i)};
    });
    Builder builder(std::move(items), options);
    Bvh bvh;
    Box box = Box::none();
    bvh.nodes = builder.run(&box);
    bvh.bounds = {store(box.lo), store(box.hi)};
    bvh.order.resize(boxes.size());
    for (size_t i = 0; i < boxes.size(); ++i)
        bvh.order[i] = builder.items()[i].primitive;
    bvh.cost = treeCost(bvh, options);
    return bvh;
}

void refitBvh(Bvh& bvh, const std::vector<Bounds>& boxes, const BvhOptions& options) {
    auto childBounds = [&](uint32_t child) {
        Bounds b;
        if (child & gpu::BVH_LEAF) {
            const uint32_t first = child & gpu::BVH_FIRST_MASK;
            const uint32_t count = child >> gpu::BVH_COUNT_SHIFT & gpu::BVH_COUNT_MASK;
            for (uint32_t i = first; i < first + count; ++i)
                b.add(boxes[bvh.order[i]]);
        } else {
            const gpu::BvhNode& n = bvh.nodes[child];
            b.add(Bounds{n.lo0, n.hi0});
            if (n.child1 != gpu::BVH_EMPTY) b.add(Bounds{n.lo1, n.hi1});
        }
        return b;
    };
    for (size_t i = bvh.nodes.size(); i-- > 0;) { // children come after parents
        gpu::BvhNode& n = bvh.nodes[i];
        const Bounds b0 = childBounds(n.child0);
        if (!b0.empty()) n.lo0 = b0.lo, n.hi0 = b0.hi;
        if (n.child1 == gpu::BVH_EMPTY) continue;
        const Bounds b1 = childBounds(n.child1);
        n.lo1 = b1.lo, n.hi1 = b1.hi;
    }
    bvh.bounds = childBounds(0);
    bvh.cost = treeCost(bvh, options);
}

} // namespace hipr
