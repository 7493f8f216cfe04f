/// @file wide_tree.h
/// Trees with eight children a node, laid out for the vector units of a processor.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/accel/bounds.h"
#include "renderer/accel/bvh_builder.h"
#include "renderer/accel/traversal.h"

namespace hipr {

/// Nodes and leaves of a tree share one array of these, a node right before what hangs on it: few pages a
/// ray.
struct alignas(32) WideUnit {
    unsigned char bytes[32];
};

/// References are unit indices; with this bit they name a leaf (a WideLeaf, or an instance at the top level).
constexpr uint32_t WIDE_LEAF = 0x80000000u;
constexpr uint32_t WIDE_NOTHING = ~0u; ///< no child in this lane
constexpr uint32_t WIDE_CHILDREN = 8;

/// Row 2 * axis holds the low planes of all children on that axis, the next row the high ones; lanes without
/// a child have an inside-out box that no ray meets.
struct alignas(32) WideNode {
    float plane[6][WIDE_CHILDREN];
    uint32_t child[WIDE_CHILDREN];
};

/// Up to four triangles, or round segments (see Corners in geometry_bounds.h). Those of a mesh that deforms
/// have one of these a key, one behind the other. Lanes without one have corners that are not numbers, which
/// no ray hits.
struct alignas(32) WideLeaf {
    static constexpr uint32_t TRIANGLES = 4;
    float corner[3][3][TRIANGLES]; ///< corner, axis, triangle
    uint32_t primitive[TRIANGLES];
};
static_assert(sizeof(WideNode) == 7 * sizeof(WideUnit) && sizeof(WideLeaf) == 5 * sizeof(WideUnit));

class WideTree {
public:
    /// Over the triangles or segments of a mesh.
    void build(const GeometryView& view);
    /// Over boxes; leaves are references to `ids[i] | WIDE_LEAF`.
    void build(const std::vector<Bounds>& boxes, const std::vector<uint32_t>& ids);
    /// New positions for the triangles of the last build(); false when the tree became so bad that it should
    /// be built again.
    bool refit(const GeometryView& view);
    void clear();

    const Bounds& bounds() const { return _bounds; }
    /// The root is a node at index 0; null when there is nothing.
    const WideUnit* units() const { return _units.empty() ? nullptr : _units.data(); }
    uint64_t bytes() const { return _units.capacity() * sizeof(WideUnit); }

private:
    std::vector<WideUnit> _units;
    Bounds _bounds;
    uint32_t _keys = 1;      ///< of the mesh
    double _builtArea = 0.0; ///< of all nodes' children, relative to the root's, when last built
};

} // namespace hipr
