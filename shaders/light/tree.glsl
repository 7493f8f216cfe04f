// Choice among many lights: a tree whose nodes bound where lights are, how much power they have and where they send it.
// A. Conty Estevez and C. Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018; the importance
// of a node without its splitting, as in M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th edition, 12.6.
//
// Nodes lie in depth-first order: the left child follows its parent, LightNode::next of it is the right one.
#ifndef HIPR_LIGHT_TREE_GLSL
#define HIPR_LIGHT_TREE_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "light/linking.glsl"
#include "shared/references.glsl"

// Cosine of max(0, a - b) for angles up to 180 degrees.
float cosineOfDifference(float cosA, float cosB) {
    if (cosA > cosB) return 1.0;
    return cosA * cosB + sqrt(max(0.0, 1.0 - cosA * cosA) * max(0.0, 1.0 - cosB * cosB));
}

// Bounds are rounded: lights this little out of them may still be seen.
const float LIGHT_BOUND_SLACK = 1e-3;

// About how much light comes from a node to `p`, a surface with normal `n` (0: one that light reaches from all sides); 0
// only where none does.
float lightImportance(LightNode node, vec3 p, vec3 n) {
    vec3 extent = 0.5 * (node.hi - node.lo), way = node.lo + extent - p;
    float squaredRadius = dot(extent, extent), squared = dot(way, way);
    bool inside = squared <= squaredRadius;
    vec3 w = way * inversesqrt(max(squared, 1e-30));
    float cosSeen = inside ? -1.0 : sqrt(1.0 - squaredRadius / squared); // half the angle that the box fills
    float cosOff = cosineOfDifference(cosineOfDifference(-dot(node.axis, w), node.cosSpread), cosSeen);
    if (cosOff < node.cosEmission - LIGHT_BOUND_SLACK) return 0.0;
    float importance = node.power * max(cosOff, LIGHT_BOUND_SLACK) / max(max(squared, squaredRadius), 1e-20);
    if (n == vec3(0.0)) return importance;
    float cosIn = cosineOfDifference(dot(n, w), cosSeen);
    return cosIn < -LIGHT_BOUND_SLACK ? 0.0 : importance * max(cosIn, LIGHT_BOUND_SLACK);
}

// The chance of the left one of two nodes. In powers of two, so that an edit of a light, which changes the bounds around it
// a little, leaves most chances as they are (see renderer/shading/light_choice.h). Below 0: neither sends any light.
float leftChance(float left, float right) {
    if (left == 0.0 || right == 0.0) return left > 0.0 ? 1.0 : right > 0.0 ? 0.0 : -1.0;
    float ratio = exp2(clamp(round(log2(right) - log2(left)), -16.0, 16.0));
    return 1.0 / (1.0 + ratio);
}

// What receives light: a point, its normal (0: light reaches it from all sides), and its set of categories.
struct Receiver {
    vec3 p, n;
    uint categories;
};

// The same of a node for an object with the links `links`; 0 also where the node's lights are linked to others.
float importanceOf(LightNode node, Receiver receiver, uint links) {
    return (node.links & links) != 0u ? lightImportance(node, receiver.p, receiver.n) : 0.0;
}

// From the root to the leaf that `u` chooses, or, where it is not NO_INDEX, to the leaf `target`. Returns the chance of coming
// there, and its light; 0: no light.
float walkLightTree(SceneRecord scene, Receiver receiver, uint target, float u, out uint light) {
    LightNodeRef nodes = LightNodeRef(scene.lightNodes);
    float chance = 1.0;
    uint i = 0u, links = linksOf(scene, receiver.categories);
    light = nodes.v[0].light;
    [[dont_unroll]] while (light == NO_INDEX) {
        uint left = i + 1u, right = nodes.v[left].next;
        float share = leftChance(importanceOf(nodes.v[left], receiver, links), importanceOf(nodes.v[right], receiver, links));
        bool goLeft = target == NO_INDEX ? u < share : target < right;
        float taken = share < 0.0 ? 0.0 : goLeft ? share : 1.0 - share;
        if (!(taken > 0.0)) return 0.0;
        u = min((goLeft ? u : u - share) / taken, 0.99999994);
        chance *= taken;
        i = goLeft ? left : right;
        light = nodes.v[i].light;
    }
    return chance;
}

// The chance that sampleLight chooses `light`.
float lightChance(SceneRecord scene, LightRecord light, Receiver receiver) {
    if (scene.lightTreeChance == 0.0 || light.leaf == NO_INDEX) return light.selectPdf;
    uint same;
    return light.selectPdf * walkLightTree(scene, receiver, light.leaf, 0.0, same);
}

// Normals as they are kept with a path: octahedral, 15 bits an axis, and bit 31 to tell that there is one.
uint packLightNormal(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    if (n.z < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    uvec2 bits = uvec2(round((0.5 + 0.5 * clamp(p, -1.0, 1.0)) * 32766.0));
    return 0x80000000u | bits.x | bits.y << 15;
}

vec3 unpackLightNormal(uint packed) {
    if (packed == 0u) return vec3(0.0);
    vec2 p = vec2(packed & 0x7fffu, packed >> 15 & 0x7fffu) / 16383.0 - 1.0;
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return normalize(n);
}
#endif
