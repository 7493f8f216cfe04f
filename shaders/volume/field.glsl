// Fields: their values at a point, and walks through their bricks along a ray.
#ifndef HIPR_VOLUME_FIELD_GLSL
#define HIPR_VOLUME_FIELD_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "shared/references.glsl"
#include "shared/volume.h"
#include "accel/motion.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer BrickEntryRef { BrickEntry v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer VolumeRef { VolumeRecord v[]; };

// PCG: M. O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for Random Number
// Generation", 2014 (RXS-M-XS, 32 bits).
float nextRandom(inout uint state) {
    state = state * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    word = (word >> 22u) ^ word;
    return float(word >> 8) * (1.0 / 16777216.0);
}

// Where in a brick a point is, in cells from its corner: between the points from `at` on.
struct CellPoint {
    uint at;
    vec3 f;
};

CellPoint cellPoint(uint brick, vec3 p) {
    const vec3 cell = clamp(floor(p), 0.0, float(BRICK_CELLS) - 1.0);
    const uvec3 c = uvec3(cell);
    return CellPoint(brick * BRICK_VALUES + c.x + BRICK_POINTS * (c.y + BRICK_POINTS * c.z), clamp(p - cell, 0.0, 1.0));
}

float interpolateChannel(FieldRecord field, CellPoint p, uint channel) {
    FloatRef values = FloatRef(field.values);
    const uint n = field.channels, y = n * BRICK_POINTS, z = BRICK_POINTS * y, at = n * p.at + channel;
    const vec4 low = vec4(values.v[at], values.v[at + n], values.v[at + y], values.v[at + y + n]);
    const vec4 high = vec4(values.v[at + z], values.v[at + z + n], values.v[at + y + z], values.v[at + y + z + n]);
    const vec4 a = mix(low, high, p.f.z);
    const vec2 b = mix(a.xy, a.zw, p.f.y);
    return mix(b.x, b.y, p.f.x);
}

// The value in a brick; of one channel in all three where the field has no more.
vec3 interpolateInBrick(FieldRecord field, uint brick, vec3 p) {
    const CellPoint point = cellPoint(brick, p);
    const float first = interpolateChannel(field, point, 0u);
    if (field.channels == 1u) return vec3(first);
    return vec3(first, interpolateChannel(field, point, 1u), interpolateChannel(field, point, 2u));
}

// The value at a point of placed space; 0 outside of all bricks.
vec3 fieldValue(FieldRecord field, vec3 position) {
    const vec3 p = field.placedToCells * vec4(position, 1.0);
    const vec3 size = vec3(field.bricks * BRICK_CELLS);
    if (field.entries == 0ul || any(lessThan(p, vec3(0.0))) || any(greaterThan(p, size))) return vec3(0.0);
    const uvec3 b = min(uvec3(p) / BRICK_CELLS, field.bricks - 1u);
    const uint brick = BrickEntryRef(field.entries).v[b.x + field.bricks.x * (b.y + field.bricks.y * b.z)].brick;
    return brick == NO_INDEX ? vec3(0.0) : interpolateInBrick(field, brick, p - vec3(b * BRICK_CELLS));
}

// A ray on its way through the bricks of a field. It stops at points of a Poisson process or of a comb, whose rate is the
// same all over a brick: J. Amanatides and A. Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987; L. Szirmay-
// Kalos et al., "Free Path Sampling in High Resolution Inhomogeneous Participating Media", 2011.
struct FieldWalk {
    vec3 origin, direction;  // in cells; distances along the ray are those of the world
    float t, end;
    vec3 next, delta;        // where the ray leaves the brick by each axis, and from there to the border after it
    ivec3 brick, turn;
    float left;              // of the rate's integral until the next stop
    uint entry;              // place of the values of the brick with the last stop
};

const float FIELD_FAR = 1e30;

