/// @file instance_diff.h
/// Which instances of an object an edit changes.
#pragma once

#include <vector>

#include "renderer/api/scene.h"

namespace hipr {

/// `instance` is an index into the new instances; into the old ones when `change` is Removed. AllInstances
/// when an edit of primvars concerns every one of them.
struct InstanceChange {
    uint32_t instance = ChangedElement::AllInstances;
    Change change = Change::None;
};

/// What has to happen to `before` for it to become `now`, in time linear in their sizes.
///
/// Instances that only come or go, anywhere in the list, are Added or Removed and leave the others alone: to
/// be numbered anew is no change of an instance unless its InstancesDesc::instanceIds say so. Otherwise
/// instances of the same index are compared: Transform where they stand elsewhere, Primvar where a primvar
/// or the id has another value, Linking where the categories differ; the longer list's tail is Added or
/// Removed.
std::vector<InstanceChange> changedInstances(const InstancesDesc& before, const InstancesDesc& now);

/// Where a primvar holds the value of an instance, whichever way it is indexed; -1 when nowhere.
int64_t instanceValue(const Primvar& primvar, size_t instance);

} // namespace hipr
