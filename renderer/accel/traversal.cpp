#include "renderer/accel/traversal.h"

#include <stdexcept>

#include "renderer/accel/bvh_traversal.h"
#include "renderer/accel/embree_traversal.h"
#include "renderer/accel/host_traversal.h"
#include "renderer/accel/ray_query_traversal.h"

namespace hipr {

std::unique_ptr<Traversal> createTraversal(TraversalKind kind, Device& device) {
    if (kind == TraversalKind::Bvh) return createBvhTraversal(device);
    if (kind == TraversalKind::RayQuery) return createRayQueryTraversal(device);
    if (!device.hostMemory())
        throw std::runtime_error(
            "Tracing on the host needs a device whose memory the host can read (a CPU device); " +
            device.info().name + " has its own");
    return kind == TraversalKind::Host ? createHostTraversal() : createEmbreeTraversal();
}

TraversalKind defaultTraversal(const Device& device) {
    if (device.info().cpu) return device.hostMemory() ? TraversalKind::Host : TraversalKind::Bvh;
    return device.info().rayQuery ? TraversalKind::RayQuery : TraversalKind::Bvh;
}

} // namespace hipr
