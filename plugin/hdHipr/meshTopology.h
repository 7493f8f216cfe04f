/// @file meshTopology.h
/// Hydra topology, subdivision tags and repr -> the renderer's mesh description.
#pragma once

#include "pxr/imaging/hd/mesh.h"
#include "pxr/pxr.h"
#include "renderer/api/mesh.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// Faces, holes, orientation, subdivision scheme and subsets. Points and primvars are left as they are.
void setTopology(HdMeshTopology const& topology, hipr::MeshDesc& desc);

/// Boundary rules, creases and corners.
void setSubdivTags(PxOsdSubdivTags const& tags, hipr::MeshDesc& desc);

/// What a repr and a display style ask of the shape.
struct MeshStyle {
    int refineLevel = 0;
    bool flat = false;
    bool operator==(MeshStyle const& o) const { return refineLevel == o.refineLevel && flat == o.flat; }
};

/// Reprs that draw wires or points are drawn as the surface they belong to.
MeshStyle meshStyle(HdMeshReprDesc const& repr, HdDisplayStyle const& display);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
