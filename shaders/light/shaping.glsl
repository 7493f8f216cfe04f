// Shaping of a light's radiance by the direction it leaves in: focus, cone and IES profile (UsdLuxShapingAPI; the
// formulas are those of the schema's documentation). The axis is the light's -Z. An IES profile has its vertical angle 0
// there, and its horizontal angle 0 for light that leaves towards -X, 90 degrees towards -Y, as in hdEmbree.
#ifndef HIPR_LIGHT_SHAPING_GLSL
#define HIPR_LIGHT_SHAPING_GLSL
#include "material/frame.glsl"
#include "shared/references.glsl"

// The profile at `theta` off the axis and `phi` in [0, 2 PI) around it, linear between its angles.
float profileAt(ShapingRecord shaping, float theta, float phi) {
    if (shaping.iesAngleScale > 0.0) theta /= shaping.iesAngleScale;
    if (shaping.iesAngleScale < 0.0) theta = PI - (PI - theta) / -shaping.iesAngleScale;
    vec2 at = vec2(clamp(theta / PI, 0.0, 1.0) * float(shaping.profileRows - 1u),
                   phi / (2.0 * PI) * float(shaping.profileColumns - 1u));
    uint row = min(uint(at.x), shaping.profileRows - 2u), column = uint(at.y);
    uint next = min(column + 1u, shaping.profileColumns - 1u);
    FloatRef values = FloatRef(shaping.profile);
    uint first = row * shaping.profileColumns, second = first + shaping.profileColumns;
    vec2 inRow = mix(vec2(values.v[first + column], values.v[second + column]),
                     vec2(values.v[first + next], values.v[second + next]), at.y - float(column));
    return mix(inRow.x, inRow.y, at.x - float(row)) * shaping.iesFactor;
}

// What is left of the light that leaves in the direction -wi.
vec3 shapingFactor(LightRecord light, vec3 wi) {
    if (light.shaping == 0ul) return vec3(1.0);
    ShapingRecord shaping = ShapingRef(light.shaping).v;
    float cosine = clamp(dot(wi, normalize(light.lightToWorld[2])), -1.0, 1.0), theta = acos(cosine);
    if (theta > shaping.coneAngle) return vec3(0.0);
    vec3 factor = vec3(1.0);
    if (shaping.focus > 0.0) factor = mix(shaping.focusTint, vec3(1.0), pow(abs(cosine), shaping.focus));
    if (theta > shaping.coneStart) factor *= 1.0 - smoothstep(shaping.coneStart, shaping.coneAngle, theta);
    if (shaping.profile != 0ul) {
        float x = dot(wi, normalize(light.lightToWorld[0])), y = dot(wi, normalize(light.lightToWorld[1]));
        float phi = x == 0.0 && y == 0.0 ? 0.0 : atan(y, x);
        factor *= profileAt(shaping, theta, phi < 0.0 ? phi + 2.0 * PI : phi);
    }
    return factor;
}
#endif
