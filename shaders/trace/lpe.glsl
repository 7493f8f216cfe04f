// Light by light path expressions: in which states a path is, and what it brings to which expression. See
// renderer/lpe/automaton.h. A bounce by several lobes leaves a path in several states with weights that add up to 1, so
// that every expression gets just what the lobes it names scatter, and all of them together what the path brings.
#ifndef HIPR_TRACE_LPE_GLSL
#define HIPR_TRACE_LPE_GLSL
#include "shared/lpe.h"
#include "shared/references.glsl"
#include "shared/trace.h"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer LpeRef { LpeRecord v; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer LpePathRef { LpePath v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer LpeSumRef { vec3 v[]; };

// The symbol of a light of a kind (LPE_LIGHT...) and a group (an interned name, or NO_INDEX).
uint lightSymbol(LpeRecord lpe, uint kind, uint group) {
    uint i = 0u;
    [[dont_unroll]] while (i < lpe.groupCount && UintRef(lpe.groups).v[i] != group) ++i;
    return LPE_LIGHTS + kind * (lpe.groupCount + 1u) + i;
}

uint nextState(LpeRecord lpe, uint state, uint symbol) {
    return UintRef(lpe.next).v[state * lpe.symbols + symbol];
}

// A path begins.
void beginExpressions(uint64_t record, uint slot) {
    const LpeRecord lpe = LpeRef(record).v;
    LpePathRef paths = LpePathRef(lpe.paths);
    paths.v[slot].current = 0u;
    paths.v[slot].shares[0] = LpeShare(lpe.start, vec3(1.0));
    for (uint k = 1u; k < LPE_SHARES; ++k)
        paths.v[slot].shares[k] = LpeShare(0u, vec3(0.0));
    for (uint i = 0u; i < lpe.count; ++i)
        LpeSumRef(lpe.sums).v[slot * lpe.count + i] = vec3(0.0);
}

// Adds what a path has met, a light of this symbol.
void addToExpressions(uint64_t record, uint slot, uint symbol, vec3 value) {
    if (value == vec3(0.0) || any(isnan(value)) || any(isinf(value))) return;
    const LpeRecord lpe = LpeRef(record).v;
    LpePathRef paths = LpePathRef(lpe.paths);
    const uint first = paths.v[slot].current * LPE_SHARES;
    [[dont_unroll]] for (uint k = first; k < first + LPE_SHARES; ++k) {
        const LpeShare share = paths.v[slot].shares[k];
        uint mask = UintRef(lpe.accepted).v[nextState(lpe, share.state, symbol)];
        [[dont_unroll]] for (; mask != 0u; mask &= mask - 1u)
            LpeSumRef(lpe.sums).v[slot * lpe.count + uint(findLSB(mask))] += value * share.weight;
    }
}

// Adds what arrives of a path's shadow ray.
void arriveInExpressions(uint64_t record, uint slot, vec3 value) {
    if (value == vec3(0.0) || any(isnan(value)) || any(isinf(value))) return;
    const LpeRecord lpe = LpeRef(record).v;
    for (uint i = slot * lpe.count; i < (slot + 1u) * lpe.count; ++i)
        LpeSumRef(lpe.sums).v[i] += value * LpeSumRef(lpe.shadows).v[i];
}

#endif
