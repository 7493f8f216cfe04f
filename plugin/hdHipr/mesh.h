/// @file mesh.h
/// HdHiprMesh: one polygon mesh and all its instances.
#pragma once

#include <memory>
#include <vector>

#include "plugin/hdHipr/meshLight.h"
#include "plugin/hdHipr/meshTopology.h"
#include "plugin/hdHipr/objectPrim.h"
#include "plugin/hdHipr/primvars.h"
#include "plugin/hdHipr/velocity.h"
#include "renderer/api/scene.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Sync turns dirty bits into the smallest edit: a moved mesh sends transforms, a deformed one new points, a
/// rebound one materials; only changed topology, subdivision or primvars build the triangles again (on the
/// Sync thread).
class HdHiprMesh final : public hdhipr::ObjectPrim<HdMesh> {
public:
    HdHiprMesh(SdfPath const& id, SdfPath const& instancerId, HdHiprRenderParam& param);

    HdDirtyBits GetInitialDirtyBitsMask() const override;
    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits,
              TfToken const& reprToken) override;
    void Finalize(HdRenderParam* renderParam) override;

protected:
    void _InitRepr(TfToken const& reprToken, HdDirtyBits* dirtyBits) override;
    HdDirtyBits _PropagateDirtyBits(HdDirtyBits bits) const override;
    void describe(HdSceneDelegate& delegate, HdHiprRenderParam& param, hipr::ObjectDesc& desc) override;

private:
    enum class Rebuild { None, Points, All };

    Rebuild syncTopology(HdSceneDelegate* delegate, HdDirtyBits bits, TfToken const& reprToken);
    Rebuild syncPrimvars(HdSceneDelegate* delegate, HdDirtyBits bits);
    Rebuild setPrimvar(HdPrimvarDescriptor const& descriptor, VtValue const& value,
                       VtIntArray const& indices);
    HdPrimvarDescriptor const& meant(HdPrimvarDescriptorVector const& same, VtValue const& value,
                                     VtIntArray const& indices);
    Rebuild setPoints(VtValue const& value);
    void syncComputedPrimvars(HdSceneDelegate* delegate, HdDirtyBits bits, TfTokenVector* names,
                              Rebuild* rebuild);
    void sendGeometry(HdSceneDelegate& delegate, Rebuild rebuild, HdHiprRenderParam& param);
    std::shared_ptr<const hipr::TriangleMesh> meshWithMotion(HdSceneDelegate& delegate,
                                                             hdhipr::Sampling const& sampling) const;
    hipr::MaterialId shining(HdSceneDelegate& delegate, HdHiprRenderParam& param, size_t slot,
                             SdfPath const& base);
    void stopShining(HdHiprRenderParam& param);

    hipr::GeometryId _geometry;
    hipr::MeshDesc
        _desc; ///< kept: an edit of one part needs the others, and Hydra drops what it has handed over
    hdhipr::DescriptorChoice _descriptorChoice;
    TfToken _reprToken; ///< the repr that `_style` is for
    hdhipr::MeshStyle _style;
    bool _computed = false;                                           ///< some primvars are computed
    std::optional<HdExtComputationPrimvarDescriptor> _pointsComputed; ///< the points are among them
    hdhipr::PointVelocities _velocities;
    SdfPathVector _subsetMaterials;
    std::string _lightGroup; ///< of what it emits
    std::optional<hdhipr::MeshLight> _light;
    std::vector<hipr::MaterialId> _shining; ///< by slot, if it is a light
    std::shared_ptr<const hipr::TriangleMesh> _mesh;
};

PXR_NAMESPACE_CLOSE_SCOPE
