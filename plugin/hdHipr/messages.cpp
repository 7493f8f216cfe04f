#include "plugin/hdHipr/messages.h"

#include <mutex>
#include <unordered_set>

#include "pxr/base/tf/debug.h"
#include "pxr/base/tf/diagnostic.h"
#include "pxr/base/tf/registryManager.h"

PXR_NAMESPACE_OPEN_SCOPE

TF_DEBUG_CODES(HDHIPR_INFO);

TF_REGISTRY_FUNCTION(TfDebug) {
    TF_DEBUG_ENVIRONMENT_SYMBOL(HDHIPR_INFO, "What the HiPR render delegate does and how long it takes");
}

namespace hdhipr {

namespace {

/// Remembers what was said. Bounded, so that a scene with endless faults cannot eat the host's memory.
bool isNew(const std::string& subject, const std::string& text) {
    static std::mutex mutex;
    static std::unordered_set<std::string> said;
    constexpr size_t most = 1 << 16;
    std::lock_guard<std::mutex> lock(mutex);
    return said.size() < most && said.insert(subject + '\n' + text).second;
}

} // namespace

void report(hipr::Severity severity, const std::string& subject, const std::string& text) {
    const std::string line = subject.empty() ? "HiPR: " + text : "HiPR: <" + subject + ">: " + text;
    if (severity == hipr::Severity::Info) {
        TF_DEBUG(HDHIPR_INFO).Msg("%s\n", line.c_str());
    } else if (isNew(subject, text)) {
        TF_WARN("%s", line.c_str());
    }
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
