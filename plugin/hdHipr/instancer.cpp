#include "plugin/hdHipr/instancer.h"

#include <algorithm>
#include <utility>

#include "plugin/hdHipr/convert.h"
#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/primvars.h"
#include "plugin/hdHipr/velocity.h"
#include "pxr/base/gf/matrix4f.h"
#include "pxr/base/gf/quatd.h"
#include "pxr/base/gf/quatf.h"
#include "pxr/base/gf/quath.h"
#include "pxr/base/gf/rotation.h"
#include "pxr/base/gf/vec3d.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/gf/vec3h.h"
#include "pxr/base/gf/vec4f.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

GfMatrix4d translation(GfVec3d const& t) {
    return GfMatrix4d(1.0).SetTranslate(t);
}
GfMatrix4d scaling(GfVec3d const& s) {
    return GfMatrix4d(1.0).SetScale(s);
}

/// A quaternion of any length as a rotation; the zero quaternion does not rotate.
GfMatrix4d rotation(double real, GfVec3d const& imaginary) {
    GfQuatd q(real, imaginary);
    return q.GetLength() > 0.0 ? GfMatrix4d(1.0).SetRotate(q.GetNormalized()) : GfMatrix4d(1.0);
}

template <class Q> GfMatrix4d rotationOf(Q const& q) {
    return rotation(double(q.GetReal()), GfVec3d(q.GetImaginary()));
}
/// Before quaternion types, Hydra sent (real, i, j, k).
GfMatrix4d rotationOf(GfVec4f const& q) {
    return rotation(q[0], GfVec3d(q[1], q[2], q[3]));
}

/// Multiplies element indices[i] of the array in `value`, made a matrix by `toMatrix`, in front of
/// transforms[i]. Returns false when the value does not hold an array of T or is too short for an index.
template <class T, class ToMatrix>
bool apply(VtValue const& value, VtIntArray const& indices, std::vector<GfMatrix4d>& transforms,
           bool* complete, ToMatrix toMatrix) {
    if (!value.IsHolding<VtArray<T>>()) {
        return false;
    }
    VtArray<T> const& array = value.UncheckedGet<VtArray<T>>();
    for (size_t i = 0; i < indices.size(); ++i) {
        const int index = indices.cdata()[i];
        if (index < 0 || size_t(index) >= array.size()) {
            *complete = false;
            continue;
        }
        transforms[i] = toMatrix(array.cdata()[index]) * transforms[i];
    }
    return true;
}

using Part = HdHiprInstancer::Part;

bool applyPart(Part part, VtValue const& value, VtIntArray const& indices,
               std::vector<GfMatrix4d>& transforms, bool* complete) {
    const auto translate = [](auto const& v) { return translation(GfVec3d(v)); };
    const auto scale = [](auto const& v) { return scaling(GfVec3d(v)); };
    const auto rotate = [](auto const& v) { return rotationOf(v); };
    const auto matrix = [](auto const& v) { return GfMatrix4d(v); };
    switch (part) {
    case Part::Translate:
        return apply<GfVec3f>(value, indices, transforms, complete, translate) ||
               apply<GfVec3d>(value, indices, transforms, complete, translate) ||
               apply<GfVec3h>(value, indices, transforms, complete, translate);
    case Part::Scale:
        return apply<GfVec3f>(value, indices, transforms, complete, scale) ||
               apply<GfVec3d>(value, indices, transforms, complete, scale) ||
               apply<GfVec3h>(value, indices, transforms, complete, scale);
    case Part::Rotate:
        return apply<GfVec4f>(value, indices, transforms, complete, rotate) ||
               apply<GfQuath>(value, indices, transforms, complete, rotate) ||
               apply<GfQuatf>(value, indices, transforms, complete, rotate) ||
               apply<GfQuatd>(value, indices, transforms, complete, rotate);
    case Part::Transform:
        break;
    }
    return apply<GfMatrix4d>(value, indices, transforms, complete, matrix) ||
           apply<GfMatrix4f>(value, indices, transforms, complete, matrix);
}

/// The order in which Hydra defines an instance's transform: each next one is applied to the object first.
/// Two names each, because they changed.
struct PartName {
    Part part;
    const char *name, *newName;
};
constexpr PartName partNames[] = {
    {Part::Translate, "translate", "hydra:instanceTranslations"},
    {Part::Rotate, "rotate", "hydra:instanceRotations"},
    {Part::Scale, "scale", "hydra:instanceScales"},
    {Part::Transform, "instanceTransform", "hydra:instanceTransforms"},
};

/// Repeats each value `times` times in place (outer level) or the whole list `times` times (inner level).
std::vector<float> repeated(std::vector<float> const& values, uint32_t components, size_t times, bool each) {
    std::vector<float> out;
    out.reserve(values.size() * times);
    const size_t run = each ? components : values.size();
    for (size_t at = 0; at < values.size(); at += run) {
        for (size_t t = 0; t < times; ++t) {
            out.insert(out.end(), values.begin() + long(at), values.begin() + long(at + run));
        }
    }
    return out;
}

