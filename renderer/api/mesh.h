/// @file mesh.h
/// Polygon meshes in, triangle meshes out. Building is pure host work and may run on many threads at once.
#pragma once

#include <memory>

#include "renderer/api/motion.h"
#include "renderer/api/types.h"

namespace hipr {

enum class SubdivisionScheme { None, CatmullClark, Loop, Bilinear };
enum class BoundaryInterpolation { None, EdgeOnly, EdgeAndCorner };
enum class FaceVaryingInterpolation { None, CornersOnly, CornersPlus1, CornersPlus2, Boundaries, All };
enum class TriangleSubdivision { CatmullClark, Smooth };

/// A set of faces with its own material slot (a GeomSubset).
struct FaceSubset {
    std::vector<int> faces; ///< indices into MeshDesc::faceVertexCounts
};

/// A polygon mesh as authored: any polygon size, holes, either orientation, optional subdivision.
struct MeshDesc {
    std::string name;                  ///< used in messages; the prim path in a Hydra host
    std::vector<glm::vec3> points;     ///< object space
    std::vector<int> faceVertexCounts;
    std::vector<int> faceVertexIndices;
    std::vector<int> holeFaces;        ///< faces that are not rendered
    bool leftHanded = false;
    bool doubleSided = false;
    std::vector<FaceSubset> subsets;   ///< subset i uses material slot i + 1; other faces use slot 0
    std::vector<Primvar> primvars;     ///< `normals` is honoured when present and scheme is None
    bool flatNormals = false;          ///< force faceted shading (hull/flat reprs, scheme None without smooth)

    SubdivisionScheme scheme = SubdivisionScheme::None;
    int refineLevel = 0;               ///< 0..8; levels of uniform refinement when scheme is not None
    BoundaryInterpolation boundary = BoundaryInterpolation::EdgeAndCorner;
    FaceVaryingInterpolation faceVaryingLinear = FaceVaryingInterpolation::CornersPlus1;
    TriangleSubdivision triangleSubdivision = TriangleSubdivision::CatmullClark;
    std::vector<int> creaseIndices, creaseLengths, cornerIndices;
    std::vector<float> creaseWeights, cornerWeights; ///< 10 and above is infinitely sharp
};

/// A triangle-mesh primvar: `Vertex` values are per vertex of TriangleMesh::positions, `FaceVarying` three per
/// triangle, `Uniform` one per triangle (of segments: one per authored curve), `Constant` one. Never indexed.
struct TrianglePrimvar {
    std::string name;
    Interpolation interpolation;
    uint32_t components;
    std::vector<float> values;
};

/// What the renderer stores: validated triangles, or round segments in their place. All index and size invariants hold.
struct TriangleMesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;         ///< counter-clockwise seen from the front
    /// In place of triangles: the first vertex of each segment, of which the next one is the second. The vertices before
    /// and behind these two exist, too; there the curve comes from and goes to, or they are those at its ends once more.
    std::vector<uint32_t> segments;
    std::vector<float> radii;                  ///< at the vertices of segments, 0 or more; else empty
    std::vector<uint32_t> triangleFace;        ///< authored face or curve (elementId) of each triangle or segment
    std::vector<uint16_t> triangleSlot;        ///< material slot of each of them; empty: all slot 0
    std::vector<glm::vec3> normals;            ///< shading normals, unit length; empty: use geometric normals
    Interpolation normalInterpolation = Interpolation::Vertex; ///< Vertex or FaceVarying
    std::vector<TrianglePrimvar> primvars;
    bool doubleSided = false;
    std::vector<MeshKey> motion; ///< by rising time; below two it does not deform. The rest is at the frame's time
    glm::vec3 boundsMin{0.f}, boundsMax{0.f}; ///< of all times

    bool empty() const { return triangles.empty() && segments.empty(); }
    /// Triangles or segments.
    uint32_t primitiveCount() const { return uint32_t(triangles.size() + segments.size()); }
};

/// Validates, refines (OpenSubdiv) and triangulates. Never throws on bad data: broken faces, points and
/// primvars are dropped with one message each that names `desc.name`. Returns a mesh that may be empty.
///
/// Normals follow UsdGeomMesh: with scheme None the primvar `normals` if it is there, else facets; Bilinear is
/// faceted; CatmullClark and Loop have the limit surface's normals when refined (split along creases that are still
/// sharp at the last level) and angle-weighted vertex normals at level 0. Refined CatmullClark and Loop vertices lie on
/// the limit surface. Loop needs triangles: a mesh with other faces is refined by CatmullClark. Levels that would
/// give more than 67 million triangles are lowered.
std::shared_ptr<const TriangleMesh> buildTriangleMesh(const MeshDesc& desc, const MessageSink& messages);

/// New positions for an unchanged topology and unchanged primvars. Cheaper than buildTriangleMesh only for scheme None
/// without holes and authored normals, where triangles and primvars are taken from `old`.
std::shared_ptr<const TriangleMesh> updatePoints(const TriangleMesh& old, const MeshDesc& desc,
                                                 const MessageSink& messages);

/// A mesh as it is at a time, in frames from the one that is rendered.
using MeshShape = std::pair<float, std::shared_ptr<const TriangleMesh>>;

/// `mesh` with the shapes that it has at other times, which are to be in order of time. Null when one of them has another
/// number of vertices or triangles, or other segments.
std::shared_ptr<const TriangleMesh> withMotion(const TriangleMesh& mesh, const std::vector<MeshShape>& shapes);

} // namespace hipr
