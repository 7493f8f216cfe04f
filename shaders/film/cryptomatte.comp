// Counts what the samples of a batch see first, by Cryptomatte ids; one pixel an invocation and its samples in order, so
// that no order of batches shows. Behind `resolve`, with its workgroups.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "material/slot.glsl"
#include "trace/wavefront.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer CryptoRef { CryptoEntry v[]; };

// One more sample of `id` in the entries from `first` on. Where all are in use it takes the place of the last one that was seen
// once: what is seen often keeps its place, whatever came before it.
void count(CryptoRef entries, uint first, float id) {
    uint place = NO_INDEX;
    for (uint i = first; i < first + CRYPTOMATTE_RANKS; ++i) {
        const uint seen = entries.v[i].count;
        if (seen > 0u && entries.v[i].id == id) {
            entries.v[i].count = seen + 1u;
            return;
        }
        if (seen <= 1u) place = i;
        if (seen == 0u) break;
    }
    if (place != NO_INDEX) entries.v[place] = CryptoEntry(id, 1u);
}

float nameOf(SlotNames names, uint kind) {
    return kind == 0u ? names.object : kind == 1u ? names.material : names.asset;
}

void main() {
    TraceRecordRef trace = TraceRecordRef(push.record);
    const TileWork tile = TileRef(trace.v.tiles).v[gl_WorkGroupID.y];
    const uint local = gl_GlobalInvocationID.x;
    if (local >= tile.width * tile.height) return;
    const uint pixel = tile.x + local % tile.width + (tile.y + local / tile.width) * trace.v.width;
    const bool anew = tile.firstSample == 0u || tile.firstSample == trace.v.pilot;
    SlotNamesRef names = SlotNamesRef(SceneRef(trace.v.scene).v.slotNames);
    [[dont_unroll]] for (uint kind = 0u; kind < CRYPTOMATTE_KINDS; ++kind) {
        if (trace.v.cryptomattes[kind] == 0ul) continue;
        CryptoRef entries = CryptoRef(trace.v.cryptomattes[kind]);
        const uint first = pixel * CRYPTOMATTE_RANKS;
        for (uint i = 0u; anew && i < CRYPTOMATTE_RANKS; ++i)
            entries.v[first + i] = CryptoEntry(0.0, 0u);
        for (uint i = 0u; i < tile.sampleCount; ++i) {
            const uint slot = SlotRef(trace.v.pathSlots).v[tile.firstSlot + local * tile.sampleCount + i];
            if (slot != NO_INDEX) count(entries, first, nameOf(names.v[slot], kind));
        }
    }
}
