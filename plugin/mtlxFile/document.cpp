#include "plugin/mtlxFile/document.h"

#include <algorithm>
#include <set>

#include "plugin/mtlxFile/cycleFinder.h"

namespace hipr::mtlx {

namespace {

using Node = pugi::xml_node;

/// Attributes of our own, on every root: the path of its document, and its folder seen from the outermost.
const char* const pathKey = "hipr:path";
const char* const folderKey = "hipr:folder";

bool isRoot(Node element) {
    return std::string(element.name()) == "materialx";
}

bool isAbsolute(std::string const& path) {
    return !path.empty() && (path[0] == '/' || path[0] == '\\' || path.find("://") != std::string::npos ||
                             (path.size() > 1 && path[1] == ':'));
}

std::string joined(std::string const& folder, std::string const& path) {
    return isAbsolute(path) ? path : folder + path;
}

size_t lineOf(std::string const& text, ptrdiff_t offset) {
    const auto end = text.begin() + std::min(offset, ptrdiff_t(text.size()));
    return 1 + size_t(std::count(text.begin(), end, '\n'));
}

} // namespace

bool isInput(Node element) {
    static const std::set<std::string> names = {"input", "parameter", "bindinput", "bindparam"};
    return names.count(element.name());
}

std::vector<Node> inputsOf(Node element) {
    std::vector<Node> inputs;
    std::copy_if(element.begin(), element.end(), std::back_inserter(inputs), isInput);
    return inputs;
}

Node childNamed(Node element, char const* category, std::string const& name) {
    return name.empty() ? element.child(category)
                        : element.find_child_by_attribute(category, "name", name.c_str());
}

std::string attribute(Node element, char const* name) {
    return element.attribute(name).value();
}

std::string inherited(Node element, char const* name) {
    for (; element; element = element.parent()) {
        if (const pugi::xml_attribute found = element.attribute(name)) {
            return found.value();
        }
    }
    return "";
}

Document::Document(std::string const& text, std::string const& path, Surroundings const& surroundings)
    : _surroundings(surroundings) {
    std::vector<std::string> open;
    const Node root = _xml.append_child("materialx");
    load(root, text, path, "", open);
    collect(root);
    for (Node element : _elements) {
        checkConnections(element);
    }
    breakCycles(_elements);
    for (Node element : _elements) {
        if (std::string(element.name()) == "nodegraph") {
            breakCycles({element.begin(), element.end()});
        }
    }
    breakCustomCycles();
}

/// Fills a root that is still empty.
void Document::load(Node root, std::string const& text, std::string const& path, std::string const& folder,
                    std::vector<std::string>& open) {
    root.append_attribute(pathKey) = path.c_str();
    root.append_attribute(folderKey) = folder.c_str();
    pugi::xml_document xml;
    const pugi::xml_parse_result parsed = xml.load_buffer(text.data(), text.size());
    if (!parsed) {
        _surroundings.message(path + ":" + std::to_string(lineOf(text, parsed.offset)) + ": no valid XML (" +
                              parsed.description() + "); nothing of it is used");
        return;
    }
    const Node content = xml.child("materialx");
    if (!content) {
        _surroundings.message(path + ": has no <materialx>; nothing of it is used");
        return;
    }
    for (pugi::xml_attribute value : content.attributes()) {
        root.append_copy(value);
    }
    for (Node element : content) {
        root.append_copy(element);
    }
    open.push_back(path);
    std::vector<Node> includes;
    for (Node element : root.children("xi:include")) {
        includes.push_back(element);
    }
    for (Node element : includes) {
        include(element, path, folder, open);
        root.remove_child(element);
    }
    open.pop_back();
}

/// Puts the root of another document in front of the element that includes it.
void Document::include(Node element, std::string const& path, std::string const& folder,
                       std::vector<std::string>& open) {
    const std::string asset = attribute(element, "href");
    const std::string target = _surroundings.anchor(path, asset);
    if (std::find(open.begin(), open.end(), target) != open.end()) {
        _surroundings.message(path + ": includes itself through '" + asset + "'; that is left out");
        return;
    }
    const std::optional<std::string> text = _surroundings.read(target);
    if (!text) {
        _surroundings.message(path + ": includes '" + asset + "', which cannot be opened");
        return;
    }
    const size_t end = asset.find_last_of("/\\");
    load(element.parent().insert_child_before("materialx", element), *text, target,
         joined(folder, end == std::string::npos ? "" : asset.substr(0, end + 1)), open);
}

void Document::collect(Node root) {
    for (Node element : root) {
        if (isRoot(element)) {
            collect(element);
            continue;
        }
        const std::string name = this->name(element);
        if (attribute(element, "name").empty()) {
            complain(element, "has no name and is left out");
            continue;
        }
        if (!_names.emplace(name, element).second) {
            complain(element, "has the name of another element and is left out");
            continue;
        }
        _elements.push_back(element);
        const std::string category = element.name();
        if (category == "nodedef") {
            _definitions[attribute(element, "node")].push_back(element);
        }
    }
    // By a graph that names its definition, or an element that names both.
    for (Node element : _elements) {
        const std::string category = element.name(), definition = attribute(element, "nodedef");
        Node graph = category == "nodegraph" ? element : Node();
        if (category == "implementation") {
            graph = find(element, attribute(element, "nodegraph"));
        }
        if (graph && find(element, definition)) {
            _implementations.emplace(this->name(find(element, definition)), graph);
        }
    }
}

int Document::version(Node element) const {
    Node root = element; // a node's own attribute is that of its definition
    while (root && !isRoot(root)) {
        root = root.parent();
    }
    const std::string version = attribute(root, "version");
    const size_t point = version.find('.');
    const int major = std::atoi(version.c_str());
    return major == 0 ? 139 : 100 * major + (point == std::string::npos ? 0 : std::atoi(&version[point + 1]));
}

std::string Document::space(Node element) const {
    const std::string space = inherited(element.parent(), "namespace");
    return space.empty() ? "" : space + ":";
}

std::string Document::name(Node element) const {
    const std::string name = attribute(element, "name");
    return isRoot(element.parent()) ? space(element) + name : name;
}

Node Document::find(Node from, std::string const& name) const {
    for (std::string const& qualified : {space(from) + name, name}) {
        const auto found = _names.find(qualified);
        if (found != _names.end()) {
            return found->second;
        }
    }
    return {};
}

Node Document::source(Node input) const {
    const std::string graph = attribute(input, "nodegraph");
    const std::string name = graph.empty() ? attribute(input, "nodename") : graph;
    // What a graph's own inputs are connected to stands beside the graph, all else within.
    Node around = input.parent();
    if (std::string(around.name()) == "nodegraph" && isInput(input)) {
        around = around.parent();
    }
    while (around && !isRoot(around) && std::string(around.name()) != "nodegraph") {
        around = around.parent();
    }
    if (name.empty() || isRoot(around)) {
        return name.empty() ? Node() : find(input, name);
    }
    auto const& members = membersOf(around);
    const auto found = members.find(name);
    return found == members.end() ? Node() : found->second;
}

Document::Names const& Document::membersOf(Node graph) const {
    const auto [entry, fresh] = _members.try_emplace(graph.hash_value());
    for (Node element : fresh ? graph.children() : Node().children()) {
        if (!isInput(element) && std::string(element.name()) != "output") {
            entry->second.emplace(attribute(element, "name"), element); // the first of a name counts
        }
    }
    return entry->second;
}

Node Document::definition(Node node) const {
    const std::string named = attribute(node, "nodedef");
    if (!named.empty()) {
        const Node found = find(node, named);
        return std::string(found.name()) == "nodedef" ? found : Node();
    }
    const auto found = _definitions.find(node.name());
    if (found == _definitions.end()) {
        return {};
    }
    Node best;
    for (Node candidate : found->second) {
        if (fits(candidate, node) && (!best || attribute(candidate, "isdefaultversion") == "true")) {
            best = candidate;
        }
    }
    return best;
}

/// Whether a node may be one of a definition: its output is of that type, its inputs are all known.
bool Document::fits(Node definition, Node node) const {
    const std::vector<Node> outs = outputs(definition);
    const std::string type = attribute(node, "type"), version = attribute(node, "version");
    // Before 1.38 a definition with a single output had its type.
    const std::string own = attribute(definition, "type");
    const std::string made = outs.empty()      ? own
                             : outs.size() > 1 ? "multioutput"
                                               : attribute(outs[0], "type");
    const std::vector<Node> known = inputs(definition), given = inputsOf(node);
    return made == type && (version.empty() || version == attribute(definition, "version")) &&
           std::all_of(given.begin(), given.end(), [&](Node input) {
               return std::any_of(known.begin(), known.end(), [&](Node other) {
                   return attribute(other, "name") == attribute(input, "name") &&
                          attribute(other, "type") == attribute(input, "type");
               });
           });
}

Node Document::implementation(Node definition) const {
    const auto found = definition ? _implementations.find(name(definition)) : _implementations.end();
    return found == _implementations.end() ? Node() : found->second;
}

std::vector<Node> Document::members(Node definition, bool inputs) const {
    std::vector<Node> all;
    std::set<Node> seen;
    while (definition && seen.insert(definition).second) {
        for (Node member : definition) {
            const bool wanted = inputs ? isInput(member) : std::string(member.name()) == "output";
            const bool known = std::any_of(all.begin(), all.end(), [&](Node other) {
                return attribute(other, "name") == attribute(member, "name");
            });
            if (wanted && !known) {
                all.push_back(member);
            }
        }
        definition = find(definition, attribute(definition, "inherit"));
    }
    return all;
}

std::vector<Node> Document::inputs(Node definition) const {
    return members(definition, true);
}

std::vector<Node> Document::outputs(Node definition) const {
    return members(definition, false);
}

std::string Document::file(Node input, std::string const& value) const {
    return joined(inherited(input, folderKey), joined(inherited(input, "fileprefix"), value));
}

void Document::complain(Node element, std::string const& what) const {
    const Node parent = element.parent();
    std::string within;
    if (isInput(element) || std::string(element.name()) == "output") {
        within = " of <" + std::string(parent.name()) + " name=\"" + attribute(parent, "name") + "\">";
    }
    _surroundings.message(inherited(element, pathKey) + ": <" + element.name() + " name=\"" +
                          attribute(element, "name") + "\">" + within + " " + what);
}

/// Takes connections to nothing away.
void Document::checkConnections(Node element) {
    struct Walker final : pugi::xml_tree_walker {
        Document* document;
        bool for_each(Node& node) override {
            document->checkConnection(node);
            return true;
        }
    } walker;
    walker.document = this;
    checkConnection(element);
    element.traverse(walker);
}

void Document::checkConnection(Node element) {
    if (!isInput(element) && std::string(element.name()) != "output") {
        return;
    }
    for (char const* by : {"nodegraph", "nodename"}) {
        const std::string name = attribute(element, by);
        if (!name.empty() && !source(element)) {
            complain(element, "is connected to '" + name + "', which is not there");
            element.remove_attribute(by);
        }
    }
}

void Document::breakCycles(std::vector<Node> const& elements) {
    CycleFinder finder([this](Node element) {
        std::vector<std::pair<Node, Node>> edges;
        for (Node input : inputsOf(element)) {
            if (const Node from = source(input)) {
                edges.emplace_back(input, from);
            }
        }
        return edges;
    });
    for (Node element : elements) {
        finder.visit(element);
    }
    for (Node input : finder.closing) {
        complain(input, "closes a cycle and is not connected");
        input.remove_attribute("nodename");
        input.remove_attribute("nodegraph");
    }
}

void Document::breakCustomCycles() {
    CycleFinder finder([this](Node definition) {
        std::vector<std::pair<Node, Node>> edges;
        for (Node node : implementation(definition)) {
            const Node used = this->definition(node);
            if (implementation(used)) {
                edges.emplace_back(used, used);
            }
        }
        return edges;
    });
    for (Node element : _elements) {
        if (std::string(element.name()) == "nodedef") {
            finder.visit(element);
        }
    }
    for (Node definition : finder.closing) {
        if (_implementations.erase(name(definition))) {
            complain(definition, "is implemented by itself; nodes of it have no effect");
        }
    }
}

} // namespace hipr::mtlx
