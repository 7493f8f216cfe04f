// Curves as triangles: tubes, and ribbons.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "renderer/geometry/curve_builder.h"
#include "renderer/geometry/normals.h"

namespace hipr::geometry {
namespace {

/// Carries a direction that is normal to the tangent from one sample to the next.
glm::vec3 carried(const glm::vec3& direction, const glm::vec3& from, const glm::vec3& to,
                  const glm::vec3& tangentFrom, const glm::vec3& tangentTo) {
    const auto reflected = [](const glm::vec3& v, const glm::vec3& plane) {
        const float squared = glm::dot(plane, plane);
        return squared > 0.f ? v - 2.f / squared * glm::dot(plane, v) * plane : v;
    };
    const glm::vec3 step = to - from;
    return reflected(reflected(direction, step), tangentTo - reflected(tangentFrom, step));
}

/// Any unit vector normal to `tangent`.
glm::vec3 anyNormal(const glm::vec3& tangent) {
    const glm::vec3 axis = std::abs(tangent.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(glm::cross(tangent, axis));
}

} // namespace

/// Directions of the curve; where it stands still, that of the chord, or of the sample before.
std::vector<glm::vec3> CurveBuilder::tangents(const Curve& curve,
                                              const std::vector<CurveSample>& samples) const {
    std::vector<glm::vec3> tangents(samples.size());
    glm::vec3 last(0.f);
    for (size_t i = 0; i < samples.size(); ++i) {
        glm::vec3 along(0.f);
        if (_desc.basis == CurveBasis::Linear) { // corners are mitred
            const size_t before = i > 0 ? i - 1 : i, after = i + 1 < samples.size() ? i + 1 : i;
            along = unitOrZero(position(curve, samples[i]) - position(curve, samples[before])) +
                    unitOrZero(position(curve, samples[after]) - position(curve, samples[i]));
        } else {
            along = pointAt(curve, samples[i].tangent, samples[i]);
            if (unitOrZero(along) == glm::vec3(0.f) && i + 1 < samples.size())
                along = position(curve, samples[i + 1]) - position(curve, samples[i]);
        }
        tangents[i] = unitOrZero(along);
        if (tangents[i] == glm::vec3(0.f)) tangents[i] = last;
        last = tangents[i];
    }
    for (size_t i = tangents.size() - 1; i > 0; --i)
        if (tangents[i - 1] == glm::vec3(0.f)) tangents[i - 1] = tangents[i];
    return tangents;
}

void CurveBuilder::addVertex(const Curve& curve, const CurveSample& sample, const glm::vec3& position,
                             const glm::vec3& normal) {
    _mesh->positions.push_back(position);
    _mesh->normals.push_back(normal);
    addPrimvars(curve, sample);
}

void CurveBuilder::addTriangle(const Curve& curve, const glm::uvec3& triangle) {
    _mesh->triangles.push_back(triangle);
    _mesh->triangleFace.push_back(curve.index);
}

void CurveBuilder::addRibbon(const Curve& curve, const std::vector<CurveSample>& samples) {
    _mesh->doubleSided = true;
    const std::vector<glm::vec3> along = tangents(curve, samples);
    const uint32_t first = uint32_t(_mesh->positions.size());
    for (size_t i = 0; i < samples.size(); ++i) {
        glm::vec3 facing(0.f);
        _normals->evaluate(curve, samples[i], &facing.x);
        facing = unitOrZero(facing);
        const glm::vec3 across = unitOrZero(glm::cross(facing, along[i])) * radius(curve, samples[i]);
        const glm::vec3 middle = position(curve, samples[i]);
        addVertex(curve, samples[i], middle - across, facing);
        addVertex(curve, samples[i], middle + across, facing);
    }
    for (uint32_t i = first; i + 3 < first + 2 * samples.size(); i += 2) {
        addTriangle(curve, {i, i + 1, i + 3});
        addTriangle(curve, {i, i + 3, i + 2});
    }
}

void CurveBuilder::addTube(const Curve& curve, const std::vector<CurveSample>& samples) {
    const std::vector<glm::vec3> along = tangents(curve, samples);
    if (along[0] == glm::vec3(0.f)) return; // all points are one
    const uint32_t first = uint32_t(_mesh->positions.size());
    glm::vec3 side = anyNormal(along[0]);
    for (size_t i = 0; i < samples.size(); ++i) {
        const glm::vec3 middle = position(curve, samples[i]);
        if (i > 0) side = carried(side, position(curve, samples[i - 1]), middle, along[i - 1], along[i]);
        side = unitOrZero(side - glm::dot(side, along[i]) * along[i]); // what rounding has added up
        if (side == glm::vec3(0.f)) side = anyNormal(along[i]);
        const glm::vec3 up = glm::cross(along[i], side);
        const float r = radius(curve, samples[i]);
        for (uint32_t k = 0; k < _sides; ++k) {
            const float angle = glm::two_pi<float>() * float(k) / float(_sides);
            const glm::vec3 outwards = std::cos(angle) * side + std::sin(angle) * up;
            addVertex(curve, samples[i], middle + r * outwards, outwards);
        }
    }
    for (uint32_t ring = 0; ring + 1 < samples.size(); ++ring)
        for (uint32_t k = 0; k < _sides; ++k) {
            const uint32_t a = first + ring * _sides + k, b = first + ring * _sides + (k + 1) % _sides;
            addTriangle(curve, {a, b, b + _sides});
            addTriangle(curve, {a, b + _sides, a + _sides});
        }
    if (!_caps || _desc.wrap == CurveWrap::Periodic) return;
    addCap(curve, samples.front(), first, -along.front(), true);
    addCap(curve, samples.back(), first + uint32_t(samples.size() - 1) * _sides, along.back(), false);
}

void CurveBuilder::addCap(const Curve& curve, const CurveSample& sample, uint32_t firstVertex,
                          const glm::vec3& outwards, bool reversed) {
    const uint32_t first = uint32_t(_mesh->positions.size());
    for (uint32_t k = 0; k < _sides; ++k)
        addVertex(curve, sample, _mesh->positions[firstVertex + k], outwards);
    for (uint32_t k = 1; k + 1 < _sides; ++k)
        addTriangle(curve, reversed ? glm::uvec3(first, first + k + 1, first + k)
                                    : glm::uvec3(first, first + k, first + k + 1));
}

} // namespace hipr::geometry
