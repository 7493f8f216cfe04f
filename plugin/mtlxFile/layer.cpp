#include "plugin/mtlxFile/layer.h"

#include <algorithm>
#include <set>

#include "plugin/mtlxFile/looks.h"
#include "plugin/mtlxFile/nodeId.h"
#include "plugin/mtlxFile/prims.h"
#include "plugin/mtlxFile/value.h"
#include "pxr/usd/sdf/attributeSpec.h"
#include "pxr/usd/sdf/types.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

using hipr::mtlx::attribute;
using hipr::mtlx::Document;
using hipr::mtlx::inputsOf;
using Element = pugi::xml_node;

/// What the elements of a document become.
enum class Kind { Node, Shader, Material, Graph, Other };

Kind kindOf(Element element) {
    static const std::set<std::string> others = {"nodedef",     "input",        "output",
                                                 "parameter",   "token",        "typedef",
                                                 "geompropdef", "attributedef", "backdrop"};
    const std::string category = element.name(), type = attribute(element, "type");
    if (category == "nodegraph") {
        return Kind::Graph;
    }
    if (category == "material" || type == "material") { // the former up to 1.37
        return Kind::Material;
    }
    if (type.empty() || others.count(category)) {
        return Kind::Other;
    }
    const bool shader = type == "surfaceshader" || type == "displacementshader" || type == "volumeshader";
    return shader ? Kind::Shader : Kind::Node;
}

/// Where an element is written, and where what it is connected to is found.
struct Place {
    SdfPath prim;                  ///< the element's own
    SdfPath nodes;                 ///< the prim that holds the nodes beside it
    SdfPath graph;                 ///< the graph with the interface that it sees; empty outside of graphs
    bool material = false;         ///< among a material's shaders, which see graphs and nodes by references
    Element interface = Element(); ///< of the graph: the graph itself, or the definition that it implements
};

/// Writes the prims of one document.
class Writer {
public:
    Writer(Document const& document, PrimWriter& prims) : _document(document), _prims(prims) {}

    void nodeGraphs();
    void materials();

private:
    void graph(SdfPath const& path, Element element, Element definition);
    void material(Element element);
    void terminal(Element shader, Element link, SdfPath const& material);
    void node(Element element, Place const& place);
    void inputs(Element element, Place const& place);
    void input(Element element, Element node, Place const& place);
    void constant(Element element, Element node, Place const& place);
    TfToken colorSpace(Element element, Element node, SdfPath const& input);
    SdfPath source(Element element, Element target, Place const& place);
    SdfPath nodesOfMaterial(SdfPath const& material, Element target);
    std::string outputOf(Element link, Element target) const;
    std::string id(Element element, Element definition) const;
    SdfPath under(SdfPath const& parent, Element element) const {
        return PrimWriter::child(parent, _document.name(element));
    }

    Document const& _document;
    PrimWriter& _prims;
    const SdfPath _root{"/MaterialX"}, _graphs{"/MaterialX/NodeGraphs"};
};

void Writer::nodeGraphs() {
    std::set<Element> implementations;
    for (Element element : _document.elements()) {
        if (const Element graph = _document.implementation(element)) {
            implementations.insert(graph);
            this->graph(under(_graphs, element), graph, element);
        }
    }
    for (Element element : _document.elements()) {
        const Kind kind = kindOf(element);
        if (kind == Kind::Graph && !implementations.count(element)) {
            graph(under(_graphs, element), element, element);
        } else if (kind == Kind::Node) {
            _prims.define(_graphs, "NodeGraph");
            node(element, {under(_graphs, element), _graphs, SdfPath(), false});
        }
    }
}

/// @param definition  has the interface: of a graph that implements nothing, the graph itself
void Writer::graph(SdfPath const& path, Element element, Element definition) {
    _prims.define(_graphs, "NodeGraph");
    if (!_prims.define(path, "NodeGraph")) {
        _document.complain(element, "would have the path of another element and is left out");
        return;
    }
    for (Element input : _document.inputs(definition)) {
        this->input(input, definition, {path, _graphs, SdfPath(), false});
    }
    for (Element child : element) {
        const Kind kind = kindOf(child);
        if (kind == Kind::Node || kind == Kind::Shader) {
            node(child, {under(path, child), path, path, false, definition});
        } else if (std::string(child.name()) == "output") {
            const SdfPath output = path.AppendProperty(TfToken("outputs:" + attribute(child, "name")));
            _prims.attribute(output, mtlxType(attribute(child, "type")));
            if (const Element target = _document.source(child)) {
                _prims.connect(output, source(child, target, {path, path, path, false}));
            }
        }
    }
}

