#include "plugin/mtlxFile/prims.h"

#include "pxr/base/tf/stringUtils.h"
#include "pxr/usd/sdf/listOp.h"
#include "pxr/usd/sdf/primSpec.h"
#include "pxr/usd/sdf/reference.h"
#include "pxr/usd/sdf/relationshipSpec.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

SdfPath PrimWriter::child(SdfPath const& parent, std::string const& name) {
    return parent.AppendChild(TfToken(TfMakeValidIdentifier(name)));
}

bool PrimWriter::define(SdfPath const& path, char const* type) {
    if (has(path)) {
        return false;
    }
    const SdfPath parent = path.GetParentPath();
    if (parent.IsAbsoluteRootPath()) {
        SdfPrimSpec::New(_layer, path.GetName(), SdfSpecifierDef, type);
    } else {
        SdfPrimSpec::New(_layer->GetPrimAtPath(parent), path.GetName(), SdfSpecifierDef, type);
    }
    return true;
}

void PrimWriter::over(SdfPath const& path) {
    SdfPrimSpec::New(_layer->GetPrimAtPath(path.GetParentPath()), path.GetName(), SdfSpecifierOver);
}

void PrimWriter::reference(SdfPath const& path, SdfPath const& target) {
    _layer->GetPrimAtPath(path)->GetReferenceList().GetPrependedItems().push_back(SdfReference("", target));
}

void PrimWriter::apiSchema(SdfPath const& path, std::string const& schema) {
    const SdfPrimSpecHandle prim = _layer->GetPrimAtPath(path);
    const TfToken key("apiSchemas");
    SdfTokenListOp list = prim->GetInfo(key).GetWithDefault<SdfTokenListOp>();
    TfTokenVector names = list.GetPrependedItems();
    names.emplace_back(schema);
    list.SetPrependedItems(names);
    prim->SetInfo(key, VtValue(list));
}

SdfAttributeSpecHandle PrimWriter::attribute(SdfPath const& path, SdfValueTypeName const& type,
                                             SdfVariability variability) {
    if (const SdfAttributeSpecHandle found = _layer->GetAttributeAtPath(path)) {
        return found;
    }
    return SdfAttributeSpec::New(_layer->GetPrimAtPath(path.GetPrimPath()), path.GetName(), type,
                                 variability);
}

void PrimWriter::uniform(SdfPath const& prim, char const* name, VtValue const& value) {
    attribute(prim.AppendProperty(TfToken(name)), SdfValueTypeNames->Token, SdfVariabilityUniform)
        ->SetDefaultValue(value);
}

void PrimWriter::connect(SdfPath const& from, SdfPath const& to) {
    SdfConnectionsProxy connections = _layer->GetAttributeAtPath(from)->GetConnectionPathList();
    connections.ClearEditsAndMakeExplicit();
    connections.Add(to);
}

void PrimWriter::relate(SdfPath const& path, SdfPathVector const& targets) {
    const SdfRelationshipSpecHandle relation = SdfRelationshipSpec::New(
        _layer->GetPrimAtPath(path.GetPrimPath()), path.GetName(), /*custom*/ false, SdfVariabilityUniform);
    relation->GetTargetPathList().ClearEditsAndMakeExplicit();
    for (SdfPath const& target : targets) {
        relation->GetTargetPathList().Add(target);
    }
}

void PrimWriter::finish() {
    for (auto const& [path, type] : _later) {
        if (_layer->GetPrimAtPath(path.GetPrimPath())) {
            attribute(path, type);
        }
    }
    _later.clear();
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
