/// @file curves.h
/// Curves and points in, triangle meshes out. Building is pure host work and may run on many threads at once.
#pragma once

#include "renderer/api/mesh.h"

namespace hipr {

enum class CurveBasis { Linear, Bezier, BSpline, CatmullRom };
enum class CurveWrap {
    Nonperiodic,
    Periodic,
    Pinned,  ///< B-splines and Catmull-Rom splines that begin and end at their first and last points
    Segments ///< pairs of points, each a line (Linear only)
};

/// A set of curves as authored (UsdGeomBasisCurves).
struct CurvesDesc {
    std::string name; ///< used in messages; the prim path in a Hydra host
    CurveBasis basis = CurveBasis::Linear;
    CurveWrap wrap = CurveWrap::Nonperiodic;
    std::vector<int> vertexCounts; ///< control points of each curve
    std::vector<glm::vec3> points; ///< object space, curve after curve
    std::vector<int> pointIndices; ///< the point of each control point; empty: one after the other
    std::vector<int> hiddenCurves; ///< curves that are not drawn
    /// Vertex: one value a control point, interpolated by the basis; Vertex with Primvar::linear (USD's
    /// varying) and FaceVarying: one a segment's end, interpolated linearly; Uniform: one a curve. `widths`
    /// (diameters) and `normals` shape the curves; both are object space.
    std::vector<Primvar> primvars;
    float width = 1.f;   ///< where there is no primvar `widths`
    int refineLevel = 0; ///< 0..8; each level doubles steps and sides
};

/// How many values a varying primvar of such curves has.
size_t varyingCount(const CurvesDesc& desc);

/// Tubes, closed at both ends unless they are very thin hair, or with `normals` flat ribbons that face them.
/// At level 0 a cubic segment has 8 steps and a tube 16 sides, sets of more than 4,096 segments 4 steps and 8
/// sides; where that would give more than 16 million triangles, 4 or 3 sides. elementId is the curve. Curves
/// with too few points, with points that are no numbers, or beyond the end of `points` are dropped with one
/// message for each reason. Never throws on bad data.
///
/// Frames are carried along the curve by double reflection: W. Wang et al., "Computation of Rotation
/// Minimizing Frames", ACM Transactions on Graphics 27(1), 2008.
std::shared_ptr<const TriangleMesh> buildCurves(const CurvesDesc& desc, const MessageSink& messages);

/// A sphere of radius 1 with smooth normals: an icosahedron, its triangles quartered `level` times (0..6).
std::shared_ptr<TriangleMesh> unitSphere(const std::string& name, int level);

/// A double-sided disk of radius 1 in the xy plane.
std::shared_ptr<TriangleMesh> unitDisk(const std::string& name, int corners);

} // namespace hipr
