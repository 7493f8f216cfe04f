#include "renderer/scene/motion.h"

#include <cmath>

#include <glm/gtc/constants.hpp>

namespace hipr {
namespace {

constexpr uint32_t MostSteps = 16;
constexpr double OnGrid = 1e-3;                                 ///< of a step
constexpr double LargestTurn = 4.0 * glm::pi<double>() / 180.0; ///< between two keys

/// The rotation nearest to a linear map, by Newton's iteration for the polar decomposition: N. Higham,
/// "Computing the Polar Decomposition - with Applications", SIAM J. Sci. Stat. Comput. 7(4), 1986.
glm::dmat3 nearestRotation(const glm::dmat3& linear) {
    glm::dmat3 q = linear;
    for (int i = 0; i < 64; ++i) {
        const glm::dmat3 next = 0.5 * (q + glm::transpose(glm::inverse(q)));
        double change = 0.0;
        for (int c = 0; c < 3; ++c)
            change = std::max(change, glm::length(next[c] - q[c]));
        q = next;
        if (change < 1e-14) break;
    }
    return glm::determinant(q) < 0.0 ? -q : q; // a mirroring stays with the stretch
}

double turnBetween(const glm::dquat& a, const glm::dquat& b) {
    return 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(a, b))));
}

/// The last sample not behind `time`, and how far that is on the way to the next one.
struct Place {
    size_t first;
    double weight;
};

template <class TimeOf> Place placeOf(double time, size_t count, const TimeOf& timeOf) {
    if (time <= timeOf(0)) return {0, 0.0};
    for (size_t i = 1; i < count; ++i)
        if (time < timeOf(i)) return {i - 1, (time - timeOf(i - 1)) / (timeOf(i) - timeOf(i - 1))};
    return {count - 1, 0.0};
}

} // namespace

uint32_t keySteps(const std::vector<float>& times, const Shutter& shutter) {
    for (uint32_t steps = 1; steps < MostSteps; ++steps) {
        const bool fits = std::all_of(times.begin(), times.end(), [&](double time) {
            if (time <= shutter.open || time >= shutter.close) return true;
            const double at = (time - shutter.open) / (shutter.close - shutter.open) * steps;
            return std::abs(at - std::round(at)) < OnGrid;
        });
        if (fits) return steps;
    }
    return MostSteps;
}

double keyFrame(const Shutter& shutter, uint32_t key, uint32_t keys) {
    return shutter.open + (shutter.close - shutter.open) * key / (keys - 1);
}

PlacementMotion::PlacementMotion(const std::vector<float>& times,
                                 const std::vector<glm::dmat4x3>& placements) {
    for (size_t i = 0; i < times.size(); ++i) {
        const glm::dmat3 linear(placements[i]), rotation = nearestRotation(linear);
        _samples.push_back({times[i], placements[i], glm::normalize(glm::quat_cast(rotation)),
                            glm::transpose(rotation) * linear});
    }
}

bool PlacementMotion::moves() const {
    return std::any_of(_samples.begin(), _samples.end(),
                       [&](const Sample& s) { return s.placement != _samples[0].placement; });
}

uint32_t PlacementMotion::keys(const Shutter& shutter) const {
    std::vector<float> times;
    for (const Sample& sample : _samples)
        times.push_back(float(sample.time));
    const uint32_t steps = keySteps(times, shutter);
    double turn = 0.0;
    glm::dquat before = glm::quat_cast(nearestRotation(glm::dmat3(at(shutter.open))));
    for (uint32_t step = 1; step <= steps; ++step) {
        const glm::dquat now =
            glm::quat_cast(nearestRotation(glm::dmat3(at(keyFrame(shutter, step, steps + 1)))));
        turn = std::max(turn, turnBetween(before, now));
        before = now;
    }
    const uint32_t finer =
        std::clamp(uint32_t(std::ceil(turn / LargestTurn)), 1u, (MaxMotionKeys - 1) / steps);
    return steps * finer + 1;
}

glm::dmat4x3 PlacementMotion::at(double time) const {
    const Place place = placeOf(time, _samples.size(), [&](size_t i) { return _samples[i].time; });
    const Sample& a = _samples[place.first];
    if (place.weight == 0.0) return a.placement;
    const Sample& b = _samples[place.first + 1];
    const glm::dvec3 offset = glm::mix(a.placement[3], b.placement[3], place.weight);
    const glm::dmat3 stretch = a.stretch * (1.0 - place.weight) + b.stretch * place.weight;
    const bool turns = turnBetween(a.rotation, b.rotation) > 1e-7;
    if (!turns && a.stretch == b.stretch) return {a.placement[0], a.placement[1], a.placement[2], offset};
    const glm::dmat3 linear = glm::mat3_cast(glm::slerp(a.rotation, b.rotation, place.weight)) * stretch;
    return {linear[0], linear[1], linear[2], offset};
}

uint32_t meshKeys(const TriangleMesh& mesh, const Shutter& shutter) {
    if (!shutter.blurs() || mesh.motion.size() < 2) return 1;
    std::vector<float> times;
    for (const MeshKey& key : mesh.motion)
        times.push_back(key.time);
    return keySteps(times, shutter) + 1;
}

std::vector<glm::vec3> keyed(const TriangleMesh& mesh, std::vector<glm::vec3> MeshKey::*values,
                             const Shutter& shutter, uint32_t keys) {
    std::vector<glm::vec3> all;
    for (uint32_t k = 0; k < keys; ++k) {
        const Place place = placeOf(keyFrame(shutter, k, keys), mesh.motion.size(),
                                    [&](size_t i) { return double(mesh.motion[i].time); });
        const std::vector<glm::vec3>& a = mesh.motion[place.first].*values;
        if (place.weight == 0.0) {
            all.insert(all.end(), a.begin(), a.end());
            continue;
        }
        const std::vector<glm::vec3>& b = mesh.motion[place.first + 1].*values;
        for (size_t i = 0; i < a.size(); ++i)
            all.push_back(glm::mix(a[i], b[i], float(place.weight)));
    }
    return all;
}

} // namespace hipr
