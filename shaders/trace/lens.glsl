// Points of an aperture.
#ifndef HIPR_TRACE_LENS_GLSL
#define HIPR_TRACE_LENS_GLSL

const float TURN = 6.28318530718;

// A point of the unit disk, or of the regular polygon in it with `blades` corners, one of them at (1, 0); uniform in area.
// Neighbouring u stay neighbours, so that well-distributed u give well-distributed points: disk by P. Shirley and
// K. Chiu, "A Low Distortion Map Between Disk and Square", 1997; polygon as triangles around its middle.
vec2 sampleAperture(uint blades, vec2 u) {
    if (blades == 0u) {
        const vec2 square = 2.0 * u - 1.0;
        const bool wide = abs(square.x) > abs(square.y);
        const float r = wide ? square.x : square.y;
        if (r == 0.0) return vec2(0.0);
        const float slice = TURN / 8.0 * (wide ? square.y / square.x : 2.0 - square.x / square.y);
        return r * vec2(cos(slice), sin(slice));
    }
    const float corner = floor(u.x * float(blades)), along = u.x * float(blades) - corner;
    const float first = TURN * corner / float(blades), second = TURN * (corner + 1.0) / float(blades);
    const vec2 edge = mix(vec2(cos(first), sin(first)), vec2(cos(second), sin(second)), along);
    return sqrt(u.y) * edge;
}
#endif
