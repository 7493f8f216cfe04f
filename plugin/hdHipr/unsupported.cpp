#include "plugin/hdHipr/unsupported.h"

#include <algorithm>

#include "plugin/hdHipr/instancer.h"
#include "plugin/hdHipr/messages.h"
#include "pxr/imaging/hd/tokens.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

/// Enough to notice motion; nothing is interpolated.
constexpr size_t samples = 4;

/// Whether read(samples, times, values), which returns how many samples there are, gives different values.
template <class Value, class Read> bool moves(Read&& read) {
    float times[samples] = {};
    Value values[samples];
    const size_t count = std::min(read(samples, times, values), samples);
    return std::any_of(values, values + count, [&](Value const& value) { return !(value == values[0]); });
}

bool primvarMoves(HdSceneDelegate& delegate, SdfPath const& id, TfToken const& name) {
    return moves<VtValue>([&](size_t most, float* times, VtValue* values) {
        return delegate.SamplePrimvar(id, name, most, times, values);
    });
}

constexpr const char* motionText = "it moves while the camera's shutter is open, and motion blur is not "
                                   "supported; it stands still where it is at the frame's time";

void warnOfInstanceMotion(HdSceneDelegate& delegate, SdfPath const& instancer) {
    bool moving = moves<GfMatrix4d>([&](size_t most, float* times, GfMatrix4d* values) {
        return delegate.SampleInstancerTransform(instancer, most, times, values);
    });
    for (HdPrimvarDescriptor const& primvar :
         delegate.GetPrimvarDescriptors(instancer, HdInterpolationInstance)) {
        moving = moving || (HdHiprInstancer::placesInstances(primvar.name) &&
                            primvarMoves(delegate, instancer, primvar.name));
    }
    if (moving) {
        warnOnce(instancer.GetString(), motionText);
    }
}

} // namespace

void warnOfCullStyle(std::string const& subject, HdCullStyle style) {
    if (style != HdCullStyleDontCare && style != HdCullStyleNothing) {
        warnOnce(subject, "culling faces by their side is not supported; all faces are drawn");
    }
}

void warnOfMotion(HdSceneDelegate& delegate, SdfPath const& id, TfToken const& points,
                  SdfPath const& instancerId) {
    const bool transform = moves<GfMatrix4d>([&](size_t most, float* times, GfMatrix4d* values) {
        return delegate.SampleTransform(id, most, times, values);
    });
    if (transform || primvarMoves(delegate, id, points)) {
        warnOnce(id.GetString(), motionText);
    }
    if (!instancerId.IsEmpty()) {
        warnOfInstanceMotion(delegate, instancerId);
    }
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
