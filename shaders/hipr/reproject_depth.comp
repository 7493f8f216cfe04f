// Takes the picture on display out of the film, and finds what is nearest in every pixel of the new one. One invocation a
// pixel of the old one.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "hipr/reprojection.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer CountsRef { CarriedCounts v; };

void takePicture(ReprojectionRecord r, uint pixel, uint tile) {
    if (UintRef(r.tileKeepsOld).v[tile] != 0u) return;
    const FilmPixel shown = FilmRef(r.film).v[pixel];
    const float weight = 1.0 / float(max(shown.count, 1u));
    OldPictureRef(r.oldPicture).v[pixel] = OldPixel(shown.color * weight, shown.albedo * weight);
}

void main() {
    const ReprojectionRecord r = ReprojectionRef(push.record).v;
    const uint pixel = push.first + gl_GlobalInvocationID.x;
    if (pixel >= push.end) return;
    takePicture(r, pixel, pixel % r.width / r.tileSize + pixel / r.width / r.tileSize * r.tileColumns);
    if (SeenRef(r.seen).v[pixel].look == SEEN_NOTHING) return;
    const uint known = subgroupBallotBitCount(subgroupBallot(true));
    if (subgroupElect()) atomicAdd(CountsRef(r.counts).v.known, known);
    const CarriedPixel to = carried(r, pixel);
    if (!to.inside) return;
    atomicMin(SourceRef(r.sources).v[to.x + to.y * r.width].depth, floatBitsToUint(to.depth));
    const uint inside = subgroupBallotBitCount(subgroupBallot(true));
    if (subgroupElect()) atomicAdd(CountsRef(r.counts).v.inside, inside);
}
