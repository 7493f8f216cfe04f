// The walk through wide trees, compiled once for every kind of processor: boxes eight at a time, triangles
// four at a time, by the operations of shaders/shared/intersect.h in their order. Rounding, and so every hit,
// is the same.
#include "renderer/accel/wide_walk_headers.h"

namespace hipr {
namespace {

#define HIPR_HOT inline __attribute__((always_inline))

using F4 = float __attribute__((vector_size(16)));
using I4 = int32_t __attribute__((vector_size(16)));
using F8 = float __attribute__((vector_size(32)));
using I8 = int32_t __attribute__((vector_size(32)));

/// One bit a lane.
HIPR_HOT uint32_t bits(const I4& m) {
#if defined(__x86_64__)
    return uint32_t(_mm_movemask_ps(__m128(m)));
#else
    uint32_t r = 0;
    for (int i = 0; i < 4; ++i)
        r |= (m[i] ? 1u : 0u) << i;
    return r;
#endif
}

/// Lanes in which a <= b.
HIPR_HOT uint32_t notAbove(const F8& a, const F8& b) {
#if defined(HIPR_WALK_AVX512)
    return _mm256_cmp_ps_mask(__m256(a), __m256(b), _CMP_LE_OQ);
#elif defined(HIPR_WALK_AVX2)
    return uint32_t(_mm256_movemask_ps(__m256(a <= b)));
#else
    const I8 m = a <= b;
    I4 half[2];
    std::memcpy(half, &m, sizeof(m));
    return bits(half[0]) | bits(half[1]) << 4;
#endif
}

template <class F> HIPR_HOT F most(const F& a, const F& b) {
    return a > b ? a : b;
}
template <class F> HIPR_HOT F least(const F& a, const F& b) {
    return a < b ? a : b;
}
HIPR_HOT F8 all8(float f) {
    return F8{f, f, f, f, f, f, f, f};
}
HIPR_HOT F4 all4(float f) {
    return F4{f, f, f, f};
}

/// gpu::BoxRay for eight boxes: on each axis the planes that the ray meets first, and the others.
struct NodeRay {
    F8 inverse[3], biasNear[3], biasFar[3], tMin;
    uint32_t nearRow[3], farRow[3];
};

HIPR_HOT void setNodeRay(NodeRay& out, const gpu::BoxRay& r, float tMin) {
    out.tMin = all8(tMin);
    for (int a = 0; a < 3; ++a) {
        const bool back = r.inverse[a] < 0.0f;
        out.inverse[a] = all8(r.inverse[a]);
        out.biasNear[a] = all8(back ? r.biasHi[a] : r.biasLo[a]);
        out.biasFar[a] = all8(back ? r.biasLo[a] : r.biasHi[a]);
        out.nearRow[a] = uint32_t(2 * a) + (back ? 1u : 0u);
        out.farRow[a] = uint32_t(2 * a) + (back ? 0u : 1u);
    }
}

/// Where the ray enters a child, above the child's reference: sorts by distance. Negative distances count as
/// zero.
using Entry = uint64_t;

HIPR_HOT uint32_t sortable(float distance) {
    distance = distance > 0.0f ? distance : 0.0f;
    uint32_t b;
    std::memcpy(&b, &distance, sizeof(b));
    return b;
}

HIPR_HOT void order(Entry& below, Entry& above) {
    const Entry lo = below < above ? below : above, hi = below < above ? above : below;
    below = hi;
    above = lo;
}

constexpr uint32_t STACK = 7 * gpu::BVH_MAX_TRIANGLE_DEPTH + 8;

/// Asks for the memory behind a reference of the tree ahead of its use.
HIPR_HOT void prefetch(const WideUnit* tree, uint32_t child) {
    const auto* p = reinterpret_cast<const char*>(tree + (child & ~WIDE_LEAF));
    for (size_t line = 0; line < sizeof(WideNode); line += 64)
        __builtin_prefetch(p + line);
}

/// What the leaves of a tree are.
enum class Leaves { Instances, Triangles };

/// The children that a ray meets: returns the nearest, the others go to the stack, the farthest first.
template <Leaves LEAVES> class Met {
public:
    HIPR_HOT Met(const WideUnit* tree, const WideNode& node, uint32_t lanes, const F8& entry)
        : _tree(tree), _node(node), _lanes(lanes) {
        const F8 distance = most(entry, F8{});
        std::memcpy(_distance, &distance, sizeof(distance));
    }
    HIPR_HOT uint32_t sort(Entry*& top) {
        Entry a = next(), b = next();
        order(a, b);
        if (!_lanes) {
            *top++ = a;
            return uint32_t(b);
        }
        Entry c = next();
        order(b, c);
        order(a, b);
        if (!_lanes) {
            top[0] = a, top[1] = b;
            top += 2;
            return uint32_t(c);
        }
        Entry* const first = top;
        top[0] = a, top[1] = b, top[2] = c;
        top += 3;
        while (_lanes) {
            const Entry e = next();
            Entry* at = top++;
            for (; at > first && at[-1] < e; --at)
                *at = at[-1];
            *at = e;
        }
        return uint32_t(*--top);
    }

private:
    HIPR_HOT Entry next() {
        const uint32_t lane = uint32_t(__builtin_ctz(_lanes));
        _lanes &= _lanes - 1;
        const uint32_t child = _node.child[lane];
        if (LEAVES == Leaves::Triangles || !(child & WIDE_LEAF)) prefetch(_tree, child);
        return Entry(_distance[lane]) << 32 | child;
    }
    const WideUnit* _tree;
    const WideNode& _node;
    uint32_t _lanes;
    alignas(32) uint32_t _distance[WIDE_CHILDREN];
};

/// Calls `leaf(index)` for the leaves that a ray meets before tMax, roughly nearest first, until it returns
/// true.
template <Leaves LEAVES, class Leaf>
HIPR_HOT void walkTree(const WideUnit* tree, const NodeRay& ray, const float& tMax, const Leaf& leaf) {
    Entry stack[STACK];
    Entry* top = stack;
    uint32_t child = 0;
    for (;;) {
        const F8 last = all8(tMax);
        while (!(child & WIDE_LEAF)) {
            const WideNode& node = reinterpret_cast<const WideNode&>(tree[child]);
            const auto* plane = reinterpret_cast<const F8*>(node.plane);
            const F8 x0 = plane[ray.nearRow[0]] * ray.inverse[0] + ray.biasNear[0];
            const F8 y0 = plane[ray.nearRow[1]] * ray.inverse[1] + ray.biasNear[1];
            const F8 z0 = plane[ray.nearRow[2]] * ray.inverse[2] + ray.biasNear[2];
            const F8 x1 = plane[ray.farRow[0]] * ray.inverse[0] + ray.biasFar[0];
            const F8 y1 = plane[ray.farRow[1]] * ray.inverse[1] + ray.biasFar[1];
            const F8 z1 = plane[ray.farRow[2]] * ray.inverse[2] + ray.biasFar[2];
            const F8 entry = most(most(x0, y0), most(z0, ray.tMin));
            const F8 exit = least(least(x1, y1), least(z1, last));
            const uint32_t met = notAbove(entry, exit);
            if (!met)
                child = WIDE_NOTHING;
            else if (!(met & (met - 1)))
                child = node.child[__builtin_ctz(met)];
            else
                child = Met<LEAVES>(tree, node, met, entry).sort(top);
        }
        if (child != WIDE_NOTHING && leaf(child & ~WIDE_LEAF)) return;
        const uint32_t reach = sortable(tMax);
        do {
            if (top == stack) return;
            --top;
        } while (uint32_t(*top >> 32) > reach);
        child = uint32_t(*top);
    }
}

/// One ray and its best hit so far.
struct Walk {
    const WideScene& scene;
    const gpu::Ray& ray;
    uint32_t mask;
    gpu::Hit best;
};

/// The ray in the space of an instance, for four triangles at a time; axes as gpu::TriangleRay turns them.
struct LeafRay {
    F4 origin[3], shear[3];
    F4 inverse[3], biasLo[3], biasHi[3];
    F4 entry, exit; ///< of the instance's world box
    float passed;   ///< sign of what a triangle's edge functions add up to on the side that the ray passes
    uint32_t instance;
    uint32_t axis[3];
};

HIPR_HOT void setLeafRay(LeafRay& out, const gpu::TriangleRay& r, const gpu::BoxRay& box, float entry,
                         float exit, uint32_t instance) {
    out.axis[0] = r.axis == 2u ? 0u : r.axis + 1u;
    out.axis[1] = r.axis == 0u ? 2u : r.axis - 1u;
    out.axis[2] = r.axis;
    for (int k = 0; k < 3; ++k) {
        const uint32_t a = out.axis[k];
        out.origin[k] = all4(r.origin[a]);
        out.shear[k] = all4(r.shear[k]);
        out.inverse[k] = all4(box.inverse[a]);
        out.biasLo[k] = all4(box.biasLo[a]);
        out.biasHi[k] = all4(box.biasHi[a]);
    }
    out.entry = all4(entry);
    out.exit = all4(exit);
    out.instance = instance;
}

/// Tests the triangles of a leaf as gpu::canonicalHit does; those that CULLS are passed from LeafRay::passed.
/// True when any hit will do and there is one.
template <bool ANY, bool CULLS = false>
HIPR_HOT bool testLeaf(Walk& w, const LeafRay& r, const WideLeaf& leaf) {
    const auto row = [&](int corner, int axis) -> const F4& {
        return reinterpret_cast<const F4*>(leaf.corner[corner])[r.axis[axis]];
    };
    const F4 az = row(0, 2) - r.origin[2], bz = row(1, 2) - r.origin[2], cz = row(2, 2) - r.origin[2];
    const F4 ax = (row(0, 0) - r.origin[0]) - r.shear[0] * az,
             ay = (row(0, 1) - r.origin[1]) - r.shear[1] * az;
    const F4 bx = (row(1, 0) - r.origin[0]) - r.shear[0] * bz,
             by = (row(1, 1) - r.origin[1]) - r.shear[1] * bz;
    const F4 cx = (row(2, 0) - r.origin[0]) - r.shear[0] * cz,
             cy = (row(2, 1) - r.origin[1]) - r.shear[1] * cz;
    const F4 wa = cx * by - cy * bx, wb = ax * cy - ay * cx, wc = bx * ay - by * ax;
    const F4 zero = {};
    const I4 inside =
        ((wa >= zero) & (wb >= zero) & (wc >= zero)) | ((wa <= zero) & (wb <= zero) & (wc <= zero));
    if (!bits(inside)) return false;

    const F4 sum = (wa + wb) + wc;
    const F4 scale = all4(1.0f) / sum;
    const F4 depth = (wa * az + wb * bz) + wc * cz;
    F4 entry = r.entry, exit = r.exit;
    for (int k = 0; k < 3; ++k) {
        const F4 &a = row(0, k), &b = row(1, k), &c = row(2, k);
        const F4 p0 = least(least(a, b), c) * r.inverse[k] + r.biasLo[k];
        const F4 p1 = most(most(a, b), c) * r.inverse[k] + r.biasHi[k];
        entry = most(entry, least(p0, p1));
        exit = least(exit, most(p0, p1));
    }
    const F4 t = least(most((depth * scale) * r.shear[2], entry), exit);
    const I4 counts = CULLS ? sum * all4(r.passed) < zero : sum != zero;
    uint32_t hit = bits(inside & counts & (entry <= exit) & (t > all4(w.ray.tMin)) & (t <= all4(w.best.t)));
    if (ANY && hit) w.best.instance = r.instance;
    if (ANY) return hit != 0;
    for (; hit; hit &= hit - 1) {
        const uint32_t lane = uint32_t(__builtin_ctz(hit)), primitive = leaf.primitive[lane];
        if (gpu::before(t[lane], r.instance, primitive, w.best.t, w.best.instance, w.best.primitive))
            w.best = {r.instance, primitive, t[lane], (wb * scale)[lane], (wc * scale)[lane]};
    }
    return false;
}

/// A ray in the space of an instance.
struct InstanceRay {
    LeafRay leaf;
    NodeRay node;
};

HIPR_HOT void setInstanceRay(InstanceRay& out, const Walk& w, uint32_t index,
                             const glm::mat4x3& worldToObject, float entry, float exit) {
    const glm::vec3 origin = gpu::mapPoint(worldToObject, w.ray.origin);
    const glm::vec3 direction = gpu::mapDirection(worldToObject, w.ray.direction);
    const gpu::BoxRay box = gpu::boxRay(origin, direction, w.scene.instances[index].extent);
    setLeafRay(out.leaf, gpu::triangleRay(origin, direction), box, entry, exit, index);
    setNodeRay(out.node, box, w.ray.tMin);
}

/// gpu::mixKeys for the corners of a leaf.
HIPR_HOT void mixLeaves(WideLeaf& out, const WideLeaf& from, const WideLeaf& to, float weight) {
    const F4 share = all4(weight);
    for (int corner = 0; corner < 3; ++corner)
        for (int axis = 0; axis < 3; ++axis) {
            const F4& a = reinterpret_cast<const F4&>(from.corner[corner][axis]);
            const F4& b = reinterpret_cast<const F4&>(to.corner[corner][axis]);
            const F4 mixed = a + (b - a) * share;
            reinterpret_cast<F4&>(out.corner[corner][axis]) = most(least(mixed, most(a, b)), least(a, b));
        }
    std::memcpy(out.primitive, from.primitive, sizeof(out.primitive));
}

/// Calls `test(leaf)` for the leaves on the way, as they are at the time of the ray, until it returns true.
template <class Test>
HIPR_HOT void walkLeaves(const Walk& w, const gpu::BvhInstance& record, const NodeRay& ray,
                         const Test& test) {
    const auto* tree = reinterpret_cast<const WideUnit*>(record.nodes);
    const gpu::KeyTime at =
        record.geometryKeys > 1 ? gpu::keyTime(w.ray.time, record.geometryKeys) : gpu::KeyTime{0, 0.0f};
    walkTree<Leaves::Triangles>(tree, ray, w.best.t, [&](uint32_t child) {
        const auto* leaf = reinterpret_cast<const WideLeaf*>(tree + child) + at.first;
        if (record.geometryKeys == 1) return test(*leaf);
        WideLeaf now;
        mixLeaves(now, leaf[0], leaf[1], at.weight);
        return test(now);
    });
}

/// Of an instance that moves or deforms while the shutter is open, or that the ray passes on one side. True
/// when any hit will do and there is one.
template <bool ANY>
__attribute__((noinline)) bool walkSpecial(Walk& w, uint32_t index, float entry, float exit) {
    const gpu::BvhInstance& record = w.scene.instances[index];
    InstanceRay ray;
    setInstanceRay(ray, w, index, worldToObject(record, w.scene.keys, w.ray.time), entry, exit);
    if (const uint32_t passed = gpu::passedSides(record.culled, w.ray.flags)) {
        const bool frontAdds = ray.leaf.shear[2][0] > 0.0f; // as gpu::intersectTriangle has it
        ray.leaf.passed = frontAdds == (passed == gpu::INSTANCE_CULL_FRONT) ? 1.0f : -1.0f;
        walkLeaves(w, record, ray.node,
                   [&](const WideLeaf& leaf) { return testLeaf<ANY, true>(w, ray.leaf, leaf); });
    } else {
        walkLeaves(w, record, ray.node,
                   [&](const WideLeaf& leaf) { return testLeaf<ANY>(w, ray.leaf, leaf); });
    }
    return ANY && w.best.instance != gpu::NO_INDEX;
}

#include "renderer/accel/wide_segments.inl"

/// True when any hit will do and there is one.
template <bool ANY> HIPR_HOT bool walkInstance(Walk& w, const gpu::BoxRay& worldBox, uint32_t index) {
    const gpu::BvhInstance& record = w.scene.instances[index];
    if (!(record.mask & w.mask)) return false;
    float entry, exit;
    gpu::boxInterval(worldBox, record.lo, record.hi, entry, exit);
    if (!(std::max(entry, w.ray.tMin) <= std::min(exit, w.best.t))) return false;
    if (record.keyCount + record.geometryKeys + record.segments + record.culled > 1)
        return record.segments ? walkSegments<ANY>(w, index, entry, exit)
                               : walkSpecial<ANY>(w, index, entry, exit);
    InstanceRay ray;
    setInstanceRay(ray, w, index, record.worldToObject, entry, exit);
    const auto* tree = reinterpret_cast<const WideUnit*>(record.nodes);
    walkTree<Leaves::Triangles>(tree, ray.node, w.best.t, [&](uint32_t leaf) {
        return testLeaf<ANY>(w, ray.leaf, reinterpret_cast<const WideLeaf&>(tree[leaf]));
    });
    return ANY && w.best.instance != gpu::NO_INDEX;
}

template <bool ANY> void walkAll(Walk& w, const gpu::BoxRay& worldBox) {
    NodeRay nodeRay;
    setNodeRay(nodeRay, worldBox, w.ray.tMin);
    walkTree<Leaves::Instances>(w.scene.top, nodeRay, w.best.t,
                                [&](uint32_t instance) { return walkInstance<ANY>(w, worldBox, instance); });
}

/// The top level is only walked when there is something to choose from.
template <bool ANY> HIPR_HOT gpu::Hit walkScene(const WideScene& scene, uint32_t mask, const gpu::Ray& ray) {
    Walk w{scene, ray, mask, {gpu::NO_INDEX, gpu::NO_INDEX, ray.tMax, 0.0f, 0.0f}};
    if (!scene.top || !gpu::traceable(ray.origin, ray.direction, ray.tMin, ray.tMax)) return w.best;
    const gpu::BoxRay worldBox = gpu::boxRay(ray.origin, ray.direction, scene.extent);
    if (scene.instanceCount == 1)
        walkInstance<ANY>(w, worldBox, 0);
    else
        walkAll<ANY>(w, worldBox);
    return w.best;
}

void nearest(const WideScene& scene, uint32_t mask, const gpu::Ray* rays, uint32_t count, gpu::Hit* hits) {
    for (uint32_t i = 0; i < count; ++i)
        hits[i] = walkScene<false>(scene, mask, rays[i]);
}

void occluded(const WideScene& scene, uint32_t mask, const gpu::Ray* rays, uint32_t count,
              uint32_t* blocked) {
    for (uint32_t i = 0; i < count; ++i)
        blocked[i] = walkScene<true>(scene, mask, rays[i]).instance != gpu::NO_INDEX ? 1u : 0u;
}

} // namespace
} // namespace hipr
