/// @file random_edits.h
/// Rows of the table in random order.
#pragma once

#include <random>
#include <set>

#include "plugin/record/failure.h"
#include "testenv/edit/edits.h"

namespace hipr::test {

/// Rows that leave UsdImaging of OpenUSD 20.08 with parts of a prototype that are gone: a later edit of such
/// a part ends the process, in UsdImagingPointInstancerAdapter::_GetProtoUsdPrim.
inline bool endsUsdImaging(const Row& row) {
    static const std::set<std::string> names = {"PrototypeRemoved",
                                                "PrototypeRemovedPart",
                                                "PrototypeInactive",
                                                "NestedInnerRemoved",
                                                "InstancerPointsInstancerRemoved",
                                                "InstancerPointsInstancerInactive",
                                                "InstancerPointsInstancerRenamed"};
    return PXR_VERSION < 2102 && names.count(row.name) > 0;
}

/// A row after which other rows are untold: see NetworkOfAnotherMaterialEdited.
inline bool sharesNodes(const Row& row) {
    return PXR_VERSION < 2102 && row.name == "NetworkConnected";
}

class RandomEdits {
public:
    explicit RandomEdits(unsigned seed) : _random(seed) {}

    /// Applies an edit that the scene, as it is now, takes.
    void applyOne(Scene& scene) {
        const Rows& rows = allRows();
        for (;;) {
            const Row& row = rows[_random() % rows.size()];
            if (!row.untold.empty() || !row.backUntold.empty() || endsUsdImaging(row) || sharesNodes(row))
                continue;
            try {
                if (row.before && _random() % 2 == 0)
                    row.before(scene);
                else
                    row.edit(scene);
            } catch (const record::Failure&) {
                continue; // what it wants to change is gone
            }
            _last = row.name;
            return;
        }
    }

    /// Name of the newest edit.
    const std::string& last() const { return _last; }

private:
    std::mt19937 _random; // unlike distributions, its numbers are the same everywhere
    std::string _last;
};

} // namespace hipr::test
