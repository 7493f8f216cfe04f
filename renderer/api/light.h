/// @file light.h
/// Lights in UsdLux units: intensity in nits, exposure in stops, lengths in object units.
#pragma once

#include <string>
#include <tuple>

#include "renderer/api/types.h"

namespace hipr {

enum class LightKind : uint32_t { Dome, Distant, Rect, Sphere, Disk, Cylinder };

/// What a dome's picture is of. LatLong: OpenEXR's latitude-longitude map, its centre towards local +Z.
/// MirroredBall: the environment in a mirror ball, seen from local +Z, which its centre reflects, x to the
/// right and y up. Angular: the same with the angle off +Z growing evenly from the centre to the rim.
/// CubeMapVerticalCross: faces of 90 degrees seen from inside, three wide and four high; the middle one of
/// the second row shows +Z, the one left of it +X, above +Y, below -Y and, upside down at the bottom, -Z.
enum class DomeFormat : uint32_t { LatLong, MirroredBall, Angular, CubeMapVerticalCross };

/// How a light's radiance depends on the direction it leaves in (UsdLuxShapingAPI). Angles are from the
/// light's axis, local -Z, in world space. Lights without an axis, domes, ignore it.
struct LightShaping {
    float focus = 0.f;        ///< exponent of the cosine; 0 and below: none
    glm::vec3 focusTint{0.f}; ///< what focus leaves of the light at 90 degrees
    float coneAngle = 180.f;  ///< degrees; nothing is sent beyond, 180 and above: everywhere
    float coneSoftness = 0.f; ///< share of the cone over which the light fades out, 0..1
    std::string iesFile;      ///< an LM-63 profile; its vertical angle 0 is the axis. May be empty
    float iesAngleScale =
        0.f; ///< stretches the profile's vertical angles from 0 (above 0) or 180 (below 0) degrees
    bool iesNormalize =
        false; ///< divide the profile by its mean over the sphere (or hemisphere) it is given for
    auto members() const {
        return std::tie(focus, focusTint, coneAngle, coneSoftness, iesFile, iesAngleScale, iesNormalize);
    }
    bool operator==(const LightShaping& o) const { return members() == o.members(); }
};

/// What a light's shadows look like (UsdLuxShadowAPI); physical ones are the default.
struct LightShadow {
    bool enable = true;
    glm::vec3 color{0.f};     ///< share of the light that gets through occluders
    float distance = -1.f;    ///< occluders further from the lit point cast none; below 0: all do
    float falloff = -1.f;     ///< within `distance`, over which shadows fade out; 0 and below: none
    float falloffGamma = 1.f; ///< exponent of that fading, above 0
    auto members() const { return std::tie(enable, color, distance, falloff, falloffGamma); }
    bool operator==(const LightShadow& o) const { return members() == o.members(); }
};

/// A UsdLux light. Rect and disk emit along local -Z; the cylinder's axis is local X; the distant light
/// shines along local -Z; the dome maps latitude-longitude with local +Y up, image centre toward local +Z...
/// see shaders/light/environment.glsl for the exact mapping.
struct LightDesc {
    std::string name;
    LightKind kind = LightKind::Sphere;
    glm::dmat4 transform{1.0}; ///< light to world
    float intensity = 1.f;
    float exposure = 0.f;
    glm::vec3 color{1.f};
    bool enableColorTemperature = false;
    float colorTemperature = 6500.f;     ///< kelvin, 1000..10000
    bool normalize = false;              ///< divide by the world-space area (or solid angle) of the light
    float radius = 0.5f;                 ///< sphere, disk, cylinder
    float width = 1.f, height = 1.f;     ///< rect
    float length = 1.f;                  ///< cylinder
    float angle = 0.53f;                 ///< distant: full angle in degrees
    float diffuse = 1.f, specular = 1.f; ///< multipliers
    bool thin = false;   ///< sphere: a point, cylinder: a line of the same power, which no ray meets
    bool visible = true; ///< false: the light is off
    std::string texture; ///< dome: latitude-longitude image; rect: image on the emitter. May be empty
    DomeFormat domeFormat = DomeFormat::LatLong;
    LightShaping shaping;
    LightShadow shadow;
    std::string lightLink;  ///< the category (ObjectDesc::categories) whose objects are lit; empty: all
    std::string shadowLink; ///< the category whose objects cast shadows; empty: all
    std::string group;      ///< of lights, for light path expressions; empty: none
    auto members() const {
        return std::tie(name, kind, transform, intensity, exposure, color, enableColorTemperature,
                        colorTemperature, normalize, radius, width, height, length, angle, diffuse, specular,
                        visible, texture, shaping, shadow, lightLink, shadowLink, thin, domeFormat, group);
    }
    bool operator==(const LightDesc& o) const { return members() == o.members(); }
};

/// What the light of a surface that emits is beside what its material sends out (UsdLuxMeshLightAPI). The
/// axis of its shaping is -Z of the object's own space.
struct SurfaceLight {
    float diffuse = 1.f, specular = 1.f; ///< multipliers
    LightShaping shaping;
    LightShadow shadow;     ///< of others: the surface always hides what is behind it
    std::string lightLink;  ///< as LightDesc::lightLink
    std::string shadowLink; ///< as LightDesc::shadowLink
    auto members() const { return std::tie(diffuse, specular, shaping, shadow, lightLink, shadowLink); }
    bool operator==(const SurfaceLight& o) const { return members() == o.members(); }
};

} // namespace hipr
