#include "plugin/hdHipr/points.h"

#include <cmath>

#include "plugin/hdHipr/messages.h"
#include "renderer/api/curves.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

constexpr int sphereLevel = 3, diskCorners = 24;

/// A primvar's value for a point, or null when it has none.
float const* valueOf(hipr::Primvar const& primvar, size_t point) {
    const size_t element = primvar.interpolation == hipr::Interpolation::Constant ? 0 : point;
    size_t value = element;
    if (!primvar.indices.empty()) {
        if (element >= primvar.indices.size() || primvar.indices[element] < 0) {
            return nullptr;
        }
        value = size_t(primvar.indices[element]);
    }
    return (value + 1) * primvar.components <= primvar.values.size()
               ? &primvar.values[value * primvar.components]
               : nullptr;
}

/// Takes a primvar out of the list.
std::optional<hipr::Primvar> take(std::vector<hipr::Primvar>& primvars, TfToken const& name,
                                  uint32_t components) {
    const auto found = std::find_if(primvars.begin(), primvars.end(),
                                    [&](hipr::Primvar const& primvar) { return name == primvar.name; });
    if (found == primvars.end()) {
        return std::nullopt;
    }
    hipr::Primvar taken = std::move(*found);
    primvars.erase(found);
    return taken.components == components ? std::optional(std::move(taken)) : std::nullopt;
}

/// Any frame whose z axis is `z`.
glm::mat3 frameAround(glm::vec3 const& z) {
    const glm::vec3 axis = std::abs(z.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 x = glm::normalize(glm::cross(axis, z));
    return {x, glm::cross(z, x), z};
}

glm::mat4 placement(glm::vec3 const& point, float radius, float const* normal) {
    const glm::vec3 direction = normal ? glm::vec3(normal[0], normal[1], normal[2]) : glm::vec3(0.f);
    const bool turned = finite(direction) && glm::length(direction) > 0.f;
    const glm::mat3 axes = (turned ? frameAround(glm::normalize(direction)) : glm::mat3(1.f)) * radius;
    return {glm::vec4(axes[0], 0), glm::vec4(axes[1], 0), glm::vec4(axes[2], 0), glm::vec4(point, 1)};
}

/// Each value `each` times, and all of that `times` times.
hipr::Primvar repeated(hipr::Primvar const& primvar, size_t times, size_t each) {
    hipr::Primvar out = primvar;
    out.values.clear();
    out.indices.clear();
    const size_t elements =
        primvar.indices.empty() ? primvar.values.size() / primvar.components : primvar.indices.size();
    for (size_t t = 0; t < times; ++t) {
        for (size_t i = 0; i < elements * each; ++i) {
            const size_t element = i / each;
            const size_t value = primvar.indices.empty() ? element : size_t(primvar.indices[element]);
            float const* from = &primvar.values[value * primvar.components];
            out.values.insert(out.values.end(), from, from + primvar.components);
        }
    }
    return out;
}

} // namespace

std::shared_ptr<const hipr::TriangleMesh> HdHiprPoints::readShape(HdSceneDelegate& delegate) {
    const std::vector<glm::vec3> points = readPoints(delegate);
    std::vector<hipr::Primvar> primvars = readPrimvars(delegate, [&](HdInterpolation interpolation) {
        return interpolation == HdInterpolationConstant || interpolation == HdInterpolationUniform
                   ? 1
                   : points.size();
    });
    const bool disks = std::any_of(primvars.begin(), primvars.end(), [](hipr::Primvar const& primvar) {
        return HdTokens->normals == primvar.name;
    });
    const std::string name = GetId().GetString();
    const auto shape =
        disks ? hipr::unitDisk(name, diskCorners)
              : hipr::unitSphere(name, sphereLevel + delegate.GetDisplayStyle(GetId()).refineLevel);
    place(points, primvars);
    for (hipr::Primvar const& primvar : primvars) {
        if (float const* value = valueOf(primvar, 0)) { // the rest are for all points alike
            shape->primvars.push_back({primvar.name, hipr::Interpolation::Constant, primvar.components,
                                       std::vector<float>(value, value + primvar.components)});
        }
    }
    return shape;
}

