/// @file lists.h
/// What --list-cameras and its kin print.
#pragma once

#include "plugin/record/options.h"

namespace hipr::record {

/// Prints the lists that the options ask for. Throws Failure.
void printLists(const Options& options);

} // namespace hipr::record