// Whether the part of a ray from tMin to tMax comes through the bricks of a field.
bool beginWalk(FieldRecord field, vec3 origin, vec3 direction, float tMin, float tMax, out FieldWalk walk) {
    walk.origin = field.placedToCells * vec4(origin, 1.0);
    walk.direction = mat3(field.placedToCells) * direction;
    const bvec3 level = lessThan(abs(walk.direction), vec3(1e-20));
    const vec3 inverse = 1.0 / mix(walk.direction, vec3(1e-20), level);
    const vec3 size = vec3(field.bricks * BRICK_CELLS);
    const vec3 a = -walk.origin * inverse, b = (size - walk.origin) * inverse;
    const vec3 near = min(a, b), far = max(a, b);
    walk.t = max(tMin, max(near.x, max(near.y, near.z)));
    walk.end = min(tMax, min(far.x, min(far.y, far.z)));
    if (!(walk.t < walk.end)) return false;
    const float cells = float(BRICK_CELLS);
    walk.brick = clamp(ivec3(floor((walk.origin + walk.t * walk.direction) / cells)), ivec3(0), ivec3(field.bricks) - 1);
    walk.turn = ivec3(sign(walk.direction));
    const vec3 border = (vec3(walk.brick) + step(0.0, walk.direction)) * cells;
    walk.next = mix((border - walk.origin) * inverse, vec3(FIELD_FAR), level);
    walk.delta = mix(cells * abs(inverse), vec3(FIELD_FAR), level);
    walk.entry = NO_INDEX;
    return true;
}

// Goes on to the next stop, `walk.left` from here. The rate is `flat_` in bricks that are not empty, and `scale` times the
// largest value there. Returns it; 0: the ray has left the field.
float nextStop(FieldRecord field, inout FieldWalk walk, float scale, float flat_) {
    BrickEntryRef entries = BrickEntryRef(field.entries);
    [[dont_unroll]] while (walk.t < walk.end) {
        const uvec3 b = uvec3(walk.brick);
        const BrickEntry entry = entries.v[b.x + field.bricks.x * (b.y + field.bricks.y * b.z)];
        const float out_ = min(walk.end, min(walk.next.x, min(walk.next.y, walk.next.z)));
        const float rate = entry.brick == NO_INDEX ? 0.0 : entry.largest * scale + flat_;
        const float way = rate * (out_ - walk.t);
        if (way > walk.left) {
            walk.t = min(walk.t + walk.left / rate, out_);
            walk.entry = entry.brick;
            return rate;
        }
        walk.left -= max(way, 0.0);
        const bvec3 crossed = lessThanEqual(walk.next, vec3(out_));
        walk.t = out_;
        walk.next += mix(vec3(0.0), walk.delta, crossed);
        walk.brick += ivec3(crossed) * walk.turn;
        if (any(lessThan(walk.brick, ivec3(0))) || any(greaterThanEqual(walk.brick, ivec3(field.bricks)))) return 0.0;
    }
    return 0.0;
}

// The stop, in cells from the corner of its brick.
vec3 stopInBrick(FieldWalk walk) {
    return walk.origin + walk.t * walk.direction - vec3(walk.brick) * float(BRICK_CELLS);
}

float densityAtStop(FieldRecord field, FieldWalk walk) {
    return interpolateChannel(field, cellPoint(walk.entry, stopInBrick(walk)), 0u);
}

// Whether the part of a ray from tMin to tMax comes through the box of a volume.
bool meetsVolume(uint64_t volumes, uint index, vec3 origin, vec3 inverse, float tMin, float tMax) {
    const vec3 a = (VolumeRef(volumes).v[index].boxMin - origin) * inverse;
    const vec3 b = (VolumeRef(volumes).v[index].boxMax - origin) * inverse;
    const vec3 near = min(a, b), far = max(a, b);
    return max(max(near.x, near.y), max(near.z, tMin)) <= min(min(far.x, far.y), min(far.z, tMax));
}

// The inverse of a direction, for meetsVolume.
vec3 inverseDirection(vec3 d) {
    return 1.0 / mix(d, vec3(1e-20), lessThan(abs(d), vec3(1e-20)));
}

// A ray of the world as the fields of a volume want it. Distances along it stay those of the world.
Ray placedRay(uint64_t volumes, uint index, Ray ray) {
    const uint keyCount = VolumeRef(volumes).v[index].keyCount;
    if (keyCount == 0u) return ray;
    const mat4x3 toObject = inverseTransform(transformAt(VolumeRef(volumes).v[index].keys, 0u, keyCount, ray.time));
    ray.origin = toObject * vec4(ray.origin, 1.0);
    ray.direction = mat3(toObject) * ray.direction;
    return ray;
}

// Distances that are exponentially distributed around 1.
float exponential(float u) {
    return -log(1.0 - min(u, 0.99999994));
}
#endif
