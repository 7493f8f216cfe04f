#if defined(__x86_64__)
// Twice the registers and mask results, but no wider vectors. Headers first, as in wide_walk_avx2.cpp.
#include "renderer/accel/wide_walk_headers.h"
#define HIPR_WALK_AVX512
#pragma GCC target("avx2,bmi,avx512f,avx512vl,avx512dq,avx512bw")
#include "renderer/accel/wide_walk.inl"

namespace hipr {

const WideWalk avx512WideWalk = {"avx512", nearest, occluded};

} // namespace hipr
#endif
