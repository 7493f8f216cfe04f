// Mends the new picture: closes its cracks and guesses what came into sight. One invocation a listed pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "hipr/reprojection.glsl"

const ivec2 AROUND[4] = ivec2[4](ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(-1, 1)); // and the opposite ways
// Steps of a search: so many of one pixel, so many of 4, so many of 16.
const uint FINE_STEPS = 16u, MEDIUM_STEPS = 12u, COARSE_STEPS = 28u;
const float FAR_AWAY = 1e6; // a way that leads to nothing
const uint INFINITE_DEPTH = 0x7f800000u; // bits

// What came to a pixel; both NO_INDEX where nothing did.
struct Came {
    uint depth;
    uint pixel;
};
const Came NOTHING_CAME = Came(NO_INDEX, NO_INDEX);

Came cameTo(ivec2 p) {
    const bool inside = all(greaterThanEqual(p, ivec2(0))) && p.x < int(push.width) && p.y < int(push.height);
    if (!inside) return NOTHING_CAME;
    const uint i = uint(p.x) + uint(p.y) * push.width;
    return Came(list(CARRIED_DEPTHS).v[i], list(CARRIED_SOURCES).v[i]);
}

// Whether the pixels on both sides show one surface, nearer than `depth`.
bool betweenNearer(ivec2 p, ivec2 step_, float depth, out Came side, out Came other) {
    side = cameTo(p + step_);
    other = cameTo(p - step_);
    if (side.pixel == NO_INDEX || other.pixel == NO_INDEX) return false;
    const float a = uintBitsToFloat(side.depth), b = uintBitsToFloat(other.depth);
    return oneSurface(a, b) && max(a, b) < depth && !oneSurface(a, depth);
}

// Whether two pixels touched in the old picture.
bool touched(uint a, uint b) {
    const ivec2 apart = ivec2(a & 0xffffu, a >> 16u) - ivec2(b & 0xffffu, b >> 16u);
    return max(abs(apart.x), abs(apart.y)) <= 1;
}

// What a pixel shows. A surface that comes closer leaves cracks of a pixel's width between pixels that touched before; a
// neighbour closes them, also those through which something behind shows.
Came shownAt(ivec2 p) {
    const Came own = cameTo(p);
    const bool empty = own.pixel == NO_INDEX;
    const float depth = uintBitsToFloat(empty ? INFINITE_DEPTH : own.depth);
    for (uint i = 0u; i < 4u; ++i) {
        Came side, other;
        if (betweenNearer(p, AROUND[i], depth, side, other) && (empty || touched(side.pixel, other.pixel)))
            return side;
    }
    return own;
}

// The nearest pixel in a direction to which something came, and how far away it is.
Came look(ivec2 p, ivec2 direction, out float distance_) {
    ListRef depths = list(CARRIED_DEPTHS);
    const int pitch = direction.x + direction.y * int(push.width), here = p.x + p.y * int(push.width);
    const ivec2 border = ivec2(greaterThan(direction, ivec2(0))) * (ivec2(push.width, push.height) - 1);
    const int last = abs(direction.x != 0 ? border.x - p.x : border.y - p.y); // that is in the picture
    int at = 0;
    for (uint i = 0u; i < FINE_STEPS + MEDIUM_STEPS + COARSE_STEPS; ++i) {
        at += i < FINE_STEPS ? 1 : i < FINE_STEPS + MEDIUM_STEPS ? 4 : 16;
        if (at > last) break;
        if (depths.v[here + at * pitch] == NO_INDEX) continue;
        distance_ = float(at);
        return cameTo(p + at * direction);
    }
    distance_ = FAR_AWAY;
    return NOTHING_CAME;
}

// A guess at what came into sight: more of the background. Along a row or column that is the farther of what both sides
// show; the shorter the way across the gap, the more it counts. False: nothing is around.
bool guess(ivec2 p, out OldPixel pixel) {
    pixel = OldPixel(vec4(0.0), vec3(0.0), 1u);
    float weights = 0.0;
    for (uint i = 0u; i < 2u; ++i) {
        Came sides[2];
        float distances[2];
        for (uint k = 0u; k < 2u; ++k)
            sides[k] = look(p, k == 0u ? AROUND[i] : -AROUND[i], distances[k]);
        // Depths that are no numbers, of sides that show nothing, are greater as words.
        const bool both = sides[0].pixel != NO_INDEX && sides[1].pixel != NO_INDEX;
        const bool first = (sides[0].depth > sides[1].depth) == both;
        const Came behind = first ? sides[0] : sides[1];
        if (behind.pixel == NO_INDEX) continue;
        const float across = both ? distances[0] + distances[1] : 2.0 * min(distances[0], distances[1]);
        const float weight = 1.0 / (across * across * across * across);
        const OldPixel old = displayed(behind.pixel);
        pixel.color += old.color * weight;
        pixel.albedo += old.albedo * weight;
        weights += weight;
    }
    if (weights == 0.0) return false;
    pixel.color /= weights;
    pixel.albedo /= weights;
    return true;
}

void main() {
    const uint entry = gl_GlobalInvocationID.x + gl_WorkGroupID.y * MEND_GROUPS * gl_WorkGroupSize.x;
    if (entry >= CountsRef(push.counts).v.torn) return;
    const uint packed_ = list(CARRIED_TORN).v[entry];
    const ivec2 p = ivec2(packed_ & 0xffffu, packed_ >> 16u);
    const uint pixel = uint(p.x) + uint(p.y) * push.width;
    uint source = shownAt(p).pixel;
    if (source == NO_INDEX) {
        OldPixel guessed;
        if (!guess(p, guessed)) guessed = displayed(packed_);
        carryTo(pixel, guessed);
        source = GUESSED;
    }
    list(CARRIED_MENDED).v[pixel] = source;
}
