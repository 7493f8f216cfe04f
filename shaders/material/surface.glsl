// What a ray finds at a hit: geometry and the parameters of its bidirectional scattering distribution (BSDF).
//
// Sides: every surface shades on both sides, whether it is doubleSided or not, since culling would let light through
// closed objects; normals are turned towards the viewer. Both sides emit. Only refraction tells front from back.
#ifndef HIPR_MATERIAL_SURFACE_GLSL
#define HIPR_MATERIAL_SURFACE_GLSL
#include "material/inputs.glsl"
#include "material/nesting.glsl"
#include "material/openpbr.glsl"
#include "material/preview.glsl"
#include "trace/offset.glsl"

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
    vec3 tangent = tangentAlong(n, vec3(0.0), e1, e2, stEdges);
    vec3 dpdt = (e2 * stEdges.x - e1 * stEdges.z) * sign(det);
    vec3 bitangent = cross(n, tangent) * (dot(cross(n, tangent), dpdt) < 0.0 ? -1.0 : 1.0);
    return normalizeOr(tangent * mapped.x + bitangent * mapped.y + n * mapped.z, n);
}

// Geometry of a hit; the rest of the surface is left to the material.
void setGeometry(inout Surface s, ShadingPoint point, vec3 wo, out vec3 e1, out vec3 e2) {
    const PointSurface at = surfaceAt(point);
    s.position = point.instance.objectToWorld * vec4(at.position, 1.0);
    e1 = mat3(point.instance.objectToWorld) * at.e1;
    e2 = mat3(point.instance.objectToWorld) * at.e2;
    s.ng = normalizeOr(frontNormal(point, at.outwards, e1, e2), wo);
    s.frontFacing = dot(s.ng, wo) >= 0.0;
    s.restless = restlessHeight(e1, e2);
}

// The part of `direction` that is perpendicular to `n`, as a unit vector; `otherwise` where there is none.
vec3 perpendicularTo(vec3 n, vec3 direction, vec3 otherwise) {
    return normalizeOr(direction - n * dot(n, direction), otherwise);
}

// The frames of coat and highlights, where the material's program makes directions of theirs. ns and tangent are there.
void setDirections(inout Surface s, MaterialInputs inputs, vec3 wo) {
    s.coatNormal = s.ns;
    s.coatTangent = s.tangent;
    if (!sceneHas(SCENE_HAS_DIRECTIONS)) return;
    const vec3 given = s.frontFacing ? inputs.coatNormal : -inputs.coatNormal;
    if (given != vec3(0.0)) s.coatNormal = bendNormal(normalizeOr(given, s.ns), s.ng, wo);
    const vec3 along = perpendicularTo(s.coatNormal, s.tangent, frameAround(s.coatNormal)[0]);
    s.coatTangent = perpendicularTo(s.coatNormal, inputs.coatTangent, along);
    s.tangent = perpendicularTo(s.ns, inputs.specularTangent, s.tangent);
}

// The parameters of the lobes, seen from the direction `wo`.
void setLobes(inout Surface s, MaterialInputs inputs, uint flags, vec3 wo) {
    s.openPbr = isOpenPbr(flags);
    if (s.openPbr) {
        setOpenPbrLobes(s, inputs, flags);
        const vec3 coatO = wo * mat3(s.coatTangent, cross(s.coatNormal, s.coatTangent), s.coatNormal);
        setOpenPbrViewer(s, clamp(inputs.coatDarkening, 0.0, 1.0), wo * lobeFrame(s), coatO);
    } else {
        setPreviewLobes(s, inputs, flags);
        setPreviewViewer(s, dot(s.ns, wo));
    }
}

// Whether a path changes what it is inside of when it crosses a surface.
bool bounds(MaterialRecord material) {
    const uint kind = MATERIAL_REFRACTIVE | MATERIAL_OPENPBR;
    return (material.flags & kind) == kind;
}

