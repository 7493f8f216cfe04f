// Discovery by paths: where in the picture is the surface that each ray has come to? Vertices x_k, k >= 1, of paths from
// active tiles add to the weight of the tile they show in. Between `nearest` and `shade`; one invocation a ray.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "hipr/discovery.glsl"

// The smaller change of depth to one of two neighbours along an axis. Neighbours that see something else say nothing.
float slopeAlong(TraceRecord trace, uvec2 pixel, uvec2 axis, VisibilityRecord seen) {
    float slope = RAY_INFINITY;
    for (uint side = 0u; side < 2u; ++side) {
        const uvec2 at = side == 0u ? pixel - axis : pixel + axis; // wraps around below 0
        if (at.x >= trace.width || at.y >= trace.height) continue;
        const VisibilityRecord next = VisibilityRef(trace.visibility).v[at.x + at.y * trace.width];
        if (next.object != seen.object || next.objectInstance != seen.objectInstance) continue;
        slope = min(slope, abs(next.cameraDepth - seen.cameraDepth));
    }
    return slope < RAY_INFINITY ? slope : 0.0;
}

// The tile in which the point `position` of an instance is seen from the camera, or NO_INDEX.
uint tileSeeing(TraceRecord trace, DiscoveryRecord discovery, vec3 position, uint instance) {
    const FilmPoint point = projectToFilm(CameraRef(trace.camera).v, position, trace.width, trace.height);
    if (!point.inside) return NO_INDEX;
    const VisibilityRecord seen = VisibilityRef(trace.visibility).v[point.x + point.y * trace.width];
    InstanceRef instances = InstanceRef(SceneRef(trace.scene).v.instances);
    if (seen.object != instances.v[instance].object || seen.objectInstance != instances.v[instance].objectInstance)
        return NO_INDEX;
    const uvec2 pixel = uvec2(point.x, point.y);
    const float slope =
        slopeAlong(trace, pixel, uvec2(1u, 0u), seen) + slopeAlong(trace, pixel, uvec2(0u, 1u), seen);
    if (!depthAgrees(point.depth, seen.cameraDepth, slope, discovery.eps)) return NO_INDEX;
    return tileAt(discovery, point.x, point.y);
}

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const uint i = gl_GlobalInvocationID.x;
    if (i >= HeaderRef(trace.headers).v[QUEUE_RAYS + push.turn].count) return;
    const DiscoveryRecord discovery = DiscoveryRef(trace.discovery).v;
    const uint slot = SlotRef(trace.raySlots[push.turn]).v[i];
    PathRef paths = PathRef(trace.paths);
    const uint pixel = paths.v[slot].pixel, k = paths.v[slot].depth;
    const uint own = tileAt(discovery, pixel & 0xffffu, pixel >> 16);
    const bool scout = push.first != 0u;
    const Hit hit = HitRef(trace.hits).v[i];

    DiscoveryVertex vertex = DiscoveryVertex(NO_INDEX, 0.0);
    const bool counts = scout || (TileWordRef(discovery.tileActive).v[own] != 0u && paths.v[slot].sampleIndex == 0u);
    if (counts && hit.instance != NO_INDEX) {
        const Ray ray = RayRef(trace.rays[push.turn]).v[i];
        vertex.share = scalarThroughput(paths.v[slot].throughput) / float(1u + k);
        vertex.tile = k == 0u ? own : tileSeeing(trace, discovery, ray.origin + hit.t * ray.direction, hit.instance);
    }
    DiscoveryVertexRef(discovery.vertices).v[slot] = vertex;
    if (scout || k == 0u || vertex.tile == NO_INDEX) return;
    const uint history = paths.v[slot].history;
    addWeight(discovery, vertex.tile,
              vertex.share * discovery.scatterWeights[history & HISTORY_LAST] * discovery.pathWeights[pathClass(history, k)]);
}
