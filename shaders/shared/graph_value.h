// The operations of shaders/shared/graph.h, for kernels and the host.
#ifndef HIPR_SHARED_GRAPH_VALUE_H
#define HIPR_SHARED_GRAPH_VALUE_H
#include "graph.h"
#include "noise.h"
HIPR_SHARED_BEGIN
#ifdef __cplusplus
using glm::abs;
using glm::acos;
using glm::asin;
using glm::atan;
using glm::ceil;
using glm::clamp;
using glm::cos;
using glm::cross;
using glm::exp;
using glm::fract;
using glm::log;
using glm::max;
using glm::min;
using glm::mod;
using glm::normalize;
using glm::pow;
using glm::radians;
using glm::sign;
using glm::sin;
using glm::tan;
using glm::greaterThan;
using glm::greaterThanEqual;
using glm::equal;
#endif

HIPR_INLINE float graphDigit(vec4 a, uint digit) {
    float low = digit == 0u ? a.x : (digit == 1u ? a.y : a.z);
    float high = digit == 3u ? a.w : (digit == 4u ? 0.0f : 1.0f);
    return digit < 3u ? low : high;
}

HIPR_INLINE vec4 graphSwizzle(vec4 a, uint digits) {
    return vec4(graphDigit(a, digits & 15u), graphDigit(a, (digits >> 4u) & 15u), graphDigit(a, (digits >> 8u) & 15u),
                graphDigit(a, (digits >> 12u) & 15u));
}

// 1 where a is 0.
HIPR_INLINE vec4 graphIsZero(vec4 a) { return vec4(equal(a, vec4(0.0f))); }

HIPR_INLINE vec4 graphDivide(vec4 a, vec4 b) {
    vec4 zero = graphIsZero(b);
    return a / (b + zero) * (1.0f - zero);
}

HIPR_INLINE float graphPower(float a, float b) {
    float size = a == 0.0f && b > 0.0f ? 0.0f : pow(max(abs(a), 1e-30f), b);
    float turned = floor(b) == b ? 1.0f - 2.0f * mod(b, 2.0f) : 0.0f;
    return a < 0.0f ? size * turned : size;
}

// A function of numbers, for each component. A loop, since LLVM runs code that no lane needs once, too.
HIPR_INLINE vec4 graphNumbers(uint op, vec4 a, vec4 b) {
    vec4 result = vec4(0.0f);
    HIPR_LOOP for (uint k = 0u; k < 4u; ++k) {
        float value = a.x;
        switch (op) {
        case GRAPH_POWER: value = graphPower(a.x, b.x); break;
        case GRAPH_SIN: value = sin(a.x); break;
        case GRAPH_COS: value = cos(a.x); break;
        case GRAPH_ASIN: value = asin(clamp(a.x, -1.0f, 1.0f)); break;
        case GRAPH_ATAN2: value = a.x == 0.0f && b.x == 0.0f ? 0.0f : atan(a.x, b.x); break;
        case GRAPH_SQRT: value = sqrt(max(a.x, 0.0f)); break;
        case GRAPH_LN: value = a.x > 0.0f ? log(a.x) : 0.0f; break;
        case GRAPH_EXP: value = exp(a.x); break;
        default: break;
        }
        result = vec4(result.y, result.z, result.w, value); // rotates into place
        a = vec4(a.y, a.z, a.w, a.x);
        b = vec4(b.y, b.z, b.w, b.x);
    }
    return result;
}

HIPR_INLINE vec4 graphSmoothstep(vec4 a, vec4 low, vec4 high) {
    vec4 t = clamp(graphDivide(a - low, high - low), vec4(0.0f), vec4(1.0f));
    t = t * t * (3.0f - 2.0f * t);
    t = mix(t, vec4(0.0f), vec4(greaterThanEqual(low, a)));
    return mix(t, vec4(1.0f), vec4(greaterThanEqual(a, high)));
}

HIPR_INLINE vec4 graphRotate(vec4 a, float degrees, vec4 axis) {
    vec3 v = vec3(a.x, a.y, a.z), n = vec3(axis.x, axis.y, axis.z);
    float length2 = dot(n, n), angle = radians(degrees), c = cos(angle);
    n = length2 > 0.0f ? n / sqrt(length2) : vec3(0.0f, 1.0f, 0.0f);
    return vec4(v * c + cross(v, n) * sin(angle) + n * (dot(n, v) * (1.0f - c)), a.w);
}