// Finds what is around the object, for a path that is inside of `interiors` when it meets it.
void setSurroundings(inout Surface s, SceneRecord scene, MaterialRecord material, uvec2 interiors) {
    s.around = NO_INDEX;
    s.aroundIor = 1.0;
    s.hidden = false;
    if (!sceneHas(SCENE_HAS_NESTING) || interiors == uvec2(0u) || (material.flags & MATERIAL_OPENPBR) == 0u) return;
    const bool leaving = bounds(material) && !s.frontFacing;
    const uint entered = findInterior(interiors, s.material + 1u);
    if (leaving) interiors = crossedInteriors(interiors, s.material, false);
    s.around = foremostInterior(scene, interiors);
    if (s.around == NO_INDEX) return;
    const MaterialRecord around = MaterialRef(scene.materials).v[s.around];
    s.aroundIor = clamp(Vec4Ref(around.constants).v[INPUT_SPECULAR_IOR].x, 0.1, 10.0);
    // Behind the place that it was at are those that were entered later.
    const bool covered = leaving && entered < INTERIORS && findInterior(interiors, s.around + 1u) >= entered;
    s.hidden = bounds(material) && around.priority >= material.priority + (covered ? 0 : 1);
}

// What a ray covers where it hits, for textures.
struct RayFootprint {
    float width;      // 0: nothing
    float levelShare; // random: see textureLevel()
    bool sampled;     // light samples may have gone there too: they find what emits, and read it at its finest
};

const RayFootprint NO_FOOTPRINT = RayFootprint(0.0, 0.0, false);

// The surface at `hit`, seen along `ray` (unit direction) by a path that is inside of `interiors`.
Surface evaluateSurface(SceneRecord scene, Hit hit, Ray ray, RayFootprint footprint, uvec2 interiors) {
    Surface s;
    vec3 wo = -ray.direction;
    ShadingPoint point = shadingPoint(scene, hit);
    moveTo(point, scene, ray.time);
    vec3 e1, e2;
    setGeometry(s, point, wo, e1, e2);

    s.material = materialIndex(scene, point);
    MaterialRecord material = MaterialRef(scene.materials).v[s.material];
    if (point.onSegment) material.flags |= MATERIAL_THIN_WALLED; // rays do not come out of it again
    if (!footprint.sampled || (material.flags & MATERIAL_EMISSIVE) == 0u) {
        const vec3 across = cross(e1, e2); // the cone's cross-section, tilted
        point.footprint = footprint.width * footprint.width / max(abs(dot(across, wo)), 1e-3 * length(across) + 1e-30);
        point.levelShare = footprint.levelShare;
    }
    MaterialInputs inputs = evaluateInputs(scene, point, material, material.stepCount);
    s.opacity = presenceOf(material.flags, inputs);
    setSurroundings(s, scene, material, interiors);

    s.ns = interpolatedNormal(point, s.ng);
    if (inputs.stEdges != vec4(0.0)) s.ns = applyNormalMap(s.ns, inputs.normal, e1, e2, inputs.stEdges);
    s.ns = normalizeOr(inputs.worldNormal, s.ns);
    if (!s.frontFacing) {
        s.ng = -s.ng;
        s.ns = -s.ns;
    }
    s.ns = bendNormal(s.ns, s.ng, wo);
    s.tangent = frameAround(s.ns)[0];
    if (point.onSegment) s.tangent = normalizeOr(e1 - s.ns * dot(s.ns, e1), s.tangent);
    if (inputs.tangentEdges != vec4(0.0)) s.tangent = tangentAlong(s.ns, s.tangent, e1, e2, inputs.tangentEdges);
    setDirections(s, inputs, wo);
    s.albedoTable = scene.specularAlbedo;
    s.openPbrTable = scene.openPbrAlbedo;
    s.stretchedTable = scene.stretchedAlbedo;
    setLobes(s, inputs, material.flags, wo);
    return s;
}

Surface evaluateSurface(SceneRecord scene, Hit hit, Ray ray, RayFootprint footprint) {
    return evaluateSurface(scene, hit, ray, footprint, uvec2(0u));
}
#endif
