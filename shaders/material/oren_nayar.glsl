// A rough diffuse lobe that keeps all light: the model of Oren and Nayar as simplified by Y. Fujii ("A tiny improvement of
// Oren-Nayar reflectance model"), with the light of several bounces as in J. Portsmouth, P. Kutz and S. Hill, "EON: A
// Practical Energy-Preserving Rough Diffuse BRDF", JCGT 14(1), 2025.
#ifndef HIPR_MATERIAL_OREN_NAYAR_GLSL
#define HIPR_MATERIAL_OREN_NAYAR_GLSL
#include "material/frame.glsl"

// Reflectance of the single-bounce lobe facing the viewer.
float orenNayarScale(float roughness) { return 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * roughness); }

// Directional albedo of the single-bounce lobe of a white surface.
float orenNayarAlbedo(float cosine, float roughness) {
    float c = clamp(cosine, 1e-4, 1.0), s = sqrt(1.0 - c * c);
    float g = s * (acos(c) - s * c) + (2.0 / 3.0) * (s / c * (1.0 - s * s * s) - s);
    return orenNayarScale(roughness) * (1.0 + roughness * g / PI);
}

// BRDF times pi for `color`; `albedoOut` is orenNayarAlbedo of the viewer's direction.
vec3 orenNayar(vec3 color, float roughness, vec3 o, vec3 i, float albedoOut) {
    if (roughness == 0.0) return color;
    float s = dot(o.xy, i.xy);
    float t = s > 0.0 ? max(o.z, i.z) : 1.0;
    float scale = orenNayarScale(roughness);
    float mean = scale * (1.0 + roughness * (2.0 / 3.0 - 28.0 / (15.0 * PI)));
    float missing = (1.0 - albedoOut) * (1.0 - orenNayarAlbedo(i.z, roughness));
    vec3 bounced = color * color * mean / ((1.0 - color * (1.0 - mean)) * (1.0 - mean));
    return color * scale * (1.0 + roughness * s / t) + bounced * missing;
}
#endif
