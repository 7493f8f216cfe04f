// Dome lights: the latitude-longitude mapping and its sampling table.
//
// Mapping (that of UsdLuxDomeLight, which follows OpenEXR's latitude-longitude maps), in the light's own space: the top
// of the image is +Y, the bottom -Y, its centre looks to +Z, and from there towards the left edge to +X, so that the
// picture reads the right way round from inside. With s to the right and t up, both in [0, 1]:
//   longitude = pi - 2 pi s, latitude = pi (t - 1/2), direction = (cos lat sin lon, sin lat, cos lat cos lon).
//
// Table (LightRecord::distribution), written by renderer/shading/dome.h: a piecewise-constant density over width x height
// cells of (s, t): height + 1 cumulative row probabilities, then for every row width + 1 cumulative cell probabilities.
#ifndef HIPR_LIGHT_ENVIRONMENT_GLSL
#define HIPR_LIGHT_ENVIRONMENT_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "material/frame.glsl"
#include "material/texture.glsl"

vec3 domeDirection(vec2 st) {
    float longitude = PI - 2.0 * PI * st.x, latitude = PI * (st.y - 0.5);
    return vec3(cos(latitude) * sin(longitude), sin(latitude), cos(latitude) * cos(longitude));
}

vec2 domeCoordinates(vec3 direction) {
    float longitude = direction.x == 0.0 && direction.z == 0.0 ? 0.0 : atan(direction.x, direction.z);
    float latitude = atan(direction.y, length(direction.xz)); // exact at the poles, unlike asin
    return vec2(0.5 - longitude / (2.0 * PI), 0.5 + latitude / PI);
}

vec3 domeRadiance(SceneRecord scene, LightRecord light, vec2 st) {
    if (light.texture == NO_INDEX) return light.radiance;
    return light.radiance * max(sampleTexture(TextureRef(scene.textures).v[light.texture], st).rgb, 0.0);
}

// Solid angle per unit of (s, t) area.
float domeJacobian(float t) { return 2.0 * PI * PI * sin(PI * t); }

// The cell of a cumulative table that holds `u`; `u` becomes the place within the cell, `probability` the cell's.
uint invertCumulative(FloatRef table, uint first, uint count, inout float u, out float probability) {
    uint lo = 0u, hi = count; // table[lo] <= u < table[hi]
    while (hi - lo > 1u) {
        uint middle = (lo + hi) >> 1;
        if (table.v[first + middle] <= u)
            lo = middle;
        else
            hi = middle;
    }
    float start = table.v[first + lo];
    probability = table.v[first + lo + 1u] - start;
    u = probability > 0.0 ? clamp((u - start) / probability, 0.0, 0.99999994) : 0.5;
    return lo;
}

// Draws a point of the image; `pdf` is per solid angle, 0 where the sample is unusable (a pole).
vec2 sampleDome(LightRecord light, vec2 u, out float pdf) {
    FloatRef table = FloatRef(light.distribution);
    float rowProbability, cellProbability;
    uint row = invertCumulative(table, 0u, light.distributionHeight, u.y, rowProbability);
    uint firstCell = light.distributionHeight + 1u + row * (light.distributionWidth + 1u);
    uint cell = invertCumulative(table, firstCell, light.distributionWidth, u.x, cellProbability);
    vec2 size = vec2(light.distributionWidth, light.distributionHeight);
    vec2 st = (vec2(cell, row) + u) / size;
    float jacobian = domeJacobian(st.y);
    pdf = jacobian > 0.0 ? rowProbability * cellProbability * size.x * size.y / jacobian : 0.0;
    return st;
}

// Density per solid angle with which sampleDome draws `st`.
float domePdf(LightRecord light, vec2 st) {
    FloatRef table = FloatRef(light.distribution);
    uvec2 size = uvec2(light.distributionWidth, light.distributionHeight);
    uvec2 cell = min(uvec2(clamp(st, 0.0, 1.0) * vec2(size)), size - 1u);
    uint firstCell = size.y + 1u + cell.y * (size.x + 1u);
    float row = table.v[cell.y + 1u] - table.v[cell.y];
    float column = table.v[firstCell + cell.x + 1u] - table.v[firstCell + cell.x];
    float jacobian = domeJacobian(st.y);
    return jacobian > 0.0 ? row * column * float(size.x) * float(size.y) / jacobian : 0.0;
}
#endif
