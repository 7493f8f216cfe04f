// Means over the hemisphere, with cosine weight, of what tables hold at the cosines (i / (n - 1))^2 and interpolate linearly
// in the root of the cosine.
#ifndef HIPR_SHARED_HEMISPHERE_H
#define HIPR_SHARED_HEMISPHERE_H
#include "language.h"
HIPR_SHARED_BEGIN

// The share of entry `i` of `n`: the integral of 4 x^3 dx (that of 2 c dc, with c = x^2) under its hat. It has to be exact:
// smooth highlights lose less than a simple rule is off, and what they lose is divided by its mean.
HIPR_INLINE float hemisphereShare(uint i, uint n) {
    float h = 1.0f / float(n - 1u), x = float(i) * h, before = x - h;
    float rising = 0.5f * before * before * before + before * before * h + 0.75f * before * h * h + 0.2f * h * h * h;
    float falling = 0.5f * x * x * x + 0.5f * x * x * h + 0.25f * x * h * h + 0.05f * h * h * h;
    return 4.0f * h * ((i > 0u ? rising : 0.0f) + (i + 1u < n ? falling : 0.0f));
}

HIPR_SHARED_END
#endif
