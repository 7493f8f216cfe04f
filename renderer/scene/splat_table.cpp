#include "renderer/scene/splat_table.h"

#include "renderer/splats/bounds.h"
#include "shaders/shared/higs.h"

namespace hipr {
namespace {

bool equal(const SplatCloud& a, const SplatCloud& b) {
    return a.name == b.name && a.positions == b.positions && a.orientations == b.orientations &&
           a.scales == b.scales && a.opacities == b.opacities && a.shDegree == b.shDegree &&
           a.coefficients == b.coefficients && a.sorting == b.sorting && a.projection == b.projection;
}

template <class T> uint64_t bytesOf(const std::vector<T>& values) {
    return values.size() * sizeof(T);
}

} // namespace

Change SplatTable::set(SplatsId id, std::shared_ptr<const SplatCloud> cloud) {
    const auto [it, added] = _sets.try_emplace(id);
    SplatSet& set = it->second;
    const bool same = !added && (set.cloud == cloud || equal(*set.cloud, *cloud));
    set.cloud = std::move(cloud);
    if (same) return Change::None;
    set.revision = ++_revisions;
    const SplatBox box = splatBox(*set.cloud, gpu::SPLAT_MAX_EXTENT);
    set.box = {box.lo, box.hi};
    return added ? Change::Added : Change::Geometry;
}

const SplatSet* SplatTable::find(SplatsId id) const {
    const auto it = _sets.find(id);
    return it == _sets.end() ? nullptr : &it->second;
}

uint64_t SplatTable::hostBytes() const {
    uint64_t bytes = 0;
    for (const auto& [id, set] : _sets)
        bytes += bytesOf(set.cloud->positions) + bytesOf(set.cloud->orientations) +
                 bytesOf(set.cloud->scales) + bytesOf(set.cloud->opacities) +
                 bytesOf(set.cloud->coefficients);
    return bytes;
}

void SplatTable::dump(SceneDump& dump) const {
    for (const auto& [id, set] : _sets) {
        const SplatCloud& cloud = *set.cloud;
        SceneDump::Element& out = dump.element("splats", cloud.name);
        out.fact("positions", cloud.size(), contentHash(cloud.positions));
        out.fact("orientations", cloud.orientations.size(), contentHash(cloud.orientations));
        out.fact("scales", cloud.scales.size(), contentHash(cloud.scales));
        out.fact("opacities", cloud.opacities.size(), contentHash(cloud.opacities));
        out.fact("degree", cloud.shDegree);
        out.fact("coefficients", cloud.coefficients.size(), contentHash(cloud.coefficients));
        out.fact("sorting", uint32_t(cloud.sorting));
        out.fact("projection", uint32_t(cloud.projection));
    }
}

} // namespace hipr