void Writer::node(Element element, Place const& place) {
    const Element definition = _document.definition(element);
    const bool custom = bool(_document.implementation(definition));
    if (!_prims.define(place.prim, custom ? "NodeGraph" : "Shader")) {
        _document.complain(element, "would have the path of another element and is left out");
        return;
    }
    if (custom) {
        _prims.reference(place.prim, under(_graphs, definition));
    } else {
        _prims.uniform(place.prim, "info:id", VtValue(TfToken(id(element, definition))));
        const std::string type = attribute(element, "type");
        if (type != "multioutput") {
            _prims.attribute(place.prim.AppendProperty(TfToken("outputs:out")), mtlxType(type));
        }
    }
    inputs(element, place);
}

std::string Writer::id(Element element, Element definition) const {
    if (definition) {
        return _document.name(definition);
    }
    const std::string named = attribute(element, "nodedef");
    if (!named.empty()) {
        return named;
    }
    // Up to 1.37 a material holds references to shaders in place of nodes.
    const bool reference = std::string(element.name()) == "shaderref";
    hipr::mtlx::NodeUse use;
    use.category = reference ? attribute(element, "node") : element.name();
    use.type = reference ? "surfaceshader" : attribute(element, "type");
    use.version = attribute(element, "version");
    use.library = _document.version(element);
    for (Element input : inputsOf(element)) {
        use.inputs[attribute(input, "name")] = attribute(input, "type");
    }
    return hipr::mtlx::standardNodeId(use);
}

void Writer::inputs(Element element, Place const& place) {
    for (Element child : inputsOf(element)) {
        input(child, element, place);
    }
}

void Writer::input(Element element, Element node, Place const& place) {
    const std::string name = attribute(element, "name");
    if (name.empty()) {
        _document.complain(element, "has no name and is left out");
        return;
    }
    const SdfPath path = place.prim.AppendProperty(TfToken("inputs:" + name));
    _prims.attribute(path, mtlxType(attribute(element, "type")));
    const std::string shared = attribute(element, "interfacename");
    if (const Element target = _document.source(element)) {
        _prims.connect(path, source(element, target, place));
        return;
    }
    if (shared.empty()) {
        constant(element, node, place);
        return;
    }
    const SdfPath from =
        place.graph.IsEmpty() ? SdfPath() : place.graph.AppendProperty(TfToken("inputs:" + shared));
    if (from.IsEmpty() || !_prims.has(from)) {
        _document.complain(element, "has the interface name '" + shared + "', which its graph lacks");
        constant(element, node, place);
        return;
    }
    _prims.connect(path, from);
    for (Element input : _document.inputs(place.interface)) {
        if (attribute(input, "name") == shared) {
            colorSpace(input, node, path);
        }
    }
}

/// The value of an input, and its colour space.
void Writer::constant(Element element, Element node, Place const& place) {
    const std::string type = attribute(element, "type");
    const SdfPath path = place.prim.AppendProperty(TfToken("inputs:" + attribute(element, "name")));
    std::string text = attribute(element, "value");
    if (text.empty()) {
        return;
    }
    if (type == "filename") {
        text = _document.file(element, text);
    }
    const std::optional<VtValue> value = mtlxValue(type, text);
    if (!value) {
        _document.complain(element, "has the value '" + text + "', which is no " + type + "; it is left out");
        return;
    }
    // What a material's shader is given can be changed at the material.
    const SdfPath shared = place.prim.GetParentPath().AppendProperty(path.GetNameToken());
    SdfAttributeSpecHandle spec;
    if (place.material && !_prims.has(shared)) {
        spec = _prims.attribute(shared, mtlxType(type));
        _prims.connect(path, shared);
    } else {
        spec = _prims.attribute(path, mtlxType(type));
    }
    spec->SetDefaultValue(*value);
    const TfToken space = colorSpace(element, node, path);
    if (!space.IsEmpty()) {
        spec->SetColorSpace(space);
    }
}

/// Gives a shader the colour space of one of its inputs, which has its value from `element`. Colour spaces
/// are those of colours: values, and files that are read as such.
TfToken Writer::colorSpace(Element element, Element node, SdfPath const& input) {
    const std::string type = attribute(element, "type");
    const std::string read = type == "filename" ? attribute(node, "type") : type;
    const TfToken space(hipr::mtlx::inherited(element, "colorspace"));
    const bool isColor = read == "color3" || read == "color4" || read == "multioutput";
    const bool isPlain = space.IsEmpty() || space == "lin_rec709" || space == "none";
    if (!isColor || (isPlain && (space.IsEmpty() || type != "filename"))) {
        return TfToken();
    }
    const std::string name = input.GetName().substr(std::string("inputs:").size());
    _prims
        .attribute(input.GetPrimPath().AppendProperty(TfToken("inputs:colorSpace:" + name)),
                   SdfValueTypeNames->Token)
        ->SetDefaultValue(VtValue(space));
    return space;
}

