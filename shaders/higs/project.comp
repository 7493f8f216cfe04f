// Splats to ellipses on the film. A workgroup is a block: splats of one placement.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "color/srgb.glsl"
#include "higs/harmonics.glsl"
#include "higs/spans.glsl"

layout(local_size_x = 256) in;

// Two numbers of 16 bits with sign.
vec2 unpackShorts(uint word) { return vec2(int(word << 16u) >> 16, int(word) >> 16); }

struct Shape {
    vec3 axes[3]; // object space, as long as the standard deviations
    float opacity;
};

Shape loadShape(SplatArrays arrays, uint i) {
    const uvec4 words = uvec4(unpackUint2x32(DoubleRef(arrays.shapes).v[2u * i]),
                              unpackUint2x32(DoubleRef(arrays.shapes).v[2u * i + 1u]));
    // Its length, and so the unit of its numbers, does not matter: `two` makes up for it.
    const vec4 q = vec4(unpackShorts(words.x), unpackShorts(words.y));
    const float two = 2.0 / dot(q, q);
    const vec3 squares = two * q.xyz * q.xyz, mixed = two * q.xyx * q.yzz, turn = two * q.w * q.xyz; // xy, yz, xz
    const vec3 scale = arrays.scaleUnit * vec3(unpackHalf2x16(words.z), unpackHalf2x16(words.w).x);
    Shape shape;
    shape.axes[0] = scale.x * vec3(1.0 - squares.y - squares.z, mixed.x + turn.z, mixed.z - turn.y);
    shape.axes[1] = scale.y * vec3(mixed.x - turn.z, 1.0 - squares.x - squares.z, mixed.y + turn.x);
    shape.axes[2] = scale.z * vec3(mixed.z + turn.y, mixed.y - turn.x, 1.0 - squares.x - squares.y);
    shape.opacity = unpackUnorm2x16(words.w).y;
    return shape;
}

vec3 toWorld(SplatPlacement placement, vec3 v) {
    return placement.toWorldX * v.x + placement.toWorldY * v.y + placement.toWorldZ * v.z;
}

// The inverse of the covariance that three axes span. The shortest ones are lengthened to 1/1000 of the longest, so that
// flat splats have one.
SplatRay rayOf(vec3 a, vec3 b, vec3 c, vec3 relative) {
    const float least = 1e-6 * (dot(a, a) + dot(b, b) + dot(c, c));
    const vec3 xx = vec3(a.x, b.x, c.x), yy = vec3(a.y, b.y, c.y), zz = vec3(a.z, b.z, c.z);
    const float sxx = dot(xx, xx) + least, syy = dot(yy, yy) + least, szz = dot(zz, zz) + least;
    const float sxy = dot(xx, yy), sxz = dot(xx, zz), syz = dot(yy, zz);
    const vec3 minors = vec3(syy * szz - syz * syz, sxz * syz - sxy * szz, sxy * syz - sxz * syy);
    const float inverse_ = 1.0 / (sxx * minors.x + sxy * minors.y + sxz * minors.z);
    SplatRay ray;
    ray.diagonal = inverse_ * vec3(minors.x, sxx * szz - sxz * sxz, sxx * syy - sxy * sxy);
    ray.other = inverse_ * vec3(minors.y, minors.z, sxy * sxz - sxx * syz);
    ray.pull = vec3(dot(vec3(ray.diagonal.x, ray.other.xy), relative),
                    dot(vec3(ray.other.x, ray.diagonal.y, ray.other.z), relative),
                    dot(vec3(ray.other.yz, ray.diagonal.z), relative));
    return ray;
}

// Tangential projection: the splat is projected orthogonally onto the plane that touches the sphere around the camera in the
// direction of its centre; one of the ellipses there, seen through the picture, becomes that of a Gaussian again. `x`, `y`:
// the gradient of the pixel along the axes, made to span that Gaussian, whose centre moves. See docs/higs.md.
void projectTangentially(SplatPlacement placement, Shape shape, vec4 p, float inverseW, inout vec2 mean, inout vec3 x,
                         inout vec3 y) {
    const vec3 relative = toWorld(placement, p.xyz - placement.eye);
    const float scale = 1.0 / dot(relative, relative);
    vec3 w; // how W changes along the axes, once they lie in that plane
    for (int k = 0; k < 3; ++k)
        w[k] = dot(placement.clipW.xyz, shape.axes[k]) * inverseW - dot(relative, toWorld(placement, shape.axes[k])) * scale;
    const float contour = min(SPLAT_TANGENT_CONTOUR, SPLAT_TANGENT_LIMIT / max(dot(w, w), 1e-20));
    const float rest = 1.0 - contour * dot(w, w), root = sqrt(rest);
    const vec2 along = vec2(dot(x, w), dot(y, w));
    mean -= contour / rest * along;
    const vec3 stretch = contour / (root * (1.0 + root)) * w;
    x = (x + along.x * stretch) / root;
    y = (y + along.y * stretch) / root;
}

