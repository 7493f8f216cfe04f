#include "renderer/trace/splat_motion.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/camera.h"
#include "shaders/shared/motion.h"

namespace hipr {
namespace {

constexpr uint32_t MostMoments = 32;
constexpr double MomentPixels = 2.0;
constexpr int WaySteps = 8; ///< in which a way over the film is measured

glm::mat4x3 between(const std::vector<glm::mat4x3>& keys, float time) {
    const gpu::KeyTime at = gpu::keyTime(time, uint32_t(keys.size()));
    return gpu::mixTransforms(keys[at.first], keys[at.first + 1], at.weight);
}

glm::vec3 corner(const WorldBox& box, int i) {
    return {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z};
}

} // namespace

bool SplatMotion::setInstances(std::vector<Placed> instances) {
    const bool changed = !(instances == _instances);
    _instances = std::move(instances);
    return changed;
}

bool SplatMotion::setCamera(const CameraDesc& camera, const gpu::CameraRecord& record,
                            const Shutter& shutter) {
    std::vector<glm::mat4x3> keys = cameraKeys(camera, record, shutter);
    const bool changed = keys != _cameraKeys;
    _camera = camera;
    _record = record;
    _cameraKeys = std::move(keys);
    return changed;
}

gpu::CameraRecord SplatMotion::camera(float time) const {
    if (_cameraKeys.empty()) return _record;
    const glm::mat4x3 key = between(_cameraKeys, time); // of points relative to the origin of the record
    glm::dmat4 moved{glm::dmat4x3(key)};
    moved =
        moved *
        glm::dmat4{
            1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -_record.origin.x, -_record.origin.y, -_record.origin.z, 1};
    CameraDesc there = _camera;
    there.worldToView = _camera.worldToView * glm::inverse(moved);
    return cameraRecord(there).value_or(_record);
}

glm::mat4x3 SplatMotion::placement(size_t instance, float time) const {
    const Placed& placed = _instances[instance];
    return placed.keys.empty() ? placed.still : between(placed.keys, time);
}

/// Of a corner of a box, in pixels; infinite where one is not in front of the camera.
double SplatMotion::longestWay(glm::vec2 film) const {
    std::vector<gpu::CameraRecord> cameras;
    for (int step = 0; step <= WaySteps; ++step)
        cameras.push_back(camera(float(step) / WaySteps));
    double longest = 0.0;
    for (size_t i = 0; i < _instances.size(); ++i) {
        if (_instances[i].keys.empty() && !cameraMoves()) continue;
        double ways[8] = {};
        glm::vec2 last[8];
        for (int step = 0; step <= WaySteps; ++step) {
            const glm::mat4x3 toWorld = placement(i, float(step) / WaySteps);
            for (int c = 0; c < 8; ++c) {
                const glm::vec3 world = toWorld * glm::vec4(corner(_instances[i].box, c), 1.f);
                const glm::vec4 clip = cameras[size_t(step)].worldToClip * glm::vec4(world, 1.f);
                if (!(clip.w > 0.f)) return HUGE_VAL;
                const glm::vec2 place = 0.5f * film * glm::vec2(clip) / clip.w;
                if (step > 0) ways[c] += double(glm::length(place - last[c]));
                last[c] = place;
            }
        }
        longest = std::max(longest, *std::max_element(ways, ways + 8));
    }
    return longest;
}

uint32_t SplatMotion::moments(uint32_t width, uint32_t height) const {
    const bool anything = cameraMoves() || std::any_of(_instances.begin(), _instances.end(),
                                                       [](const Placed& p) { return !p.keys.empty(); });
    if (!anything) return 0;
    const double way = longestWay(glm::vec2(width, height));
    return uint32_t(std::clamp(std::ceil(way / MomentPixels), 2.0, double(MostMoments)));
}

void SplatMean::add(const gpu::SplatPixel* pixels, size_t count) {
    if (_count == 0) _sums.assign(count, glm::vec4(0.f));
    for (size_t i = 0; i < count; ++i)
        _sums[i] += glm::vec4(pixels[i].color, pixels[i].transmittance);
    ++_count;
}

} // namespace hipr
