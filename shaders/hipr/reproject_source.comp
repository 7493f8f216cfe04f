// Chooses, among the pixels of the old picture that show what is nearest in a pixel of the new one, the first. One
// invocation a pixel of the old one, a row of them in y.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "hipr/reprojection.glsl"

void main() {
    const uint x = gl_GlobalInvocationID.x, y = gl_WorkGroupID.y;
    if (x >= push.width) return;
    const SeenPoint seen = seenAt(x + y * push.width);
    const CarriedPixel to = carryPixel(CameraRef(push.after).v, seen, x, y, push.width, push.height);
    if (!to.inside) return;
    const uint i = to.x + to.y * push.width;
    if (oneSurface(to.depth, uintBitsToFloat(list(CARRIED_DEPTHS).v[i])))
        atomicMin(list(CARRIED_SOURCES).v[i], x | y << 16u);
}