// A. R. Smith, "Color Gamut Transform Pairs", SIGGRAPH 1978.
HIPR_INLINE vec4 graphRgbToHsv(vec4 a) {
    float most = max(a.x, max(a.y, a.z)), range = most - min(a.x, min(a.y, a.z));
    if (most <= 0.0f || range <= 0.0f) return vec4(0.0f, 0.0f, most, a.w);
    float sixth = a.x >= most ? (a.y - a.z) / range
                              : (a.y >= most ? 2.0f + (a.z - a.x) / range : 4.0f + (a.x - a.y) / range);
    float hue = sixth / 6.0f;
    return vec4(hue < 0.0f ? hue + 1.0f : hue, range / most, most, a.w);
}

HIPR_INLINE vec4 graphHsvToRgb(vec4 a) {
    vec3 shifted = fract(vec3(a.x) + vec3(0.0f, 2.0f, 1.0f) / 3.0f);
    vec3 ramp = clamp(abs(shifted * 6.0f - 3.0f) - 1.0f, vec3(0.0f), vec3(1.0f));
    return vec4(a.z * mix(vec3(1.0f), ramp, a.y < 0.0001f ? 0.0f : a.y), a.w);
}

HIPR_INLINE vec4 graphNoise(uint op, uint immediate, vec4 a, vec4 b) {
    uint dimensions = immediate & 3u;
    vec3 p = vec3(a.x, a.y, dimensions == 3u ? a.z : 0.0f);
    if (op == GRAPH_NOISE) return vec4(fractalNoise(p, b.x, b.y, b.z, dimensions), 1.0f);
    if (op == GRAPH_CELL) return vec4(cellNoise(p, dimensions));
    if (op == GRAPH_CELL3) return vec4(cellNoise3(latticeCell(p, dimensions), dimensions), 1.0f);
    return vec4(worleyNoise(p, b.x, dimensions, (immediate & GRAPH_NEAREST) != 0u), 1.0f);
}

// The value of a step from GRAPH_FIRST_PURE on.
HIPR_INLINE vec4 graphValue(uint op, uint immediate, vec4 a, vec4 b, vec4 c) {
    vec4 value = a;
    switch (op) {
    case GRAPH_ADD: value = a + b; break;
    case GRAPH_SUBTRACT: value = a - b; break;
    case GRAPH_MULTIPLY: value = a * b; break;
    case GRAPH_DIVIDE: value = graphDivide(a, b); break;
    case GRAPH_MODULO: value = a - b * floor(graphDivide(a, b)); value *= 1.0f - graphIsZero(b); break;
    case GRAPH_MIN: value = min(a, b); break;
    case GRAPH_MAX: value = max(a, b); break;
    case GRAPH_MIX: value = mix(a, b, c); break;
    case GRAPH_SMOOTHSTEP: value = graphSmoothstep(a, b, c); break;
    case GRAPH_ABS: value = abs(a); break;
    case GRAPH_FLOOR: value = floor(a); break;
    case GRAPH_SIGN: value = sign(a); break;
    case GRAPH_POWER:
    case GRAPH_SIN:
    case GRAPH_COS:
    case GRAPH_ASIN:
    case GRAPH_ATAN2:
    case GRAPH_SQRT:
    case GRAPH_LN:
    case GRAPH_EXP: value = graphNumbers(op, a, b); break;
    case GRAPH_GREATER: value = vec4(greaterThan(a, b)); break;
    case GRAPH_EQUAL: value = vec4(equal(a, b)); break;
    case GRAPH_SELECT:
        value = vec4(c.x != 0.0f ? a.x : b.x, c.y != 0.0f ? a.y : b.y, c.z != 0.0f ? a.z : b.z, c.w != 0.0f ? a.w : b.w);
        break;
    case GRAPH_DOT:
        value = a * b;
        value = vec4(value.x + value.y + (immediate > 2u ? value.z : 0.0f) + (immediate > 3u ? value.w : 0.0f));
        break;
    case GRAPH_CROSS: value = vec4(cross(vec3(a.x, a.y, a.z), vec3(b.x, b.y, b.z)), 0.0f); break;
    case GRAPH_SWIZZLE: value = graphSwizzle(a, immediate); break;
    case GRAPH_COMBINE: value = vec4(a.x, b.x, c.x, 1.0f); break;
    case GRAPH_WITH_W: value = vec4(a.x, a.y, a.z, b.x); break;
    case GRAPH_ROTATE: value = graphRotate(a, b.x, c); break;
    case GRAPH_RGB_TO_HSV: value = graphRgbToHsv(a); break;
    case GRAPH_HSV_TO_RGB: value = graphHsvToRgb(a); break;
    case GRAPH_NOISE:
    case GRAPH_CELL:
    case GRAPH_CELL3:
    case GRAPH_WORLEY: value = graphNoise(op, immediate, a, b); break;
    default: break; // GRAPH_MOVE
    }
    return value;
}

HIPR_SHARED_END
#endif
