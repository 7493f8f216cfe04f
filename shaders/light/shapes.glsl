// Area lights: rectangle, sphere, disk and cylinder under any affine map. Spheres and rectangles are sampled uniformly in
// the solid angle they fill in the light's own space, disks and cylinders (the facing part) uniformly in area. Points are
// drawn and rays are met in that space, where shapes are regular; densities are carried to world space exactly:
//   directions: w = M l / |M l| has d(w) = |det M| / |M l|^3 d(l) for a unit direction l,
//   areas:      an element with local normal n grows by |det M| |M^-T n|.
// Shapes emit from their outer side only: rectangle and disk towards local -Z, sphere and cylinder outwards, the
// cylinder (along X) not from its caps (UsdLux).
#ifndef HIPR_LIGHT_SHAPES_GLSL
#define HIPR_LIGHT_SHAPES_GLSL
#include "light/rect.glsl"
#include "shared/references.glsl"

// Where a ray meets a light, or where a light was sampled.
struct LightPoint {
    float t;      // world distance
    float pdf;    // per solid angle at the ray's origin, without the choice of the light
    vec2 st;      // rectangle: texture coordinates
};

float volumeScale(LightRecord light) { return abs(determinant(mat3(light.lightToWorld))); }

// Density per solid angle of a point drawn uniformly from `localArea`. `facing` is the cosine-like product of local
// normal and local (unnormalised) direction: the scale of the normal and that of the area cancel.
float areaPdf(LightRecord light, float localArea, float t, float facing) {
    return t * t / (localArea * volumeScale(light) * facing);
}

// In default position texture coordinates start at (+X, +Y) and end at (-X, -Y) (UsdLuxRectLight); with rows counted from
// the bottom, t = 1 is at +Y: seen from the lit side the picture reads upright.
vec2 rectCoordinates(LightRecord light, vec2 p) { return vec2(0.5 - p.x / light.size.x, 0.5 + p.y / light.size.y); }

float planarArea(LightRecord light) {
    return light.kind == LIGHT_RECT ? light.size.x * light.size.y : PI * light.size.x * light.size.x;
}

// The part of a cylinder's side that faces a point at distance `rho` from the axis: half of its angle.
float cylinderHalfAngle(float radius, float rho) { return acos(clamp(radius / rho, 0.0, 1.0)); }

// Density of a uniform choice in the local solid angle `angle`, for the local image of a unit world direction, which has
// length `inverseStretch`.
float anglePdf(LightRecord light, float angle, float inverseStretch) {
    return 1.0 / (angle * volumeScale(light) * inverseStretch * inverseStretch * inverseStretch);
}

// The same for the cone in which a sphere is seen from a local point at squared distance `squared` from its centre.
float spherePdf(LightRecord light, float squared, float inverseStretch) {
    float sin2 = light.size.x * light.size.x / squared;
    float oneMinusCos = sin2 / (1.0 + sqrt(max(0.0, 1.0 - sin2)));
    return anglePdf(light, 2.0 * PI * oneMinusCos, inverseStretch);
}

bool meetPlanar(LightRecord light, vec3 o, vec3 d, out LightPoint hit) {
    if (o.z >= 0.0 || d.z <= 0.0) return false;
    hit.t = -o.z / d.z;
    vec2 p = o.xy + hit.t * d.xy;
    bool inside = light.kind == LIGHT_RECT ? abs(p.x) <= 0.5 * light.size.x && abs(p.y) <= 0.5 * light.size.y
                                           : dot(p, p) <= light.size.x * light.size.x;
    if (!inside) return false;
    float angle = light.kind == LIGHT_RECT ? sphericalRect(light.size, o).angle : 0.0;
    hit.pdf = angle > MIN_RECT_ANGLE ? anglePdf(light, angle, length(d)) : areaPdf(light, planarArea(light), hit.t, d.z);
    hit.st = rectCoordinates(light, p);
    return true;
}

bool meetSphere(LightRecord light, vec3 o, vec3 d, out LightPoint hit) {
    float squared = dot(o, o), r2 = light.size.x * light.size.x;
    float inverseStretch = length(d); // 1 / |M l|
    vec3 l = d / inverseStretch;
    float along = -dot(o, l);
    vec3 nearest = o + along * l;
    float under = r2 - dot(nearest, nearest);
    hit.st = vec2(0.0);
    if (squared <= r2 || along <= 0.0 || under < 0.0) return false;
    hit.t = (squared - r2) / ((along + sqrt(under)) * inverseStretch);
    hit.pdf = spherePdf(light, squared, inverseStretch);
    return true;
}