/// Fills placements and primvars of the points, and takes the latter out of `primvars`.
void HdHiprPoints::place(std::vector<glm::vec3> const& points, std::vector<hipr::Primvar>& primvars) {
    const std::optional<hipr::Primvar> widths = take(primvars, HdTokens->widths, 1),
                                       normals = take(primvars, HdTokens->normals, 3);
    _perPoint.clear();
    _placements.clear();
    _placed.clear();
    const auto constant =
        std::stable_partition(primvars.begin(), primvars.end(), [](hipr::Primvar const& primvar) {
            return primvar.interpolation == hipr::Interpolation::Constant ||
                   primvar.interpolation == hipr::Interpolation::Uniform;
        });
    std::vector<hipr::Primvar> perPoint(std::make_move_iterator(constant),
                                        std::make_move_iterator(primvars.end()));
    primvars.erase(constant, primvars.end());
    for (hipr::Primvar const& primvar : perPoint) {
        _perPoint.push_back({primvar.name, hipr::Interpolation::Constant, primvar.components, {}, {}, false});
    }
    size_t dropped = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        float const* width = widths ? valueOf(*widths, i) : nullptr;
        const float radius = 0.5f * (width ? *width : 1.f);
        if (!finite(points[i]) || !std::isfinite(radius) || radius < 0.f) {
            ++dropped;
            continue;
        }
        _placed.push_back(uint32_t(i));
        _placements.push_back(placement(points[i], radius, normals ? valueOf(*normals, i) : nullptr));
        for (size_t p = 0; p < perPoint.size(); ++p) {
            float const* value = valueOf(perPoint[p], i);
            const std::vector<float> none(perPoint[p].components, 0.f);
            if (!value) {
                warnOnce(GetId().GetString(),
                         "primvar '" + perPoint[p].name + "' lacks values for some points; they are 0");
                value = none.data();
            }
            auto& values = _perPoint[p].values;
            values.insert(values.end(), value, value + perPoint[p].components);
        }
    }
    if (dropped) {
        warnOnce(GetId().GetString(),
                 std::to_string(dropped) + (dropped == 1 ? " point" : " points") +
                     " dropped: a position or a width is no number, or a width is negative");
    }
}

/// The points' own motion and that of what they are part of, together.
hipr::InstanceMotion HdHiprPoints::motion(HdSceneDelegate& delegate, hipr::InstancesDesc const& placed,
                                          Sampling const& sampling) {
    const Samples<VtValue> samples = samplePoints(delegate, sampling);
    hipr::InstanceMotion motion;
    motion.times = placed.motion.times;
    addTimes(samples, motion.times);
    for (const float time : motion.times) {
        const auto outer = placed.motion.times.empty() ? placed.transforms : at(placed.motion, time);
        std::vector<glm::vec3> const points =
            samples.values.empty() ? std::vector<glm::vec3>() : toVec3s(at(samples, time));
        std::vector<glm::mat4x3>& transforms = motion.transforms.emplace_back();
        for (glm::mat4x3 const& transform : outer) {
            for (size_t i = 0; i < _placements.size(); ++i) {
                glm::mat4 placement = _placements[i];
                if (samples.moves() && _placed[i] < points.size()) {
                    placement[3] = glm::vec4(points[_placed[i]], 1.f);
                }
                transforms.push_back(transform * placement);
            }
        }
    }
    return motion;
}

hipr::InstancesDesc HdHiprPoints::instances(HdSceneDelegate& delegate, Sampling const& sampling) {
    const hipr::InstancesDesc placed = readInstances(delegate, GetId(), GetInstancerId(), sampling);
    const size_t points = _placements.size(), instances = placed.transforms.size();
    hipr::InstancesDesc desc;
    desc.transforms.reserve(points * instances);
    for (size_t i = 0; i < instances; ++i) {
        const glm::mat4x3& transform = placed.transforms[i];
        for (glm::mat4 const& placement : _placements) {
            desc.transforms.push_back(transform * placement);
            desc.instanceIds.push_back(int(i));
        }
        if (!placed.categories.empty()) {
            desc.categories.insert(desc.categories.end(), points, placed.categories[i]);
        }
    }
    if (sampling.open()) {
        desc.motion = motion(delegate, placed, sampling);
    }
    for (hipr::Primvar const& primvar : _perPoint) {
        if (points > 0) {
            desc.primvars.push_back(repeated(primvar, instances, 1));
        }
    }
    for (hipr::Primvar const& primvar : placed.primvars) {
        const bool own = std::any_of(_perPoint.begin(), _perPoint.end(),
                                     [&](hipr::Primvar const& other) { return other.name == primvar.name; });
        if (!own && points > 0) {
            desc.primvars.push_back(repeated(primvar, 1, points));
        }
    }
    return desc;
}

PXR_NAMESPACE_CLOSE_SCOPE
