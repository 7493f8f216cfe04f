#include "plugin/hdHipr/meshTopology.h"

#include <algorithm>

#include "pxr/imaging/pxOsd/subdivTags.h"
#include "pxr/imaging/pxOsd/tokens.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

template <class T> std::vector<T> toVector(VtArray<T> const& array) {
    return std::vector<T>(array.cdata(), array.cdata() + array.size());
}

hipr::SubdivisionScheme toScheme(TfToken const& token) {
    if (token == PxOsdOpenSubdivTokens->catmullClark) {
        return hipr::SubdivisionScheme::CatmullClark;
    }
    if (token == PxOsdOpenSubdivTokens->loop) {
        return hipr::SubdivisionScheme::Loop;
    }
    if (token == PxOsdOpenSubdivTokens->bilinear) {
        return hipr::SubdivisionScheme::Bilinear;
    }
    return hipr::SubdivisionScheme::None;
}

hipr::BoundaryInterpolation toBoundary(TfToken const& token) {
    if (token == PxOsdOpenSubdivTokens->none) {
        return hipr::BoundaryInterpolation::None;
    }
    if (token == PxOsdOpenSubdivTokens->edgeOnly) {
        return hipr::BoundaryInterpolation::EdgeOnly;
    }
    return hipr::BoundaryInterpolation::EdgeAndCorner;
}

hipr::FaceVaryingInterpolation toFaceVarying(TfToken const& token) {
    using Rule = hipr::FaceVaryingInterpolation;
    if (token == PxOsdOpenSubdivTokens->none) {
        return Rule::None;
    }
    if (token == PxOsdOpenSubdivTokens->cornersOnly) {
        return Rule::CornersOnly;
    }
    if (token == PxOsdOpenSubdivTokens->cornersPlus2) {
        return Rule::CornersPlus2;
    }
    if (token == PxOsdOpenSubdivTokens->boundaries) {
        return Rule::Boundaries;
    }
    if (token == PxOsdOpenSubdivTokens->all) {
        return Rule::All;
    }
    return Rule::CornersPlus1;
}

} // namespace

void setTopology(HdMeshTopology const& topology, hipr::MeshDesc& desc) {
    desc.faceVertexCounts = toVector(topology.GetFaceVertexCounts());
    desc.faceVertexIndices = toVector(topology.GetFaceVertexIndices());
    desc.holeFaces = toVector(topology.GetHoleIndices());
    const std::vector<int> invisible = toVector(topology.GetInvisibleFaces());
    desc.holeFaces.insert(desc.holeFaces.end(), invisible.begin(), invisible.end());
    desc.leftHanded = topology.GetOrientation() == PxOsdOpenSubdivTokens->leftHanded;
    desc.scheme = toScheme(topology.GetScheme());
    desc.subsets.clear();
    for (HdGeomSubset const& subset : topology.GetGeomSubsets()) {
        desc.subsets.push_back({toVector(subset.indices)});
    }
}

void setSubdivTags(PxOsdSubdivTags const& tags, hipr::MeshDesc& desc) {
    desc.boundary = toBoundary(tags.GetVertexInterpolationRule());
    desc.faceVaryingLinear = toFaceVarying(tags.GetFaceVaryingInterpolationRule());
    desc.triangleSubdivision = tags.GetTriangleSubdivision() == PxOsdOpenSubdivTokens->smooth
                                   ? hipr::TriangleSubdivision::Smooth
                                   : hipr::TriangleSubdivision::CatmullClark;
    desc.creaseIndices = toVector(tags.GetCreaseIndices());
    desc.creaseLengths = toVector(tags.GetCreaseLengths());
    desc.creaseWeights = toVector(tags.GetCreaseWeights());
    desc.cornerIndices = toVector(tags.GetCornerIndices());
    desc.cornerWeights = toVector(tags.GetCornerWeights());
}

MeshStyle meshStyle(HdMeshReprDesc const& repr, HdDisplayStyle const& display) {
    const bool refined = repr.geomStyle == HdMeshGeomStyleSurf || repr.geomStyle == HdMeshGeomStyleEdgeOnly ||
                         repr.geomStyle == HdMeshGeomStyleEdgeOnSurf ||
                         repr.geomStyle == HdMeshGeomStylePoints;
    return {refined ? std::clamp(display.refineLevel, 0, 8) : 0,
            repr.flatShadingEnabled || display.flatShadingEnabled};
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
