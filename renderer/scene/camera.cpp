#include "renderer/scene/camera.h"

#include <cmath>
#include <limits>

namespace hipr {
namespace {

bool finite(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}

// Depth along the view axis of the clip plane z = ndcZ at the centre of the picture.
double planeDepth(const glm::dmat4& clipToWorld, double ndcZ, const glm::dvec3& origin,
                  const glm::dvec3& forward) {
    const glm::dvec4 p = clipToWorld * glm::dvec4(0, 0, ndcZ, 1);
    if (std::abs(p.w) <= 1e-12 * glm::length(glm::dvec3(p))) return std::numeric_limits<float>::max();
    const double depth = glm::dot(glm::dvec3(p) / p.w - origin, forward);
    return depth;
}

} // namespace

// Let M be the inverse of the clip matrix. All rays pass through the homogeneous point E = M (0, 0, 1, 0):
// the eye when E.w is not 0, else the common direction. The ray of (x, y) also passes through A = M (x, y, 0,
// 1), and A.xyz - eye A.w is its direction times A.w, which is affine in x and y.
std::optional<gpu::CameraRecord> cameraRecord(const CameraDesc& camera) {
    const glm::dmat4 worldToClip = camera.projection * camera.worldToView;
    if (!finite(camera.worldToView) || !finite(camera.projection)) return std::nullopt;
    const glm::dmat4 projectionInverse = glm::inverse(camera.projection);
    const glm::dmat4 viewToWorld = glm::inverse(camera.worldToView);
    const glm::dmat4 m = viewToWorld * projectionInverse;
    if (!finite(m)) return std::nullopt;

    const glm::dvec3 forward = -glm::normalize(glm::dvec3(viewToWorld[2]));
    const glm::dvec4 e = m[2];
    glm::dvec3 origin, originX(0), originY(0), direction, directionX(0), directionY(0);
    const bool orthographic = std::abs(e.w) <= 1e-12 * glm::length(glm::dvec3(e));
    if (orthographic) {
        const double w = m[3].w;
        origin = glm::dvec3(m[3]) / w;
        originX = glm::dvec3(m[0]) / w;
        originY = glm::dvec3(m[1]) / w;
        direction = glm::dvec3(e);
    } else {
        origin = glm::dvec3(e) / e.w;
        direction = glm::dvec3(m[3]) - origin * m[3].w;
        directionX = glm::dvec3(m[0]) - origin * m[0].w;
        directionY = glm::dvec3(m[1]) - origin * m[1].w;
    }
    const double scale = (glm::dot(direction, forward) < 0 ? -1 : 1) / glm::length(direction);
    if (!std::isfinite(scale)) return std::nullopt;

    double nearDepth = planeDepth(m, -1, origin, forward);
    double farDepth = planeDepth(m, 1, origin, forward);
    // Beyond infinity lies behind the eye.
    if (!orthographic && nearDepth < 0) nearDepth = std::numeric_limits<float>::max();
    if (!orthographic && farDepth < 0) farDepth = std::numeric_limits<float>::max();
    if (nearDepth > farDepth) std::swap(nearDepth, farDepth);
    if (orthographic) { // rays start on the near plane
        origin += forward * nearDepth;
        farDepth -= nearDepth;
        nearDepth = 0;
    }
    if (!(farDepth > nearDepth)) return std::nullopt;

    gpu::CameraRecord record{};
    record.worldToClip = glm::mat4(worldToClip);
    record.worldToView = glm::mat4x3(camera.worldToView);
    record.origin = origin;
    record.originX = originX;
    record.originY = originY;
    record.nearDepth = float(nearDepth);
    record.farDepth = float(farDepth);
    record.direction = direction * scale;
    record.directionX = directionX * scale;
    record.directionY = directionY * scale;
    record.forward = forward;
    return record;
}

} // namespace hipr
