// Marks the tiles in which a pixel's centre sees something that changed, now or before the edit. One invocation a pixel,
// push.first + [0, push.count).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "hipr/discovery.glsl"

// Binary search: the first key not before (object, instance) is the key itself or stands for the whole object.
bool changed(DiscoveryRecord discovery, VisibilityRecord seen) {
    ElementRef elements = ElementRef(discovery.elements);
    uint first = 0u, end = discovery.elementCount;
    while (first < end) {
        const uint middle = (first + end) / 2u;
        const ElementKey key = elements.v[middle];
        if (key.object < seen.object || (key.object == seen.object && key.instance < seen.objectInstance))
            first = middle + 1u;
        else
            end = middle;
    }
    if (first == discovery.elementCount) return false;
    const ElementKey key = elements.v[first];
    return key.object == seen.object && (key.instance == seen.objectInstance || key.instance == EVERY_INSTANCE);
}

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const DiscoveryRecord discovery = DiscoveryRef(trace.discovery).v;
    if (gl_GlobalInvocationID.x >= push.count) return;
    const uint pixel = push.first + gl_GlobalInvocationID.x;
    bool active_ = changed(discovery, VisibilityRef(trace.visibility).v[pixel]);
    if (!active_ && discovery.previousHits != 0ul)
        active_ = changed(discovery, VisibilityRef(discovery.previousHits).v[pixel]);
    if (active_)
        TileWordRef(discovery.tileActive).v[tileAt(discovery, pixel % trace.width, pixel / trace.width)] = 1u;
}
