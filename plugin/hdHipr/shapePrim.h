/// @file shapePrim.h
/// What prims have in common whose shape is read as a whole: curves and points.
#pragma once

#include <algorithm>
#include <vector>

#include "plugin/hdHipr/motion.h"
#include "plugin/hdHipr/objectPrim.h"
#include "plugin/hdHipr/primvars.h"
#include "plugin/hdHipr/velocity.h"
#include "pxr/imaging/hd/tokens.h"
#include "renderer/api/mesh.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// An Rprim with one geometry and one object. A change of any part of its shape reads all of it again; a
/// moved or hidden prim sends transforms or visibility.
template <class Base> class ShapePrim : public ObjectPrim<Base> {
    using ObjectPrim<Base>::objectBits;
    using ObjectPrim<Base>::instanceBits;

public:
    ShapePrim(SdfPath const& id, SdfPath const& instancerId, HdHiprRenderParam& param)
        : ObjectPrim<Base>(id, instancerId, param), _geometry(param.newId<hipr::GeometryId>()) {}

    HdDirtyBits GetInitialDirtyBitsMask() const final {
        return HdChangeTracker::InitRepr | objectBits | instanceBits | shapeBits;
    }

    void Finalize(HdRenderParam* renderParam) final {
        auto& param = static_cast<HdHiprRenderParam&>(*renderParam);
        this->removeObject(param);
        param.edit().removeGeometry(_geometry);
        Base::Finalize(renderParam);
    }

    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits,
              TfToken const&) final {
        auto& param = static_cast<HdHiprRenderParam&>(*renderParam);
        const HdDirtyBits bits = this->syncBase(delegate, dirtyBits);
        const Sampling sampling = param.sampling();
        if (bits & shapeBits) {
            param.edit().setGeometry(_geometry, shapeWithMotion(*delegate, sampling));
        }
        const bool relinked = this->syncLinks(*delegate, bits);
        if (bits & objectBits) {
            this->sendObject(*delegate, param);
        }
        const HdDirtyBits placing = shapePlacesInstances() ? instanceBits | shapeBits : instanceBits;
        if (relinked || (bits & placing)) {
            this->sendInstances(instances(*delegate, sampling), param);
        }
        *dirtyBits = HdChangeTracker::Clean;
    }

protected:
    /// Reads all of the shape: Hydra drops what it has handed over.
    virtual std::shared_ptr<const hipr::TriangleMesh> readShape(HdSceneDelegate& delegate) = 0;
    /// The shape that was read last with other points; null where these do not shape it.
    virtual std::shared_ptr<const hipr::TriangleMesh> shapeOf(VtValue const& points) = 0;
    /// Where the geometry stands; with an open shutter also at other times.
    virtual hipr::InstancesDesc instances(HdSceneDelegate& delegate, Sampling const& sampling) {
        return this->standingAt(delegate, sampling);
    }
    /// Whether instances() depends on the shape.
    virtual bool shapePlacesInstances() const { return false; }

    /// Reads the points of the shape.
    std::vector<glm::vec3> readPoints(HdSceneDelegate& delegate) {
        return _points = toVec3s(delegate.Get(this->GetId(), HdTokens->points));
    }
    /// The points of the shape that was read last while the shutter is open: by velocities where it has them.
    Samples<VtValue> samplePoints(HdSceneDelegate& delegate, Sampling const& sampling) {
        return _velocities.samples(delegate, this->GetId(), _points, sampling);
    }

    /// All authored primvars but the points. `elements` tells how many values an interpolation has.
    template <class Elements>
    std::vector<hipr::Primvar> readPrimvars(HdSceneDelegate& delegate, Elements elements) {
        HdPrimvarDescriptorVector authored;
        for (int i = 0; i < HdInterpolationCount; ++i) {
            const auto some = this->GetPrimvarDescriptors(&delegate, HdInterpolation(i));
            authored.insert(authored.end(), some.begin(), some.end());
        }
        std::vector<hipr::Primvar> primvars;
        _velocities = PointVelocities();
        for (HdPrimvarDescriptorVector const& same : byName(authored)) {
            if (same.front().name == HdTokens->points) {
                continue;
            }
            VtIntArray indices;
            const VtValue value = this->readPrimvar(&delegate, same.front().name, &indices);
            _velocities.read(same.front().name, value);
            const size_t count = !indices.empty()        ? indices.size()
                                 : value.IsArrayValued() ? value.GetArraySize()
                                                         : 1;
            std::vector<bool> fits;
            for (HdPrimvarDescriptor const& descriptor : same) {
                fits.push_back(elements(descriptor.interpolation) == count);
            }
            HdPrimvarDescriptor const& meant = _descriptorChoice.choose(same, fits, std::nullopt);
            const std::optional<hipr::Interpolation> interpolation = toInterpolation(meant.interpolation);
            std::optional<hipr::Primvar> primvar = toPrimvar(meant.name, value);
            if (!interpolation || !primvar) {
                continue;
            }
            primvar->interpolation = *interpolation;
            primvar->linear = meant.interpolation == HdInterpolationVarying;
            primvar->indices.assign(indices.cdata(), indices.cdata() + indices.size());
            primvars.push_back(std::move(*primvar));
        }
        _velocities.takeUnfit(this->GetId(), _points.size(), primvars);
        return primvars;
    }

    /// There is one way to draw these prims.
    void _InitRepr(TfToken const&, HdDirtyBits*) final {}

    /// So that the host prepares all of the shape.
    HdDirtyBits _PropagateDirtyBits(HdDirtyBits bits) const final {
        return bits & shapeBits ? bits | shapeBits : bits;
    }

    void describe(HdSceneDelegate&, HdHiprRenderParam& param, hipr::ObjectDesc& desc) final {
        desc.geometry = _geometry;
        desc.materials = {param.materialId(this->GetMaterialId())};
    }

private:
    /// Samples come last: UsdImaging hands out the points once, and asking for samples of them counts.
    std::shared_ptr<const hipr::TriangleMesh> shapeWithMotion(HdSceneDelegate& delegate,
                                                              Sampling const& sampling) {
        const std::shared_ptr<const hipr::TriangleMesh> shape = readShape(delegate);
        if (!_velocities.any()) {
            _points = {}; // which velocities alone need
        }
        if (!sampling.open()) {
            return shape;
        }
        return deforming(this->GetId(), shape, samplePoints(delegate, sampling),
                         [this](VtValue const& points) { return shapeOf(points); });
    }

    static constexpr HdDirtyBits shapeBits =
        HdChangeTracker::DirtyTopology | HdChangeTracker::DirtyPoints | HdChangeTracker::DirtyNormals |
        HdChangeTracker::DirtyWidths | HdChangeTracker::DirtyPrimvar | HdChangeTracker::DirtyDisplayStyle;

    hipr::GeometryId _geometry;
    DescriptorChoice _descriptorChoice;
    PointVelocities _velocities;
    std::vector<glm::vec3> _points; ///< at the frame, where there are velocities
};

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
