// Rectangles seen as solid angles: C. Urena, M. Fajardo and A. King, "An Area-Preserving Parametrization for Spherical
// Rectangles", EGSR 2013, sections 3 and 4. The rectangle lies in the plane z = 0 of the light's own space.
#ifndef HIPR_LIGHT_RECT_GLSL
#define HIPR_LIGHT_RECT_GLSL
#include "material/frame.glsl"

// Below this solid angle the sum of angles has too few digits left; uniform points do as well there.
const float MIN_RECT_ANGLE = 0.02;

struct SphericalRect {
    vec2 lo, hi;      // corners relative to the viewer
    float distance;   // of the viewer from the plane
    float b0, b1, k;  // the paper's constants
    float angle;      // solid angle
};

SphericalRect sphericalRect(vec2 size, vec3 o) {
    SphericalRect r;
    r.lo = -0.5 * size - o.xy;
    r.hi = 0.5 * size - o.xy;
    r.distance = abs(o.z);
    // z components of the normals of the four planes through the viewer and an edge: bottom, right, top, left.
    vec4 n = vec4(-r.lo.y, r.hi.x, r.hi.y, -r.lo.x);
    n *= inversesqrt(r.distance * r.distance + n * n);
    vec4 g = acos(clamp(-n * n.yzwx, -1.0, 1.0)); // angles between neighbouring planes
    r.b0 = n.x;
    r.b1 = n.z;
    r.k = 2.0 * PI - g.z - g.w;
    r.angle = g.x + g.y - r.k;
    return r;
}

// The point of the rectangle (x, y relative to the viewer) for u: uniform in solid angle.
vec2 sampleSphericalRect(SphericalRect r, vec2 u) {
    float au = u.x * r.angle + r.k;
    float fu = (cos(au) * r.b0 - r.b1) / sin(au);
    float cu = (fu > 0.0 ? 1.0 : -1.0) * inversesqrt(fu * fu + r.b0 * r.b0);
    cu = clamp(cu, -0.9999999, 0.9999999);
    float x = clamp(cu * r.distance * inversesqrt(1.0 - cu * cu), r.lo.x, r.hi.x);
    float d2 = x * x + r.distance * r.distance;
    float h0 = r.lo.y * inversesqrt(d2 + r.lo.y * r.lo.y), h1 = r.hi.y * inversesqrt(d2 + r.hi.y * r.hi.y);
    float h = mix(h0, h1, u.y);
    float y = h * h < 0.999999 ? h * sqrt(d2 / (1.0 - h * h)) : r.hi.y;
    return vec2(x, clamp(y, r.lo.y, r.hi.y));
}
#endif
