// What scattering does to the states of a path: see lpe.glsl.
#ifndef HIPR_TRACE_LPE_SCATTER_GLSL
#define HIPR_TRACE_LPE_SCATTER_GLSL
#include "material/lobe_shares.glsl"
#include "trace/lpe.glsl"

const uint LPE_LOBES = 4u;
const uint LPE_BY_LOBES = 0xffffffffu; // instead of one event
const uint LPE_NO_EVENT = 0xfffffffeu; // the path goes on as if nothing was there

LobeShares noLobes() { return LobeShares(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), false); }

uint lobeSymbol(bool through, uint lobe) {
    if (through) return lobe == 0u ? LPE_DIFFUSE_THROUGH : LPE_TRANSMISSION;
    return lobe == 0u ? LPE_DIFFUSE : lobe == 1u ? LPE_SHEEN : lobe == 2u ? LPE_SPECULAR : LPE_COAT;
}

vec3 lobeShare(LobeShares shares, uint lobe) {
    const vec3 share = lobe == 0u ? shares.diffuse : lobe == 1u ? shares.sheen : lobe == 2u ? shares.specular : shares.coat;
    const vec3 sum = shares.diffuse + shares.sheen + shares.specular + shares.coat;
    return share / max(sum, vec3(1e-37));
}

// The number of ways in which a path goes on, and the `way`-th of them for one of its shares.
uint waysOn(uint event) { return event == LPE_BY_LOBES ? LPE_LOBES : 1u; }

LpeShare wayOn(LpeRecord lpe, LpeShare share, LobeShares lobes, uint event, uint way) {
    if (event == LPE_NO_EVENT) return share;
    if (event != LPE_BY_LOBES) return LpeShare(nextState(lpe, share.state, event), share.weight);
    return LpeShare(nextState(lpe, share.state, lobeSymbol(lobes.through, way)), share.weight * lobeShare(lobes, way));
}

// Tells which share of a path's shadow ray towards a light of this symbol is in which expression.
void shadowInExpressions(uint64_t record, uint slot, LobeShares lobes, uint event, uint light) {
    const LpeRecord lpe = LpeRef(record).v;
    for (uint i = slot * lpe.count; i < (slot + 1u) * lpe.count; ++i)
        LpeSumRef(lpe.shadows).v[i] = vec3(0.0);
    LpePathRef paths = LpePathRef(lpe.paths);
    const uint first = paths.v[slot].current * LPE_SHARES, ways = waysOn(event);
    [[dont_unroll]] for (uint k = 0u; k < LPE_SHARES * ways; ++k) {
        const LpeShare way = wayOn(lpe, paths.v[slot].shares[first + k / ways], lobes, event, k % ways);
        uint mask = UintRef(lpe.accepted).v[nextState(lpe, way.state, light)];
        [[dont_unroll]] for (; mask != 0u; mask &= mask - 1u)
            LpeSumRef(lpe.shadows).v[slot * lpe.count + uint(findLSB(mask))] += way.weight;
    }
}

// One more state that a path may be in. Where there is no room for it, it or the last one is dropped by chance, with the
// weight of the other made up for.
void addShare(LpePathRef paths, uint slot, uint first, LpeShare added, uint random) {
    if (added.state == 0u || added.weight == vec3(0.0)) return;
    [[dont_unroll]] for (uint k = first; k < first + LPE_SHARES; ++k) {
        const uint state = paths.v[slot].shares[k].state;
        if (state != 0u && state != added.state) continue;
        if (state == added.state) added.weight += paths.v[slot].shares[k].weight;
        paths.v[slot].shares[k] = added;
        return;
    }
    LpeShare kept = paths.v[slot].shares[first + LPE_SHARES - 1u];
    const float a = dot(added.weight, vec3(1.0)), b = dot(kept.weight, vec3(1.0)), chance = a / (a + b);
    const bool taken = float(random >> 8) * (1.0 / 16777216.0) < chance;
    if (taken) kept = added;
    kept.weight /= taken ? chance : 1.0 - chance;
    paths.v[slot].shares[first + LPE_SHARES - 1u] = kept;
}

// Takes a path on. `random`: of this bounce alone.
void goOnInExpressions(uint64_t record, uint slot, LobeShares lobes, uint event, uint random) {
    const LpeRecord lpe = LpeRef(record).v;
    LpePathRef paths = LpePathRef(lpe.paths);
    const uint current = paths.v[slot].current, first = current * LPE_SHARES, other = (1u - current) * LPE_SHARES;
    for (uint k = other; k < other + LPE_SHARES; ++k)
        paths.v[slot].shares[k] = LpeShare(0u, vec3(0.0));
    const uint ways = waysOn(event);
    [[dont_unroll]] for (uint k = 0u; k < LPE_SHARES * ways; ++k) {
        random = random * 747796405u + 2891336453u;
        addShare(paths, slot, other, wayOn(lpe, paths.v[slot].shares[first + k / ways], lobes, event, k % ways), random);
    }
    paths.v[slot].current = 1u - current;
}
#endif
