#include "plugin/hdHipr/mesh.h"

#include <algorithm>

#include "plugin/hdHipr/cards.h"
#include "plugin/hdHipr/convert.h"
#include "plugin/hdHipr/instancer.h"
#include "plugin/hdHipr/materialNetwork.h"
#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/motion.h"
#include "plugin/hdHipr/primvars.h"
#include "plugin/hdHipr/renderParam.h"
#include "pxr/imaging/hd/extComputationUtils.h"
#include "pxr/imaging/hd/tokens.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

constexpr HdDirtyBits objectBits = HdChangeTracker::DirtyVisibility | HdChangeTracker::DirtyMaterialId |
                                   HdChangeTracker::DirtyPrimID | HdChangeTracker::DirtyRenderTag |
                                   HdChangeTracker::DirtyTopology | HdChangeTracker::DirtyCategories |
                                   HdChangeTracker::DirtyCullStyle;
constexpr HdDirtyBits instanceBits =
    HdChangeTracker::DirtyTransform | HdChangeTracker::DirtyInstancer | HdChangeTracker::DirtyInstanceIndex;
constexpr HdDirtyBits styleBits =
    HdChangeTracker::DirtyDisplayStyle | HdChangeTracker::DirtyRepr | HdChangeTracker::NewRepr;
constexpr HdDirtyBits primvarBits = HdChangeTracker::DirtyPoints | HdChangeTracker::DirtyNormals |
                                    HdChangeTracker::DirtyWidths | HdChangeTracker::DirtyPrimvar |
                                    HdChangeTracker::DirtyComputationPrimvarDesc;

/// The primvars that name the light group of what a mesh emits: ours, and Karma's.
bool namesLightGroup(TfToken const& primvar) {
    return primvar == "hipr:lightGroup" || primvar == "karma:object:lpetag";
}

/// A text, or the only one of an array.
std::string textOf(VtValue const& value) {
    if (value.IsHolding<TfToken>()) {
        return value.UncheckedGet<TfToken>().GetString();
    }
    if (value.IsHolding<VtArray<std::string>>() && value.GetArraySize() == 1) {
        return value.UncheckedGet<VtArray<std::string>>()[0];
    }
    return value.GetWithDefault<std::string>();
}

size_t elementCount(hipr::MeshDesc const& desc, hipr::Interpolation interpolation) {
    switch (interpolation) {
    case hipr::Interpolation::Constant:
        return 1;
    case hipr::Interpolation::Uniform:
        return desc.faceVertexCounts.size();
    case hipr::Interpolation::Vertex:
        return desc.points.size();
    case hipr::Interpolation::FaceVarying:
        break;
    }
    return desc.faceVertexIndices.size();
}

} // namespace

HdHiprMesh::HdHiprMesh(SdfPath const& id, SdfPath const& instancerId, HdHiprRenderParam& param)
    : RprimBase(id, instancerId), _geometry(param.newId<hipr::GeometryId>()),
      _object(param.newId<hipr::ObjectId>()) {
    _desc.name = id.GetString();
}

HdDirtyBits HdHiprMesh::GetInitialDirtyBitsMask() const {
    return HdChangeTracker::InitRepr | objectBits | instanceBits | primvarBits |
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
    param.removeObject(_object);
    stopShining(param);
    param.edit().removeGeometry(_geometry);
    HdMesh::Finalize(renderParam);
}

