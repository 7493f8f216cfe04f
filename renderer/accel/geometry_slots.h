/// @file geometry_slots.h
/// Geometries by slot, for traversals that build them at their next commit.
#pragma once

#include <memory>
#include <vector>

#include "renderer/accel/traversal.h"

namespace hipr {

/// Puts a view into a slot, or frees it. `Geometry` has `GeometryView view` and `bool changed`, which is true
/// from here until it is built.
template <class Geometry>
void setSlot(std::vector<std::unique_ptr<Geometry>>& slots, uint32_t slot, const GeometryView* view) {
    if (slot >= slots.size()) slots.resize(slot + 1);
    std::unique_ptr<Geometry>& g = slots[slot];
    if (!view) {
        g.reset();
        return;
    }
    if (!g) g = std::make_unique<Geometry>();
    const bool same = view->sameTopology && (!g->changed || g->view.sameTopology);
    g->view = *view;
    g->view.sameTopology = same; // as what was built last, not as what was set last
    g->changed = true;
}

} // namespace hipr
