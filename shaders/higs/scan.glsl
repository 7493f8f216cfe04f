// Sums over the invocations of a workgroup of 256.
#ifndef HIPR_HIGS_SCAN_GLSL
#define HIPR_HIGS_SCAN_GLSL

const uint THREADS = 256u;
layout(local_size_x = 256) in;

shared uvec2 sums[THREADS]; // afterwards: up to and with the invocation

// The sum of the invocations before this one (J. Hillis, G. Steele, "Data parallel algorithms", CACM 29(12), 1986).
uvec2 scan(uvec2 own) {
    const uint i = gl_LocalInvocationIndex;
    uvec2 sum = own;
    for (uint step_ = 1u; step_ < THREADS; step_ *= 2u) {
        sums[i] = sum;
        barrier();
        if (i >= step_) sum += sums[i - step_];
        barrier();
    }
    sums[i] = sum;
    barrier();
    return sum - own;
}
#endif
