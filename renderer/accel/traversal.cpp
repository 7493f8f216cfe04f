#include "renderer/accel/traversal.h"

#include <stdexcept>

#include "renderer/accel/embree_traversal.h"

namespace hipr {

std::unique_ptr<Traversal> createTraversal(TraversalKind kind, Device& device) {
    if (kind != TraversalKind::Embree) throw std::runtime_error("this build traces rays with Embree only");
    if (!device.hostMemory())
        throw std::runtime_error(
            "Embree traces on the host and needs a device whose memory the host can read (a CPU "
            "device); " +
            device.info().name + " has its own");
    return createEmbreeTraversal();
}

TraversalKind defaultTraversal(const Device&) {
    return TraversalKind::Embree;
}

} // namespace hipr
