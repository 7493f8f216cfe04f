#include "renderer/accel/host_traversal.h"

#include <stdexcept>

#include "renderer/accel/geometry_slots.h"
#include "renderer/accel/host_rays.h"
#include "renderer/accel/instance_table.h"
#include "renderer/accel/wide_walk.h"

namespace hipr {
namespace {

/// A geometry slot and its tree.
struct HostGeometry {
    GeometryView view{};
    WideTree tree;
    bool changed = false;
};

class HostTraversal final : public Traversal {
public:
    void setGeometry(uint32_t slot, const GeometryView* view) override {
        setSlot(_geometries, slot, view);
        _instancesChanged = true; // boxes of instances follow their geometry
    }

    void setInstances(const InstanceView& instances) override {
        _records = instances.records;
        _keys = instances.keys;
        _instancesChanged = true;
    }

    void commit() override {
        const FlushDenormals flush;
        std::vector<HostGeometry*> changed;
        for (const auto& g : _geometries)
            if (g && g->changed) changed.push_back(g.get());
        tbb::parallel_for(size_t(0), changed.size(), [&](size_t i) {
            const FlushDenormals flushThere;
            HostGeometry& g = *changed[i];
            g.changed = false;
            if (!g.view.sameTopology || !g.tree.refit(g.view)) g.tree.build(g.view);
        });
        if (_instancesChanged) buildTop();
        _instancesChanged = false;
    }

    bool onHost() const override { return true; }

    uint64_t hostBytes() const override {
        uint64_t bytes = _top.bytes();
        for (const auto& g : _geometries)
            if (g) bytes += g->tree.bytes();
        return bytes;
    }

    void nearest(const TraceQueue& queue) override {
        auto* hits = queue.results->mapped<gpu::Hit>();
        forRays(queue, [&](uint32_t first, uint32_t count, const gpu::Ray* rays) {
            _walk.nearest(_scene, queue.mask, rays, count, hits + first);
        });
    }

    void occluded(const TraceQueue& queue) override {
        auto* blocked = queue.results->mapped<uint32_t>();
        forRays(queue, [&](uint32_t first, uint32_t count, const gpu::Ray* rays) {
            _walk.occluded(_scene, queue.mask, rays, count, blocked + first);
        });
    }

    void recordNearest(VkCommandBuffer, VkDeviceAddress, const TraceQueue&) override { recordingIsWrong(); }
    void recordOccluded(VkCommandBuffer, VkDeviceAddress, const TraceQueue&) override { recordingIsWrong(); }

private:
    const HostGeometry* geometry(uint32_t slot) const {
        return slot < _geometries.size() ? _geometries[slot].get() : nullptr;
    }

    void buildTop() {
        _table = makeInstanceTable({_records, _keys}, [this](uint32_t slot) {
            const HostGeometry* g = geometry(slot);
            return g ? slotShape(g->view, g->tree.bounds()) : SlotShape{};
        });
        std::vector<Bounds> boxes;
        std::vector<uint32_t> instances; // with a mask
        for (uint32_t i = 0; i < _table.records.size(); ++i) {
            gpu::BvhInstance& record = _table.records[i];
            if (!record.mask) continue;
            record.nodes = reinterpret_cast<uint64_t>(geometry(_records[i].geometry)->tree.units());
            boxes.push_back({record.lo, record.hi});
            instances.push_back(i);
        }
        _top.build(boxes, instances);
        _scene = {_table.records.data(), uint32_t(_table.records.size()), _table.extent, _top.units(),
                  _table.keys.data()};
    }

    [[noreturn]] static void recordingIsWrong() {
        throw std::logic_error(
            "the host traces between submissions; it cannot be recorded into a command buffer");
    }

    const WideWalk& _walk = *wideWalks().front();
    std::vector<std::unique_ptr<HostGeometry>> _geometries; ///< by slot; null: free
    std::vector<gpu::InstanceRecord> _records;
    std::vector<glm::mat4x3> _keys; ///< of moving instances
    InstanceTable _table;
    WideTree _top;
    WideScene _scene{};
    bool _instancesChanged = true;
};

} // namespace

std::unique_ptr<Traversal> createHostTraversal() {
    return std::make_unique<HostTraversal>();
}

} // namespace hipr
