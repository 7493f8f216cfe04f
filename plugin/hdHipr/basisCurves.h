/// @file basisCurves.h
/// HdHiprBasisCurves: a set of curves, drawn as tubes or ribbons.
#pragma once

#include "plugin/hdHipr/shapePrim.h"
#include "pxr/imaging/hd/basisCurves.h"
#include "renderer/api/curves.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprBasisCurves final : public hdhipr::ShapePrim<HdBasisCurves> {
public:
    using ShapePrim::ShapePrim;

protected:
    std::shared_ptr<const hipr::TriangleMesh> readShape(HdSceneDelegate& delegate) override;
    std::shared_ptr<const hipr::TriangleMesh> shapeOf(VtValue const& points) override;

private:
    hipr::CurvesDesc _desc; ///< as read last
};

PXR_NAMESPACE_CLOSE_SCOPE
