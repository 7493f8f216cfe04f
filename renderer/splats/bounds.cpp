#include "renderer/splats/bounds.h"

#include <cmath>

#include <glm/gtc/quaternion.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace hipr {
namespace {

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The box of one splat. A row of its rotation times its scales is half an edge, in standard deviations.
SplatBox boxOf(const SplatCloud& cloud, size_t i, float deviations) {
    const glm::vec3 scale = i < cloud.scales.size() ? cloud.scales[i] : glm::vec3(1.f);
    const glm::mat3 turn = i < cloud.orientations.size()
                               ? glm::mat3_cast(glm::normalize(cloud.orientations[i]))
                               : glm::mat3(1.f);
    glm::vec3 squares(0.f);
    for (int k = 0; k < 3; ++k)
        squares += turn[k] * turn[k] * (scale[k] * scale[k]);
    const glm::vec3 half = deviations * glm::sqrt(squares);
    return {cloud.positions[i] - half, cloud.positions[i] + half};
}

} // namespace

SplatBox splatBox(const SplatCloud& cloud, float deviations) {
    return tbb::parallel_reduce(
        tbb::blocked_range<size_t>(0, cloud.size(), 4096), SplatBox(),
        [&](const auto& range, SplatBox box) {
            for (size_t i = range.begin(); i != range.end(); ++i) {
                const SplatBox one = boxOf(cloud, i, deviations);
                if (finite(one.lo) && finite(one.hi)) box.add(one);
            }
            return box;
        },
        [](SplatBox a, const SplatBox& b) {
            a.add(b);
            return a;
        });
}

} // namespace hipr
