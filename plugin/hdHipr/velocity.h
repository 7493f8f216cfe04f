/// @file velocity.h
/// Motion by velocities: points and instances go on from where they are at the frame's own time, as
/// UsdGeomPointBased and UsdGeomPointInstancer say, instead of lying between the samples of the stage.
/// Velocities are in units a second, accelerations in units a second squared, angular velocities in degrees a
/// second about their own direction, all in the space of what they belong to.
#pragma once

#include "plugin/hdHipr/motion.h"
#include "plugin/hdHipr/sampling.h"
#include "renderer/api/mesh.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// Positions over the shutter, from those at the frame. No samples where there are no velocities
/// or, with a message that names `id`, not one for each position. Accelerations may be missing.
Samples<VtValue> movedBy(SdfPath const& id, std::vector<glm::vec3> const& positions,
                         VtValue const& velocities, VtValue const& accelerations, Sampling const& sampling);

/// What a prim says of the velocities of its points, at the frame.
class PointVelocities {
public:
    /// A primvar was read, perhaps one of those that count here; empty: there is none.
    void read(TfToken const& primvar, VtValue const& value);
    bool any() const { return !_velocities.IsEmpty(); }
    /// Takes those that do not fit so many points out of `primvars`, and tells of them: what is made of the
    /// primvars would tell of them once more.
    std::vector<hipr::Primvar> takeUnfit(SdfPath const& id, size_t points,
                                         std::vector<hipr::Primvar>& primvars) const;
    /// Where `points` are over the shutter: by their velocities, else as the scene samples them.
    Samples<VtValue> samples(HdSceneDelegate& delegate, SdfPath const& id,
                             std::vector<glm::vec3> const& points, Sampling const& sampling) const;

private:
    VtValue _velocities, _accelerations;
};

/// Rotations (quaternions of any precision, or Hydra's old (real, i, j, k)) likewise, so close that none
/// turns by half a turn from one sample to the next.
Samples<VtValue> turnedBy(SdfPath const& id, VtValue const& rotations, VtValue const& angularVelocities,
                          Sampling const& sampling);

/// Whether a primvar of instances is one of those by which they move.
bool movesInstances(TfToken const& primvar);

/// A value at the frame's own time, of a primvar or, as UsdImaging reads it, an attribute of this name; empty
/// where there is none. Reads a sample.
VtValue valueAtFrame(HdSceneDelegate& delegate, SdfPath const& id, TfToken const& name);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
