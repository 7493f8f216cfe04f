// Pixel filters, importance-sampled: a sample offset drawn with density proportional to the filter, so that the pixel
// value is a plain mean (filter importance sampling; M. Ernst et al., "Filter importance sampling", 2006).
#ifndef HIPR_SAMPLING_FILTER_GLSL
#define HIPR_SAMPLING_FILTER_GLSL
#extension GL_EXT_control_flow_attributes : require

// The choices of the setting `hipr:pixelFilter`, in its order.
const uint FILTER_BOX = 0u;             // own width 1
const uint FILTER_TRIANGLE = 1u;        // own width 2
const uint FILTER_GAUSSIAN = 2u;        // own width 3, standard deviation width / 6, cut off at the width
const uint FILTER_BLACKMAN_HARRIS = 3u; // own width 3.3

// Integral of the Blackman-Harris window from its centre to x, as a part of its area; x in [-0.5, 0.5].
// F. J. Harris, "On the use of windows for harmonic analysis", Proc. IEEE 66(1), 1978: 4 terms, -92 dB.
vec2 blackmanHarrisCdf(vec2 x) {
    vec2 a = 6.28318530718 * x;
    return 0.5 + x + (0.48829 * sin(a) + 0.5 * 0.14128 * sin(2.0 * a) + 0.01168 / 3.0 * sin(3.0 * a)) *
                         (1.0 / (0.35875 * 6.28318530718));
}

vec2 blackmanHarrisPdf(vec2 x) {
    vec2 a = 6.28318530718 * x;
    return 1.0 + (0.48829 * cos(a) + 0.14128 * cos(2.0 * a) + 0.01168 * cos(3.0 * a)) * (1.0 / 0.35875);
}

// Normal deviates cut off at +-3, scaled to [-0.5, 0.5], by inversion: M. Giles, "Approximating the erfinv function",
// GPU Computing Gems 2, 2011, single precision, central branch (|deviate| <= 3 stays inside it).
vec2 sampleGaussian(vec2 u) {
    vec2 x = (2.0 * u - 1.0) * 0.9973002039; // erf(3 / sqrt 2)
    vec2 w = -log((1.0 - x) * (1.0 + x)) - 2.5;
    vec2 p = vec2(2.81022636e-08);
    p = 3.43273939e-07 + p * w;
    p = -3.5233877e-06 + p * w;
    p = -4.39150654e-06 + p * w;
    p = 0.00021858087 + p * w;
    p = -0.00125372503 + p * w;
    p = -0.00417768164 + p * w;
    p = 0.246640727 + p * w;
    p = 1.50140941 + p * w;
    return clamp(p * x * (1.41421356 / 6.0), -0.5, 0.5);
}

// Inverse of the window's cumulative distribution: Newton steps from the normal distribution nearest to it. The error in
// the distribution is below 1e-5.
vec2 sampleBlackmanHarris(vec2 u) {
    vec2 x = 0.85 * sampleGaussian(u);
    [[dont_unroll]] for (int i = 0; i < 3; ++i) {
        vec2 step = (blackmanHarrisCdf(x) - u) / max(blackmanHarrisPdf(x), vec2(1e-5));
        x = clamp(x - step, -0.5, 0.5);
    }
    return x;
}

// An offset from the pixel's centre, in pixels. `width` is the filter's full width in pixels, 0: its own width.
vec2 sampleFilter(uint filterKind, float width, vec2 u) {
    if (filterKind == FILTER_BOX) return (u - 0.5) * (width > 0.0 ? width : 1.0);
    if (filterKind == FILTER_TRIANGLE) {
        vec2 d = 0.5 - abs(u - 0.5); // distance to the nearer end of the distribution
        return sign(u - 0.5) * (0.5 - sqrt(0.5 * d)) * (width > 0.0 ? width : 2.0);
    }
    if (filterKind == FILTER_GAUSSIAN) return sampleGaussian(u) * (width > 0.0 ? width : 3.0);
    return sampleBlackmanHarris(u) * (width > 0.0 ? width : 3.3);
}
#endif
