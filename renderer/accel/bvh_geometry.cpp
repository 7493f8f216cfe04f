#include "renderer/accel/bvh_geometry.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "renderer/accel/geometry_bounds.h"

namespace hipr {
namespace {

/// A refitted tree that costs this much more than when it was built is built anew.
constexpr float WORN_OUT = 1.4f;

std::vector<gpu::BvhTriangle> leafTriangles(const GeometryView& view, const std::vector<uint32_t>& order) {
    static_assert(sizeof(gpu::BvhTriangle) == 40); // BVH_TRIANGLE_BYTES
    std::vector<gpu::BvhTriangle> out(order.size() * view.keys);
    tbb::parallel_for(tbb::blocked_range<size_t>(0, out.size(), 32768), [&](const auto& range) {
        for (size_t i = range.begin(); i < range.end(); ++i) {
            const uint32_t primitive = order[i % order.size()];
            const auto [a, b, c] = cornersOf(view, primitive, uint32_t(i / order.size()));
            out[i] = {a, b, c, primitive};
        }
    });
    return out;
}

} // namespace

void BvhGeometry::setView(const GeometryView& view) {
    _sameTopology = view.sameTopology && (_sameTopology || !_changed);
    _view = view;
    _changed = true;
}

void BvhGeometry::fetch(Device& device) {
    if (!_sameTopology || !_buffer) return;
    _bvh.nodes.resize(_nodeCount);
    _triangles.resize(_triangleCount);
    device.download(_buffer, _bvh.nodes.data(), _nodeCount * sizeof(gpu::BvhNode));
    device.download(_buffer, _triangles.data(), _triangleCount * sizeof(gpu::BvhTriangle),
                    _nodeCount * sizeof(gpu::BvhNode));
    _bvh.order.resize(_triangleCount);
    for (uint32_t i = 0; i < _triangleCount; ++i)
        _bvh.order[i] = _triangles[i].primitive;
}

void BvhGeometry::prepare() {
    const std::vector<Bounds> boxes = primitiveBoxes(_view);
    const BvhOptions options;
    if (!_bvh.nodes.empty() && _triangleCount == boxes.size()) refitBvh(_bvh, boxes, options);
    if (_bvh.nodes.empty() || _triangleCount != boxes.size() || _bvh.cost > WORN_OUT * _builtCost) {
        _bvh = buildBvh(boxes, options);
        _builtCost = _bvh.cost;
    }
    _bounds = _bvh.bounds;
    _triangles = leafTriangles(_view, _bvh.order);
}

void BvhGeometry::send(Device& device) {
    const uint64_t nodeBytes = _bvh.nodes.size() * sizeof(gpu::BvhNode);
    const uint64_t triangleBytes = _triangles.size() * sizeof(gpu::BvhTriangle);
    _nodeCount = _bvh.nodes.size();
    _triangleCount = uint32_t(_triangles.size()) / _view.keys;
    if (_triangles.empty()) {
        _buffer = {};
    } else {
        if (_buffer.bytes() != nodeBytes + triangleBytes) {
            _buffer = {};
            _buffer = device.createBuffer(nodeBytes + triangleBytes, MemoryUse::Device, "acceleration");
        }
        device.upload(_buffer, _bvh.nodes.data(), nodeBytes);
        device.upload(_buffer, _triangles.data(), triangleBytes, nodeBytes);
    }
    _bvh = {};
    _triangles = {};
    _changed = _sameTopology = false;
}

} // namespace hipr
