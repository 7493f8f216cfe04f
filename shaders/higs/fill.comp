// Writes the tiles' lists: every splat finds its places where `count`, and the sums over it, say. In lanes lists come
// out in order of splats, otherwise in any order; sorting makes both the same.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/bin_all.glsl"

// Distance at which the ray through the middle of a tile meets the largest density of a splat.
float rayHitDistance(SplatFrame frame, uint tile, uint splat) {
    const CameraRecord camera = CameraRef(frame.camera).v;
    const vec2 size = vec2(frame.tileWidth, frame.tileHeight);
    const vec2 middle = (vec2(tile % frame.tileColumns, tile / frame.tileColumns) + 0.5) * size;
    const vec2 ndc = 2.0 * middle / vec2(frame.width, frame.height) - 1.0;
    const vec3 d = normalize(camera.direction + ndc.x * camera.directionX + ndc.y * camera.directionY);
    const vec3 o = ndc.x * camera.originX + ndc.y * camera.originY;
    const SplatRay ray = RayRef(frame.rays).v[splat];
    const vec3 md = vec3(dot(vec3(ray.diagonal.x, ray.other.xy), d),
                         dot(vec3(ray.other.x, ray.diagonal.y, ray.other.z), d),
                         dot(vec3(ray.other.yz, ray.diagonal.z), d));
    return max((dot(d, ray.pull) - dot(md, o)) / dot(d, md), 0.0);
}

void visit(SplatFrame frame, uint chunk, uint tile, uint splat, ProjectedSplat s) {
    if (WordRef(frame.tileMask).v[tile] == 0u) return;
    WordRef histogram = WordRef(frame.histogram);
#ifdef LANES
    const uint counter = chunk * frame.tileColumns * frame.tileRows + tile;
    const uint slot = histogram.v[counter];
    histogram.v[counter] = slot + 1u;
#else
    const uint slot = atomicAdd(histogram.v[tile], 1u);
#endif
    float key = s.key;
    if (frame.rays != 0ul) key = rayHitDistance(frame, tile, splat);
    PairRef(frame.pairs[0]).v[TileRef(frame.tiles).v[tile].first + slot] = SplatPair(floatBitsToUint(key), splat);
}

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    if (StateRef(frame.state).v.overflow != 0u) return;
    visitAll(frame);
}
