// Finds what of the picture on display is nearest in every pixel of the new one. One invocation a pixel of the old one, a
// row of them in y.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "hipr/reprojection.glsl"

void main() {
    const uint x = gl_GlobalInvocationID.x, y = gl_WorkGroupID.y;
    if (x >= push.width) return;
    const SeenPoint seen = seenAt(x + y * push.width);
    const CarriedPixel to = carryPixel(CameraRef(push.after).v, seen, x, y, push.width, push.height);
    const uint known = subgroupBallotBitCount(subgroupBallot(seen.look != SEEN_NOTHING));
    const uint inside = subgroupBallotBitCount(subgroupBallot(to.inside));
    if (subgroupElect()) {
        atomicAdd(CountsRef(push.counts).v.known, known);
        atomicAdd(CountsRef(push.counts).v.inside, inside);
    }
    if (to.inside) atomicMin(list(CARRIED_DEPTHS).v[to.x + to.y * push.width], floatBitsToUint(to.depth));
}
