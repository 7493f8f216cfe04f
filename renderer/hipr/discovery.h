/// @file discovery.h
/// Paper mode's answer to where an edit shows: which elements changed, and how found tiles are ranked. The
/// host's part; renderer/trace/discovery_passes.h runs the kernels. See docs/hipr.md.
#pragma once

#include <vector>

#include "renderer/api/settings.h"
#include "renderer/hipr/tile_grid.h"
#include "renderer/scene/world_box.h"
#include "shaders/shared/hipr.h"

namespace hipr {

/// What changed since the picture on display was looked at: elements, and the boxes where they were and are.
/// Edits add up until clear(), so that none is lost when the next one comes before discovery has begun.
class ChangedElements {
public:
    void add(const std::vector<gpu::ElementKey>& elements, const std::vector<WorldBox>& boxes);
    void clear();

    /// Sorted, each once; an object of which everything changed has that one key.
    const std::vector<gpu::ElementKey>& keys() const { return _keys; }
    /// At most gpu::MAX_CHANGED_BOXES; where there were more, those that fit each other best are merged.
    const std::vector<WorldBox>& boxes() const { return _boxes; }

private:
    void addBox(const WorldBox& box);

    std::vector<gpu::ElementKey> _keys;
    std::vector<WorldBox> _boxes;
};

/// The weights of the settings, those of scattering and those of path classes each summing to 1.
struct DiscoveryWeights {
    glm::vec4 scatter{0.f}; ///< by gpu::SCATTER_*
    glm::vec4 path{0.f};    ///< by gpu::PATH_*; the last is 0
    /// What a shadow ray counts: a diffuse surface, lit directly.
    float shadow() const { return scatter[gpu::SCATTER_DIFFUSE] * path[gpu::PATH_DIRECT]; }
};
DiscoveryWeights discoveryWeights(const Settings& settings);

/// Priorities of tiles from their weight W (in units of 1 / gpu::WEIGHT_SCALE): active tiles before all
/// others, by W among themselves; 0 for tiles that were not discovered.
std::vector<float> discoveredPriorities(const std::vector<uint64_t>& weights,
                                        const std::vector<uint32_t>& active);

} // namespace hipr