/// The output that a link leads to.
SdfPath Writer::source(Element element, Element target, Place const& place) {
    const TfToken output("outputs:" + outputOf(element, target));
    SdfPath nodes = place.nodes, defined = place.nodes;
    if (place.material && kindOf(target) != Kind::Shader) {
        nodes = nodesOfMaterial(place.prim.GetParentPath(), target);
        defined = _graphs;
    } else if (place.material && !_prims.has(under(nodes, target))) {
        node(target, {under(nodes, target), nodes, SdfPath(), true});
    }
    // Which outputs a node of MaterialX's own has is only seen by what is connected to them.
    if (kindOf(target) != Kind::Graph && !_document.implementation(_document.definition(target))) {
        _prims.attributeLater(under(defined, target).AppendProperty(output),
                              mtlxType(attribute(element, "type")));
    }
    return under(nodes, target).AppendProperty(output);
}

/// The prim in a material below which it finds a graph or a node outside of graphs.
SdfPath Writer::nodesOfMaterial(SdfPath const& material, Element target) {
    const std::vector<Element> inputs = inputsOf(target);
    const bool alone = kindOf(target) == Kind::Graph &&
                       std::none_of(inputs.begin(), inputs.end(),
                                    [&](Element input) { return bool(_document.source(input)); });
    // Nodes outside of graphs refer to each other, so that all of them are needed.
    const SdfPath nodes = alone ? material : material.AppendChild(_graphs.GetNameToken());
    const SdfPath referenced = alone ? under(material, target) : nodes;
    if (!_prims.has(referenced)) {
        _prims.over(referenced);
        _prims.reference(referenced, alone ? under(_graphs, target) : _graphs);
    }
    return nodes;
}

std::string Writer::outputOf(Element link, Element target) const {
    const std::string named = attribute(link, "output");
    if (!named.empty()) {
        return named;
    }
    std::vector<Element> outputs;
    if (kindOf(target) == Kind::Graph) {
        const auto children = target.children("output");
        outputs.assign(children.begin(), children.end());
    } else if (const Element definition = _document.definition(target)) {
        outputs = _document.outputs(definition);
    }
    return outputs.empty() ? "out" : attribute(outputs.front(), "name");
}

void Writer::materials() {
    const SdfPath scope = _root.AppendChild(TfToken("Materials"));
    _prims.define(scope, "");
    for (Element element : _document.elements()) {
        if (kindOf(element) == Kind::Material) {
            material(element);
        }
    }
}

void Writer::material(Element element) {
    const SdfPath path = under(_root.AppendChild(TfToken("Materials")), element);
    if (!_prims.define(path, "Material")) {
        _document.complain(element, "would have the path of another element and is left out");
        return;
    }
    for (Element link : inputsOf(element)) {
        const std::string name = attribute(link, "name");
        if (name != "surfaceshader" && name != "displacementshader" && name != "volumeshader") {
            continue; // backsurfaceshader, which neither USD nor we know
        }
        if (const Element shader = _document.source(link)) {
            terminal(shader, link, path);
        }
    }
    for (Element shader : element.children("shaderref")) {
        const SdfPath own = PrimWriter::child(path, attribute(shader, "name"));
        node(shader, {own, path, SdfPath(), true});
        const SdfPath output = own.AppendProperty(TfToken("outputs:out"));
        _prims.attribute(output, SdfValueTypeNames->Token);
        const SdfPath surface = path.AppendProperty(TfToken("outputs:mtlx:surface"));
        _prims.attribute(surface, SdfValueTypeNames->Token);
        _prims.connect(surface, output);
    }
}

/// Writes a material's surface, displacement or volume.
void Writer::terminal(Element shader, Element link, SdfPath const& material) {
    const std::string type = attribute(link, "name"); // ends with "shader"
    const SdfPath output =
        material.AppendProperty(TfToken("outputs:mtlx:" + type.substr(0, type.size() - 6)));
    _prims.attribute(output, SdfValueTypeNames->Token);
    // As an input of a shader that would stand in the material.
    _prims.connect(
        output, source(link, shader, {material.AppendChild(TfToken("shader")), material, SdfPath(), true}));
}

} // namespace

SdfLayerRefPtr mtlxLayer(Document const& document) {
    const SdfLayerRefPtr layer = SdfLayer::CreateAnonymous("mtlx.usda");
    PrimWriter prims(layer);
    prims.define(SdfPath("/MaterialX"), "");
    layer->SetDefaultPrim(TfToken("MaterialX"));
    Writer writer(document, prims);
    writer.nodeGraphs();
    writer.materials();
    mtlxLooks(document, prims);
    prims.finish();
    return layer;
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
