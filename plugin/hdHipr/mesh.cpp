#include "plugin/hdHipr/mesh.h"

#include <algorithm>

#include "plugin/hdHipr/cards.h"
#include "plugin/hdHipr/convert.h"
#include "plugin/hdHipr/material.h"
#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/motion.h"
#include "plugin/hdHipr/primvars.h"
#include "pxr/imaging/hd/tokens.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

/// What changes the object of a mesh: subsets name materials.
constexpr HdDirtyBits meshBits = HdChangeTracker::DirtyTopology | HdChangeTracker::DirtyCullStyle;
constexpr HdDirtyBits styleBits =
    HdChangeTracker::DirtyDisplayStyle | HdChangeTracker::DirtyRepr | HdChangeTracker::NewRepr;
constexpr HdDirtyBits primvarBits = HdChangeTracker::DirtyPoints | HdChangeTracker::DirtyNormals |
                                    HdChangeTracker::DirtyWidths | HdChangeTracker::DirtyPrimvar |
                                    HdChangeTracker::DirtyComputationPrimvarDesc;

} // namespace

HdHiprMesh::HdHiprMesh(SdfPath const& id, SdfPath const& instancerId, HdHiprRenderParam& param)
    : ObjectPrim(id, instancerId, param), _geometry(param.newId<hipr::GeometryId>()) {
    _desc.name = id.GetString();
}

HdDirtyBits HdHiprMesh::GetInitialDirtyBitsMask() const {
    return HdChangeTracker::InitRepr | objectBits | meshBits | instanceBits | primvarBits |
           HdChangeTracker::DirtyDisplayStyle | HdChangeTracker::DirtyRepr |
           HdChangeTracker::DirtySubdivTags | HdChangeTracker::DirtyDoubleSided;
}

/// Decides what the scene delegate prepares for Sync.
HdDirtyBits HdHiprMesh::_PropagateDirtyBits(HdDirtyBits bits) const {
    // UsdImaging says DirtyPrimvar when normals come, go, or change their interpolation, but looks at normals
    // only when DirtyNormals is asked for.
    if (bits & HdChangeTracker::DirtyPrimvar) {
        bits |= HdChangeTracker::DirtyNormals;
    }
    // Skinning reads the transform and primvars of the mesh, and UsdImaging marks no more than them and the
    // computation.
    constexpr HdDirtyBits inputs = HdChangeTracker::DirtyTransform | HdChangeTracker::DirtyPrimvar;
    return _computed && (bits & inputs) ? bits | HdChangeTracker::DirtyComputationPrimvarDesc : bits;
}

void HdHiprMesh::_InitRepr(TfToken const& reprToken, HdDirtyBits* dirtyBits) {
    const auto known = std::find_if(_reprs.begin(), _reprs.end(), _ReprComparator(reprToken));
    if (known == _reprs.end()) {
        _reprs.emplace_back(reprToken, HdReprSharedPtr());
    } else if (reprToken == _reprToken) {
        return;
    }
    // Also for one that was left and comes back: Hydra takes DirtyRepr off before it syncs.
    *dirtyBits |= HdChangeTracker::NewRepr;
}

void HdHiprMesh::Finalize(HdRenderParam* renderParam) {
    auto& param = static_cast<HdHiprRenderParam&>(*renderParam);
    removeObject(param);
    stopShining(param);
    param.edit().removeGeometry(_geometry);
    HdMesh::Finalize(renderParam);
}

void HdHiprMesh::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits,
                      TfToken const& reprToken) {
    auto& param = static_cast<HdHiprRenderParam&>(*renderParam);
    const HdDirtyBits bits = syncBase(delegate, dirtyBits);

    const std::string lightGroup = _lightGroup;
    Rebuild rebuild = syncTopology(delegate, bits, reprToken);
    if (bits & primvarBits) {
        rebuild = std::max(rebuild, syncPrimvars(delegate, bits));
    }
    if (rebuild != Rebuild::None) {
        sendGeometry(*delegate, rebuild, param);
    }
    const bool relinked = syncLinks(*delegate, bits);
    const bool areaChanged =
        _light && _light->normalize && (rebuild != Rebuild::None || (bits & instanceBits));
    if ((bits & (objectBits | meshBits)) || lightGroup != _lightGroup || areaChanged) {
        sendObject(*delegate, param);
    }
    if (relinked || (bits & instanceBits)) {
        sendInstances(standingAt(*delegate, param.sampling()), param);
    }
    *dirtyBits = HdChangeTracker::Clean; // custom bits, too: AllDirty holds them
}

HdHiprMesh::Rebuild HdHiprMesh::syncTopology(HdSceneDelegate* delegate, HdDirtyBits bits,
                                             TfToken const& reprToken) {
    Rebuild rebuild = Rebuild::None;
    if (bits & HdChangeTracker::DirtyTopology) {
        const HdMeshTopology topology = GetMeshTopology(delegate);
        setTopology(topology, _desc);
        _subsetMaterials.clear();
        for (HdGeomSubset const& subset : topology.GetGeomSubsets()) {
            _subsetMaterials.push_back(subset.materialId);
        }
        rebuild = Rebuild::All;
    }
    if (bits & (HdChangeTracker::DirtyTopology | HdChangeTracker::DirtySubdivTags)) {
        if (_desc.scheme != hipr::SubdivisionScheme::None) {
            setSubdivTags(GetSubdivTags(delegate), _desc);
        }
        rebuild = Rebuild::All;
    }
    if (bits & HdChangeTracker::DirtyDoubleSided) {
        const bool doubleSided = IsDoubleSided(delegate);
        if (doubleSided != _desc.doubleSided) {
            rebuild = Rebuild::All;
        }
        _desc.doubleSided = doubleSided;
    }
    if ((bits & styleBits) || reprToken != _reprToken) {
        const MeshStyle style = meshStyle(_GetReprDesc(reprToken)[0], GetDisplayStyle(delegate));
        if (!(style == _style)) {
            rebuild = Rebuild::All;
        }
        _style = style;
        _reprToken = reprToken;
    }
    return rebuild;
}

