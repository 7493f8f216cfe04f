/// @file messages.h
/// The delegate's voice: warnings through Tf, each text about each prim only once.
#pragma once

#include <string>

#include "pxr/pxr.h"
#include "renderer/api/types.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// Warnings and errors become Tf warnings ("<prim>: text"): a Tf error would raise an exception in a Python
/// host for what is a fault of the scene. Information is shown when TF_DEBUG holds HDHIPR_INFO. A text that
/// was already given for the same subject is not repeated. Thread-safe.
void report(hipr::Severity severity, const std::string& subject, const std::string& text);

inline void warnOnce(const std::string& subject, const std::string& text) {
    report(hipr::Severity::Warning, subject, text);
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
