// Part of wide_walk.inl: instances of round segments. Boxes of segments are tested four at a time, by the
// operations of shaders/shared/segment.h; what is in a box, one by one.

/// The ray in the space of an instance.
struct SegmentLeafRay {
    gpu::SegmentRay ray;
    F4 inverse[3], biasLo[3], biasHi[3];
    F4 entry, exit; ///< of the instance's world box
    uint32_t instance;
};

HIPR_HOT void setSegmentLeafRay(SegmentLeafRay& out, const gpu::SegmentRay& r, const gpu::BoxRay& box,
                                float entry, float exit, uint32_t instance) {
    out.ray = r;
    for (int k = 0; k < 3; ++k) {
        out.inverse[k] = all4(box.inverse[k]);
        out.biasLo[k] = all4(box.biasLo[k]);
        out.biasHi[k] = all4(box.biasHi[k]);
    }
    out.entry = all4(entry);
    out.exit = all4(exit);
    out.instance = instance;
}

/// Tests the segments of a leaf as gpu::canonicalSegmentHit does. True when any hit will do and there is one.
template <bool ANY> HIPR_HOT bool testSegments(Walk& w, const SegmentLeafRay& r, const WideLeaf& leaf) {
    const auto row = [&](int corner, int axis) -> const F4& {
        return reinterpret_cast<const F4&>(leaf.corner[corner][axis]);
    };
    const F4 &radiusA = row(2, 0), &radiusB = row(2, 1);
    F4 entry = r.entry, exit = r.exit;
    for (int k = 0; k < 3; ++k) {
        const F4 &a = row(0, k), &b = row(1, k);
        const F4 p0 = least(a - radiusA, b - radiusB) * r.inverse[k] + r.biasLo[k];
        const F4 p1 = most(a + radiusA, b + radiusB) * r.inverse[k] + r.biasHi[k];
        entry = most(entry, least(p0, p1));
        exit = least(exit, most(p0, p1));
    }
    uint32_t met = bits((entry <= exit) & (exit > all4(w.ray.tMin)) & (entry <= all4(w.best.t)));
    for (; met; met &= met - 1) {
        const uint32_t lane = uint32_t(__builtin_ctz(met)), primitive = leaf.primitive[lane];
        const auto vertex = [&](int corner) {
            return glm::vec3(leaf.corner[corner][0][lane], leaf.corner[corner][1][lane],
                             leaf.corner[corner][2][lane]);
        };
        float t, u, v;
        if (!gpu::intersectSegment(r.ray, vertex(0), vertex(1), radiusA[lane], radiusB[lane], t, u, v))
            continue;
        t = std::min(std::max(t, entry[lane]), exit[lane]);
        if (!(t > w.ray.tMin) ||
            !gpu::before(t, r.instance, primitive, w.best.t, w.best.instance, w.best.primitive))
            continue;
        w.best = {r.instance, primitive, t, u, v};
        if (ANY) return true;
    }
    return false;
}

/// Of an instance of segments, whether it moves or not. True when any hit will do and there is one.
template <bool ANY>
__attribute__((noinline)) bool walkSegments(Walk& w, uint32_t index, float entry, float exit) {
    const gpu::BvhInstance& record = w.scene.instances[index];
    if (gpu::passesSide(gpu::passedSides(record.culled, w.ray.flags), true)) return false;
    const glm::mat4x3 toObject = worldToObject(record, w.scene.keys, w.ray.time);
    const glm::vec3 origin = gpu::mapPoint(toObject, w.ray.origin);
    const glm::vec3 direction = gpu::mapDirection(toObject, w.ray.direction);
    const gpu::BoxRay box = gpu::boxRay(origin, direction, record.extent);
    SegmentLeafRay leafRay;
    NodeRay nodeRay;
    setSegmentLeafRay(leafRay, gpu::segmentRay(origin, direction), box, entry, exit, index);
    setNodeRay(nodeRay, box, w.ray.tMin);
    walkLeaves(w, record, nodeRay, [&](const WideLeaf& leaf) { return testSegments<ANY>(w, leafRay, leaf); });
    return ANY && w.best.instance != gpu::NO_INDEX;
}
