// Bilinear texture look-up from texels in memory.
#ifndef HIPR_MATERIAL_TEXTURE_GLSL
#define HIPR_MATERIAL_TEXTURE_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "color/srgb.glsl"
#include "shared/references.glsl"

vec4 decodeTexel(TextureRecord texture, uint index) {
    if (texture.format <= TEXEL_RGBA8) {
        vec4 c = unpackUnorm4x8(UintRef(texture.texels).v[index]);
        if (texture.format == TEXEL_RGBA8_SRGB) c.rgb = decodeSrgb(c.rgb);
        return c;
    }
    if (texture.format == TEXEL_RGBA16F) {
        uvec2 h = Uvec2Ref(texture.texels).v[index];
        return vec4(unpackHalf2x16(h.x), unpackHalf2x16(h.y));
    }
    return Vec4Ref(texture.texels).v[index];
}

// Folds a coordinate into one period; the mirrored half of a period then reads like a clamped one.
float foldCoordinate(float s, uint wrap) {
    if (wrap == WRAP_REPEAT) return s - floor(s);
    if (wrap == WRAP_MIRROR) return 1.0 - abs(1.0 - (s - 2.0 * floor(0.5 * s)));
    return clamp(s, -2.0, 3.0); // keeps the conversion to int defined; the border is far inside
}

// The texel number nearest to `i` that exists; `inside` becomes false for texels of a black border.
int wrapTexel(int i, int size, uint wrap, inout bool inside) {
    if (wrap == WRAP_REPEAT) i = i < 0 ? i + size : (i >= size ? i - size : i);
    if (wrap == WRAP_BLACK && (i < 0 || i >= size)) inside = false;
    return clamp(i, 0, size - 1);
}

// The level of detail whose texels are as large as what a ray covers of a texture: the coarser of two with the chance that
// is nearer, `share` being a random number. Ray cones: T. Akenine-Moller et al., "Improved Shader and Texture Level of
// Detail Using Ray Cones", JCGT 10(1), 2021; here by areas instead of widths.
uint textureLevel(TextureRecord texture, float area, float share) {
    float texels = area * float(texture.width) * float(texture.height);
    return min(uint(0.5 * log2(max(texels, 1.0)) + share), texture.coarserLevels);
}

// The value of a texture (not TEXEL_NONE) at `st`. It spans [0, 1]^2; texel centres are at half-integer texel coordinates.
vec4 sampleTexture(TextureRecord texture, vec2 st) {
    ivec2 size = ivec2(texture.width, texture.height);
    vec2 p = vec2(foldCoordinate(st.x, texture.wrapS), foldCoordinate(st.y, texture.wrapT)) * vec2(size) - 0.5;
    vec2 corner = floor(p);
    vec2 f = p - corner;
    vec4 sum = vec4(0.0);
    bvec2 outside = notEqual(st, clamp(st, 0.0, 1.0));
    if ((texture.wrapS == WRAP_CUT && outside.x) || (texture.wrapT == WRAP_CUT && outside.y)) return sum;
    [[dont_unroll]] for (int k = 0; k < 4; ++k) {
        ivec2 tap = ivec2(k & 1, k >> 1);
        bool inside = true;
        int x = wrapTexel(int(corner.x) + tap.x, size.x, texture.wrapS, inside);
        int y = wrapTexel(int(corner.y) + tap.y, size.y, texture.wrapT, inside);
        float weight = (tap.x == 1 ? f.x : 1.0 - f.x) * (tap.y == 1 ? f.y : 1.0 - f.y);
        if (inside && weight > 0.0) sum += weight * decodeTexel(texture, uint(y) * texture.width + uint(x));
    }
    return sum;
}
#endif