void HdHiprMesh::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits,
                      TfToken const& reprToken) {
    auto& param = static_cast<HdHiprRenderParam&>(*renderParam);
    syncInstancer(delegate, dirtyBits);
    const HdDirtyBits bits = *dirtyBits;
    if (bits & HdChangeTracker::DirtyVisibility) {
        _UpdateVisibility(delegate, dirtyBits);
    }
    if (bits & HdChangeTracker::DirtyMaterialId) {
        updateMaterialId(delegate, delegate->GetMaterialId(GetId()));
    }

    const std::string lightGroup = _lightGroup;
    const Rebuild rebuild = std::max(syncTopology(delegate, bits, reprToken), syncPrimvars(delegate, bits));
    if (rebuild != Rebuild::None) {
        sendGeometry(*delegate, rebuild, param);
    }
    const bool relinked = _links.sync(*delegate, GetId(), GetInstancerId(), bits);
    const bool areaChanged =
        _light && _light->normalize && (rebuild != Rebuild::None || (bits & instanceBits));
    if ((bits & objectBits) || lightGroup != _lightGroup || areaChanged) {
        sendObject(delegate, param);
    }
    if (relinked || (bits & instanceBits)) {
        sendInstances(delegate, param);
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

HdHiprMesh::Rebuild HdHiprMesh::syncPrimvars(HdSceneDelegate* delegate, HdDirtyBits bits) {
    Rebuild rebuild = Rebuild::None;
    if (!(bits & primvarBits)) {
        return rebuild;
    }
    TfTokenVector names;
    syncComputedPrimvars(delegate, bits, &names, &rebuild);
    const auto listed = [&names](TfToken const& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    HdPrimvarDescriptorVector authored;
    for (int i = 0; i < HdInterpolationCount; ++i) {
        const auto some = GetPrimvarDescriptors(delegate, HdInterpolation(i));
        authored.insert(authored.end(), some.begin(), some.end());
    }
    for (HdPrimvarDescriptorVector const& same : byName(authored)) {
        TfToken const& name = same.front().name;
        if (listed(name)) {
            continue; // computed values win over authored ones
        }
        names.push_back(name);
        if (!HdChangeTracker::IsPrimvarDirty(bits, GetId(), name)) {
            continue;
        }
        VtIntArray indices;
        const VtValue value = readPrimvar(delegate, name, &indices);
        rebuild = std::max(rebuild, setPrimvar(meant(same, value, indices), value, indices));
    }
    if (!listed(HdTokens->points) && (bits & HdChangeTracker::DirtyPoints)) {
        rebuild = std::max(rebuild, setPoints(GetPoints(delegate)));
    }
    if (std::none_of(names.begin(), names.end(), namesLightGroup)) {
        _lightGroup.clear();
    }
    for (TfToken const& name : {HdTokens->velocities, HdTokens->accelerations}) {
        if (!listed(name)) {
            _velocities.read(name, VtValue());
        }
    }
    const auto gone = std::remove_if(_desc.primvars.begin(), _desc.primvars.end(),
                                     [&](hipr::Primvar const& pv) { return !listed(TfToken(pv.name)); });
    if (gone != _desc.primvars.end()) {
        rebuild = Rebuild::All;
    }
    _desc.primvars.erase(gone, _desc.primvars.end());
    return rebuild;
}

void HdHiprMesh::syncComputedPrimvars(HdSceneDelegate* delegate, HdDirtyBits bits, TfTokenVector* names,
                                      Rebuild* rebuild) {
    HdExtComputationPrimvarDescriptorVector dirty;
    _pointsComputed.reset();
    for (int i = 0; i < HdInterpolationCount; ++i) {
        for (auto const& pv : delegate->GetExtComputationPrimvarDescriptors(GetId(), HdInterpolation(i))) {
            names->push_back(pv.name);
            if (pv.name == HdTokens->points) {
                _pointsComputed = pv;
            }
            const bool changed = HdChangeTracker::IsPrimvarDirty(bits, GetId(), pv.name) ||
                                 (bits & HdChangeTracker::DirtyComputationPrimvarDesc);
            if (changed) {
                dirty.push_back(pv);
            }
        }
    }
    _computed = !names->empty();
    if (dirty.empty()) {
        return;
    }
    const auto values = HdExtComputationUtils::GetComputedPrimvarValues(dirty, delegate);
    for (auto const& pv : dirty) {
        const auto value = values.find(pv.name);
        if (value == values.end()) {
            warnOnce(GetId().GetString(),
                     "the computation of primvar '" + pv.name.GetString() + "' gave no value");
            continue;
        }
        *rebuild = std::max(*rebuild, setPrimvar(pv, value->second, VtIntArray()));
    }
}

HdPrimvarDescriptor const& HdHiprMesh::meant(HdPrimvarDescriptorVector const& same, VtValue const& value,
                                             VtIntArray const& indices) {
    if (same.size() == 1) {
        return same.front();
    }
    const size_t values = value.IsArrayValued() ? value.GetArraySize() : 1;
    const size_t count = indices.empty() ? values : indices.size();
    std::vector<bool> fits;
    for (HdPrimvarDescriptor const& descriptor : same) {
        const std::optional<hipr::Interpolation> interpolation = toInterpolation(descriptor.interpolation);
        fits.push_back(interpolation && elementCount(_desc, *interpolation) == count);
    }
    const auto used = std::find_if(_desc.primvars.begin(), _desc.primvars.end(),
                                   [&](hipr::Primvar const& pv) { return same.front().name == pv.name; });
    std::optional<HdInterpolation> now;
    for (HdPrimvarDescriptor const& descriptor : same) {
        const bool linear = descriptor.interpolation == HdInterpolationVarying;
        if (used != _desc.primvars.end() && used->linear == linear &&
            toInterpolation(descriptor.interpolation) == used->interpolation) {
            now = descriptor.interpolation;
        }
    }
    return _descriptorChoice.choose(same, fits, now);
}

HdHiprMesh::Rebuild HdHiprMesh::setPoints(VtValue const& value) {
    _desc.points = toVec3s(value);
    return Rebuild::Points;
}

HdHiprMesh::Rebuild HdHiprMesh::setPrimvar(HdPrimvarDescriptor const& descriptor, VtValue const& value,
                                           VtIntArray const& indices) {
    if (descriptor.name == HdTokens->points) {
        return setPoints(value);
    }
    _velocities.read(descriptor.name, value);
    if (namesLightGroup(descriptor.name)) {
        _lightGroup = textOf(value);
        return Rebuild::None;
    }
    const std::optional<hipr::Interpolation> interpolation = toInterpolation(descriptor.interpolation);
    std::optional<hipr::Primvar> primvar = toPrimvar(descriptor.name, value);
    auto& primvars = _desc.primvars;
    const auto old = std::find_if(primvars.begin(), primvars.end(),
                                  [&](hipr::Primvar const& pv) { return descriptor.name == pv.name; });
    if (!primvar || !interpolation) {
        if (old == primvars.end()) {
            return Rebuild::None;
        }
        primvars.erase(old);
        return Rebuild::All;
    }
    primvar->interpolation = *interpolation;
    primvar->linear = descriptor.interpolation == HdInterpolationVarying;
    primvar->indices.assign(indices.cdata(), indices.cdata() + indices.size());
    if (old == primvars.end()) {
        primvars.push_back(std::move(*primvar));
        return Rebuild::All;
    }
    if (*old == *primvar) {
        return Rebuild::None;
    }
    *old = std::move(*primvar);
    // Animated normals come with animated points; any other primvar is stored per triangle corner or vertex.
    return descriptor.name == HdTokens->normals ? Rebuild::Points : Rebuild::All;
}

void HdHiprMesh::sendGeometry(HdSceneDelegate& delegate, Rebuild rebuild, HdHiprRenderParam& param) {
    const bool hasNormals = std::any_of(_desc.primvars.begin(), _desc.primvars.end(),
                                        [](hipr::Primvar const& pv) { return HdTokens->normals == pv.name; });
    const bool faceted =
        _desc.scheme == hipr::SubdivisionScheme::None || _desc.scheme == hipr::SubdivisionScheme::Bilinear;
    _desc.refineLevel = _style.refineLevel;
    _desc.flatNormals = _style.flat || (faceted && !hasNormals);
    const bool pointsOnly = rebuild == Rebuild::Points && _mesh && !_mesh->triangles.empty();
    if (isCards(_desc)) {
        _mesh = hipr::buildTriangleMesh(separateCards(_desc), report);
    } else {
        _mesh =
            pointsOnly ? hipr::updatePoints(*_mesh, _desc, report) : hipr::buildTriangleMesh(_desc, report);
    }
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

void HdHiprMesh::sendObject(HdSceneDelegate* delegate, HdHiprRenderParam& param) {
    ObjectState state;
    state.path = GetId();
    state.renderTag = delegate->GetRenderTag(GetId());
    state.desc.name = _desc.name;
    state.desc.geometry = _geometry;
    state.desc.visible = IsVisible();
    state.desc.primId = GetPrimId();
    state.desc.categories = _links.names();
    state.desc.lightGroup = _lightGroup;
    state.desc.cull = toCullStyle(GetCullStyle(delegate));
    _light = meshLight(delegate, GetId());
    if (!_light) {
        stopShining(param);
    }
    SdfPathVector paths = {GetMaterialId()};
    for (SdfPath const& path : _subsetMaterials) {
        paths.push_back(path.IsEmpty() ? GetMaterialId() : path);
    }
    for (size_t slot = 0; slot < paths.size(); ++slot) {
        state.desc.materials.push_back(_light ? shining(delegate, param, slot, paths[slot])
                                              : param.materialId(paths[slot]));
    }
    param.setObject(_object, state);
}

/// The material of a slot as the mesh's light has it shine.
hipr::MaterialId HdHiprMesh::shining(HdSceneDelegate* delegate, HdHiprRenderParam& param, size_t slot,
                                     SdfPath const& base) {
    while (_shining.size() <= slot) {
        _shining.push_back(param.newId<hipr::MaterialId>());
    }
    MeshLight light = *_light;
    if (light.normalize && _mesh) {
        const double area = worldArea(*_mesh, delegate->GetTransform(GetId()));
        light.radiance *= area > 0 ? float(1 / area) : 0.f;
    }
    std::optional<hipr::MaterialDesc> desc;
    if (!base.IsEmpty()) {
        desc = materialDesc(base, materialNetworks(*delegate, base));
    }
    param.shiningMaterials().set(_shining[slot], base, desc, light, param.edit());
    return _shining[slot];
}

void HdHiprMesh::stopShining(HdHiprRenderParam& param) {
    for (const hipr::MaterialId id : _shining) {
        param.shiningMaterials().remove(id, param.edit());
    }
    _shining.clear();
}

void HdHiprMesh::renderTagChanged(HdSceneDelegate* delegate, HdRenderParam* renderParam) {
    if (_mesh) {
        sendObject(delegate, static_cast<HdHiprRenderParam&>(*renderParam));
    }
}

void HdHiprMesh::sendInstances(HdSceneDelegate* delegate, HdHiprRenderParam& param) {
    param.edit().setInstances(_object, readInstances(*delegate, GetId(), GetInstancerId(), param.sampling()));
}

PXR_NAMESPACE_CLOSE_SCOPE
