#include "renderer/geometry/refiner.h"

#include <opensubdiv/far/topologyRefinerFactory.h>

using hipr::geometry::RefinerInput;

// OpenSubdiv asks a mesh class for its topology through these specialisations.
namespace OpenSubdiv {
namespace OPENSUBDIV_VERSION {
namespace Far {

template <>
bool TopologyRefinerFactory<RefinerInput>::resizeComponentTopology(TopologyRefiner& refiner,
                                                                   const RefinerInput& input) {
    const hipr::geometry::Polygons& polygons = input.cage.polygons;
    setNumBaseVertices(refiner, int(input.vertexSource.size()));
    setNumBaseFaces(refiner, int(polygons.faceCount()));
    for (size_t f = 0; f < polygons.faceCount(); ++f) {
        setNumBaseFaceVertices(refiner, int(f), int(polygons.faceSize(f)));
    }
    return true;
}

template <>
bool TopologyRefinerFactory<RefinerInput>::assignComponentTopology(TopologyRefiner& refiner,
                                                                   const RefinerInput& input) {
    const hipr::geometry::Polygons& polygons = input.cage.polygons;
    for (size_t f = 0; f < polygons.faceCount(); ++f) {
        IndexArray vertices = getBaseFaceVertices(refiner, int(f));
        for (int i = 0; i < vertices.size(); ++i) {
            vertices[i] = int(input.cornerVertex[polygons.faceStart[f] + uint32_t(i)]);
        }
    }
    return true;
}

template <>
bool TopologyRefinerFactory<RefinerInput>::assignComponentTags(TopologyRefiner& refiner,
                                                               const RefinerInput& input) {
    for (const hipr::geometry::SharpEdge& crease : input.cage.creases) {
        const uint32_t v0 = input.renumbered[crease.v0], v1 = input.renumbered[crease.v1];
        Index edge = INDEX_INVALID;
        if (v0 != RefinerInput::Unused && v1 != RefinerInput::Unused)
            edge = findBaseEdge(refiner, int(v0), int(v1));
        if (edge == INDEX_INVALID) {
            ++input.missingCreaseEdges;
        } else {
            setBaseEdgeSharpness(refiner, edge, crease.sharpness);
        }
    }
    for (const hipr::geometry::SharpVertex& corner : input.cage.corners) {
        const uint32_t vertex = input.renumbered[corner.vertex];
        if (vertex != RefinerInput::Unused) setBaseVertexSharpness(refiner, int(vertex), corner.sharpness);
    }
    for (size_t f = 0; f < input.cage.faceIsHole.size(); ++f) {
        if (input.cage.faceIsHole[f]) setBaseFaceHole(refiner, int(f), true);
    }
    return true;
}

template <>
bool TopologyRefinerFactory<RefinerInput>::assignFaceVaryingTopology(TopologyRefiner& refiner,
                                                                     const RefinerInput& input) {
    const hipr::geometry::Polygons& polygons = input.cage.polygons;
    for (const hipr::geometry::FaceVaryingTopology& topology : input.channels) {
        const int channel = createBaseFVarChannel(refiner, int(topology.representative.size()));
        for (size_t f = 0; f < polygons.faceCount(); ++f) {
            IndexArray values = getBaseFaceFVarValues(refiner, int(f), channel);
            for (int i = 0; i < values.size(); ++i) {
                values[i] = topology.cornerValue[polygons.faceStart[f] + uint32_t(i)];
            }
        }
    }
    return true;
}

template <>
void TopologyRefinerFactory<RefinerInput>::reportInvalidTopology(TopologyError, const char*,
                                                                 const RefinerInput&) {
    // Only called when full validation is asked for, which makeRefiner does not: Create's null answer is
    // enough.
}

} // namespace Far
} // namespace OPENSUBDIV_VERSION
} // namespace OpenSubdiv

namespace hipr::geometry {

namespace {

namespace Sdc = OpenSubdiv::Sdc;

Sdc::SchemeType schemeType(SubdivisionScheme scheme) {
    switch (scheme) {
    case SubdivisionScheme::Loop:
        return Sdc::SCHEME_LOOP;
    case SubdivisionScheme::Bilinear:
        return Sdc::SCHEME_BILINEAR;
    default:
        return Sdc::SCHEME_CATMARK;
    }
}

Sdc::Options::VtxBoundaryInterpolation boundaryRule(BoundaryInterpolation rule) {
    switch (rule) {
    case BoundaryInterpolation::None:
        return Sdc::Options::VTX_BOUNDARY_NONE;
    case BoundaryInterpolation::EdgeOnly:
        return Sdc::Options::VTX_BOUNDARY_EDGE_ONLY;
    case BoundaryInterpolation::EdgeAndCorner:
        break;
    }
    return Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER;
}

Sdc::Options::FVarLinearInterpolation faceVaryingRule(FaceVaryingInterpolation rule) {
    switch (rule) {
    case FaceVaryingInterpolation::None:
        return Sdc::Options::FVAR_LINEAR_NONE;
    case FaceVaryingInterpolation::CornersOnly:
        return Sdc::Options::FVAR_LINEAR_CORNERS_ONLY;
    case FaceVaryingInterpolation::CornersPlus1:
        return Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1;
    case FaceVaryingInterpolation::CornersPlus2:
        return Sdc::Options::FVAR_LINEAR_CORNERS_PLUS2;
    case FaceVaryingInterpolation::Boundaries:
        return Sdc::Options::FVAR_LINEAR_BOUNDARIES;
    case FaceVaryingInterpolation::All:
        break;
    }
    return Sdc::Options::FVAR_LINEAR_ALL;
}

Sdc::Options subdivisionOptions(const MeshDesc& desc) {
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(boundaryRule(desc.boundary));
    options.SetFVarLinearInterpolation(faceVaryingRule(desc.faceVaryingLinear));
    options.SetTriangleSubdivision(desc.triangleSubdivision == TriangleSubdivision::Smooth
                                       ? Sdc::Options::TRI_SUB_SMOOTH
                                       : Sdc::Options::TRI_SUB_CATMARK);
    return options;
}

} // namespace

RefinerInput::RefinerInput(const MeshDesc& d, const Cage& c)
    : desc(d), cage(c), renumbered(d.points.size(), Unused) {
    cornerVertex.reserve(c.polygons.vertex.size());
    for (const uint32_t point : c.polygons.vertex) {
        if (renumbered[point] == Unused) {
            renumbered[point] = uint32_t(vertexSource.size());
            vertexSource.push_back(point);
        }
        cornerVertex.push_back(renumbered[point]);
    }
}

std::unique_ptr<Far::TopologyRefiner> makeRefiner(const RefinerInput& input) {
    using Factory = Far::TopologyRefinerFactory<RefinerInput>;
    const Factory::Options options(schemeType(input.cage.scheme), subdivisionOptions(input.desc));
    std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(input, options));
    if (!refiner) return nullptr;
    Far::TopologyRefiner::UniformOptions uniform(input.cage.refineLevel);
    uniform.fullTopologyInLastLevel = true; // limit masks and sharp normals look at neighbours there
    refiner->RefineUniform(uniform);
    return refiner;
}

} // namespace hipr::geometry
