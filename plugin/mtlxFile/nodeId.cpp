#include "plugin/mtlxFile/nodeId.h"

#include <algorithm>
#include <array>
#include <set>

namespace hipr::mtlx {

namespace {

using Names = std::set<std::string>;

std::string typeOf(NodeUse const& use, char const* input, char const* fallback = "") {
    const auto found = use.inputs.find(input);
    return found == use.inputs.end() ? fallback : found->second;
}

/// Closures carry their type in small letters, if at all.
bool isClosure(std::string const& type) {
    return type == "BSDF" || type == "EDF" || type == "VDF";
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(tolower(c)); });
    return text;
}

/// Definitions that there is only one of, named after the node alone.
bool isOnlyOne(std::string const& category) {
    static const Names names = {"surfacematerial",
                                "volumematerial",
                                "surface_unlit",
                                "ramp",
                                "ramp_gradient",
                                "gooch_shade",
                                "surface",
                                "volume",
                                "light",
                                "point_light",
                                "directional_light",
                                "spot_light",
                                "blackbody",
                                "roughness_dual",
                                "roughness_anisotropy",
                                "artistic_ior",
                                "open_pbr_anisotropy",
                                "glossiness_anisotropy",
                                "UsdUVTexture",
                                "UsdTransform2d",
                                "disney_principled",
                                "gltf_colorimage",
                                "chiang_hair_roughness",
                                "chiang_hair_absorption_from_color",
                                "deon_hair_absorption_from_melanin"};
    const auto endsWith = [&](std::string const& end) {
        return category.size() > end.size() &&
               category.compare(category.size() - end.size(), end.size(), end) == 0;
    };
    return names.count(category) || endsWith("_bsdf") || endsWith("_edf") || endsWith("_vdf");
}

/// Nodes whose definitions are told apart by the type of what goes in.
std::string byInput(NodeUse const& use) {
    static const std::map<std::string, char const*> inputs = {
        {"magnitude", "in"}, {"determinant", "in"}, {"extract", "in"},   {"separate2", "in"},
        {"separate3", "in"}, {"separate4", "in"},   {"distance", "in1"}, {"dotproduct", "in1"}};
    static const std::map<std::string, std::string> usual = {{"separate2", "vector2"},
                                                             {"separate3", "color3"},
                                                             {"separate4", "color4"},
                                                             {"determinant", "matrix33"},
                                                             {"extract", "color3"}};
    const auto found = inputs.find(use.category);
    if (found == inputs.end()) {
        return "";
    }
    const auto fallback = usual.find(use.category);
    return "_" + typeOf(use, found->second, fallback == usual.end() ? "vector3" : fallback->second.c_str());
}

/// Nodes with in and out in their definitions' names.
std::string byInputAndOutput(NodeUse const& use) {
    if (use.category == "convert" || use.category == "swizzle") {
        return "_" + typeOf(use, "in", "float") + "_" + use.type;
    }
    if (use.category == "creatematrix") {
        return "_" + typeOf(use, "in1", use.type == "matrix33" ? "vector3" : "vector4") + "_" + use.type;
    }
    return "";
}

/// "FA": a node of colours or vectors whose other operands are floats.
bool isFloatVariant(NodeUse const& use) {
    static const std::map<std::string, char const*> operands = {
        {"add", "in2"},   {"subtract", "in2"},  {"multiply", "in2"}, {"divide", "in2"}, {"modulo", "in2"},
        {"power", "in2"}, {"safepower", "in2"}, {"min", "in2"},      {"max", "in2"},    {"invert", "amount"}};
    static const std::map<std::string, std::array<char const*, 5>> ranges = {
        {"clamp", {"low", "high"}},
        {"smoothstep", {"low", "high"}},
        {"contrast", {"amount", "pivot"}},
        {"remap", {"inlow", "inhigh", "outlow", "outhigh"}},
        {"range", {"inlow", "inhigh", "gamma", "outlow", "outhigh"}},
        {"noise2d", {"amplitude"}},
        {"noise3d", {"amplitude"}},
        {"fractal3d", {"amplitude"}}};
    if (use.type == "float" || use.type == "integer" || isClosure(use.type)) {
        return false;
    }
    const auto operand = operands.find(use.category);
    if (operand != operands.end()) {
        return typeOf(use, operand->second) == "float";
    }
    const auto range = ranges.find(use.category);
    return range != ranges.end() &&
           std::any_of(range->second.begin(), range->second.end(),
                       [&](char const* input) { return input && typeOf(use, input) == "float"; });
}

