#include "renderer/shading/light_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "shaders/shared/scene.h"

namespace hipr {

namespace {

constexpr double Pi = 3.14159265358979323846;
constexpr int Buckets = 12;

glm::vec3 centreOf(const LightBounds& bounds) {
    return 0.5f * (bounds.lo + bounds.hi);
}

/// The smallest cone around both, to rounding.
void mergeCones(LightBounds& a, const LightBounds& b) {
    const glm::dvec3 first(a.axis), second(b.axis);
    const double between = std::acos(glm::clamp(glm::dot(first, second), -1.0, 1.0));
    if (std::min(between + b.spread, Pi) <= a.spread) return;
    if (std::min(between + a.spread, Pi) <= b.spread) {
        a.axis = b.axis, a.spread = b.spread;
        return;
    }
    const double spread = 0.5 * (a.spread + between + b.spread);
    const glm::dvec3 across = glm::cross(first, second);
    if (spread >= Pi || glm::dot(across, across) < 1e-20) {
        a.spread = Pi;
        return;
    }
    const double turn = spread - a.spread; // of the first axis towards the second
    const glm::dvec3 sideways = glm::normalize(glm::cross(glm::normalize(across), first));
    a.axis = glm::vec3(first * std::cos(turn) + sideways * std::sin(turn));
    a.spread = spread;
}

void merge(LightBounds& a, const LightBounds& b) {
    if (!(b.power > 0.0)) return;
    if (!(a.power > 0.0)) {
        a = b;
        return;
    }
    a.lo = glm::min(a.lo, b.lo), a.hi = glm::max(a.hi, b.hi);
    mergeCones(a, b);
    a.emission = std::max(a.emission, b.emission);
    a.power += b.power;
    a.links |= b.links;
}

/// Solid angle that the cone covers, weighed by the cosine where light leaves the normals' cone (Conty
/// Estevez and Kulla, section 4.4).
double coneMeasure(const LightBounds& bounds) {
    const double o = bounds.spread, w = std::min(o + bounds.emission, Pi);
    return 2.0 * Pi * (1.0 - std::cos(o)) +
           0.5 * Pi * (2.0 * w * std::sin(o) - std::cos(o - 2.0 * w) - 2.0 * o * std::sin(o) + std::cos(o));
}

double boxArea(const LightBounds& bounds) {
    const glm::dvec3 d = glm::max(glm::dvec3(bounds.hi) - glm::dvec3(bounds.lo), glm::dvec3(0.0));
    return 2.0 * (d.x * d.y + d.y * d.z + d.z * d.x);
}

double costOf(const LightBounds& bounds) {
    return bounds.power * coneMeasure(bounds) * boxArea(bounds);
}

class Builder {
public:
    Builder(const std::vector<LightBounds>& lights, std::vector<uint32_t>& leaves)
        : _lights(lights), _leaves(leaves), _order(lights.size()) {
        std::iota(_order.begin(), _order.end(), 0u);
        _leaves.assign(lights.size(), gpu::NO_INDEX);
        nodes.reserve(2 * lights.size());
    }

    LightBounds build(size_t begin, size_t end) {
        const size_t at = nodes.size();
        nodes.emplace_back();
        LightBounds bounds;
        if (end - begin == 1) {
            bounds = _lights[_order[begin]];
            _leaves[_order[begin]] = uint32_t(at);
        } else {
            const size_t middle = split(begin, end);
            bounds = build(begin, middle);
            merge(bounds, build(middle, end));
        }
        gpu::LightNode& node = nodes[at];
        node.lo = bounds.lo, node.hi = bounds.hi;
        node.axis = bounds.axis;
        node.power = float(bounds.power);
        node.links = bounds.links;
        node.cosSpread = float(std::cos(bounds.spread));
        node.cosEmission = float(std::cos(bounds.emission));
        node.light = end - begin == 1 ? _order[begin] : gpu::NO_INDEX;
        node.next = uint32_t(nodes.size());
        return bounds;
    }

    std::vector<gpu::LightNode> nodes;

private:
    struct Split {
        double cost = std::numeric_limits<double>::infinity();
        int axis = 0, bucket = 0;
    };

    int bucketOf(uint32_t light, int axis, double lo, double size) const {
        const double place = (double(centreOf(_lights[light])[axis]) - lo) / size;
        return std::min(std::max(int(place * Buckets), 0), Buckets - 1);
    }

