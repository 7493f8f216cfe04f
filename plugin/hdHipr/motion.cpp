#include "plugin/hdHipr/motion.h"

#include "plugin/hdHipr/compat.h"

#include "pxr/base/gf/quatd.h"
#include "pxr/base/gf/quatf.h"
#include "pxr/base/gf/quath.h"
#include "pxr/base/gf/vec3d.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/gf/vec3h.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/base/vt/array.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

/// The sample before a time, and how far that is on the way to the next.
struct Place {
    size_t first = 0;
    float weight = 0.f;
};

Place placeOf(std::vector<float> const& times, float time) {
    if (time <= times.front()) {
        return {};
    }
    const size_t next = size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    if (next == times.size()) {
        return {times.size() - 1, 0.f};
    }
    return {next - 1, (time - times[next - 1]) / (times[next] - times[next - 1])};
}

template <class T> T between(T const& a, T const& b, double weight) {
    return T(a * (1.0 - weight) + b * weight);
}
GfVec3h between(GfVec3h const& a, GfVec3h const& b, double weight) {
    return GfVec3h(between(GfVec3f(a), GfVec3f(b), weight));
}
GfQuath between(GfQuath const& a, GfQuath const& b, double weight) {
    return GfSlerp(weight, a, b);
}
GfQuatf between(GfQuatf const& a, GfQuatf const& b, double weight) {
    return GfSlerp(weight, a, b);
}
GfQuatd between(GfQuatd const& a, GfQuatd const& b, double weight) {
    return GfSlerp(weight, a, b);
}
/// Hydra's quaternions of before it had a type for them: (real, i, j, k).
GfVec4f between(GfVec4f const& a, GfVec4f const& b, double weight) {
    const GfQuatd turned = GfSlerp(weight, GfQuatd(a[0], a[1], a[2], a[3]), GfQuatd(b[0], b[1], b[2], b[3]));
    const GfVec3d i = turned.GetImaginary();
    return GfVec4f(float(turned.GetReal()), float(i[0]), float(i[1]), float(i[2]));
}

/// Nothing where the values are no arrays of T of one length.
template <class T> VtValue arraysBetween(VtValue const& a, VtValue const& b, double weight) {
    if (!a.IsHolding<VtArray<T>>() || !b.IsHolding<VtArray<T>>()) {
        return {};
    }
    VtArray<T> const &from = a.UncheckedGet<VtArray<T>>(), &to = b.UncheckedGet<VtArray<T>>();
    if (from.size() != to.size()) {
        return {};
    }
    VtArray<T> mixed(from.size());
    for (size_t i = 0; i < from.size(); ++i) {
        mixed[i] = between(from.cdata()[i], to.cdata()[i], weight);
    }
    return VtValue(mixed);
}

template <class... T> VtValue anyBetween(VtValue const& a, VtValue const& b, double weight) {
    VtValue mixed;
    ((mixed.IsEmpty() ? void(mixed = arraysBetween<T>(a, b, weight)) : void()), ...);
    return mixed.IsEmpty() ? a : mixed;
}

} // namespace

Samples<GfMatrix4d> sampleTransform(HdSceneDelegate& delegate, SdfPath const& id) {
    return readSamples<GfMatrix4d>([&](size_t most, float* times, GfMatrix4d* values) {
        return delegate.SampleTransform(id, most, times, values);
    });
}

Samples<GfMatrix4d> sampleInstancerTransform(HdSceneDelegate& delegate, SdfPath const& instancer) {
    return readSamples<GfMatrix4d>([&](size_t most, float* times, GfMatrix4d* values) {
        return delegate.SampleInstancerTransform(instancer, most, times, values);
    });
}

Samples<VtValue> samplePrimvar(HdSceneDelegate& delegate, SdfPath const& id, TfToken const& name) {
    return readSamples<VtValue>([&](size_t most, float* times, VtValue* values) {
        return delegate.SamplePrimvar(id, name, most, times, values);
    });
}

Samples<VtValue> sampleComputed(HdSceneDelegate& delegate, SdfPath const& id,
                                HdExtComputationPrimvarDescriptor const& primvar) {
    Samples<VtValue> samples;
    for (auto& [time, value] : computedSamples(&delegate, primvar)) {
        samples.times.push_back(time);
        samples.values.push_back(std::move(value));
    }
    if (samples.values.empty()) {
        samples = samplePrimvar(delegate, id, TfToken("hipr:computed:" + primvar.name.GetString()));
    }
    const bool complete = std::none_of(samples.values.begin(), samples.values.end(),
                                       [](VtValue const& value) { return value.IsEmpty(); });
    return complete ? samples : Samples<VtValue>();
}

GfMatrix4d at(Samples<GfMatrix4d> const& samples, float time) {
    const Place place = placeOf(samples.times, time);
    GfMatrix4d const& a = samples.values[place.first];
    return place.weight > 0.f ? between(a, samples.values[place.first + 1], place.weight) : a;
}

VtValue at(Samples<VtValue> const& samples, float time) {
    const Place place = placeOf(samples.times, time);
    VtValue const& a = samples.values[place.first];
    if (place.weight == 0.f) {
        return a;
    }
    return anyBetween<GfVec3f, GfVec3d, GfVec3h, GfQuath, GfQuatf, GfQuatd, GfVec4f, GfMatrix4d>(
        a, samples.values[place.first + 1], place.weight);
}

std::vector<glm::mat4x3> at(hipr::InstanceMotion const& motion, float time) {
    const Place place = placeOf(motion.times, time);
    std::vector<glm::mat4x3> placements = motion.transforms[place.first];
    for (size_t i = 0; i < placements.size() && place.weight > 0.f; ++i) {
        placements[i] =
            placements[i] * (1.f - place.weight) + motion.transforms[place.first + 1][i] * place.weight;
    }
    return placements;
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