void HdHiprMesh::sendGeometry(HdSceneDelegate& delegate, Rebuild rebuild, HdHiprRenderParam& param) {
    const bool hasNormals = std::any_of(_desc.primvars.begin(), _desc.primvars.end(),
                                        [](hipr::Primvar const& pv) { return HdTokens->normals == pv.name; });
    const bool faceted =
        _desc.scheme == hipr::SubdivisionScheme::None || _desc.scheme == hipr::SubdivisionScheme::Bilinear;
    _desc.refineLevel = _style.refineLevel;
    _desc.flatNormals = _style.flat || (faceted && !hasNormals);
    const bool pointsOnly = rebuild == Rebuild::Points && _mesh && !_mesh->triangles.empty();
    // Not for good: there may be other points before there are other velocities.
    std::vector<hipr::Primvar> unfit = _velocities.takeUnfit(GetId(), _desc.points.size(), _desc.primvars);
    _mesh = pointsOnly ? hipr::updatePoints(*_mesh, _desc, report) : hipr::buildTriangleMesh(_desc, report);
    std::move(unfit.begin(), unfit.end(), std::back_inserter(_desc.primvars));
    param.edit().setGeometry(_geometry, meshWithMotion(delegate, param.sampling()));
}

/// Samples are read after the points: UsdImaging hands those out once, and asking for samples counts.
std::shared_ptr<const hipr::TriangleMesh> HdHiprMesh::meshWithMotion(HdSceneDelegate& delegate,
                                                                     Sampling const& sampling) const {
    if (!sampling.open()) {
        return _mesh;
    }
    const Samples<VtValue> points = _pointsComputed
                                        ? sampleComputed(delegate, GetId(), *_pointsComputed)
                                        : _velocities.samples(delegate, GetId(), _desc.points, sampling);
    if (points.values.empty() && _pointsComputed) {
        warnOnce(GetId().GetString(),
                 "its points are computed (skinning), and the host does not tell how they move; "
                 "while the shutter is open it stays as it is at the frame's time");
    }
    hipr::MeshDesc desc = _desc; // whose other primvars no shape needs
    const auto others = [](hipr::Primvar const& pv) { return HdTokens->normals != pv.name; };
    desc.primvars.erase(std::remove_if(desc.primvars.begin(), desc.primvars.end(), others),
                        desc.primvars.end());
    return deforming(GetId(), _mesh, points, [&](VtValue const& value) {
        desc.points = toVec3s(value);
        return hipr::buildTriangleMesh(desc, [](hipr::Severity, std::string const&, std::string const&) {});
    });
}

void HdHiprMesh::describe(HdSceneDelegate& delegate, HdHiprRenderParam& param, hipr::ObjectDesc& desc) {
    desc.geometry = _geometry;
    desc.lightGroup = _lightGroup;
    desc.cull = isCards(_desc) ? hipr::CullStyle::BackAndForLight : toCullStyle(GetCullStyle(&delegate));
    _light = meshLight(&delegate, GetId());
    if (_light) {
        desc.light = _light->controls;
        if (_lightGroup.empty()) {
            desc.lightGroup = _light->group;
        }
    } else {
        stopShining(param);
    }
    SdfPathVector paths = {GetMaterialId()};
    for (SdfPath const& path : _subsetMaterials) {
        paths.push_back(path.IsEmpty() ? GetMaterialId() : path);
    }
    for (size_t slot = 0; slot < paths.size(); ++slot) {
        desc.materials.push_back(_light ? shining(delegate, param, slot, paths[slot])
                                        : param.materialId(paths[slot]));
    }
}

/// The material of a slot as the mesh's light has it shine.
hipr::MaterialId HdHiprMesh::shining(HdSceneDelegate& delegate, HdHiprRenderParam& param, size_t slot,
                                     SdfPath const& base) {
    while (_shining.size() <= slot) {
        _shining.push_back(param.newId<hipr::MaterialId>());
    }
    MeshLight light = *_light;
    if (light.normalize && _mesh) {
        const double area = worldArea(*_mesh, delegate.GetTransform(GetId()));
        light.radiance *= area > 0 ? float(1 / area) : 0.f;
    }
    param.shiningMaterials().set(_shining[slot], base, surfaceOf(delegate.GetRenderIndex(), base), light,
                                 param.edit());
    return _shining[slot];
}

void HdHiprMesh::stopShining(HdHiprRenderParam& param) {
    for (const hipr::MaterialId id : _shining) {
        param.shiningMaterials().remove(id, param.edit());
    }
    _shining.clear();
}

PXR_NAMESPACE_CLOSE_SCOPE
