#include "plugin/record/mergeLayer.h"

#include <algorithm>

#include "pxr/base/vt/dictionary.h"
#include "pxr/usd/sdf/copyUtils.h"
#include "pxr/usd/sdf/listOp.h"
#include "pxr/usd/sdf/payload.h"
#include "pxr/usd/sdf/reference.h"
#include "pxr/usd/sdf/schema.h"
#include "pxr/usd/sdf/types.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

namespace {

VtDictionary combined(const VtDictionary& strong, const VtDictionary& weak) {
    return VtDictionaryOverRecursive(strong, weak);
}

SdfVariantSelectionMap combined(SdfVariantSelectionMap strong, const SdfVariantSelectionMap& weak) {
    strong.insert(weak.begin(), weak.end());
    return strong;
}

SdfTimeSampleMap combined(SdfTimeSampleMap strong, const SdfTimeSampleMap& weak) {
    strong.insert(weak.begin(), weak.end());
    return strong;
}

template <class T> SdfListOp<T> combined(const SdfListOp<T>& strong, const SdfListOp<T>& weak) {
    const auto both = strong.ApplyOperations(weak);
    return both ? *both : strong; // added and reordered items cannot be combined in general
}

/// Combines the values if they are of type T.
template <class T> bool combineAs(const VtValue& strong, const VtValue& weak, VtValue& result) {
    if (!strong.IsHolding<T>() || !weak.IsHolding<T>()) return false;
    result = VtValue(combined(strong.UncheckedGet<T>(), weak.UncheckedGet<T>()));
    return true;
}

template <class... Types> bool combineAsAny(const VtValue& strong, const VtValue& weak, VtValue& result) {
    return (combineAs<Types>(strong, weak, result) || ...);
}

/// A field's value after the merge, where both layers have one.
VtValue merged(const TfToken& field, const VtValue& strong, const VtValue& weak) {
    if (field == SdfFieldKeys->Specifier && strong == SdfSpecifierOver) return weak;
    VtValue result = strong;
    combineAsAny<VtDictionary, SdfVariantSelectionMap, SdfTimeSampleMap, SdfTokenListOp, SdfPathListOp,
                 SdfStringListOp, SdfReferenceListOp, SdfPayloadListOp, SdfIntListOp, SdfUIntListOp,
                 SdfInt64ListOp, SdfUInt64ListOp, SdfUnregisteredValueListOp>(strong, weak, result);
    return result;
}

/// Children of both specs, those of the destination first; a child that is not copied is an empty name in
/// `source`.
template <class T>
bool mergeChildren(const VtValue& strong, const VtValue& weak, VtValue& source, VtValue& all) {
    if (!strong.IsHolding<std::vector<T>>() || !weak.IsHolding<std::vector<T>>()) return false;
    std::vector<T> result = weak.UncheckedGet<std::vector<T>>(), copied(result.size());
    for (const T& child : strong.UncheckedGet<std::vector<T>>()) {
        const size_t at = size_t(std::find(result.begin(), result.end(), child) - result.begin());
        if (at == result.size()) {
            result.push_back(child);
            copied.emplace_back();
        }
        copied[at] = child;
    }
    source = VtValue::Take(copied);
    all = VtValue::Take(result);
    return true;
}

} // namespace

void mergeLayer(const SdfLayerHandle& from, const SdfLayerHandle& into) {
    // The optional that SdfCopySpec hands over is boost's or the standard library's, by version.
    const auto value = [](SdfSpecType, const TfToken& field, const SdfLayerHandle& source,
                          const SdfPath& path, bool inSource, const SdfLayerHandle& target,
                          const SdfPath& targetPath, bool inTarget, auto* copied) {
        if (!inSource) // true takes the field away
            return field == SdfFieldKeys->TimeSamples && source->HasField(path, SdfFieldKeys->Default);
        if (inTarget)
            *copied = merged(field, source->GetField(path, field), target->GetField(targetPath, field));
        return true;
    };
    const auto children = [](const TfToken& field, const SdfLayerHandle& source, const SdfPath& path,
                             bool inSource, const SdfLayerHandle& target, const SdfPath& targetPath,
                             bool inTarget, auto* copied, auto* all) {
        if (!inSource || !inTarget) return inSource;
        const VtValue strong = source->GetField(path, field), weak = target->GetField(targetPath, field);
        VtValue sourceNames, allNames;
        if (!mergeChildren<TfToken>(strong, weak, sourceNames, allNames) &&
            !mergeChildren<SdfPath>(strong, weak, sourceNames, allNames))
            return false;
        *copied = sourceNames;
        *all = allNames;
        return true;
    };
    const SdfPath root = SdfPath::AbsoluteRootPath();
    SdfCopySpec(from, root, into, root, value, children);
}

} // namespace hipr::record
