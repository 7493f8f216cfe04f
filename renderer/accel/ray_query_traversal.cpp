#include "renderer/accel/ray_query_traversal.h"

#include <stdexcept>
#include <string>

#include "hipr_accel_kernels.h"
#include "renderer/accel/device_instances.h"
#include "renderer/accel/device_traversal.h"
#include "renderer/accel/geometry_bounds.h"
#include "renderer/accel/geometry_slots.h"
#include "renderer/accel/ray_query_structures.h"
#include "shaders/shared/intersect.h"

namespace hipr {
namespace {

struct RayQueryGeometry {
    GeometryView view{};
    Bounds bounds;
    std::unique_ptr<RayQueryStructure> structure; ///< null: nothing in it
    Buffer boxes;                                 ///< of segments, until they are built
    bool changed = false;
};

VkAccelerationStructureInstanceKHR deviceInstance(const gpu::InstanceRecord& record,
                                                  const gpu::BvhInstance& box, VkDeviceAddress structure) {
    VkAccelerationStructureInstanceKHR out{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            out.transform.matrix[row][column] = record.objectToWorld[column][row];
    out.mask = box.mask;
    out.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
    if (!box.culled) out.flags |= VK_GEOMETRY_INSTANCE_FORCE_OPAQUE_BIT_KHR;
    out.accelerationStructureReference = box.mask ? structure : 0; // 0: inactive
    return out;
}

/// The driver's box test does not know the allowance of canonical hits (boxRay), so boxes get it built in,
/// four times over for origins outside the geometry.
std::vector<VkAabbPositionsKHR> segmentBoxes(const RayQueryGeometry& g) {
    const float m = 4.0f * gpu::BOX_ALLOWANCE * g.bounds.extent();
    std::vector<VkAabbPositionsKHR> boxes;
    boxes.reserve(g.view.triangleCount);
    for (const Bounds& b : primitiveBoxes(g.view))
        boxes.push_back({b.lo.x - m, b.lo.y - m, b.lo.z - m, b.hi.x + m, b.hi.y + m, b.hi.z + m});
    return boxes;
}

class RayQueryTraversal final : public DeviceTraversal {
public:
    explicit RayQueryTraversal(Device& device)
        : DeviceTraversal(Kernel(device, spirv::rayQueryNearest_spv, spirv::rayQueryNearest_spv_size,
                                 sizeof(gpu::TracePush), "rayQueryNearest", true),
                          Kernel(device, spirv::rayQueryOccluded_spv, spirv::rayQueryOccluded_spv_size,
                                 sizeof(gpu::TracePush), "rayQueryOccluded", true)),
          _device(device), _functions(device) {}

    void setGeometry(uint32_t slot, const GeometryView* view) override {
        setSlot(_geometries, slot, view);
        _instancesChanged = true; // boxes of instances follow their geometry
    }

    bool knowsTime() const override { return false; } // Vulkan has no motion but in vendors' extensions

    void setInstances(const InstanceView& instances) override {
        _records = instances.records;
        _instancesChanged = true;
    }

    void commit() override {
        std::vector<RayQueryStructure*> builds;
        for (const auto& g : _geometries)
            if (g && g->changed) planGeometry(*g, builds);
        buildStructures(_device, builds);
        for (const auto& g : _geometries)
            if (g) g->boxes = {};
        if (_instancesChanged) buildTop();
        _instancesChanged = false;
    }

    VkDeviceAddress sceneAddress() const override { return _instances.address(); }

private:
    void planGeometry(RayQueryGeometry& g, std::vector<RayQueryStructure*>& builds) {
        g.changed = false;
        g.bounds = geometryBounds(g.view);
        if (g.view.triangleCount == 0) {
            g.structure.reset();
            return;
        }
        if (!g.structure) g.structure = std::make_unique<RayQueryStructure>(_device, _functions);
        if (g.view.segments) {
            const std::vector<VkAabbPositionsKHR> boxes = segmentBoxes(g);
            g.boxes = _device.createFrom(boxes.data(), boxes.size(), "acceleration scratch");
            g.structure->planSegments(g.view, g.boxes.address());
        } else {
            g.structure->planTriangles(g.view);
        }
        builds.push_back(g.structure.get());
    }

    const RayQueryGeometry* geometry(uint32_t slot) const {
        return slot < _geometries.size() ? _geometries[slot].get() : nullptr;
    }

    void buildTop() {
        if (_records.size() >= 1u << 24)
            throw std::runtime_error(std::to_string(_records.size()) +
                                     " instances are too many for ray query");
        const InstanceTable table = makeInstanceTable({_records, {}}, [this](uint32_t slot) {
            const RayQueryGeometry* g = geometry(slot);
            return g ? slotShape(g->view, g->bounds) : SlotShape{};
        });
        std::vector<VkAccelerationStructureInstanceKHR> instances(_records.size());
        for (size_t i = 0; i < _records.size(); ++i) {
            const RayQueryGeometry* g = geometry(_records[i].geometry);
            instances[i] = deviceInstance(_records[i], table.records[i],
                                          g && g->structure ? g->structure->address() : 0);
        }
        const Buffer input = _device.createFrom(instances.data(), instances.size(), "acceleration scratch");
        _top.planInstances(input.address(), uint32_t(instances.size()));
        buildStructures(_device, {&_top});
        _nearest.setTlas(_top.handle());
        _occluded.setTlas(_top.handle());
        _instances.send(_device, table, {}, 0);
    }

    Device& _device;
    RayQueryFunctions _functions;
    std::vector<std::unique_ptr<RayQueryGeometry>> _geometries; ///< by slot; null: free
    std::vector<gpu::InstanceRecord> _records;
    RayQueryStructure _top{_device, _functions};
    DeviceInstances _instances;
    bool _instancesChanged = true;
};

} // namespace

std::unique_ptr<Traversal> createRayQueryTraversal(Device& device) {
    return std::make_unique<RayQueryTraversal>(device);
}

} // namespace hipr
