#include "renderer/hipr/discovery.h"

#include <algorithm>

namespace hipr {
namespace {

bool before(const gpu::ElementKey& a, const gpu::ElementKey& b) {
    return a.object != b.object ? a.object < b.object : a.instance < b.instance;
}

WorldBox merged(WorldBox a, const WorldBox& b) {
    a.add(b);
    return a;
}

/// Half the surface of a box: proportional to the chance that a ray meets it.
float halfArea(const WorldBox& box) {
    const glm::vec3 d = box.max - box.min;
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

/// Parts of 1; equal ones if all are 0.
glm::vec4 normalised(glm::vec4 weights, int count) {
    const float sum = weights.x + weights.y + weights.z + weights.w;
    if (sum > 0.f) return weights / sum;
    for (int i = 0; i < count; ++i)
        weights[i] = 1.f / float(count);
    return weights;
}

} // namespace

void ChangedElements::add(const std::vector<gpu::ElementKey>& elements, const std::vector<WorldBox>& boxes) {
    _keys.insert(_keys.end(), elements.begin(), elements.end());
    // An object's key for everything comes last of its keys: seen from the end, it swallows the others.
    std::sort(_keys.begin(), _keys.end(), before);
    const auto kept = std::unique(
        _keys.rbegin(), _keys.rend(), [](const gpu::ElementKey& later, const gpu::ElementKey& key) {
            return later.object == key.object &&
                   (later.instance == key.instance || later.instance == gpu::EVERY_INSTANCE);
        });
    _keys.erase(_keys.begin(), kept.base());
    for (const WorldBox& box : boxes)
        if (!box.empty()) addBox(box);
}

void ChangedElements::addBox(const WorldBox& box) {
    _boxes.push_back(box);
    if (_boxes.size() <= gpu::MAX_CHANGED_BOXES) return;
    size_t first = 0, second = 1;
    float least = std::numeric_limits<float>::infinity();
    for (size_t i = 0; i < _boxes.size(); ++i)
        for (size_t j = i + 1; j < _boxes.size(); ++j) {
            const float growth =
                halfArea(merged(_boxes[i], _boxes[j])) - halfArea(_boxes[i]) - halfArea(_boxes[j]);
            if (growth < least) least = growth, first = i, second = j;
        }
    _boxes[first].add(_boxes[second]);
    _boxes.erase(_boxes.begin() + std::ptrdiff_t(second));
}

void ChangedElements::clear() {
    _keys.clear();
    _boxes.clear();
}

DiscoveryWeights discoveryWeights(const Settings& settings) {
    DiscoveryWeights weights;
    weights.scatter[gpu::SCATTER_DIFFUSE] = settings.weightDiffuse;
    weights.scatter[gpu::SCATTER_GLOSSY] = settings.weightGlossy;
    weights.scatter[gpu::SCATTER_SPECULAR] = settings.weightSpecular;
    weights.scatter[gpu::SCATTER_TRANSMISSION] = settings.weightTransmission;
    weights.path[gpu::PATH_DIRECT] = settings.weightDirect;
    weights.path[gpu::PATH_INDIRECT] = settings.weightIndirect;
    weights.path[gpu::PATH_CAUSTIC] = settings.weightCaustic;
    weights.scatter = normalised(weights.scatter, 4);
    weights.path = normalised(weights.path, 3);
    return weights;
}

std::vector<float> discoveredPriorities(const std::vector<uint64_t>& weights,
                                        const std::vector<uint32_t>& active) {
    std::vector<float> priorities(weights.size());
    float largest = 0.f;
    for (size_t tile = 0; tile < weights.size(); ++tile) {
        priorities[tile] = float(double(weights[tile]) / gpu::WEIGHT_SCALE);
        largest = std::max(largest, priorities[tile]);
    }
    for (size_t tile = 0; tile < weights.size(); ++tile)
        if (active[tile]) priorities[tile] += 1.f + largest;
    return priorities;
}

} // namespace hipr
