#include "renderer/accel/embree_traversal.h"

#include <stdexcept>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "renderer/accel/denormals.h"
#include "renderer/accel/embree_query.h"

namespace hipr {
namespace {

constexpr uint32_t RAYS_PER_TASK = 256;

class EmbreeTraversal final : public Traversal {
public:
    EmbreeTraversal() : _scene(embreeCallbacks()) {}

    void setGeometry(uint32_t slot, const GeometryView* view) override { _scene.setGeometry(slot, view); }
    void setInstances(const std::vector<gpu::InstanceRecord>& instances) override {
        _scene.setInstances(instances);
    }
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
    template <class Function> static void forRays(const TraceQueue& queue, const Function& function) {
        const auto& header =
            *reinterpret_cast<const gpu::QueueHeader*>(queue.header->mapped<char>() + queue.headerOffset);
        const auto* rays = queue.rays->mapped<gpu::Ray>();
        tbb::parallel_for(tbb::blocked_range<uint32_t>(0, header.count, RAYS_PER_TASK),
                          [&](const auto& range) {
                              const FlushDenormals flush;
                              function(range.begin(), range.end() - range.begin(), rays + range.begin());
                          });
    }

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
