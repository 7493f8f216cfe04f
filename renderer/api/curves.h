/// @file curves.h
/// Curves and points in, meshes of triangles or round segments out. Building is pure host work and may run on many threads at once.
#pragma once

#include <optional>

#include "renderer/api/mesh.h"

namespace hipr {

enum class CurveBasis { Linear, Bezier, BSpline, CatmullRom };
enum class CurveWrap {
    Nonperiodic,
    Periodic,
    Pinned,  ///< B-splines and Catmull-Rom splines that begin and end at their first and last points
    Segments ///< pairs of points, each a line (Linear only)
};

/// How curves are built.
struct CurveForm {
    bool round = false;         ///< of round segments, else of triangles
    std::vector<uint8_t> steps; ///< round: how many segments are made of each of all authored curves' segments
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
    /// As it was chosen for the same curves with other points; none: as curveForm() chooses. For shapes at other times,
    /// which have to have as many vertices.
    std::optional<CurveForm> form;
};

/// How many values a varying primvar of such curves has.
size_t varyingCount(const CurvesDesc& desc);

/// Sets of more segments than this are hair.
constexpr size_t FewCurveSegments = 4096;

/// Round segments for curves that are on average over 100 times as long as wide, or more than 4,096 segments;
/// triangles for others, and for all that have `normals`. A cubic segment has up to 4 steps, doubled at each of the
/// first four levels, as many as keep it within an eighth of its width, or a hundredth of its length, and a quarter of
/// that at each level.
CurveForm curveForm(const CurvesDesc& desc);

/// Thin curves and hair of round segments, whatever the point of view: spheres swept along, seen from outside alone
/// (shaders/shared/segment.h). Others are tubes of triangles, closed at both ends, or with `normals` flat ribbons that
/// face them: at level 0 a cubic segment has 8 steps and a tube 16 sides, ribbons of more than 4,096 segments 4 steps;
/// where that would give more than 16 million triangles, tubes have fewer sides. elementId is the curve. Curves
/// with too few points, with points that are no numbers, above 1e18, or beyond the end of `points` are dropped with one
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
