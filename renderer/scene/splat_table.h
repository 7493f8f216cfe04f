/// @file splat_table.h
/// Clouds of splats by id, and where they stand.
#pragma once

#include <map>
#include <memory>

#include "renderer/api/scene.h"
#include "renderer/scene/scene_dump.h"
#include "renderer/scene/world_box.h"

namespace hipr {

/// One placement of a cloud.
struct SplatPlacement {
    SplatsId splats = SplatsId::None;
    glm::mat4x3 objectToWorld{1.f};
    int primId = -1;
    int instanceId = 0;
    std::vector<glm::mat4x3> keys; ///< object to world while the shutter is open; empty: it stands still
    bool operator==(const SplatPlacement& o) const {
        return splats == o.splats && objectToWorld == o.objectToWorld && primId == o.primId &&
               instanceId == o.instanceId && keys == o.keys;
    }
};

/// A cloud as it is in the scene.
struct SplatSet {
    std::shared_ptr<const SplatCloud> cloud;
    uint32_t revision = 0; ///< goes up with every change
    WorldBox box;          ///< of everything its splats reach, in object space
};

class SplatTable {
public:
    /// Adds or replaces. None: it is the same cloud, or an equal one.
    Change set(SplatsId id, std::shared_ptr<const SplatCloud> cloud);
    /// Returns whether there was such a cloud.
    bool remove(SplatsId id) { return _sets.erase(id) > 0; }
    /// Null: there is no such cloud.
    const SplatSet* find(SplatsId id) const;

    void dump(SceneDump& dump) const;
    uint64_t hostBytes() const;

private:
    std::map<SplatsId, SplatSet> _sets;
    uint32_t _revisions = 0;
};

} // namespace hipr
