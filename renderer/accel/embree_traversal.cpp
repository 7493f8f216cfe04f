#include "renderer/accel/embree_traversal.h"

#include <stdexcept>

#include "renderer/accel/embree_query.h"
#include "renderer/accel/host_rays.h"

namespace hipr {
namespace {

class EmbreeTraversal final : public Traversal {
public:
    EmbreeTraversal() : _scene(embreeCallbacks()) {}

    void setGeometry(uint32_t slot, const GeometryView* view) override { _scene.setGeometry(slot, view); }
    void setInstances(const InstanceView& instances) override { _scene.setInstances(instances); }
    void commit() override { _scene.commit(); }
    bool onHost() const override { return true; }
    uint64_t hostBytes() const override { return _scene.bytes(); }

    void nearest(const TraceQueue& queue) override {
        auto* hits = queue.results->mapped<gpu::Hit>();
        forRays(queue, [&](uint32_t first, uint32_t count, const gpu::Ray* rays) {
            embreeNearest(_scene, queue.mask, rays, count, hits + first);
        });
    }

    void occluded(const TraceQueue& queue) override {
        auto* blocked = queue.results->mapped<uint32_t>();
        forRays(queue, [&](uint32_t first, uint32_t count, const gpu::Ray* rays) {
            embreeOccluded(_scene, queue.mask, rays, count, blocked + first);
        });
    }

    void recordNearest(VkCommandBuffer, VkDeviceAddress, const TraceQueue&) override { recordingIsWrong(); }
    void recordOccluded(VkCommandBuffer, VkDeviceAddress, const TraceQueue&) override { recordingIsWrong(); }

private:
    [[noreturn]] static void recordingIsWrong() {
        throw std::logic_error(
            "Embree traces between submissions; it cannot be recorded into a command buffer");
    }

    EmbreeScene _scene;
};

} // namespace

std::unique_ptr<Traversal> createEmbreeTraversal() {
    return std::make_unique<EmbreeTraversal>();
}

} // namespace hipr
