#if defined(__x86_64__)
// Headers come first: what they define inline is shared with other files and must run on every processor.
#include "renderer/accel/wide_walk_headers.h"
#define HIPR_WALK_AVX2
#pragma GCC target("avx2,bmi")
#include "renderer/accel/wide_walk.inl"

namespace hipr {

const WideWalk avx2WideWalk = {"avx2", nearest, occluded};

} // namespace hipr
#endif