/// What follows the type: "I" and "B" for what is compared, "CF", "VF" and "VV" for what is combined, and
/// so on.
std::string suffix(NodeUse const& use) {
    if (isFloatVariant(use)) {
        return "FA";
    }
    if (use.category == "ifgreater" || use.category == "ifgreatereq" || use.category == "ifequal") {
        const std::string compared = typeOf(use, "value1", typeOf(use, "value2", "float").c_str());
        return compared == "integer" ? "I" : compared == "boolean" ? "B" : "";
    }
    if (use.category == "switch") {
        return typeOf(use, "which") == "integer" ? "I" : "";
    }
    if (use.category == "combine2") {
        return use.type == "color4"                         ? "CF"
               : use.type != "vector4"                      ? ""
               : typeOf(use, "in1", "vector2") == "vector3" ? "VF"
                                                            : "VV";
    }
    if (use.category == "transformmatrix") {
        const std::string matrix = typeOf(use, "mat");
        return use.type == "vector2" ? "M3" : use.type == "vector3" && matrix == "matrix44" ? "M4" : "";
    }
    if (use.category == "mix" && !isClosure(use.type) && use.type != "float" &&
        typeOf(use, "mix") == use.type) {
        return "_" + use.type;
    }
    return "";
}

std::string closureId(NodeUse const& use) {
    const std::string id = "ND_" + use.category + "_" + lower(use.type);
    if (use.category == "multiply") {
        return id + (typeOf(use, "in2") == "color3" ? "C" : "F");
    }
    return use.category == "layer" ? "ND_layer_" + lower(typeOf(use, "base", "BSDF")) : id;
}

/// Nodes of glTF: named with the type twice, and with a version.
std::string gltfId(NodeUse const& use) {
    if (use.category == "gltf_image") {
        return "ND_gltf_image_" + use.type + "_" + use.type + "_1_0";
    }
    return "ND_" + use.category + "_" + use.type + "_1_0";
}

} // namespace

std::string standardNodeId(NodeUse const& use) {
    static const Names logical = {"and", "or", "xor", "not"};
    static const Names mixing = {"mix", "add", "multiply", "layer"};
    static const Names gltf = {"gltf_image", "gltf_normalmap", "gltf_iridescence_thickness"};
    const std::string base = "ND_" + use.category;
    if (isOnlyOne(use.category)) {
        return base;
    }
    if (logical.count(use.category)) {
        return "ND_logical_" + use.category;
    }
    if (isClosure(use.type) && mixing.count(use.category)) {
        return closureId(use);
    }
    if (gltf.count(use.category)) {
        return gltfId(use);
    }
    if (use.category == "normalmap") { // told apart by its scale from 1.39 on
        return use.library < 139 ? base : base + "_" + typeOf(use, "scale", "float");
    }
    if (use.category == "displacement") {
        return base + "_" + typeOf(use, "displacement", "float");
    }
    if (use.category == "standard_surface" && use.version == "1.0.0") {
        return base + "_surfaceshader_100";
    }
    if (use.category == "randomfloat" || use.category == "randomcolor") {
        return base + "_" + typeOf(use, "in", "float");
    }
    for (std::string const& types : {byInput(use), byInputAndOutput(use)}) {
        if (!types.empty()) {
            return base + types;
        }
    }
    return base + "_" + use.type + suffix(use);
}

} // namespace hipr::mtlx
