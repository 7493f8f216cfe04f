// Paints the new picture from the old one and estimates what is wrong with it. One invocation a row of a tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "hipr/reprojection.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer RowRef { CarriedRow v[]; };

const ivec2 AROUND[4] = ivec2[4](ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(-1, 1)); // and the opposite ways
// Steps of a search: so many of one pixel, so many of 4, so many of 16.
const uint FINE_STEPS = 16u, MEDIUM_STEPS = 12u, COARSE_STEPS = 28u;
const float FAR_AWAY = 1e6; // a way that leads to nothing
const uint INFINITE_DEPTH = 0x7f800000u; // bits

CarriedSource sourceAt(ReprojectionRecord r, ivec2 p) {
    const bool inside = all(greaterThanEqual(p, ivec2(0))) && p.x < int(r.width) && p.y < int(r.height);
    if (!inside) return CarriedSource(NO_INDEX, NO_INDEX);
    return SourceRef(r.sources).v[uint(p.x) + uint(p.y) * r.width];
}

// Whether the pixels on both sides show one surface, nearer than `depth`.
bool betweenNearer(ReprojectionRecord r, ivec2 p, ivec2 step_, float depth, out CarriedSource side,
                   out CarriedSource other) {
    side = sourceAt(r, p + step_);
    other = sourceAt(r, p - step_);
    if (side.pixel == NO_INDEX || other.pixel == NO_INDEX) return false;
    const float a = uintBitsToFloat(side.depth), b = uintBitsToFloat(other.depth);
    return oneSurface(a, b) && max(a, b) < depth && !oneSurface(a, depth);
}

// Whether two pixels touched in the old picture.
bool touched(ReprojectionRecord r, uint a, uint b) {
    const ivec2 apart = ivec2(a % r.width, a / r.width) - ivec2(b % r.width, b / r.width);
    return max(abs(apart.x), abs(apart.y)) <= 1;
}

// What a pixel shows. A surface that comes closer leaves cracks of a pixel's width between pixels that touched before; a
// neighbour closes them, also those through which something behind shows.
CarriedSource shownAt(ReprojectionRecord r, ivec2 p) {
    const CarriedSource own = sourceAt(r, p);
    const bool empty = own.pixel == NO_INDEX;
    const float depth = uintBitsToFloat(empty ? INFINITE_DEPTH : own.depth);
    for (uint i = 0u; i < 4u; ++i) {
        CarriedSource side, other;
        if (betweenNearer(r, p, AROUND[i], depth, side, other) && (empty || touched(r, side.pixel, other.pixel)))
            return side;
    }
    return own;
}

// The nearest pixel in a direction to which something came, and how far away it is.
CarriedSource look(ReprojectionRecord r, ivec2 p, ivec2 direction, out float distance_) {
    int at = 0;
    for (uint i = 0u; i < FINE_STEPS + MEDIUM_STEPS + COARSE_STEPS; ++i) {
        at += i < FINE_STEPS ? 1 : i < FINE_STEPS + MEDIUM_STEPS ? 4 : 16;
        const CarriedSource found = sourceAt(r, p + at * direction);
        if (found.pixel == NO_INDEX) continue;
        distance_ = float(at);
        return found;
    }
    distance_ = FAR_AWAY;
    return CarriedSource(NO_INDEX, NO_INDEX);
}

// A guess at what came into sight: more of the background. Along a row or column that is the farther of what both sides
// show; the shorter the way across the gap, the more it counts. False: nothing is around.
bool guess(ReprojectionRecord r, ivec2 p, out OldPixel pixel) {
    pixel = OldPixel(vec4(0.0), vec3(0.0));
    float weights = 0.0;
    for (uint i = 0u; i < 2u; ++i) {
        CarriedSource sides[2];
        float distances[2];
        for (uint k = 0u; k < 2u; ++k)
            sides[k] = look(r, p, k == 0u ? AROUND[i] : -AROUND[i], distances[k]);
        // Depths that are no numbers, of sides that show nothing, are greater as words.
        const bool both = sides[0].pixel != NO_INDEX && sides[1].pixel != NO_INDEX;
        const bool first = (sides[0].depth > sides[1].depth) == both;
        const CarriedSource behind = first ? sides[0] : sides[1];
        if (behind.pixel == NO_INDEX) continue;
        const float across = both ? distances[0] + distances[1] : 2.0 * min(distances[0], distances[1]);
        const float weight = 1.0 / (across * across * across * across);
        const OldPixel old = OldPictureRef(r.oldPicture).v[behind.pixel];
        pixel.color += old.color * weight;
        pixel.albedo += old.albedo * weight;
        weights += weight;
    }
    if (weights == 0.0) return false;
    pixel.color /= weights;
    pixel.albedo /= weights;
    return true;
}

SeenPoint turned(ReprojectionRecord r, SeenPoint seen) {
    if (seen.look >= SEEN_SKY) return seen;
    const vec3 before = viewDirection(CameraRef(r.before).v, seen.point);
    const vec3 after = viewDirection(CameraRef(r.after).v, seen.point);
    return SeenPoint(seen.point, turnedLook(seen.look, length(after - before)));
}

void paint(ReprojectionRecord r, uint pixel, inout CarriedRow row) {
    const ivec2 p = ivec2(pixel % r.width, pixel / r.width);
    const uint source = shownAt(r, p).pixel;
    OldPixel old = OldPictureRef(r.oldPicture).v[pixel];
    SeenPoint seen = SeenPoint(vec3(0.0), SEEN_NOTHING);
    if (source != NO_INDEX) {
        old = OldPictureRef(r.oldPicture).v[source];
        seen = turned(r, SeenRef(r.seen).v[source]);
    } else {
        OldPixel guessed;
        if (guess(r, p, guessed)) old = guessed;
        ++row.uncovered;
    }
    const float radiance = max(dot(old.color.rgb, vec3(1.0 / 3.0)), 0.0);
    row.radiance += radiance;
    row.stale += radiance * staleness(seen.look);
    SeenRef(r.seenAfter).v[pixel] = seen;
    FilmRef(r.film).v[pixel] = FilmPixel(old.color, old.albedo, 1u, vec3(0.0), vec3(0.0));
}

void main() {
    const ReprojectionRecord r = ReprojectionRef(push.record).v;
    const uint i = push.first + gl_GlobalInvocationID.x;
    if (i >= push.end) return;
    const uint tile = i / r.tileSize;
    const uint y = tile / r.tileColumns * r.tileSize + i % r.tileSize;
    const uint first = tile % r.tileColumns * r.tileSize, end = min(first + r.tileSize, r.width);
    CarriedRow row = CarriedRow(0u, 0.0, 0.0);
    for (uint x = first; x < end && y < r.height; ++x)
        paint(r, x + y * r.width, row);
    RowRef(r.rows).v[i] = row;
}
