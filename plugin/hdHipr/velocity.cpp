#include "plugin/hdHipr/velocity.h"

#include <algorithm>
#include <cmath>

#include "plugin/hdHipr/primvars.h"
#include "pxr/base/gf/quatd.h"
#include "pxr/base/gf/quatf.h"
#include "pxr/base/gf/quath.h"
#include "pxr/base/gf/rotation.h"
#include "pxr/base/gf/vec3d.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/base/vt/array.h"
#include "pxr/imaging/hd/tokens.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

/// A parabola over the shutter in so many straight pieces is off by 1/64 of its height.
constexpr size_t parabolaSteps = 4;
/// Between two samples rotations go the shorter way.
constexpr double largestTurn = 90.0;
constexpr size_t mostTurnSteps = 64;

std::vector<float> timesOf(hipr::Shutter const& shutter, size_t steps) {
    std::vector<float> times;
    for (size_t i = 0; i <= steps; ++i) {
        times.push_back(float(shutter.open + (shutter.close - shutter.open) * double(i) / double(steps)));
    }
    return times;
}

/// Whether there is one finite value for each of `count`. If there are values and they do not fit, that is
/// told.
bool usable(SdfPath const& id, const char* name, std::vector<glm::vec3> const& values, size_t count) {
    if (values.empty()) {
        return false;
    }
    if (values.size() != count) {
        warnOnce(id.GetString(), "it has " + std::to_string(values.size()) + " " + name + " where " +
                                     std::to_string(count) + " are wanted; they are not used");
        return false;
    }
    if (!std::all_of(values.begin(), values.end(), finite)) {
        warnOnce(id.GetString(), std::string("some of its ") + name + " are no numbers; none are used");
        return false;
    }
    return true;
}

std::vector<GfQuatd> toQuats(VtValue const& value) {
    std::vector<GfQuatd> quats;
    const auto convert = [](auto const& q) { return GfQuatd(q.GetReal(), GfVec3d(q.GetImaginary())); };
    const auto old = [](GfVec4f const& q) { return GfQuatd(q[0], q[1], q[2], q[3]); };
    appendArray<GfQuath>(value, quats, convert) || appendArray<GfQuatf>(value, quats, convert) ||
        appendArray<GfQuatd>(value, quats, convert) || appendArray<GfVec4f>(value, quats, old);
    return quats;
}

GfQuatd turn(GfVec3d const& degreesPerSecond, double seconds) {
    return GfRotation(degreesPerSecond, seconds * degreesPerSecond.GetLength()).GetQuat();
}

} // namespace

Samples<VtValue> movedBy(SdfPath const& id, std::vector<glm::vec3> const& from, VtValue const& velocities,
                         VtValue const& accelerations, Sampling const& sampling) {
    const std::vector<glm::vec3> speeds = toVec3s(velocities);
    if (!usable(id, "velocities", speeds, from.size())) {
        return {};
    }
    const std::vector<glm::vec3> growths = toVec3s(accelerations);
    const bool straight = !usable(id, "accelerations", growths, from.size());
    Samples<VtValue> samples;
    samples.times = timesOf(sampling.shutter, straight ? 1 : parabolaSteps);
    for (const float time : samples.times) {
        const float seconds = float(sampling.seconds(time));
        VtVec3fArray moved(from.size());
        GfVec3f* const to = moved.data();
        for (size_t i = 0; i < from.size(); ++i) {
            const glm::vec3 speed = straight ? speeds[i] : speeds[i] + 0.5f * seconds * growths[i];
            const glm::vec3 there = from[i] + seconds * speed;
            to[i] = GfVec3f(there.x, there.y, there.z);
        }
        samples.values.emplace_back(moved);
    }
    return samples;
}

void PointVelocities::read(TfToken const& primvar, VtValue const& value) {
    if (primvar == HdTokens->velocities) {
        _velocities = value;
    } else if (primvar == HdTokens->accelerations) {
        _accelerations = value;
    }
}

std::vector<hipr::Primvar> PointVelocities::takeUnfit(SdfPath const& id, size_t points,
                                                      std::vector<hipr::Primvar>& primvars) const {
    std::vector<hipr::Primvar> unfit;
    for (auto const& [name, value] : {std::pair(HdTokens->velocities, &_velocities),
                                      std::pair(HdTokens->accelerations, &_accelerations)}) {
        const auto found =
            std::find_if(primvars.begin(), primvars.end(),
                         [name = name](hipr::Primvar const& primvar) { return name == primvar.name; });
        const std::vector<glm::vec3> values = toVec3s(*value);
        if (found != primvars.end() && !values.empty() && !usable(id, name.GetText(), values, points)) {
            unfit.push_back(std::move(*found));
            primvars.erase(found);
        }
    }
    return unfit;
}

Samples<VtValue> PointVelocities::samples(HdSceneDelegate& delegate, SdfPath const& id,
                                          std::vector<glm::vec3> const& points,
                                          Sampling const& sampling) const {
    Samples<VtValue> moved = movedBy(id, points, _velocities, _accelerations, sampling);
    return moved.values.empty() ? samplePrimvar(delegate, id, HdTokens->points) : moved;
}

Samples<VtValue> turnedBy(SdfPath const& id, VtValue const& rotations, VtValue const& angularVelocities,
                          Sampling const& sampling) {
    const std::vector<GfQuatd> from = toQuats(rotations);
    const std::vector<glm::vec3> speeds = toVec3s(angularVelocities);
    if (!usable(id, "angularVelocities", speeds, from.size())) {
        return {};
    }
    double fastest = 0.0;
    for (glm::vec3 const& speed : speeds) {
        fastest = std::max(fastest, double(glm::length(speed)));
    }
    const double most = fastest * sampling.seconds(sampling.shutter.close - sampling.shutter.open);
    const double steps = std::ceil(most / largestTurn);
    Samples<VtValue> samples;
    samples.times =
        timesOf(sampling.shutter, steps < mostTurnSteps ? size_t(std::max(steps, 1.0)) : mostTurnSteps);
    for (const float time : samples.times) {
        VtArray<GfQuatd> turned(from.size());
        GfQuatd* const to = turned.data();
        for (size_t i = 0; i < from.size(); ++i) {
            to[i] = turn(GfVec3d(speeds[i].x, speeds[i].y, speeds[i].z), sampling.seconds(time)) * from[i];
        }
        samples.values.emplace_back(turned);
    }
    return samples;
}

bool movesInstances(TfToken const& primvar) {
    return primvar == HdTokens->velocities || primvar == HdTokens->accelerations ||
           primvar == "angularVelocities";
}

VtValue valueAtFrame(HdSceneDelegate& delegate, SdfPath const& id, TfToken const& name) {
    const Samples<VtValue> samples = samplePrimvar(delegate, id, name);
    return samples.values.empty() ? VtValue() : at(samples, 0.f);
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