std::vector<std::string> toNames(VtArray<TfToken> const& categories) {
    std::vector<std::string> names;
    for (size_t i = 0; i < categories.size(); ++i) {
        names.push_back(categories.cdata()[i].GetString());
    }
    std::sort(names.begin(), names.end()); // UsdImaging's order depends on addresses
    return names;
}

bool anyLinked(std::vector<VtArray<TfToken>> const& categories) {
    return std::any_of(categories.begin(), categories.end(),
                       [](VtArray<TfToken> const& names) { return !names.empty(); });
}

/// At any level from this instancer up; empty: there is none.
bool instancesLinked(HdSceneDelegate& delegate, SdfPath const& instancerId) {
    HdInstancer* instancer = delegate.GetRenderIndex().GetInstancer(instancerId);
    return instancer && (anyLinked(delegate.GetInstanceCategories(instancerId)) ||
                         instancesLinked(delegate, instancer->GetParentId()));
}

/// Every outer instance's names with every inner one's; empty lists stand for no names.
std::vector<std::vector<std::string>> combine(std::vector<std::vector<std::string>> const& outer,
                                              size_t outerCount,
                                              std::vector<std::vector<std::string>> const& inner,
                                              size_t innerCount) {
    std::vector<std::vector<std::string>> all;
    for (size_t i = 0; i < outerCount && !(outer.empty() && inner.empty()); ++i) {
        for (size_t j = 0; j < innerCount; ++j) {
            all.push_back(outer.empty() ? std::vector<std::string>() : outer[i]);
            if (!inner.empty()) {
                all.back().insert(all.back().end(), inner[j].begin(), inner[j].end());
            }
        }
    }
    return all;
}

} // namespace

void HdHiprInstancer::syncPrimvars(HdDirtyBits dirtyBits) {
    std::map<TfToken, VtValue> primvars;
    for (HdPrimvarDescriptor const& pv :
         GetDelegate()->GetPrimvarDescriptors(GetId(), HdInterpolationInstance)) {
        const auto old = _primvars.find(pv.name);
        if (old == _primvars.end() || HdChangeTracker::IsPrimvarDirty(dirtyBits, GetId(), pv.name)) {
            primvars[pv.name] = GetDelegate()->Get(GetId(), pv.name);
        } else {
            primvars[pv.name] = old->second;
        }
    }
    _primvars = std::move(primvars);
}

std::optional<HdHiprInstancer::Part> HdHiprInstancer::partOf(TfToken const& primvar) {
    for (PartName const& part : partNames) {
        if (primvar == part.name || primvar == part.newName) {
            return part.part;
        }
    }
    return std::nullopt;
}

std::vector<GfMatrix4d> HdHiprInstancer::nested(std::vector<GfMatrix4d> const& inner,
                                                std::vector<GfMatrix4d> const& outer) {
    std::vector<GfMatrix4d> all;
    all.reserve(outer.size() * inner.size());
    for (GfMatrix4d const& outerTransform : outer) {
        for (GfMatrix4d const& transform : inner) {
            all.push_back(transform * outerTransform);
        }
    }
    return all;
}

std::vector<GfMatrix4d> HdHiprInstancer::localTransforms(VtIntArray const& indices,
                                                         GfMatrix4d const& instancerTransform,
                                                         std::map<TfToken, VtValue> const& primvars) const {
    std::vector<GfMatrix4d> transforms(indices.size(), instancerTransform);
    for (PartName const& part : partNames) {
        for (const char* name : {part.name, part.newName}) {
            const auto found = primvars.find(TfToken(name));
            if (found == primvars.end() || found->second.IsEmpty()) {
                continue;
            }
            bool complete = true;
            if (!applyPart(part.part, found->second, indices, transforms, &complete)) {
                warnOnce(GetId().GetString(), "instance primvar '" + std::string(name) +
                                                  "' has the unsupported type " +
                                                  found->second.GetTypeName());
            } else if (!complete) {
                warnOnce(GetId().GetString(), "instance primvar '" + std::string(name) +
                                                  "' has fewer values than there are instances");
            }
        }
    }
    return transforms;
}

