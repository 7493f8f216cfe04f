/// @file sampling.h
/// What prims have to know of time to sample what moves.
#pragma once

#include "pxr/imaging/hd/changeTracker.h"
#include "pxr/pxr.h"
#include "renderer/api/motion.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// What is dirty of an rprim when it has to be sampled anew.
constexpr HdDirtyBits sampledBits = HdChangeTracker::DirtyTransform | HdChangeTracker::DirtyPoints;

/// While what prims are sampled, and how fast time runs.
struct Sampling {
    hipr::Shutter shutter;         ///< of all cameras; closed: nothing is sampled
    double framesPerSecond = 24.0; ///< positive
    bool open() const { return shutter.blurs(); }
    /// From the frame's own time to another, in frames from there.
    double seconds(double time) const { return time / framesPerSecond; }
};

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