    /// The best of the splits between buckets along one axis.
    void tryAxis(size_t begin, size_t end, int axis, const glm::dvec3& lo, const glm::dvec3& size,
                 Split& best) const {
        LightBounds buckets[Buckets], below[Buckets];
        for (size_t i = begin; i < end; ++i)
            merge(buckets[bucketOf(_order[i], axis, lo[axis], size[axis])], _lights[_order[i]]);
        LightBounds sum;
        for (int b = 0; b < Buckets; ++b)
            merge(sum, buckets[b]), below[b] = sum;
        sum = {};
        const double thin = std::max(size.x, std::max(size.y, size.z)) / size[axis];
        for (int b = Buckets - 2; b >= 0; --b) {
            merge(sum, buckets[b + 1]);
            if (!(sum.power > 0.0) || !(below[b].power > 0.0)) continue;
            const double cost = thin * (costOf(below[b]) + costOf(sum));
            if (cost < best.cost) best = {cost, axis, b};
        }
    }

    /// Puts the lights of the left child first; returns where those of the right one begin.
    size_t split(size_t begin, size_t end) {
        glm::dvec3 lo(std::numeric_limits<double>::infinity()), hi(-lo);
        for (size_t i = begin; i < end; ++i) {
            const glm::dvec3 centre(centreOf(_lights[_order[i]]));
            lo = glm::min(lo, centre), hi = glm::max(hi, centre);
        }
        const glm::dvec3 size = hi - lo;
        Split best;
        for (int axis = 0; axis < 3; ++axis)
            if (size[axis] > 0.0) tryAxis(begin, end, axis, lo, size, best);
        const auto first = _order.begin() + long(begin), last = _order.begin() + long(end);
        const auto middle = std::stable_partition(first, last, [&](uint32_t light) {
            return size[best.axis] > 0.0 &&
                   bucketOf(light, best.axis, lo[best.axis], size[best.axis]) <= best.bucket;
        });
        const bool apart = middle != first && middle != last; // not if all are in one place
        return apart ? size_t(middle - _order.begin()) : begin + (end - begin) / 2;
    }

    const std::vector<LightBounds>& _lights;
    std::vector<uint32_t>& _leaves;
    std::vector<uint32_t> _order;
};

/// Half the size of the world-space box of a light's shape, around its origin.
glm::vec3 halfExtent(const gpu::LightRecord& record) {
    const glm::mat4x3& m = record.lightToWorld;
    const glm::vec3 x = glm::abs(m[0]), y = glm::abs(m[1]);
    const auto ellipse = [](const glm::vec3& a, const glm::vec3& b) { return glm::sqrt(a * a + b * b); };
    switch (record.kind) {
    case gpu::LIGHT_RECT:
        return 0.5f * (record.size.x * x + record.size.y * y);
    case gpu::LIGHT_DISK:
        return record.size.x * ellipse(m[0], m[1]);
    case gpu::LIGHT_SPHERE:
        return record.size.x * glm::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    case gpu::LIGHT_CYLINDER:
        return 0.5f * record.size.y * x + record.size.x * ellipse(m[1], m[2]);
    default: // thin
        return 0.5f * record.size.y * x;
    }
}

} // namespace

void narrow(LightBounds& bounds, const glm::vec3& axis, double coneAngle) {
    bounds.axis = axis;
    bounds.emission = std::min(coneAngle, 0.5 * Pi);
    bounds.spread = coneAngle - bounds.emission;
}

LightBounds boundsOf(const gpu::LightRecord& record, double coneAngle, double power) {
    LightBounds bounds;
    const glm::vec3 centre = record.lightToWorld[3];
    const glm::vec3 extent =
        halfExtent(record) + 1e-5f * (glm::abs(centre) + halfExtent(record)); // for rounding
    bounds.lo = centre - extent, bounds.hi = centre + extent;
    bounds.power = power;
    const bool flat = record.kind == gpu::LIGHT_RECT || record.kind == gpu::LIGHT_DISK;
    const double widest = flat ? 0.5 * Pi : Pi;
    bounds.emission = 0.5 * Pi;
    bounds.spread = flat ? 0.0 : Pi;
    if (coneAngle < widest) {
        narrow(bounds, -glm::normalize(record.lightToWorld[2]), coneAngle);
    } else if (flat) { // the normal of the side -Z: the inverse transposed applied to it
        const glm::mat3 inverse(record.worldToLight);
        bounds.axis = -glm::normalize(glm::vec3(inverse[0].z, inverse[1].z, inverse[2].z));
    }
    return bounds;
}

std::vector<gpu::LightNode> buildLightTree(const std::vector<LightBounds>& lights,
                                           std::vector<uint32_t>& leaves) {
    Builder builder(lights, leaves);
    if (!lights.empty()) builder.build(0, lights.size());
    return std::move(builder.nodes);
}

} // namespace hipr
