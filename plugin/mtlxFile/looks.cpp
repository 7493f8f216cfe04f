#include "plugin/mtlxFile/looks.h"

#include "pxr/base/tf/stringUtils.h"
#include "pxr/usd/sdf/primSpec.h"
#include "pxr/usd/sdf/reference.h"
#include "pxr/usd/sdf/variantSetSpec.h"
#include "pxr/usd/sdf/variantSpec.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

using hipr::mtlx::attribute;
using hipr::mtlx::Document;
using Element = pugi::xml_node;

class LookWriter {
public:
    LookWriter(Document const& document, PrimWriter& prims) : _document(document), _prims(prims) {}

    void write() {
        for (Element element : _document.elements()) {
            if (std::string(element.name()) == "look") {
                _looks.push_back(element);
            }
        }
        if (_looks.empty()) {
            return;
        }
        _prims.define(_collections, "");
        _prims.define(_scope, "");
        for (Element element : _document.elements()) {
            if (std::string(element.name()) == "collection") {
                collection(element, TfMakeValidIdentifier(_document.name(element)));
            }
        }
        for (Element look : _looks) {
            this->look(look);
        }
        variants();
    }

private:
    void collection(Element element, std::string const& name);
    void look(Element element);
    void assign(Element assignment, SdfPath const& look);
    void variants();
    SdfPathVector geometry(Element element, char const* name);
    SdfPath pathOf(Element element) const { return PrimWriter::child(_scope, _document.name(element)); }

    Document const& _document;
    PrimWriter& _prims;
    std::vector<Element> _looks;
    TfTokenVector _order; ///< of the bindings of a look
    int _made = 0;        ///< collections for assignments that name geometry themselves
    const SdfPath _scope{"/MaterialX/Looks"}, _collections{"/MaterialX/Collections"};
    const SdfPath _materials{"/MaterialX/Materials"};
};

/// What a list of geometry names, as prims below the collections, which move with those that refer to them.
SdfPathVector LookWriter::geometry(Element element, char const* name) {
    SdfPathVector paths;
    const std::string prefix = hipr::mtlx::inherited(element, "geomprefix");
    for (std::string const& word : TfStringTokenize(attribute(element, name), ", ")) {
        const std::string full = prefix + word;
        const std::string relative = TfStringTrimLeft(full, "/");
        if (relative.empty() || relative == "*") {
            paths.push_back(_collections);
        } else if (SdfPath::IsValidPathString(relative)) {
            paths.push_back(_collections.AppendPath(SdfPath(relative)));
        } else {
            _document.complain(element, "names '" + full + "', which is no path of a prim and is left out");
        }
    }
    return paths;
}

void LookWriter::collection(Element element, std::string const& name) {
    const std::string prefix = "collection:" + name + ":";
    SdfPathVector includes = geometry(element, "includegeom");
    const SdfPathVector named = geometry(element, "geom"); // of an assignment
    includes.insert(includes.end(), named.begin(), named.end());
    for (std::string const& other : TfStringTokenize(attribute(element, "includecollection"), ", ")) {
        includes.push_back(
            _collections.AppendProperty(TfToken("collection:" + TfMakeValidIdentifier(other))));
    }
    _prims.apiSchema(_collections, "CollectionAPI:" + name);
    _prims.relate(_collections.AppendProperty(TfToken(prefix + "includes")), includes);
    const SdfPathVector excludes = geometry(element, "excludegeom");
    if (!excludes.empty()) {
        _prims.relate(_collections.AppendProperty(TfToken(prefix + "excludes")), excludes);
    }
}

void LookWriter::look(Element element) {
    const SdfPath path = pathOf(element);
    if (!_prims.define(path, "")) {
        _document.complain(element, "would have the path of another look and is left out");
        return;
    }
    _prims.apiSchema(path, "MaterialBindingAPI");
    // The first binding counts; a look's own come before those it inherits.
    _order.clear();
    for (Element assignment : element.children("materialassign")) {
        assign(assignment, path);
    }
    _prims.layer()->GetPrimAtPath(path)->SetPropertyOrder(_order);
    for (Element inherited : element.children("lookinherit")) { // up to 1.36
        _prims.reference(path, PrimWriter::child(_scope, attribute(inherited, "look")));
    }
    if (!attribute(element, "inherit").empty()) {
        _prims.reference(path, PrimWriter::child(_scope, attribute(element, "inherit")));
    }
    _prims.reference(path, _collections);
}

void LookWriter::assign(Element assignment, SdfPath const& look) {
    const std::string given = attribute(assignment, "material");
    const SdfPath material =
        PrimWriter::child(_materials, given.empty() ? attribute(assignment, "name") : given);
    if (!_prims.has(material)) {
        _document.complain(assignment, "assigns a material that is not there: '" + given + "'");
        return;
    }
    std::string name = TfMakeValidIdentifier(attribute(assignment, "collection"));
    if (attribute(assignment, "collection").empty()) {
        name = "geom_" + std::to_string(++_made);
        collection(assignment, name);
    }
    const SdfPath scope = look.AppendChild(_materials.GetNameToken());
    const SdfPath own = scope.AppendChild(material.GetNameToken());
    _prims.define(scope, "");
    if (_prims.define(own, "")) {
        _prims.reference(own, material);
    }
    // With the look's name, for those of an inherited look count too.
    const TfToken binding("material:binding:collection:" +
                          TfMakeValidIdentifier(look.GetName() + "_" + attribute(assignment, "name")));
    const SdfPath path = look.AppendProperty(binding);
    if (_prims.has(path)) {
        _document.complain(assignment, "has the name of another assignment and is left out");
        return;
    }
    _prims.relate(path, {look.AppendProperty(TfToken("collection:" + name)), own});
    _order.push_back(binding);
}

/// One variant for each look, the first one or a look group's default selected.
void LookWriter::variants() {
    const SdfPath root("/ModelRoot");
    _prims.define(root, "");
    const SdfPrimSpecHandle prim = _prims.layer()->GetPrimAtPath(root);
    const std::string name = "LookVariant";
    const SdfVariantSetSpecHandle set = SdfVariantSetSpec::New(prim, name);
    prim->GetVariantSetNameList().Prepend(name);
    std::string selected = TfMakeValidIdentifier(_document.name(_looks.front()));
    for (Element look : _looks) {
        const SdfVariantSpecHandle variant =
            SdfVariantSpec::New(set, TfMakeValidIdentifier(_document.name(look)));
        variant->GetPrimSpec()->GetReferenceList().Prepend(SdfReference("", pathOf(look)));
    }
    for (Element group : _document.elements()) {
        if (std::string(group.name()) == "lookgroup" && !attribute(group, "default").empty()) {
            selected = TfMakeValidIdentifier(attribute(group, "default"));
        }
    }
    prim->SetVariantSelection(name, selected);
}

} // namespace

void mtlxLooks(Document const& document, PrimWriter& prims) {
    LookWriter(document, prims).write();
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
