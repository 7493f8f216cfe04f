/// @file cage.h
/// The validated form of a MeshDesc that every later step reads. Internal to renderer/geometry.
#pragma once

#include "renderer/api/mesh.h"

namespace hipr::geometry {

/// Polygons over some vertex array. Corner c of the soup is vertex[c]; face f owns corners
/// faceStart[f] .. faceStart[f + 1].
struct Polygons {
    std::vector<uint32_t> faceStart{0};
    std::vector<uint32_t> vertex;

    size_t faceCount() const { return faceStart.size() - 1; }
    uint32_t faceSize(size_t face) const { return faceStart[face + 1] - faceStart[face]; }
};

/// A crease edge or a sharp vertex (`v1` unused), sharpness in 0..10 where 10 is infinitely sharp.
struct SharpEdge {
    uint32_t v0, v1;
    float sharpness;
};
struct SharpVertex {
    uint32_t vertex;
    float sharpness;
};

/// The faces of a MeshDesc that can be built. Every face has 3 or more corners, no corner equals the next
/// one, all vertices exist and are finite, and corners run counter-clockwise seen from the front whatever the
/// authored orientation.
struct Cage {
    Polygons polygons;
    std::vector<uint32_t> cornerSource; ///< authored corner (index into faceVertexIndices) of each corner
    std::vector<uint32_t> faceSource;   ///< authored face of each face
    std::vector<uint16_t> faceSlot;     ///< material slot of each face; empty: all 0
    std::vector<uint8_t>
        faceIsHole; ///< empty: no holes. Holes shape a subdivision surface, so they stay here.
    std::vector<SharpEdge> creases;
    std::vector<SharpVertex> corners;
    SubdivisionScheme scheme = SubdivisionScheme::None;
    int refineLevel = 0; ///< 0 when scheme is None
};

/// A usable primvar: every element of its interpolation's domain (authored numbering) has a finite value.
struct PrimvarView {
    std::string name;
    Interpolation interpolation;
    uint32_t components;
    bool linear;         ///< Vertex only: not smoothed by subdivision
    const float* values; ///< points into the description, or into `repaired`
    const int* indices;  ///< element -> value, or null when element e has value e
    std::vector<float> repaired;

    const float* at(size_t element) const {
        return values + size_t(components) * (indices ? size_t(indices[element]) : element);
    }
};

/// Sends one warning about the mesh.
void warn(const MessageSink& messages, const std::string& mesh, const std::string& text);

/// Finite in all three coordinates.
bool isFinite(const glm::vec3& point);

/// Drops what cannot be built and says so, one message per kind of problem.
Cage validateFaces(const MeshDesc& desc, const MessageSink& messages);

/// Fills scheme, refineLevel, creases and corners of `cage` from the description.
void validateSubdivision(const MeshDesc& desc, const MessageSink& messages, Cage& cage);

/// The primvars whose sizes and indices fit, truncated to their domain; names are unique.
std::vector<PrimvarView> validatePrimvars(const MeshDesc& desc, const MessageSink& messages);

} // namespace hipr::geometry
