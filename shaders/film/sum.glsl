// Sums that many small values do not blur.
#ifndef HIPR_FILM_SUM_GLSL
#define HIPR_FILM_SUM_GLSL

// W. Kahan, "Further remarks on reducing truncation errors", Comm. ACM 8(1), 1965: a million equal samples have their
// value as mean, where a plain float sum is off by percents.
void addTo(inout vec3 sum, inout vec3 error, vec3 value) {
    precise vec3 corrected = value - error;
    precise vec3 next = sum + corrected;
    precise vec3 lost = (next - sum) - corrected;
    error = lost;
    sum = next;
}
#endif
