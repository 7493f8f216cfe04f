// Where instances are while the shutter is open.
#include <iterator>

#include "plugin/hdHipr/convert.h"
#include "plugin/hdHipr/instancer.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

std::vector<HdHiprInstancer::Level> HdHiprInstancer::sampleLevels(SdfPath const& prototypeId) {
    ensureSynced();
    HdSceneDelegate& delegate = *GetDelegate();
    Level level{this,
                delegate.GetInstanceIndices(GetId(), prototypeId),
                sampleInstancerTransform(delegate, GetId()),
                {}};
    if (level.own.values.empty()) {
        level.own = {{0.f}, {delegate.GetInstancerTransform(GetId())}};
    }
    for (auto const& [name, value] : _primvars) {
        if (!placesInstances(name)) {
            continue;
        }
        Samples<VtValue> samples = samplePrimvar(delegate, GetId(), name);
        level.parts[name] = samples.values.empty() ? Samples<VtValue>{{0.f}, {value}} : std::move(samples);
    }
    std::vector<Level> levels{std::move(level)};
    HdInstancer* parent = delegate.GetRenderIndex().GetInstancer(GetParentId());
    if (parent && !GetParentId().IsEmpty()) {
        auto outer = static_cast<HdHiprInstancer*>(parent)->sampleLevels(GetId());
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
