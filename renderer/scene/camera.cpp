#include "renderer/scene/camera.h"

#include <cmath>
#include <limits>
#include <utility>

#include "renderer/scene/motion.h"

namespace hipr {
namespace {

bool finite(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}

// Depth along the view axis of the clip plane z = ndcZ at the centre of the picture.
double planeDepth(const glm::dmat4& clipToView, double ndcZ, const glm::dvec3& eye) {
    const glm::dvec4 p = clipToView * glm::dvec4(0, 0, ndcZ, 1);
    if (std::abs(p.w) <= 1e-12 * glm::length(glm::dvec3(p))) return std::numeric_limits<float>::max();
    return eye.z - p.z / p.w;
}

/// CameraRecord's rays in view space, in double precision.
struct ViewRays {
    glm::dvec3 origin{0}, originX{0}, originY{0}, direction{0}, directionX{0}, directionY{0};
    double nearDepth = 0, farDepth = 0;
};

// Let M be the inverse of the projection. All rays pass through the homogeneous point E = M (0, 0, 1, 0): the
// eye when E.w is not 0, else the common direction. The ray of (x, y) also passes through A = M (x, y, 0, 1),
// and A.xyz - eye A.w is its direction times A.w, which is affine in x and y.
ViewRays viewRays(const glm::dmat4& m) {
    ViewRays rays;
    const glm::dvec4 e = m[2];
    const bool orthographic = std::abs(e.w) <= 1e-12 * glm::length(glm::dvec3(e));
    if (orthographic) {
        const double w = m[3].w;
        rays.origin = glm::dvec3(m[3]) / w;
        rays.originX = glm::dvec3(m[0]) / w;
        rays.originY = glm::dvec3(m[1]) / w;
        rays.direction = glm::dvec3(e);
    } else {
        rays.origin = glm::dvec3(e) / e.w;
        rays.direction = glm::dvec3(m[3]) - rays.origin * m[3].w;
        rays.directionX = glm::dvec3(m[0]) - rays.origin * m[0].w;
        rays.directionY = glm::dvec3(m[1]) - rays.origin * m[1].w;
    }
    const double scale = (rays.direction.z > 0 ? -1 : 1) / glm::length(rays.direction);
    rays.direction *= scale;
    rays.directionX *= scale;
    rays.directionY *= scale;

    rays.nearDepth = planeDepth(m, -1, rays.origin);
    rays.farDepth = planeDepth(m, 1, rays.origin);
    // Beyond infinity lies behind the eye.
    if (!orthographic && rays.nearDepth < 0) rays.nearDepth = std::numeric_limits<float>::max();
    if (!orthographic && rays.farDepth < 0) rays.farDepth = std::numeric_limits<float>::max();
    if (rays.nearDepth > rays.farDepth) std::swap(rays.nearDepth, rays.farDepth);
    if (orthographic) { // rays start on the near plane
        rays.origin.z -= rays.nearDepth;
        rays.farDepth -= rays.nearDepth;
        rays.nearDepth = 0;
    }
    return rays;
}

/// Adds the lens. Its disk lies in the plane of depth 0, as the eye does.
void addLens(const Lens& lens, const glm::dmat3& toWorld, gpu::CameraRecord& record) {
    if (!(lens.radius > 0 && std::isfinite(lens.radius))) return;
    if (!(lens.focusDistance > 0 && std::isfinite(lens.focusDistance))) return;
    if (record.originX != glm::vec3(0) || record.originY != glm::vec3(0)) return; // orthographic
    const double turn = glm::radians(double(lens.bladeRotation));
    const glm::dvec3 x = glm::normalize(toWorld[0]), y = glm::normalize(toWorld[1]);
    record.lensX = lens.radius * (std::cos(turn) * x + std::sin(turn) * y);
    record.lensY = lens.radius * (std::cos(turn) * y - std::sin(turn) * x);
    record.focusDepth = float(lens.focusDistance * glm::length(glm::dvec3(record.forward)));
    record.lensBlades = lens.blades < 3 ? 0 : uint32_t(lens.blades);
}

static_assert(MaxClipPlanes == gpu::MAX_CLIP_PLANES);

void addClipPlanes(const CameraDesc& camera, const glm::dvec3& origin, gpu::CameraRecord& record) {
    for (const glm::dvec4& plane : camera.clipPlanes) {
        const glm::dvec4 world = glm::transpose(camera.worldToView) * plane;
        if (record.clipPlaneCount == gpu::MAX_CLIP_PLANES) return;
        if (!std::isfinite(glm::dot(world, world))) continue;
        record.clipPlanes[record.clipPlaneCount++] =
            glm::dvec4(glm::dvec3(world), glm::dot(world, glm::dvec4(origin, 1)));
    }
}

} // namespace

std::optional<gpu::CameraRecord> cameraRecord(const CameraDesc& camera) {
    if (!finite(camera.worldToView) || !finite(camera.projection)) return std::nullopt;
    const glm::dmat4 clipToView = glm::inverse(camera.projection),
                     viewToWorld = glm::inverse(camera.worldToView);
    if (!finite(clipToView) || !finite(viewToWorld)) return std::nullopt;
    const ViewRays rays = viewRays(clipToView);
    const glm::dmat3 toWorld(viewToWorld);
    if (!std::isfinite(glm::length(rays.direction)) || !(rays.farDepth > rays.nearDepth)) return std::nullopt;

    gpu::CameraRecord record{};
    record.worldToClip = glm::mat4(camera.projection * camera.worldToView);
    record.worldToView = glm::mat4x3(camera.worldToView);
    record.origin = glm::dvec3(viewToWorld * glm::dvec4(rays.origin, 1));
    record.originX = toWorld * rays.originX;
    record.originY = toWorld * rays.originY;
    record.nearDepth = float(rays.nearDepth);
    record.farDepth = float(rays.farDepth);
    record.direction = toWorld * rays.direction;
    record.directionX = toWorld * rays.directionX;
    record.directionY = toWorld * rays.directionY;
    const glm::dmat4& v = camera.worldToView; // may scale: depths are in view units
    record.forward = -glm::dvec3(v[0].z, v[1].z, v[2].z);
    addLens(camera.lens, toWorld, record);
    addClipPlanes(camera, glm::dvec3(record.origin), record);
    return record;
}

std::vector<glm::mat4x3> cameraKeys(const CameraDesc& camera, const gpu::CameraRecord& record,
                                    const Shutter& shutter) {
    if (!shutter.blurs() || camera.motion.size() < 2) return {};
    const glm::dvec4 eye = camera.worldToView * glm::dvec4(glm::dvec3(record.origin), 1);
    std::vector<float> times;
    std::vector<glm::dmat4x3> places;
    for (const CameraKey& key : camera.motion) {
        const glm::dmat4 viewToWorld = glm::inverse(key.worldToView);
        if (!finite(viewToWorld)) return {};
        const glm::dmat3 linear = glm::dmat3(viewToWorld) * glm::dmat3(camera.worldToView);
        times.push_back(key.time);
        places.push_back({linear[0], linear[1], linear[2], glm::dvec3(viewToWorld * eye)});
    }
    const PlacementMotion motion(times, places);
    if (!motion.moves()) return {};
    std::vector<glm::mat4x3> keys;
    const uint32_t count = motion.keys(shutter);
    for (uint32_t k = 0; k < count; ++k)
        keys.push_back(glm::mat4x3(motion.at(keyFrame(shutter, k, count))));
    return keys;
}

} // namespace hipr
