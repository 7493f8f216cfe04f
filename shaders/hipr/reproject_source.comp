// Chooses, among the pixels of the old picture that show what is nearest in a pixel of the new one, the first. One
// invocation a pixel of the old one.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "hipr/reprojection.glsl"

void main() {
    const ReprojectionRecord r = ReprojectionRef(push.record).v;
    const uint pixel = push.first + gl_GlobalInvocationID.x;
    if (pixel >= push.end) return;
    const CarriedPixel to = carried(r, pixel);
    if (!to.inside) return;
    SourceRef sources = SourceRef(r.sources);
    const uint i = to.x + to.y * r.width;
    if (oneSurface(to.depth, uintBitsToFloat(sources.v[i].depth))) atomicMin(sources.v[i].pixel, pixel);
}
