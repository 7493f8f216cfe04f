// Evaluates and samples one surface: invocation i sees it from wo[i], evaluates towards wi[i], and samples with u[i].
#version 460
#extension GL_GOOGLE_include_directive : require
#include "material/bsdf.glsl"

layout(local_size_x = 64) in;

struct SurfaceParameters {
    uint64_t constants, albedoTable, openPbrTable, stretchedTable;
    vec3 ng, ns, coatNormal, tangent;
    uint flags, frontFacing;
};

struct Outcome {
    vec3 f;        // towards wi[i]
    float pdf;
    vec3 sampled;  // direction
    float sampledPdf;
    vec3 weight;
    uint lobe;     // 99: sampling failed
    vec3 sampledF; // evaluated anew for the sampled direction
    float sampledEvalPdf;
};

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ParametersRef { SurfaceParameters v; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer OutcomeRef { Outcome v[]; };
layout(push_constant, scalar) uniform Push {
    uint64_t parameters, wo, wi, u, outcomes;
    uint count;
} push;

Surface makeSurface(SurfaceParameters p, vec3 wo) {
    Surface s;
    s.frontFacing = p.frontFacing != 0u;
    s.ng = p.ng;
    s.ns = bendNormal(p.ns, p.ng, wo);
    s.tangent = frameAround(s.ns)[0];
    s.around = NO_INDEX;
    s.aroundIor = 1.0;
    s.albedoTable = p.albedoTable;
    s.openPbrTable = p.openPbrTable;
    s.stretchedTable = p.stretchedTable;
    MaterialInputs inputs = constantInputs(p.constants, (p.flags & MATERIAL_OPENPBR) != 0u);
    inputs.coatNormal = p.coatNormal;
    inputs.specularTangent = p.tangent;
    setDirections(s, inputs, wo);
    setLobes(s, inputs, p.flags, wo);
    return s;
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    const vec3 wo = Vec3Ref(push.wo).v[i];
    const Surface s = makeSurface(ParametersRef(push.parameters).v, wo);
    Outcome result;
    result.f = evalBsdf(s, wo, Vec3Ref(push.wi).v[i], result.pdf);
    if (!sampleBsdf(s, wo, Vec4Ref(push.u).v[i], result.sampled, result.weight, result.sampledPdf, result.lobe))
        result.lobe = 99u;
    result.sampledF = evalBsdf(s, wo, result.sampled, result.sampledEvalPdf);
    OutcomeRef(push.outcomes).v[i] = result;
}
