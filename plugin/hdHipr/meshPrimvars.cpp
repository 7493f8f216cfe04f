// The primvars of meshes: those of the scene, and computed ones.
#include <algorithm>

#include "plugin/hdHipr/convert.h"
#include "plugin/hdHipr/mesh.h"
#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/primvars.h"
#include "pxr/imaging/hd/extComputationUtils.h"
#include "pxr/imaging/hd/tokens.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

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

HdHiprMesh::Rebuild HdHiprMesh::syncPrimvars(HdSceneDelegate* delegate, HdDirtyBits bits) {
    Rebuild rebuild = Rebuild::None;
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

PXR_NAMESPACE_CLOSE_SCOPE
