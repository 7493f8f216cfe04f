// Where instances are while the shutter is open.
#include <iterator>

#include "plugin/hdHipr/convert.h"
#include "plugin/hdHipr/instancer.h"
#include "plugin/hdHipr/primvars.h"
#include "plugin/hdHipr/velocity.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

size_t arraySize(VtValue const& value) {
    return value.IsArrayValued() ? value.GetArraySize() : 0;
}

} // namespace

/// A primvar of instances that Hydra may name or not: before 22.11 UsdImaging knows velocities as attributes
/// only.
VtValue HdHiprInstancer::primvarAtFrame(TfToken const& name) {
    const auto found = _primvars.find(name);
    return found == _primvars.end() ? valueAtFrame(*GetDelegate(), GetId(), name) : found->second;
}

/// Those that go by velocities. If any do, all others stay as they are at the frame, as UsdGeomPointInstancer
/// says.
std::map<TfToken, Samples<VtValue>> HdHiprInstancer::partsByVelocity(Sampling const& sampling) {
    static const TfToken velocities("velocities"), accelerations("accelerations"),
        angularVelocities("angularVelocities");
    std::map<TfToken, Samples<VtValue>> moved;
    for (auto const& [name, value] : _primvars) {
        Samples<VtValue> samples;
        if (partOf(name) == Part::Translate) {
            samples = movedBy(GetId(), toVec3s(value), primvarAtFrame(velocities),
                              primvarAtFrame(accelerations), sampling);
        } else if (partOf(name) == Part::Rotate) {
            samples = turnedBy(GetId(), value, primvarAtFrame(angularVelocities), sampling);
        }
        if (!samples.values.empty()) {
            moved[name] = std::move(samples);
        }
    }
    return moved;
}

std::map<TfToken, Samples<VtValue>> HdHiprInstancer::sampleParts(Sampling const& sampling) {
    std::map<TfToken, Samples<VtValue>> parts = partsByVelocity(sampling);
    const bool byVelocity = !parts.empty();
    for (auto const& [name, value] : _primvars) {
        if (!partOf(name) || parts.count(name) > 0) {
            continue;
        }
        Samples<VtValue> samples;
        if (!byVelocity) {
            samples = samplePrimvar(*GetDelegate(), GetId(), name);
        }
        const bool alike = std::all_of(samples.values.begin(), samples.values.end(),
                                       [size = arraySize(value)](VtValue const& v) {
                                           return arraySize(v) == size; // else they are of other instances
                                       });
        parts[name] =
            samples.values.empty() || !alike ? Samples<VtValue>{{0.f}, {value}} : std::move(samples);
    }
    return parts;
}

std::vector<HdHiprInstancer::Level> HdHiprInstancer::sampleLevels(SdfPath const& prototypeId,
                                                                  Sampling const& sampling) {
    ensureSynced();
    HdSceneDelegate& delegate = *GetDelegate();
    Level level{this, delegate.GetInstanceIndices(GetId(), prototypeId),
                sampleInstancerTransform(delegate, GetId()), sampleParts(sampling)};
    if (level.own.values.empty()) {
        level.own = {{0.f}, {delegate.GetInstancerTransform(GetId())}};
    }
    std::vector<Level> levels{std::move(level)};
    HdInstancer* parent = delegate.GetRenderIndex().GetInstancer(GetParentId());
    if (parent && !GetParentId().IsEmpty()) {
        auto outer = static_cast<HdHiprInstancer*>(parent)->sampleLevels(GetId(), sampling);
        std::move(outer.begin(), outer.end(), std::back_inserter(levels));
    }
    return levels;
}

std::vector<GfMatrix4d> HdHiprInstancer::transformsAt(std::vector<Level> const& levels, float time,
                                                      size_t level) {
    Level const& here = levels[level];
    std::map<TfToken, VtValue> primvars;
    for (auto const& [name, samples] : here.parts) {
        primvars[name] = at(samples, time);
    }
    const auto local = here.instancer->localTransforms(here.indices, at(here.own, time), primvars);
    return level + 1 == levels.size() ? local : nested(local, transformsAt(levels, time, level + 1));
}

hipr::InstanceMotion hdhipr::instanceMotion(Samples<GfMatrix4d> const& own,
                                            std::vector<HdHiprInstancer::Level> const& levels) {
    std::vector<float> times;
    addTimes(own, times);
    for (HdHiprInstancer::Level const& level : levels) {
        addTimes(level.own, times);
        for (auto const& [name, part] : level.parts) {
            addTimes(part, times);
        }
    }
    hipr::InstanceMotion motion;
    motion.times = times;
    for (const float time : times) {
        std::vector<glm::mat4x3>& placements = motion.transforms.emplace_back();
        const GfMatrix4d self = at(own, time);
        const auto outer = levels.empty() ? std::vector<GfMatrix4d>{GfMatrix4d(1.0)}
                                          : HdHiprInstancer::transformsAt(levels, time);
        for (GfMatrix4d const& transform : outer) {
            placements.push_back(toGlmAffine(self * transform));
        }
    }
    return motion;
}

PXR_NAMESPACE_CLOSE_SCOPE