bool meetCylinder(LightRecord light, vec3 o, vec3 d, out LightPoint hit) {
    float radius = light.size.x, rho2 = dot(o.yz, o.yz), r2 = radius * radius;
    float a = dot(d.yz, d.yz), b = -dot(o.yz, d.yz);
    hit.st = vec2(0.0);
    if (rho2 <= r2 || b <= 0.0 || a <= 0.0) return false;
    vec2 nearest = o.yz + b / a * d.yz;
    float under = r2 - dot(nearest, nearest);
    if (under < 0.0) return false;
    hit.t = (rho2 - r2) / (b + sqrt(under * a));
    vec3 p = o + hit.t * d;
    float localArea = 2.0 * cylinderHalfAngle(radius, sqrt(rho2)) * radius * light.size.y;
    hit.pdf = areaPdf(light, localArea, hit.t, -dot(p.yz, d.yz) / radius);
    return abs(p.x) <= 0.5 * light.size.y && hit.pdf > 0.0;
}

// Whether the emitting side of an area light is on the ray, and where.
bool meetLight(LightRecord light, vec3 origin, vec3 direction, out LightPoint hit) {
    vec3 o = light.worldToLight * vec4(origin, 1.0);
    vec3 d = mat3(light.worldToLight) * direction;
    if (light.kind == LIGHT_SPHERE) return meetSphere(light, o, d, hit);
    if (light.kind == LIGHT_CYLINDER) return meetCylinder(light, o, d, hit);
    return meetPlanar(light, o, d, hit);
}

// Direction to a sphere seen from local `o`, uniform in the cone it fills.
bool sampleSphere(LightRecord light, vec3 o, vec2 u, out vec3 wi, out LightPoint point) {
    float squared = dot(o, o), r2 = light.size.x * light.size.x;
    if (squared <= r2) return false;
    float sin2 = r2 / squared;
    float x = u.x * sin2 / (1.0 + sqrt(max(0.0, 1.0 - sin2))); // 1 - cosine
    float sine2 = x * (2.0 - x), phi = 2.0 * PI * u.y;
    vec3 l = frameAround(-o * inversesqrt(squared)) * vec3(sqrt(sine2) * vec2(cos(phi), sin(phi)), 1.0 - x);
    float along = sqrt(squared) * (1.0 - x);
    float localT = (squared - r2) / (along + sqrt(max(0.0, r2 - squared * sine2)));
    vec3 stretched = mat3(light.lightToWorld) * l;
    float stretch = length(stretched);
    wi = stretched / stretch;
    point = LightPoint(localT * stretch, spherePdf(light, squared, 1.0 / stretch), vec2(0.0));
    return true;
}

// A point of a flat shape or of the facing part of a cylinder, seen from local `o`: local position and normal; uniform in
// the solid angle `angle` where that is not 0, else in the area `localArea`.
bool samplePoint(LightRecord light, vec3 o, vec2 u, out vec3 p, out vec3 n, out float localArea, out float angle) {
    n = vec3(0.0, 0.0, -1.0);
    localArea = planarArea(light);
    angle = 0.0;
    if (light.kind == LIGHT_RECT) {
        SphericalRect rect = sphericalRect(light.size, o);
        angle = rect.angle > MIN_RECT_ANGLE ? rect.angle : 0.0;
        p = vec3(angle > 0.0 ? o.xy + sampleSphericalRect(rect, u) : (u - 0.5) * light.size, 0.0);
        return o.z < 0.0;
    }
    float radius = light.size.x;
    if (light.kind == LIGHT_DISK) {
        float r = radius * sqrt(u.x), phi = 2.0 * PI * u.y;
        p = vec3(r * cos(phi), r * sin(phi), 0.0);
        return o.z < 0.0;
    }
    float rho = length(o.yz);
    float halfAngle = cylinderHalfAngle(radius, rho);
    float phi = atan(o.z, o.y) + (2.0 * u.x - 1.0) * halfAngle;
    n = vec3(0.0, cos(phi), sin(phi));
    p = vec3((u.y - 0.5) * light.size.y, radius * n.yz);
    localArea = 2.0 * halfAngle * radius * light.size.y;
    return rho > radius && localArea > 0.0;
}

// Draws a direction from `origin` to an area light. False: the light's emitting side cannot be seen from there.
bool sampleShape(LightRecord light, vec3 origin, vec2 u, out vec3 wi, out LightPoint point) {
    vec3 o = light.worldToLight * vec4(origin, 1.0);
    if (light.kind == LIGHT_SPHERE) return sampleSphere(light, o, u, wi, point);
    vec3 p, n;
    float localArea, angle;
    if (!samplePoint(light, o, u, p, n, localArea, angle)) return false;
    vec3 way = mat3(light.lightToWorld) * (p - o);
    point.t = length(way);
    wi = way / point.t;
    point.st = rectCoordinates(light, p.xy);
    float facing = -dot(n, p - o) / point.t; // local direction is (p - o) / t
    point.pdf = angle > 0.0 ? anglePdf(light, angle, length(p - o) / point.t) : areaPdf(light, localArea, point.t, facing);
    return facing > 0.0 && point.t > 0.0;
}
#endif
