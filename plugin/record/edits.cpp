#include "plugin/record/edits.h"

#include <algorithm>

#include "plugin/record/failure.h"
#include "plugin/record/mergeLayer.h"
#include "plugin/record/usdaText.h"
#include "pxr/base/tf/error.h"
#include "pxr/base/tf/errorMark.h"
#include "pxr/base/tf/notice.h"
#include "pxr/base/tf/stringUtils.h"
#include "pxr/base/tf/weakBase.h"
#include "pxr/usd/pcp/node.h"
#include "pxr/usd/pcp/primIndex.h"
#include "pxr/usd/sdf/attributeSpec.h"
#include "pxr/usd/sdf/layerUtils.h"
#include "pxr/usd/sdf/namespaceEdit.h"
#include "pxr/usd/sdf/primSpec.h"
#include "pxr/usd/sdf/relationshipSpec.h"
#include "pxr/usd/usd/editContext.h"
#include "pxr/usd/usd/notice.h"
#include "pxr/usd/usd/prim.h"
#include "pxr/usd/usd/variantSets.h"
#include "pxr/usd/usdUtils/dependencies.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

namespace {

const char* const layerName = "hiprEdits.usda";

/// Hears whether the stage changes while it lives.
class ChangeListener : public TfWeakBase {
public:
    explicit ChangeListener(const UsdStageRefPtr& stage)
        : _key(TfNotice::Register(TfCreateWeakPtr(this), &ChangeListener::onChange, UsdStageWeakPtr(stage))) {
    }
    ~ChangeListener() { TfNotice::Revoke(_key); }
    bool heard() const { return _heard; }

private:
    void onChange(const UsdNotice::ObjectsChanged&) { _heard = true; }
    bool _heard = false;
    TfNotice::Key _key;
};

class Application {
public:
    Application(const UsdStageRefPtr& stage, const Edit& edit)
        : _stage(stage), _edit(edit), _layer(editLayer(stage)) {}
    void run();

private:
    [[noreturn]] void fail(const std::string& why) const {
        throw Failure(ExitUsage, _edit.title() + ": " + why);
    }
    UsdPrim prim(const SdfPath& path) const;
    void requireOwn(const SdfPath& path, const char* verb) const;
    std::string findLayer(const std::string& identifier) const;
    void muteLayers();
    void rename(const SdfPath& from, const SdfPath& to);
    void retarget(const SdfLayerHandle& layer, const SdfPath& from, const SdfPath& to);
    void remove(const SdfPath& path);
    void change(const SdfLayerHandle& layer, const SdfNamespaceEdit& namespaceEdit);
    void merge();
    void select(const Edit::Variant& variant);

