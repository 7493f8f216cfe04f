// What the kernels of discovery share.
#ifndef HIPR_HIPR_DISCOVERY_GLSL
#define HIPR_HIPR_DISCOVERY_GLSL
#include "trace/wavefront.glsl"
#include "shared/hipr.h"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer DiscoveryRef { DiscoveryRecord v; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer ElementRef { ElementKey v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer BoxRef { ChangedBox v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer DiscoveryVertexRef { DiscoveryVertex v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TileWordRef { uint v[]; };

uint tileAt(DiscoveryRecord discovery, uint x, uint y) {
    return x / discovery.tileSize + y / discovery.tileSize * discovery.tileColumns;
}

void addWeight(DiscoveryRecord discovery, uint tile, float weight) {
    atomicAdd(TileWordRef(discovery.tileWeights).v[tile], fixedWeight(weight));
}
#endif