// The ellipse: J S S^T J^T + dilation, J being the gradient of the projection at the centre, S the axes.
bool projectShape(SplatFrame frame, SplatPlacement placement, Shape shape, vec4 p, inout ProjectedSplat s) {
    const float inverseW = 1.0 / dot(placement.clipW, p);
    s.mean = vec2(dot(placement.pixelX, p), dot(placement.pixelY, p)) * inverseW;
    vec2 at = s.mean;
    const bool tangential = (placement.flags & SPLATS_TANGENTIAL) != 0u;
    if (!tangential) {
        // Far outside the picture the gradient says little about the splat's shape inside it: as 3DGS, stay within
        // 1.3 times the field of view.
        const vec2 size = vec2(frame.width, frame.height);
        at = clamp(at, -0.15 * size, 1.15 * size);
    }
    const vec3 gradientX = (placement.pixelX.xyz - at.x * placement.clipW.xyz) * inverseW;
    const vec3 gradientY = (placement.pixelY.xyz - at.y * placement.clipW.xyz) * inverseW;
    vec3 x = vec3(dot(gradientX, shape.axes[0]), dot(gradientX, shape.axes[1]), dot(gradientX, shape.axes[2]));
    vec3 y = vec3(dot(gradientY, shape.axes[0]), dot(gradientY, shape.axes[1]), dot(gradientY, shape.axes[2]));
    if (tangential && (frame.flags & FRAME_PARALLEL) == 0u)
        projectTangentially(placement, shape, p, inverseW, s.mean, x, y);
    // The determinant as a sum of squares: that of needles keeps its precision.
    const bool antialiased = (frame.flags & FRAME_ANTIALIASED) != 0u;
    const float dilation = antialiased ? SPLAT_FILTER : SPLAT_DILATION;
    const vec3 minors = cross(x, y);
    const float sharp = dot(minors, minors);
    const float determinant_ = sharp + dilation * (dot(x, x) + dot(y, y) + dilation);
    const float yy = dot(y, y) + dilation;
    // Cholesky factor of the inverse of [xx xy; xy yy]: [a 0; b c], a^2 = yy / det, a b = -xy / det, c^2 = 1 / yy.
    const float scale = sqrt(0.5 * LOG2_E);
    s.shape.x = scale * sqrt(yy / determinant_);
    s.shape.y = -scale * dot(x, y) * inversesqrt(determinant_ * yy);
    s.shape.z = scale * inversesqrt(yy);
    float opacity = shape.opacity;
    if (antialiased) opacity *= sqrt(sharp / determinant_);
    s.bias = opacity >= 1.0 / 255.0 ? -log2(opacity) : SPLAT_SIGMA_LIMIT;
    return s.bias < SPLAT_SIGMA_LIMIT && determinant_ < 1e30 && s.shape.x > 0.0;
}

bool meetsCrop(SplatFrame frame, SplatEllipse e) {
    return all(greaterThan(e.mean + e.half_, vec2(frame.cropLo))) && all(lessThan(e.mean - e.half_, vec2(frame.cropHi)));
}

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uint block = push.first + workgroupIndex();
    if (block >= push.count) return;
    const SplatBlock source = BlockRef(frame.blocks).v[block];
    const SplatPlacement placement = PlacementRef(frame.placements).v[source.placement];
    const uint local = source.first + gl_LocalInvocationIndex, i = placement.first + local;
    if (local >= placement.arrays.count) return;

    ProjectedSplat s = ProjectedSplat(vec2(0.0), vec3(1.0), SPLAT_SIGMA_LIMIT, vec3(0.0), 0.0);
    const Shape shape = loadShape(placement.arrays, local);
    const vec4 p = vec4(Vec3Ref(placement.arrays.positions).v[local], 1.0);
    s.depth = dot(placement.depth, p);
    const bool shown = (placement.flags & SPLATS_HIDDEN) == 0u && shape.opacity > 0.0 && dot(placement.clipW, p) > 0.0 &&
                       s.depth >= frame.nearDepth && s.depth <= frame.farDepth && projectShape(frame, placement, shape, p, s);
    const SplatEllipse e = splatEllipse(s.mean, s.shape, splatReach(s.bias));
    if (!shown || !meetsCrop(frame, e)) {
        storeReach(frame, i, SplatReach(0u, 0.0));
        return;
    }
    const bool parallel = (frame.flags & FRAME_PARALLEL) != 0u;
    const vec3 towards = p.xyz - placement.eye, relative = toWorld(placement, towards);
    s.color = splatColor(placement.arrays, local, normalize(parallel ? placement.direction : towards));
    if ((frame.flags & FRAME_SRGB) != 0u) s.color = decodeSrgb(s.color);
    storeSplat(frame, i, s);
    const float key = max(parallel || frame.sorting == SORT_Z_DEPTH ? s.depth : length(relative), 0.0);
    // Squares are not listed: their tiles are those of another shape.
    const bool squares = (frame.flags & FRAME_SQUARES) != 0u;
    storeReach(frame, i, SplatReach(squares ? SPLAT_FAR : tilesOf(frame, e), key));
    if (frame.rays != 0ul)
        RayRef(frame.rays).v[i] = rayOf(toWorld(placement, shape.axes[0]), toWorld(placement, shape.axes[1]),
                                        toWorld(placement, shape.axes[2]), relative);
    if ((frame.flags & FRAME_PROFILING) != 0u) atomicAdd(StateRef(frame.state).v.visible, 1u);
}
