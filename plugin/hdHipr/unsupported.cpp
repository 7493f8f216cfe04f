#include "plugin/hdHipr/unsupported.h"

#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/motion.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

void warnOfMotion(HdSceneDelegate& delegate, SdfPath const& id, TfToken const& points,
                  hipr::InstanceMotion const& motion) {
    if (!motion.times.empty() || samplePrimvar(delegate, id, points).moves()) {
        warnOnce(id.GetString(),
                 "it moves while the camera's shutter is open, and splats are not blurred; they "
                 "stand still where they are at the frame's time");
    }
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
