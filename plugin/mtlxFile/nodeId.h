/// @file nodeId.h
/// The names of MaterialX's own node definitions. Its libraries are not there, so the rules by which they
/// are named stand here (MaterialX 1.36 to 1.39).
#pragma once

#include <map>
#include <string>

namespace hipr::mtlx {

/// A node as far as its definition's name depends on it.
struct NodeUse {
    std::string category;                      ///< such as "image"
    std::string type;                          ///< of its output, or "multioutput"
    std::map<std::string, std::string> inputs; ///< types of the inputs that are given, by name
    std::string version;                       ///< of the definition, as asked for; mostly empty
    int library = 139;                         ///< MaterialX's version, major * 100 + minor
};

/// Such as ND_image_color3, ND_multiply_vector3FA or ND_convert_float_color3.
std::string standardNodeId(NodeUse const& use);

} // namespace hipr::mtlx
