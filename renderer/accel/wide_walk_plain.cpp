#include "renderer/accel/wide_walk.inl"

namespace hipr {

const WideWalk plainWideWalk = {"plain", nearest, occluded};

std::vector<const WideWalk*> wideWalks() {
    std::vector<const WideWalk*> walks;
#if defined(__x86_64__)
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi");
    const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
    if (avx512) walks.push_back(&avx512WideWalk);
    if (avx2) walks.push_back(&avx2WideWalk);
#endif
    walks.push_back(&plainWideWalk);
    return walks;
}

} // namespace hipr
