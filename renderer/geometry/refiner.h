/// @file refiner.h
/// A Cage as an OpenSubdiv topology. Internal to renderer/geometry.
#pragma once

#include <memory>

#include <opensubdiv/far/topologyRefiner.h>

#include "renderer/geometry/cage.h"

namespace hipr::geometry {

namespace Far = OpenSubdiv::Far;

/// How a face-varying primvar's values connect: two corners of neighbouring faces at the same vertex share a
/// value, or there is a seam between them.
struct FaceVaryingTopology {
    std::vector<int> cornerValue;         ///< value of each cage corner
    std::vector<uint32_t> representative; ///< a cage corner that carries each value
};

/// Corners share a value when they have the same authored index, or, without indices, equal numbers: hosts
/// often flatten indexed primvars, and seams must not appear just because of that.
FaceVaryingTopology connectFaceVarying(const Cage& cage, const PrimvarView& view);

/// What OpenSubdiv needs to know. Only vertices that faces use take part, renumbered.
struct RefinerInput {
    RefinerInput(const MeshDesc& desc, const Cage& cage);

    const MeshDesc& desc;
    const Cage& cage;
    std::vector<uint32_t> cornerVertex; ///< renumbered vertex of each cage corner
    std::vector<uint32_t> vertexSource; ///< authored point of each renumbered vertex
    std::vector<uint32_t> renumbered;   ///< authored point -> vertex, or Unused
    std::vector<FaceVaryingTopology> channels;
    mutable size_t missingCreaseEdges = 0; ///< found while the topology is built

    static constexpr uint32_t Unused = 0xffffffffu;
};

/// Builds the topology and refines it uniformly to cage.refineLevel, with the full topology of the last
/// level. Null when OpenSubdiv refuses it.
std::unique_ptr<Far::TopologyRefiner> makeRefiner(const RefinerInput& input);

} // namespace hipr::geometry
