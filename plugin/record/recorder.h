/// @file recorder.h
/// A whole recording: stage, renderer, frames, files.
#pragma once

#include <atomic>

#include "plugin/record/failure.h"
#include "plugin/record/options.h"

namespace hipr::record {

/// Makes hiprrecord's own plugins known to OpenUSD: those beside the program, in ../plugin/usd.
void registerPlugins();

/// Does what the options say. `interrupted` may be raised by a signal handler: the frame so far is then
/// written. Returns ExitOk or ExitInterrupted; throws Failure for everything else.
ExitCode record(const Options& options, const std::atomic<bool>& interrupted);

} // namespace hipr::record
