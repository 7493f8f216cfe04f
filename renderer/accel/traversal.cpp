#include "renderer/accel/traversal.h"

#include <stdexcept>

#include "renderer/accel/bvh_traversal.h"
#include "renderer/accel/embree_traversal.h"

namespace hipr {

std::unique_ptr<Traversal> createTraversal(TraversalKind kind, Device& device) {
    if (kind == TraversalKind::Bvh) return createBvhTraversal(device);
    if (kind == TraversalKind::RayQuery) throw std::runtime_error("this build has no ray query traversal");
    if (!device.hostMemory())
        throw std::runtime_error(
            "Embree traces on the host and needs a device whose memory the host can read (a "
            "CPU device); " +
            device.info().name + " has its own");
    return createEmbreeTraversal();
}

TraversalKind defaultTraversal(const Device& device) {
    return device.info().cpu && device.hostMemory() ? TraversalKind::Embree : TraversalKind::Bvh;
}

} // namespace hipr
