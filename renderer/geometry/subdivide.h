/// @file subdivide.h
/// Uniform refinement of subdivision surfaces. Internal to renderer/geometry.
#pragma once

#include "renderer/geometry/cage.h"

namespace hipr::geometry {

/// A primvar over a RefinedSurface. Uniform and Constant views still count authored elements.
struct RefinedPrimvar {
    PrimvarView view;
    std::vector<uint32_t> cornerElement; ///< FaceVarying: element of each refined corner
};

/// The last level of refinement. Positions are on the limit surface.
struct RefinedSurface {
    std::vector<glm::vec3> positions;
    Polygons polygons;
    std::vector<uint32_t> cageFace;       ///< face of the cage that each face comes from
    std::vector<uint8_t> faceIsHole;      ///< empty: none
    std::vector<glm::vec3> vertexNormals; ///< limit normals, zero where there is none; empty for Bilinear
    std::vector<glm::vec3> cornerNormals; ///< per corner, when creases split vertex normals; else empty
    std::vector<RefinedPrimvar> primvars;
};

/// Refines cage.refineLevel (1 or more) times. False when OpenSubdiv refuses the topology; one message says
/// so.
bool subdivide(const MeshDesc& desc, const Cage& cage, const std::vector<PrimvarView>& primvars,
               const MessageSink& messages, RefinedSurface& surface);

} // namespace hipr::geometry
