#include "renderer/shading/light_shape.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "renderer/shading/blackbody.h"
#include "renderer/shading/elliptic.h"
#include "shaders/shared/scene.h"

namespace hipr {

namespace {

constexpr double Pi = 3.14159265358979323846;

template <class M> bool isFinite(const M& m) {
    bool finite = true;
    for (int c = 0; c < m.length(); ++c)
        for (int r = 0; r < m[c].length(); ++r)
            finite = finite && std::isfinite(m[c][r]);
    return finite;
}

double halfAngle(const LightDesc& desc) {
    return std::min(std::max(double(desc.angle), 0.0), 360.0) * (Pi / 360.0);
}

double areaOf(const LightDesc& desc) {
    const glm::dmat3 m(desc.transform);
    switch (desc.kind) {
    case LightKind::Rect:
        return glm::length(glm::cross(m[0], m[1])) * desc.width * desc.height;
    case LightKind::Disk:
        return glm::length(glm::cross(m[0], m[1])) * Pi * desc.radius * desc.radius;
    case LightKind::Sphere:
        return ellipsoidArea(m) * desc.radius * desc.radius;
    case LightKind::Cylinder:
        // A circle around the axis, stretched across it.
        return ellipsePerimeter(glm::cross(m[0], m[1]), glm::cross(m[0], m[2])) * desc.radius * desc.length;
    default:
        return 0.0;
    }
}

bool positiveSize(const LightDesc& desc) {
    switch (desc.kind) {
    case LightKind::Rect:
        return desc.width > 0.f && desc.height > 0.f;
    case LightKind::Cylinder:
        return desc.radius > 0.f && desc.length > 0.f;
    case LightKind::Sphere:
    case LightKind::Disk:
        return desc.radius > 0.f;
    default:
        return true;
    }
}

bool allFinite(std::initializer_list<float> values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

bool finiteNumbers(const LightShaping& s) {
    return allFinite(
        {s.focus, s.focusTint.x, s.focusTint.y, s.focusTint.z, s.coneAngle, s.coneSoftness, s.iesAngleScale});
}

bool finiteNumbers(const LightShadow& s) {
    return allFinite({s.color.x, s.color.y, s.color.z, s.distance, s.falloff, s.falloffGamma});
}

bool finiteNumbers(const LightDesc& desc) {
    return isFinite(desc.transform) && finiteNumbers(desc.shaping) && finiteNumbers(desc.shadow) &&
           allFinite({desc.intensity, desc.exposure, desc.color.x, desc.color.y, desc.color.z,
                      desc.colorTemperature, desc.radius, desc.width, desc.height, desc.length, desc.angle,
                      desc.diffuse, desc.specular});
}

/// The rotation (or reflection) next to a transform: infinite lights have a direction but no size.
glm::dmat3 orientation(const glm::dmat4& transform) {
    const glm::dvec3 z = glm::normalize(glm::dvec3(transform[2]));
    glm::dvec3 y = glm::dvec3(transform[1]);
    y = glm::normalize(y - z * glm::dot(y, z));
    glm::dvec3 x = glm::cross(y, z);
    if (glm::dot(x, glm::dvec3(transform[0])) < 0.0) x = -x;
    return {x, y, z};
}

glm::dvec3 radianceOf(const LightDesc& desc) {
    glm::dvec3 radiance = glm::dvec3(desc.color) * double(desc.intensity) * std::exp2(double(desc.exposure));
    if (desc.enableColorTemperature) radiance *= glm::dvec3(blackbodyColor(desc.colorTemperature));
    if (desc.normalize) radiance /= lightSizeFactor(desc);
    return radiance;
}

/// What is left of the radius: how much power the light has. Normalised, it does not matter.
void makeThin(const LightDesc& desc, gpu::LightRecord& record) {
    const bool line = desc.kind == LightKind::Cylinder;
    record.kind = gpu::LIGHT_THIN;
    record.size = {0.f, line ? desc.length : 0.f};
    record.radiance *= record.area / (line ? float(Pi) : 4.f);
}

bool isThin(const LightDesc& desc) {
    return desc.thin && (desc.kind == LightKind::Sphere || desc.kind == LightKind::Cylinder);
}

void setShape(const LightDesc& desc, gpu::LightRecord& record) {
    switch (desc.kind) {
    case LightKind::Rect:
        record.size = {desc.width, desc.height};
        break;
    case LightKind::Cylinder:
        record.size = {desc.radius, desc.length};
        break;
    case LightKind::Sphere:
    case LightKind::Disk:
        record.size = {desc.radius, desc.radius};
        break;
    case LightKind::Distant:
        record.size = {float(std::cos(halfAngle(desc))), 0.f};
        break;
    case LightKind::Dome:
        break;
    }
    const double sine = std::sin(0.5 * halfAngle(desc));
    record.area = desc.kind == LightKind::Distant ? float(4.0 * Pi * sine * sine) : float(areaOf(desc));
}

} // namespace

bool hasFiniteNumbers(const SurfaceLight& light) {
    return finiteNumbers(light.shaping) && finiteNumbers(light.shadow) &&
           allFinite({light.diffuse, light.specular});
}

double lightSizeFactor(const LightDesc& desc) {
    if (desc.kind == LightKind::Dome) return 1.0;
    if (desc.kind != LightKind::Distant) return areaOf(desc);
    const double half = halfAngle(desc), sine = std::sin(half);
    if (half == 0.0) return 1.0;
    return Pi * (half <= 0.5 * Pi ? sine * sine : 2.0 - sine * sine);
}

bool describeLight(const LightDesc& asked, gpu::LightRecord& record, std::string& problem) {
    problem.clear();
    LightDesc desc = asked;
    if (isThin(desc) && desc.normalize && desc.radius == 0.f) desc.radius = 1.f; // any, see makeThin()
    if (!desc.visible) return false;
    if (!finiteNumbers(desc)) {
        problem = "a value is not finite; the light is off";
        return false;
    }
    const bool infinite = desc.kind == LightKind::Dome || desc.kind == LightKind::Distant;
    const glm::dmat3 linear = infinite ? orientation(desc.transform) : glm::dmat3(desc.transform);
    glm::dmat4 transform(linear);
    if (!infinite) transform[3] = desc.transform[3];
    const glm::dmat4 inverse = glm::inverse(transform);
    record = {};
    record.kind = uint32_t(desc.kind);
    record.lightToWorld = glm::mat4x3(transform);
    record.worldToLight = glm::mat4x3(inverse);
    if (!positiveSize(desc) || !isFinite(record.worldToLight) || !isFinite(record.lightToWorld) ||
        glm::determinant(glm::mat3(record.lightToWorld)) == 0.f) {
        problem = "it has no area or a singular transform; the light is off";
        return false;
    }
    setShape(desc, record);
    record.radiance = glm::vec3(glm::max(radianceOf(desc), glm::dvec3(0.0)));
    record.texture = gpu::NO_INDEX;
    record.diffuse = std::max(desc.diffuse, 0.f);
    record.specular = std::max(desc.specular, 0.f);
    if (isThin(desc)) makeThin(desc, record);
    if (!isFinite(glm::mat3(record.radiance, glm::vec3(record.area, 0.f, 0.f), glm::vec3(0.f)))) {
        problem = "its radiance or area exceeds single precision; the light is off";
        return false;
    }
    return record.radiance != glm::vec3(0.f) && (record.diffuse > 0.f || record.specular > 0.f);
}

std::optional<gpu::ShadowRecord> describeShadow(const LightShadow& shadow, uint32_t category) {
    const bool plain = shadow.enable && shadow.color == glm::vec3(0.f) && shadow.distance < 0.f;
    if (plain && category == gpu::NO_INDEX) return std::nullopt;
    gpu::ShadowRecord record{};
    record.color = shadow.enable ? glm::max(shadow.color, glm::vec3(0.f)) : glm::vec3(1.f);
    record.end = shadow.distance < 0.f ? std::numeric_limits<float>::infinity() : shadow.distance;
    const bool fades = shadow.distance > 0.f && shadow.falloff > 0.f;
    record.fadeStart = fades ? std::max(shadow.distance - shadow.falloff, 0.f) : record.end;
    record.gamma = std::max(shadow.falloffGamma, 1e-3f);
    record.category = category;
    record.instance = gpu::NO_INDEX;
    return record;
}

double lightPower(const gpu::LightRecord& record, const glm::vec3& pictureMean, double sceneRadius) {
    const double radiance =
        glm::dot(glm::dvec3(record.radiance * pictureMean), glm::dvec3(0.2126, 0.7152, 0.0722)) *
        std::max(record.diffuse, record.specular);
    const double disk = Pi * sceneRadius * sceneRadius; // what the scene catches of parallel light
    if (record.kind == gpu::LIGHT_DOME) return radiance * 4.0 * Pi * disk;
    if (record.kind == gpu::LIGHT_DISTANT)
        return radiance * (record.area > 0.f ? double(record.area) : 1.0) * disk;
    if (record.kind == gpu::LIGHT_THIN) return radiance * Pi * (record.size.y > 0.f ? Pi : 4.0);
    return radiance * Pi * record.area;
}

} // namespace hipr
