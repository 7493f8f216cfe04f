#include "renderer/scene/instance_diff.h"

#include <algorithm>
#include <cstring>

namespace hipr {
namespace {

/// By bits, so that a transform that is not a number equals itself.
bool sameTransform(const glm::mat4x3& a, const glm::mat4x3& b) {
    static_assert(sizeof(glm::mat4x3) == 12 * sizeof(float), "no padding");
    return std::memcmp(&a, &b, sizeof(a)) == 0;
}

bool complete(const Primvar& primvar, size_t count) {
    if (primvar.components < 1) return false;
    for (size_t i = 0; i < count; ++i)
        if (instanceValue(primvar, i) < 0) return false;
    return true;
}

/// Two states of one object's instances.
class Comparison {
public:
    Comparison(const InstancesDesc& before, const InstancesDesc& now) : _before(before), _now(now) {
        const std::vector<Primvar>&old = before.primvars, &current = now.primvars;
        _primvarsDiffer = old.size() != current.size();
        for (size_t p = 0; p < old.size() && !_primvarsDiffer; ++p)
            _primvarsDiffer = !pair(old[p], current[p]);
    }

    /// A primvar came, went, or became one that has no value for some instance: all may look different.
    bool primvarsDiffer() const { return _primvarsDiffer; }

    /// What differs between instance `i` as it was and `j` as it is.
    Change change(size_t i, size_t j) const {
        Change change = Change::None;
        if (!sameTransform(_before.transforms[i], _now.transforms[j]) || !sameMotion(i, j))
            change = Change::Transform;
        if (!sameCategories(i, j)) change = change | Change::Linking;
        return sameId(i, j) && samePrimvars(i, j) ? change : change | Change::Primvar;
    }
    bool same(size_t i, size_t j) const { return change(i, j) == Change::None; }

private:
    /// Keeps a primvar for comparison value by value. False when that would not tell the difference.
    bool pair(const Primvar& old, const Primvar& now) {
        const size_t oldCount = _before.transforms.size(), count = _now.transforms.size();
        if (oldCount == count && old == now) return true;
        if (old.name != now.name || old.components != now.components) return false;
        if (!complete(old, oldCount) || !complete(now, count)) return false;
        _pairs.push_back({&old, &now});
        return true;
    }
    bool sameMotion(size_t i, size_t j) const {
        const InstanceMotion &old = _before.motion, &now = _now.motion;
        if (old.times != now.times) return false;
        for (size_t t = 0; t < old.times.size(); ++t)
            if (!sameTransform(old.transforms[t][i], now.transforms[t][j])) return false;
        return true;
    }
    bool sameId(size_t i, size_t j) const {
        const std::vector<int>&old = _before.instanceIds, &now = _now.instanceIds;
        if (i >= old.size() && j >= now.size()) return true; // counted, so none of their own
        return (i < old.size() ? old[i] : int(i)) == (j < now.size() ? now[j] : int(j));
    }
    bool sameCategories(size_t i, size_t j) const {
        const auto &old = _before.categories, &now = _now.categories;
        if (i < old.size() && j < now.size()) return old[i] == now[j];
        return (i >= old.size() || old[i].empty()) && (j >= now.size() || now[j].empty());
    }
    bool samePrimvars(size_t i, size_t j) const {
        return std::all_of(_pairs.begin(), _pairs.end(), [&](const auto& pair) {
            const auto& [old, now] = pair;
            const size_t components = old->components;
            const float* a = old->values.data() + size_t(instanceValue(*old, i)) * components;
            const float* b = now->values.data() + size_t(instanceValue(*now, j)) * components;
            return std::memcmp(a, b, components * sizeof(float)) == 0;
        });
    }

    const InstancesDesc &_before, &_now;
    std::vector<std::pair<const Primvar*, const Primvar*>> _pairs;
    bool _primvarsDiffer = false;
};

/// The instances that the longer of two lists has beyond the shorter one, when they have all others in
/// common in the same order. `same(l, s)` compares members of the longer and the shorter list.
template <class Same>
bool surplus(size_t longer, size_t shorter, Change change, const Same& same,
             std::vector<InstanceChange>& changes) {
    size_t s = 0;
    for (size_t l = 0; l < longer; ++l) {
        if (s < shorter && same(l, s))
            ++s;
        else
            changes.push_back({uint32_t(l), change});
        if (changes.size() > longer - shorter) break; // too many to be the surplus alone
    }
    if (s == shorter && changes.size() == longer - shorter) return true;
    changes.clear();
    return false;
}

} // namespace

int64_t instanceValue(const Primvar& primvar, size_t instance) {
    if (!primvar.indices.empty()) {
        if (instance >= primvar.indices.size() || primvar.indices[instance] < 0) return -1;
        instance = size_t(primvar.indices[instance]);
    }
    return (instance + 1) * primvar.components <= primvar.values.size() ? int64_t(instance) : -1;
}

std::vector<InstanceChange> changedInstances(const InstancesDesc& before, const InstancesDesc& now) {
    const Comparison comparison(before, now);
    const size_t old = before.transforms.size(), count = now.transforms.size();
    std::vector<InstanceChange> changes;
    const auto inOrder = [&](size_t i, size_t j) { return comparison.same(i, j); };
    const auto swapped = [&](size_t j, size_t i) { return comparison.same(i, j); };
    const bool found = (old > count && surplus(old, count, Change::Removed, inOrder, changes)) ||
                       (old < count && surplus(count, old, Change::Added, swapped, changes));
    if (!found) {
        for (size_t i = 0; i < std::max(old, count); ++i) {
            const Change change = i >= count ? Change::Removed
                                  : i >= old ? Change::Added
                                             : comparison.change(i, i);
            if (change != Change::None) changes.push_back({uint32_t(i), change});
        }
    }
    if (comparison.primvarsDiffer() && count > 0)
        changes.push_back({ChangedElement::AllInstances, Change::Primvar});
    return changes;
}

} // namespace hipr
