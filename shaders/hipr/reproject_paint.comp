// Paints the new picture from the old one and estimates what is wrong with it. One invocation a pixel of the new one, a row
// of them in y; CARRIED_STRIP neighbouring lanes of a subgroup, which may have more, sum up what they find.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_clustered : require
#include "hipr/reprojection.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer StripRef { CarriedStrip v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer DepthRef { float v[]; };

SeenPoint turned(SeenPoint seen) {
    if (seen.look >= SEEN_SKY) return seen;
    const vec3 before = viewDirection(CameraRef(push.before).v, seen.point);
    const vec3 after = viewDirection(CameraRef(push.after).v, seen.point);
    return SeenPoint(seen.point, turnedLook(seen.look, length(after - before)));
}

// Where splats are hidden until the new camera's first hits are known.
float cameraDepth(SeenPoint seen, uint x, uint y) {
    if (seen.look >= SEEN_SKY) return 0.0;
    const CameraRecord camera = CameraRef(push.after).v;
    const vec2 ndc = 2.0 * (vec2(x, y) + 0.5) / vec2(push.width, push.height) - 1.0;
    return dot(camera.forward, seen.point - (camera.origin + ndc.x * camera.originX + ndc.y * camera.originY));
}

CarriedStrip paint(uint x, uint y) {
    const uint pixel = x + y * push.width;
    const uint mended = list(CARRIED_MENDED).v[pixel];
    const uint source = mended != NO_INDEX ? mended : list(CARRIED_SOURCES).v[pixel];
    OldPixel old;
    SeenPoint seen = SeenPoint(vec3(0.0), SEEN_NOTHING);
    if (source == GUESSED) {
        old = meanAt(carriedAddress(pixel));
    } else {
        old = displayed(source);
        seen = turned(seenAt((source & 0xffffu) + (source >> 16u) * push.width));
        carryTo(pixel, old);
    }
    keepSeen(pixel, seen);
    if (push.depths != 0ul) DepthRef(push.depths).v[pixel] = cameraDepth(seen, x, y);
    const float radiance = max(dot(old.color.rgb, vec3(1.0 / 3.0)), 0.0);
    return CarriedStrip(uint(source == GUESSED), radiance * staleness(seen.look), radiance);
}

void main() {
    const uint x = gl_GlobalInvocationID.x, y = gl_WorkGroupID.y;
    CarriedStrip own = CarriedStrip(0u, 0.0, 0.0);
    if (x < push.width) own = paint(x, y);
    const CarriedStrip sum = CarriedStrip(subgroupClusteredAdd(own.uncovered, CARRIED_STRIP),
                                          subgroupClusteredAdd(own.stale, CARRIED_STRIP),
                                          subgroupClusteredAdd(own.radiance, CARRIED_STRIP));
    const uint strips = (push.tileColumns << push.tileShift) / CARRIED_STRIP;
    if (x % CARRIED_STRIP == 0u && x / CARRIED_STRIP < strips) StripRef(push.strips).v[x / CARRIED_STRIP + y * strips] = sum;
}
