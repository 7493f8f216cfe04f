/// @file commands.h
/// What users may have the delegate do besides rendering: HdRenderDelegate::InvokeCommand of OpenUSD 21.08
/// and later.
#pragma once

#include <string>
#include <vector>

#include "pxr/base/tf/token.h"
#include "pxr/base/vt/dictionary.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprRenderParam;

namespace hdhipr {

struct Command {
    const char* name;
    const char* description; ///< for a button's tip
    VtDictionary arguments;  ///< with their defaults
    bool (*invoke)(HdHiprRenderParam& param, VtDictionary const& arguments);
};

std::vector<Command> const& commands();

/// Runs a command with the defaults of the arguments that are not given. False for one that is not in the
/// list or fails, which is told.
bool invokeCommand(HdHiprRenderParam& param, TfToken const& name, VtDictionary const& arguments);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
