/// @file finish.h
/// Last steps of every kind of triangle mesh. Internal to renderer/geometry.
#pragma once

#include <new>
#include <stdexcept>

#include "renderer/api/mesh.h"

namespace hipr::geometry {

/// Bounds of the vertices that triangles and segments use; authored points may hold unused ones anywhere.
void setBounds(TriangleMesh& mesh);

/// The renderer keeps going when one mesh is too large for the machine.
template <typename Make>
std::shared_ptr<const TriangleMesh> orEmptyMesh(const std::string& name, const MessageSink& messages,
                                                const Make& make) {
    try {
        return make();
    } catch (const std::bad_alloc&) {
        if (messages) messages(Severity::Error, name, "dropped: out of memory");
    } catch (const std::length_error&) {
        if (messages) messages(Severity::Error, name, "dropped: too large");
    }
    auto empty = std::make_shared<TriangleMesh>();
    empty->name = name;
    return empty;
}

} // namespace hipr::geometry
