/// @file primvars.h
/// Hydra values -> the renderer's primvars.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include <glm/glm.hpp>

#include "pxr/base/tf/token.h"
#include "pxr/base/vt/array.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/enums.h"
#include "pxr/imaging/hd/sceneDelegate.h"
#include "pxr/pxr.h"
#include "renderer/api/types.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// Numbers of any kind (half, float, double, bool, integers; scalars and 2..4-vectors; arrays and single
/// values) as floats. Returns nothing for other types (text, matrices) and for empty arrays. The
/// interpolation is not set.
std::optional<hipr::Primvar> toPrimvar(TfToken const& name, VtValue const& value);

/// A number, which counts for all three channels, or the first three of a vector. Nothing for other types and
/// where one of them is not finite.
std::optional<glm::vec3> toColor(TfToken const& name, VtValue const& value);

/// Varying becomes Vertex (Primvar::linear tells them apart). Nothing for instance-rate primvars, which
/// travel with the instances.
std::optional<hipr::Interpolation> toInterpolation(HdInterpolation interpolation);

/// Which of several descriptors of one primvar is meant. UsdImaging of 20.08 adds one when the interpolation
/// changes and keeps those of before.
class DescriptorChoice {
public:
    /// `same`: at least one, of one primvar, which is used with the interpolation `now`, if at all. `fits`:
    /// for each whether the primvar has the right number of values. Prefers what fits, then what has not been
    /// turned down before, then what is new.
    HdPrimvarDescriptor const& choose(HdPrimvarDescriptorVector const& same, std::vector<bool> const& fits,
                                      std::optional<HdInterpolation> now);

private:
    std::set<std::pair<TfToken, HdInterpolation>> _outdated;
};

/// Descriptors in groups of one name each; one group holds several only as above.
std::vector<HdPrimvarDescriptorVector> byName(HdPrimvarDescriptorVector const& descriptors);

/// Appends the elements of an array of T, each made a value of the renderer by `convert`. Returns whether it
/// is one.
template <class T, class Out, class Convert>
bool appendArray(VtValue const& value, std::vector<Out>& out, Convert convert) {
    if (!value.IsHolding<VtArray<T>>()) {
        return false;
    }
    VtArray<T> const& array = value.UncheckedGet<VtArray<T>>();
    out.reserve(out.size() + array.size());
    for (T const* v = array.cdata(); v != array.cdata() + array.size(); ++v) {
        out.push_back(convert(*v));
    }
    return true;
}

bool finite(glm::vec3 const& v);

/// An array of triples of single, double or half precision. Empty when the value holds none.
std::vector<glm::vec3> toVec3s(VtValue const& value);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
