#include "renderer/accel/bvh_traversal.h"

#include <stdexcept>

#include <tbb/parallel_for.h>

#include "hipr_accel_kernels.h"
#include "renderer/accel/bvh_geometry.h"
#include "renderer/accel/denormals.h"
#include "renderer/accel/device_instances.h"
#include "renderer/accel/device_traversal.h"
#include "renderer/vulkan/kernel.h"

namespace hipr {
namespace {

Kernel nearestKernel(Device& device, uint32_t features) {
    return Kernel(device, spirv::bvhNearest_spv, spirv::bvhNearest_spv_size, sizeof(gpu::TracePush),
                  "bvhNearest", false, features);
}

Kernel occludedKernel(Device& device, uint32_t features) {
    return Kernel(device, spirv::bvhOccluded_spv, spirv::bvhOccluded_spv_size, sizeof(gpu::TracePush),
                  "bvhOccluded", false, features);
}

class BvhTraversal final : public DeviceTraversal {
public:
    explicit BvhTraversal(Device& device)
        : DeviceTraversal(nearestKernel(device, 0), occludedKernel(device, 0)), _device(device) {}

    void setGeometry(uint32_t slot, const GeometryView* view) override {
        if (slot >= _geometries.size()) _geometries.resize(slot + 1);
        _instancesChanged = true; // boxes of instances follow their geometry
        if (!view) {
            _geometries[slot].reset();
            return;
        }
        if (!_geometries[slot]) _geometries[slot] = std::make_unique<BvhGeometry>();
        if (view->segments) need(gpu::SCENE_HAS_SEGMENTS);
        _geometries[slot]->setView(*view);
    }

    void setInstances(const InstanceView& instances) override {
        _records = instances.records;
        _keys = instances.keys;
        _keysAddress = instances.keysAddress;
        _instancesChanged = true;
    }

    void commit() override {
        const FlushDenormals flush;
        std::vector<BvhGeometry*> changed;
        for (const auto& g : _geometries)
            if (g && g->changed()) changed.push_back(g.get());
        for (BvhGeometry* g : changed)
            g->fetch(_device);
        tbb::parallel_for(size_t(0), changed.size(), [&](size_t i) {
            const FlushDenormals flushThere;
            changed[i]->prepare();
        });
        for (BvhGeometry* g : changed)
            g->send(_device);
        if (_instancesChanged) buildTop();
        _instancesChanged = false;
    }

    VkDeviceAddress sceneAddress() const override { return _instances.address(); }

private:
    /// Has kernels know of a feature, which others need no code for.
    void need(uint32_t feature) {
        if (_features & feature) return;
        _features |= feature;
        _nearest = nearestKernel(_device, _features);
        _occluded = occludedKernel(_device, _features);
    }

    const BvhGeometry* geometry(uint32_t slot) const {
        return slot < _geometries.size() ? _geometries[slot].get() : nullptr;
    }

    void buildTop() {
        InstanceTable table = makeInstanceTable({_records, _keys}, [this](uint32_t slot) {
            const BvhGeometry* g = geometry(slot);
            return g ? g->shape() : SlotShape{};
        });
        if (table.culls) need(gpu::SCENE_HAS_CULLING);
        std::vector<Bounds> boxes;
        std::vector<uint32_t> instances; // with a mask
        for (uint32_t i = 0; i < table.records.size(); ++i) {
            gpu::BvhInstance& record = table.records[i];
            if (!record.mask) continue;
            const BvhGeometry* g = geometry(_records[i].geometry);
            record.nodes = g->nodes();
            record.triangles = g->triangles();
            boxes.push_back({record.lo, record.hi});
            instances.push_back(i);
        }
        Bvh top = buildBvh(boxes, {1, gpu::BVH_MAX_INSTANCE_DEPTH, 1.0f});
        auto pointAtInstance = [&](uint32_t& child) {
            if (child != gpu::BVH_EMPTY && (child & gpu::BVH_LEAF))
                child = (child & ~gpu::BVH_FIRST_MASK) | instances[top.order[child & gpu::BVH_FIRST_MASK]];
        };
        for (gpu::BvhNode& n : top.nodes) {
            pointAtInstance(n.child0);
            pointAtInstance(n.child1);
        }
        _instances.send(_device, table, top.nodes, _keysAddress);
    }

    Device& _device;
    std::vector<std::unique_ptr<BvhGeometry>> _geometries; ///< by slot; null: free
    std::vector<gpu::InstanceRecord> _records;
    std::vector<glm::mat4x3> _keys; ///< of moving instances
    VkDeviceAddress _keysAddress = 0;
    DeviceInstances _instances;
    bool _instancesChanged = true;
    uint32_t _features = 0; ///< SCENE_HAS_* that the kernels know of
};

} // namespace

std::unique_ptr<Traversal> createBvhTraversal(Device& device) {
    return std::make_unique<BvhTraversal>(device);
}

} // namespace hipr
