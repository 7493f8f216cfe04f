/// @file culling.h
/// Cull styles as flags of instances.
#pragma once

#include <memory>

#include "renderer/api/cull.h"
#include "renderer/api/mesh.h"

namespace hipr {

/// INSTANCE_CULL_* of a style.
uint32_t cullFlags(CullStyle style, bool doubleSided);

/// Whether faces of a mesh lie back to back. A ray that passes one of them would miss the other one, which is
/// at the same place. (UsdImaging's cards do, until the delegate moves them apart.)
bool hasFacesBackToBack(const TriangleMesh& mesh);

/// The same, remembered for the mesh that was asked for last.
class BackToBack {
public:
    bool of(const std::shared_ptr<const TriangleMesh>& mesh) {
        if (mesh != _mesh) {
            _mesh = mesh;
            _answer = hasFacesBackToBack(*mesh);
        }
        return _answer;
    }

private:
    std::shared_ptr<const TriangleMesh> _mesh;
    bool _answer = false;
};

} // namespace hipr
