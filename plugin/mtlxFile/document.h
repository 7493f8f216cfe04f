/// @file document.h
/// A MaterialX document as one tree of XML elements, included documents within.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <pugixml.hpp>

namespace hipr::mtlx {

/// What a document needs from outside.
struct Surroundings {
    /// The content of a document by its path; nothing when it cannot be opened.
    std::function<std::optional<std::string>(std::string const& path)> read;
    /// The path of an asset that is named in the document at `base`.
    std::function<std::string(std::string const& base, std::string const& asset)> anchor;
    /// Told of everything that is wrong. Begins with the document's path.
    std::function<void(std::string const& message)> message;
};

/// `<input>`, or what older versions have in its place: `<parameter>`, `<bindinput>`, `<bindparam>`.
bool isInput(pugi::xml_node element);
/// The inputs among an element's children, in order.
std::vector<pugi::xml_node> inputsOf(pugi::xml_node element);
/// The child with a category and a name; the first of the category for an empty name.
pugi::xml_node childNamed(pugi::xml_node element, char const* category, std::string const& name);
/// An attribute's text; empty without it.
std::string attribute(pugi::xml_node element, char const* name);
/// An attribute of the element or, without one, of the nearest element around it: `colorspace`, `fileprefix`.
std::string inherited(pugi::xml_node element, char const* name);

class Document {
public:
    /// Reads `text`, the content of the document at `path`. What is wrong is told once, and left out: a text
    /// that is no XML is an empty document; includes that are missing or include themselves, elements
    /// without a name or with one that is taken, and connections that close a cycle count as not there.
    Document(std::string const& text, std::string const& path, Surroundings const& surroundings);

    /// The elements right below `<materialx>`, those of included documents too, in order.
    std::vector<pugi::xml_node> const& elements() const { return _elements; }

    /// MaterialX's version as major * 100 + minor, such as 138, of the document an element stands in.
    int version(pugi::xml_node element) const;
    /// The name with its namespace in front.
    std::string name(pugi::xml_node element) const;
    /// The element of the document that `name` means where `from` stands.
    pugi::xml_node find(pugi::xml_node from, std::string const& name) const;
    /// The element that an input or output is connected to, of the same node graph where it stands in one;
    /// none without a connection.
    pugi::xml_node source(pugi::xml_node input) const;
    /// The definition of a node, where it stands in the document itself.
    pugi::xml_node definition(pugi::xml_node node) const;
    /// The node graph that implements a definition; none for one without, or made of itself.
    pugi::xml_node implementation(pugi::xml_node definition) const;
    /// Inputs and outputs of a definition with those that it inherits, each once.
    std::vector<pugi::xml_node> inputs(pugi::xml_node definition) const;
    std::vector<pugi::xml_node> outputs(pugi::xml_node definition) const;
    /// A file's path as USD wants it: with its prefix, relative to the outermost document.
    std::string file(pugi::xml_node input, std::string const& value) const;

    /// Tells that something is wrong with an element, naming it and the document.
    void complain(pugi::xml_node element, std::string const& what) const;

private:
    using Names = std::unordered_map<std::string, pugi::xml_node>;

    void load(pugi::xml_node root, std::string const& text, std::string const& path,
              std::string const& folder, std::vector<std::string>& open);
    void include(pugi::xml_node element, std::string const& path, std::string const& folder,
                 std::vector<std::string>& open);
    void collect(pugi::xml_node root);
    std::string space(pugi::xml_node element) const;
    std::vector<pugi::xml_node> members(pugi::xml_node definition, bool inputs) const;
    bool fits(pugi::xml_node definition, pugi::xml_node node) const;
    /// Of an element and all below it.
    void checkConnections(pugi::xml_node element);
    void checkConnection(pugi::xml_node element);
    /// What inputs within a node graph are connected to.
    Names const& membersOf(pugi::xml_node graph) const;
    void breakCycles(std::vector<pugi::xml_node> const& elements);
    void breakCustomCycles();

    Surroundings _surroundings;
    pugi::xml_document _xml;
    std::vector<pugi::xml_node> _elements;
    Names _names;
    std::unordered_map<std::string, std::vector<pugi::xml_node>> _definitions; // by the node they define
    Names _implementations;                                                    // by the definition's name
    mutable std::unordered_map<size_t, Names> _members; // of node graphs that were asked for
};

} // namespace hipr::mtlx