std::vector<hipr::Primvar> HdHiprInstancer::localPrimvars(VtIntArray const& indices) const {
    std::vector<hipr::Primvar> result;
    for (auto const& [name, value] : _primvars) {
        if (partOf(name)) {
            continue;
        }
        const std::optional<hipr::Primvar> all = toPrimvar(name, value);
        if (!all) {
            continue;
        }
        hipr::Primvar picked;
        picked.name = all->name;
        picked.components = all->components;
        picked.values.reserve(indices.size() * all->components);
        const size_t count = all->values.size() / all->components;
        bool complete = true;
        for (size_t i = 0; i < indices.size(); ++i) {
            const size_t index = size_t(indices.cdata()[i]);
            complete = complete && index < count;
            const size_t from = (index < count ? index : count - 1) * all->components;
            picked.values.insert(picked.values.end(), all->values.begin() + long(from),
                                 all->values.begin() + long(from + all->components));
        }
        if (complete) {
            result.push_back(std::move(picked));
        } else if (!movesInstances(name)) { // of those the motion tells
            warnOnce(GetId().GetString(), "instance primvar '" + name.GetString() +
                                              "' has fewer values than there are instances; it is ignored");
        }
    }
    return result;
}

std::vector<std::vector<std::string>> HdHiprInstancer::localCategories(VtIntArray const& indices) const {
    const std::vector<VtArray<TfToken>> all = GetDelegate()->GetInstanceCategories(GetId());
    if (!anyLinked(all)) {
        return {};
    }
    std::vector<std::vector<std::string>> picked;
    for (size_t i = 0; i < indices.size(); ++i) {
        const size_t index = size_t(indices.cdata()[i]);
        picked.push_back(index < all.size() ? toNames(all[index]) : std::vector<std::string>());
    }
    return picked;
}

HdHiprInstancer::Instances HdHiprInstancer::instances(SdfPath const& prototypeId) {
    ensureSynced();
    const VtIntArray indices = GetDelegate()->GetInstanceIndices(GetId(), prototypeId);
    Instances local{localTransforms(indices, GetDelegate()->GetInstancerTransform(GetId()), _primvars),
                    localPrimvars(indices), localCategories(indices)};
    if (GetParentId().IsEmpty()) {
        return local;
    }

    HdInstancer* parent = GetDelegate()->GetRenderIndex().GetInstancer(GetParentId());
    if (!parent) {
        warnOnce(GetId().GetString(),
                 "the parent instancer <" + GetParentId().GetString() + "> does not exist");
        return local;
    }
    const Instances outer = static_cast<HdHiprInstancer*>(parent)->instances(GetId());
    Instances all;
    all.transforms = nested(local.transforms, outer.transforms);
    all.categories =
        combine(outer.categories, outer.transforms.size(), local.categories, local.transforms.size());
    for (hipr::Primvar& pv : local.primvars) {
        pv.values = repeated(pv.values, pv.components, outer.transforms.size(), false);
        all.primvars.push_back(std::move(pv));
    }
    for (hipr::Primvar const& pv : outer.primvars) {
        const bool hidden = std::any_of(all.primvars.begin(), all.primvars.end(),
                                        [&](hipr::Primvar const& inner) { return inner.name == pv.name; });
        if (hidden) {
            continue;
        }
        all.primvars.push_back(pv);
        all.primvars.back().values = repeated(pv.values, pv.components, local.transforms.size(), true);
    }
    return all;
}

bool LinkState::sync(HdSceneDelegate& delegate, SdfPath const& id, SdfPath const& instancerId,
                     HdDirtyBits bits) {
    if (!(bits & HdChangeTracker::DirtyCategories)) {
        return false;
    }
    _names = toNames(delegate.GetCategories(id));
    const bool were = std::exchange(_instancesLinked, instancesLinked(delegate, instancerId));
    return were || _instancesLinked;
}

hipr::InstancesDesc hdhipr::readInstances(HdSceneDelegate& delegate, SdfPath const& id,
                                          SdfPath const& instancerId, Sampling const& sampling) {
    const GfMatrix4d own = delegate.GetTransform(id);
    Samples<GfMatrix4d> ownSamples;
    if (sampling.open()) {
        ownSamples = sampleTransform(delegate, id);
    }
    if (ownSamples.values.empty()) {
        ownSamples = {{0.f}, {own}};
    }
    std::vector<HdHiprInstancer::Level> levels;
    hipr::InstancesDesc desc;
    if (instancerId.IsEmpty()) {
        desc.transforms.push_back(toGlmAffine(own));
    } else if (HdInstancer* instancer = delegate.GetRenderIndex().GetInstancer(instancerId)) {
        auto* const placing = static_cast<HdHiprInstancer*>(instancer);
        HdHiprInstancer::Instances instances = placing->instances(id);
        if (sampling.open()) {
            levels = placing->sampleLevels(id, sampling);
        }
        desc.transforms.reserve(instances.transforms.size());
        for (GfMatrix4d const& transform : instances.transforms) {
            desc.transforms.push_back(toGlmAffine(own * transform));
        }
        desc.primvars = std::move(instances.primvars);
        desc.categories = std::move(instances.categories);
    } else {
        warnOnce(id.GetString(),
                 "its instancer <" + instancerId.GetString() + "> does not exist; it is not drawn");
        return desc;
    }
    desc.motion = instanceMotion(ownSamples, levels);
    return desc;
}

PXR_NAMESPACE_CLOSE_SCOPE
