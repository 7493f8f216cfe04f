/// @file points.h
/// HdHiprPoints: a set of points, drawn as spheres or, with normals, as disks.
#pragma once

#include "plugin/hdHipr/shapePrim.h"
#include "pxr/imaging/hd/points.h"

PXR_NAMESPACE_OPEN_SCOPE

/// One small geometry and an instance of it for each point, so that millions of points need no triangles of
/// their own.
class HdHiprPoints final : public hdhipr::ShapePrim<HdPoints> {
public:
    using ShapePrim::ShapePrim;

protected:
    std::shared_ptr<const hipr::TriangleMesh> readShape(HdSceneDelegate& delegate) override;
    std::shared_ptr<const hipr::TriangleMesh> shapeOf(VtValue const&) override { return nullptr; }
    hipr::InstancesDesc instances(HdSceneDelegate& delegate, hdhipr::Sampling const& sampling) override;
    bool shapePlacesInstances() const override { return true; }

private:
    void place(std::vector<glm::vec3> const& points, std::vector<hipr::Primvar>& primvars);
    hipr::InstanceMotion motion(HdSceneDelegate& delegate, hipr::InstancesDesc const& placed,
                                hdhipr::Sampling const& sampling);

    std::vector<glm::mat4> _placements;   ///< of the unit shape, in the space of the prim
    std::vector<uint32_t> _placed;        ///< which point each of them is of
    std::vector<hipr::Primvar> _perPoint; ///< one value for each of them
};

PXR_NAMESPACE_CLOSE_SCOPE
