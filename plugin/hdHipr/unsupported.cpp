#include "plugin/hdHipr/unsupported.h"

#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/motion.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

void warnOfMotion(HdSceneDelegate& delegate, SdfPath const& id, TfToken const& points) {
    if (samplePrimvar(delegate, id, points).moves()) {
        warnOnce(
            id.GetString(),
            "its splats move on their own while the camera's shutter is open, which is not blurred; they "
            "stand where they are at the frame's time");
    }
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
