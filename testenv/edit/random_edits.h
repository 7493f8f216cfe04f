/// @file random_edits.h
/// Rows of the table in random order.
#pragma once

#include <random>

#include "plugin/record/failure.h"
#include "testenv/edit/edits.h"

namespace hipr::test {

class RandomEdits {
public:
    explicit RandomEdits(unsigned seed) : _random(seed) {}

    /// Applies an edit that the scene, as it is now, takes.
    void applyOne(Scene& scene) {
        const Rows& rows = allRows();
        for (;;) {
            const Row& row = rows[_random() % rows.size()];
            if (!row.untold.empty() || !row.backUntold.empty()) continue;
            try {
                if (row.before && _random() % 2 == 0)
                    row.before(scene);
                else
                    row.edit(scene);
            } catch (const record::Failure&) {
                continue; // what it wants to change is gone
            }
            _history += (_history.empty() ? "" : ", ") + row.name;
            return;
        }
    }

    /// Names of all edits so far.
    const std::string& history() const { return _history; }

private:
    std::mt19937 _random; // unlike distributions, its numbers are the same everywhere
    std::string _history;
};

} // namespace hipr::test