    UsdStageRefPtr _stage;
    const Edit& _edit;
    SdfLayerRefPtr _layer;
};

std::string text(const SdfPath& path) {
    return "<" + path.GetString() + ">";
}

/// Whether an arc of a prim has an opinion about it, or one of the arcs behind it has.
bool bringsIn(const PcpNodeRef& arc) {
    if (arc.HasSpecs()) return true;
    const auto [first, end] = arc.GetChildrenRange();
    return std::any_of(first, end, bringsIn);
}

void Application::run() {
    if (!_edit.mute.empty() || !_edit.unmute.empty()) muteLayers();
    for (const auto& [from, to] : _edit.rename)
        rename(from, to);
    for (const SdfPath& path : _edit.remove)
        remove(path);
    if (!_edit.usda.empty()) merge();
    const UsdEditContext context(_stage, UsdEditTarget(_layer));
    for (const Edit::Variant& variant : _edit.variants)
        select(variant);
    for (const SdfPath& path : _edit.deactivate)
        prim(path).SetActive(false);
    for (const SdfPath& path : _edit.activate)
        prim(path).SetActive(true);
}

UsdPrim Application::prim(const SdfPath& path) const {
    const UsdPrim found = _stage->GetPrimAtPath(path);
    if (!found) fail("there is no prim " + text(path));
    if (found.IsInstanceProxy()) fail(text(path) + " is inside an instance, which cannot be edited");
    return found;
}

/// Prims that an ancestor's reference, payload, inherit or variant brings in would come back. What the prim's
/// own arcs bring in goes with them.
void Application::requireOwn(const SdfPath& path, const char* verb) const {
    const auto [first, end] = prim(path).GetPrimIndex().GetRootNode().GetChildrenRange();
    const auto fromAbove = [](const PcpNodeRef& arc) { return arc.IsDueToAncestor() && bringsIn(arc); };
    if (std::any_of(first, end, fromAbove))
        fail(text(path) + " is brought in by a reference, payload, inherit or variant and cannot be " + verb +
             "; deactivate it instead");
}

std::string Application::findLayer(const std::string& identifier) const {
    std::vector<std::string> known = _stage->GetMutedLayers();
    for (const SdfLayerHandle& layer : _stage->GetUsedLayers())
        known.push_back(layer->GetIdentifier());
    const auto exact = std::find(known.begin(), known.end(), identifier);
    if (exact != known.end()) return *exact;
    std::vector<std::string> matches;
    const std::string ending = "/" + TfStringTrimLeft(identifier, "./");
    std::copy_if(known.begin(), known.end(), std::back_inserter(matches),
                 [&](const std::string& name) { return TfStringEndsWith(name, ending); });
    if (matches.size() == 1) return matches.front();
    const char* const problem = matches.empty() ? "the stage uses no layer '" : "several layers are called '";
    fail(problem + identifier + "'. Layers: " + TfStringJoin(matches.empty() ? known : matches, ", "));
}

void Application::muteLayers() {
    std::vector<std::string> mute, unmute;
    for (const std::string& identifier : _edit.mute) {
        mute.push_back(findLayer(identifier));
        if (mute.back() == _stage->GetRootLayer()->GetIdentifier()) fail("the root layer cannot be muted");
    }
    for (const std::string& identifier : _edit.unmute)
        unmute.push_back(findLayer(identifier));
    _stage->MuteAndUnmuteLayers(mute, unmute);
}

void Application::change(const SdfLayerHandle& layer, const SdfNamespaceEdit& namespaceEdit) {
    SdfBatchNamespaceEdit batch;
    batch.Add(namespaceEdit);
    if (!layer->Apply(batch))
        fail("layer " + layer->GetIdentifier() + " does not let " + text(namespaceEdit.currentPath) +
             " change");
}

void Application::rename(const SdfPath& from, const SdfPath& to) {
    requireOwn(from, "renamed");
    if (_stage->GetPrimAtPath(to)) fail("there is a prim " + text(to) + " already");
    if (to.HasPrefix(from)) fail(text(from) + " cannot move below itself");
    if (!to.GetParentPath().IsAbsoluteRootPath()) prim(to.GetParentPath());
    for (const SdfLayerHandle& layer : _stage->GetLayerStack()) {
        if (layer->GetPrimAtPath(from)) {
            SdfCreatePrimInLayer(layer, to.GetParentPath());
            change(layer, SdfNamespaceEdit(from, to));
        }
        retarget(layer, from, to);
    }
}

void Application::retarget(const SdfLayerHandle& layer, const SdfPath& from, const SdfPath& to) {
    std::vector<SdfPath> properties;
    layer->Traverse(SdfPath::AbsoluteRootPath(), [&](const SdfPath& path) {
        if (path.IsPrimPropertyPath()) properties.push_back(path);
    });
    const auto follow = [&](const SdfPath& target) { return target.ReplacePrefix(from, to); };
    for (const SdfPath& path : properties) {
        if (const SdfRelationshipSpecHandle relationship = layer->GetRelationshipAtPath(path))
            relationship->GetTargetPathList().ModifyItemEdits(follow);
        else if (const SdfAttributeSpecHandle attribute = layer->GetAttributeAtPath(path))
            attribute->GetConnectionPathList().ModifyItemEdits(follow);
    }
}

void Application::remove(const SdfPath& path) {
    requireOwn(path, "removed");
    for (const SdfLayerHandle& layer : _stage->GetLayerStack())
        if (layer->GetPrimAtPath(path)) change(layer, SdfNamespaceEdit::Remove(path));
}

void Application::merge() {
    TfErrorMark errors;
    const SdfLayerRefPtr snippet = SdfLayer::CreateAnonymous(layerName);
    if (!snippet->ImportFromString(completeUsda(_edit.usda)) || !errors.IsClean()) {
        std::string why = "its usda cannot be read";
        for (const TfError& error : errors)
            why += ": " + TfStringTrim(error.GetCommentary());
        errors.Clear();
        fail(why);
    }
    const SdfLayerHandle root = _stage->GetRootLayer();
    UsdUtilsModifyAssetPaths(snippet, [&](const std::string& path) {
        return path.empty() ? path : SdfComputeAssetPathRelativeToLayer(root, path);
    });
    mergeLayer(snippet, _layer);
}

void Application::select(const Edit::Variant& variant) {
    UsdVariantSets sets = prim(variant.prim).GetVariantSets();
    if (!sets.HasVariantSet(variant.set))
        fail(text(variant.prim) + " has no variant set '" + variant.set + "'");
    UsdVariantSet set = sets.GetVariantSet(variant.set);
    const std::vector<std::string> names = set.GetVariantNames();
    if (!variant.selection.empty() && std::find(names.begin(), names.end(), variant.selection) == names.end())
        fail("the variant set '" + variant.set + "' of " + text(variant.prim) + " has no variant '" +
             variant.selection + "', only: " + TfStringJoin(names, ", "));
    set.SetVariantSelection(variant.selection);
}

} // namespace

std::string Edit::title() const {
    return "edit " + std::to_string(index) + (name.empty() ? "" : " '" + name + "'");
}

SdfLayerRefPtr editLayer(const UsdStageRefPtr& stage) {
    const SdfLayerHandle session = stage->GetSessionLayer();
    for (const std::string& identifier : session->GetSubLayerPaths())
        if (SdfLayer::IsAnonymousLayerIdentifier(identifier) &&
            SdfLayer::GetDisplayNameFromIdentifier(identifier) == layerName)
            if (const SdfLayerRefPtr layer = SdfLayer::Find(identifier)) return layer;
    const SdfLayerRefPtr layer = SdfLayer::CreateAnonymous(layerName);
    session->InsertSubLayerPath(layer->GetIdentifier(), 0);
    return layer;
}

bool applyEdit(const UsdStageRefPtr& stage, const Edit& edit) {
    Application application(stage, edit);
    const ChangeListener listener(stage); // after the edit layer was made, which is no edit
    application.run();
    return listener.heard();
}

} // namespace hipr::record
