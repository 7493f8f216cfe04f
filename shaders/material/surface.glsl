// What a ray finds at a hit: geometry and the parameters of its bidirectional scattering distribution (BSDF).
//
// Sides: every surface shades on both sides, whether it is doubleSided or not, since culling would let light through
// closed objects; normals are turned towards the viewer. Both sides emit. Only refraction tells front from back.
#ifndef HIPR_MATERIAL_SURFACE_GLSL
#define HIPR_MATERIAL_SURFACE_GLSL
#include "material/inputs.glsl"
#include "material/microfacet.glsl"

struct Surface {
    vec3 position;
    vec3 ng;            // geometric normal on the viewer's side, unit length
    vec3 ns;            // shading normal on the viewer's side, unit length
    vec3 emission;      // radiance
    float opacity;      // part of light the surface stops; the rest goes straight on
    vec3 albedo;        // colour of all scattered light, for the albedo AOV
    bool frontFacing;

    vec3 diffuse;       // albedo of the diffuse lobe without the specular lobe above it
    vec3 f0;            // reflectance at normal incidence of the specular lobe
    float roughness;
    float alpha;        // GGX slope parameter, roughness^2
    float coat;         // weight of the clear coat
    float coatRoughness;
    float coatAlpha;
    float glass;        // weight of the refracting interface, 0 for opaque materials; the other lobes weigh 1 - glass
    float eta;          // index of refraction beyond the surface over that on the viewer's side

    uint64_t albedoTable;
    vec3 specularOut;   // directional albedo of the specular lobe towards the viewer
    vec3 specularMean;  // its mean over all directions
    float coatOut;      // directional albedo of the coat, weight included
    vec4 lobeChance;    // of sampling coat, specular, diffuse, glass; sums to 1
};

// Front-facing geometric normal of a triangle; `mirrored` transforms turn the winding over.
vec3 triangleNormal(vec3 e1, vec3 e2, bool mirrored) {
    vec3 n = cross(e1, e2);
    return mirrored ? -n : n;
}

// The smallest turn of `n` that lets the mirror direction of `wo` leave the surface whose geometric normal is `ng`, so
// that interpolated and mapped normals never show a viewer their back. wo and ng are on one side.
vec3 bendNormal(vec3 n, vec3 ng, vec3 wo) {
    float least = min(1e-3, 0.5 * dot(ng, wo)); // never bends ng itself
    vec3 mirror = 2.0 * dot(n, wo) * n - wo;
    float height = dot(mirror, ng);
    if (height >= least && dot(n, wo) > 0.0) return n;
    return normalizeOr(wo + normalizeOr(mirror + (least - height) * ng, ng), ng);
}

// Tangent-space normal to world space. The tangent follows the texture coordinates in which the map was read
// (st rotations of a UsdTransform2d included).
vec3 applyNormalMap(vec3 n, vec3 mapped, vec3 e1, vec3 e2, vec4 stEdges) {
    float det = stEdges.x * stEdges.w - stEdges.y * stEdges.z;
    if (det == 0.0) return n;
    vec3 dpds = (e1 * stEdges.w - e2 * stEdges.y) * sign(det);
    vec3 dpdt = (e2 * stEdges.x - e1 * stEdges.z) * sign(det);
    vec3 tangent = normalizeOr(dpds - n * dot(n, dpds), vec3(0.0));
    vec3 bitangent = cross(n, tangent) * (dot(cross(n, tangent), dpdt) < 0.0 ? -1.0 : 1.0);
    return normalizeOr(tangent * mapped.x + bitangent * mapped.y + n * mapped.z, n);
}

// Interpolated normal in world space, on the front side.
vec3 interpolatedNormal(ShadingPoint point, vec3 ng) {
    if (point.geometry.normals == 0ul) return ng;
    bool faceVarying = (point.geometry.flags & GEOMETRY_NORMALS_FACE_VARYING) != 0u;
    uvec3 at = faceVarying ? 3u * point.primitive + uvec3(0u, 1u, 2u) : point.vertices;
    Vec3Ref normals = Vec3Ref(point.geometry.normals);
    vec3 n = normals.v[at.x] * (1.0 - point.uv.x - point.uv.y) + normals.v[at.y] * point.uv.x + normals.v[at.z] * point.uv.y;
    n = normalizeOr(n * mat3(point.instance.worldToObject), ng); // times the inverse transpose
    return dot(n, ng) < 0.0 ? -n : n;
}

// Geometry of a hit; the rest of the surface is left to the material.
void setGeometry(inout Surface s, ShadingPoint point, vec3 wo, out vec3 e1, out vec3 e2) {
    Vec3Ref positions = Vec3Ref(point.geometry.positions);
    vec3 p0 = positions.v[point.vertices.x];
    vec3 edge1 = positions.v[point.vertices.y] - p0;
    vec3 edge2 = positions.v[point.vertices.z] - p0;
    s.position = point.instance.objectToWorld * vec4(p0 + edge1 * point.uv.x + edge2 * point.uv.y, 1.0);
    e1 = mat3(point.instance.objectToWorld) * edge1;
    e2 = mat3(point.instance.objectToWorld) * edge2;
    s.ng = normalizeOr(triangleNormal(e1, e2, (point.instance.flags & INSTANCE_MIRRORED) != 0u), wo);
    s.frontFacing = dot(s.ng, wo) >= 0.0;
}

// Index of refraction a texture may ask for, kept off 1, where refraction has no direction of its own.
float usableIor(float ior) {
    ior = clamp(ior, 0.1, 10.0);
    return abs(ior - 1.0) < MIN_IOR_STEP ? 1.0 + MIN_IOR_STEP : ior;
}

// Parameters of the lobes: UsdPreviewSurface Specification 2.6, "UsdPreviewSurface".
void setLobes(inout Surface s, MaterialInputs inputs, uint flags) {
    float metallic = clamp(inputs.metallic, 0.0, 1.0);
    vec3 color = clamp(inputs.diffuseColor, 0.0, 1.0);
    float ior = usableIor(inputs.ior);
    float index = clamp(inputs.ior, 0.0, 100.0); // 0, a way to ask for a full mirror, included
    float normalIncidence = (1.0 - index) / (1.0 + index);
    bool specularWorkflow = (flags & MATERIAL_SPECULAR_WORKFLOW) != 0u;
    bool refractive = (flags & MATERIAL_REFRACTIVE) != 0u;
    s.f0 = specularWorkflow ? clamp(inputs.specularColor, 0.0, 1.0)
                            : mix(vec3(normalIncidence * normalIncidence), color, metallic);
    s.diffuse = specularWorkflow ? color : color * (1.0 - metallic);
    s.roughness = clamp(inputs.roughness, 0.0, 1.0);
    s.alpha = max(s.roughness * s.roughness, MIN_ALPHA);
    s.glass = refractive ? 1.0 - clamp(inputs.opacity, 0.0, 1.0) : 0.0;
    s.eta = s.frontFacing ? ior : 1.0 / ior;
    s.coat = refractive && !s.frontFacing ? 0.0 : clamp(inputs.clearcoat, 0.0, 1.0); // a coat is on the outside only
    s.coatRoughness = clamp(inputs.clearcoatRoughness, 0.0, 1.0);
    s.coatAlpha = max(s.coatRoughness * s.coatRoughness, MIN_ALPHA);
}

const float COAT_F0 = 0.04; // index of refraction 1.5

// What depends on the viewer: albedos of the lobes seen from `cosine`, and how often each is sampled.
void setViewer(inout Surface s, float cosine) {
    vec2 towards = specularAlbedo(s.albedoTable, cosine, s.roughness);
    vec2 mean = meanSpecularAlbedo(s.albedoTable, s.roughness);
    vec2 coat = specularAlbedo(s.albedoTable, cosine, s.coatRoughness);
    s.specularOut = s.f0 * towards.x + towards.y;
    s.specularMean = s.f0 * mean.x + mean.y;
    s.coatOut = s.coat * (COAT_F0 * coat.x + coat.y);
    vec3 diffuse = s.diffuse * (1.0 - s.specularOut);
    float below = 1.0 - s.coatOut;
    s.albedo = s.coatOut + below * mix(s.specularOut + diffuse, vec3(1.0), s.glass);
    s.lobeChance = vec4(s.coatOut, below * (1.0 - s.glass) * luminance(s.specularOut),
                        below * (1.0 - s.glass) * luminance(diffuse), below * s.glass);
    float sum = dot(s.lobeChance, vec4(1.0));
    s.lobeChance = sum > 1e-6 ? s.lobeChance / sum : vec4(0.0, 0.0, 1.0, 0.0);
}

// The surface at `hit`, seen along `ray` (unit direction).
Surface evaluateSurface(SceneRecord scene, Hit hit, Ray ray) {
    Surface s;
    vec3 wo = -ray.direction;
    ShadingPoint point = shadingPoint(scene, hit);
    vec3 e1, e2;
    setGeometry(s, point, wo, e1, e2);

    uint material = materialIndex(scene, point);
    uint flags = MaterialRef(scene.materials).v[material].flags;
    MaterialInputs inputs = evaluateInputs(scene, point, material, 0u, INPUT_COUNT - 1u);
    s.opacity = presenceOf(flags, inputs);
    s.emission = max(inputs.emissiveColor, 0.0);
    setLobes(s, inputs, flags);

    s.ns = interpolatedNormal(point, s.ng);
    if (inputs.stEdges != vec4(0.0)) s.ns = applyNormalMap(s.ns, inputs.normal, e1, e2, inputs.stEdges);
    if (!s.frontFacing) {
        s.ng = -s.ng;
        s.ns = -s.ns;
    }
    s.ns = bendNormal(s.ns, s.ng, wo);
    s.albedoTable = scene.specularAlbedo;
    setViewer(s, dot(s.ns, wo));
    return s;
}
#endif
