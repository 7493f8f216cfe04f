/// Names of node definitions. Those on the left are MaterialX's own, of versions 1.38 and 1.39.
#include <sstream>

#include <gtest/gtest.h>

#include "plugin/mtlxFile/nodeId.h"

namespace hipr::mtlx {
namespace {

struct Row {
    const char* id;
    const char* category;
    const char* type;
    const char* inputs; ///< "name:type ..."
    int library = 139;
};

std::string idOf(Row const& row, std::string const& version = "") {
    NodeUse use;
    use.category = row.category;
    use.type = row.type;
    use.version = version;
    use.library = row.library;
    std::istringstream words(row.inputs);
    for (std::string word; words >> word;) {
        const size_t colon = word.find(':');
        use.inputs[word.substr(0, colon)] = word.substr(colon + 1);
    }
    return standardNodeId(use);
}

const Row rows[] = {
    {"ND_image_color3", "image", "color3", "file:filename"},
    {"ND_tiledimage_vector2", "tiledimage", "vector2", "file:filename"},
    {"ND_constant_float", "constant", "float", "value:float"},
    {"ND_texcoord_vector2", "texcoord", "vector2", ""},
    {"ND_place2d_vector2", "place2d", "vector2", "texcoord:vector2 offset:vector2"},
    {"ND_geompropvalue_color3", "geompropvalue", "color3", "geomprop:string"},
    {"ND_standard_surface_surfaceshader", "standard_surface", "surfaceshader", "base:float"},
    {"ND_gltf_pbr_surfaceshader", "gltf_pbr", "surfaceshader", ""},
    {"ND_UsdPreviewSurface_surfaceshader", "UsdPreviewSurface", "surfaceshader", ""},
    {"ND_surface_unlit", "surface_unlit", "surfaceshader", ""},
    {"ND_UsdUVTexture", "UsdUVTexture", "multioutput", "file:filename"},
    {"ND_UsdTransform2d", "UsdTransform2d", "vector2", "in:vector2"},
    {"ND_UsdPrimvarReader_float", "UsdPrimvarReader", "float", "varname:string"},
    // floats beside colours and vectors
    {"ND_multiply_color3", "multiply", "color3", "in1:color3 in2:color3"},
    {"ND_multiply_color3FA", "multiply", "color3", "in1:color3 in2:float"},
    {"ND_multiply_float", "multiply", "float", "in1:float in2:float"},
    {"ND_add_vector3", "add", "vector3", "in1:vector3"},
    {"ND_clamp_vector2FA", "clamp", "vector2", "in:vector2 high:float"},
    {"ND_remap_color4FA", "remap", "color4", "in:color4 outlow:float outhigh:float"},
    {"ND_range_color3", "range", "color3", "in:color3 inlow:color3"},
    {"ND_contrast_color3FA", "contrast", "color3", "in:color3 amount:float"},
    {"ND_invert_vector4FA", "invert", "vector4", "in:vector4 amount:float"},
    {"ND_noise2d_color3FA", "noise2d", "color3", "amplitude:float"},
    {"ND_noise2d_color3", "noise2d", "color3", "amplitude:vector3 pivot:float"},
    {"ND_noise3d_float", "noise3d", "float", "amplitude:float"},
    {"ND_rotate2d_vector2", "rotate2d", "vector2", "in:vector2 amount:float"},
    {"ND_hsvadjust_color3", "hsvadjust", "color3", "in:color3 amount:vector3"},
    // mixtures
    {"ND_mix_color3", "mix", "color3", "fg:color3 bg:color3 mix:float"},
    {"ND_mix_color3_color3", "mix", "color3", "fg:color3 bg:color3 mix:color3"},
    {"ND_mix_float", "mix", "float", "fg:float bg:float mix:float"},
    {"ND_mix_bsdf", "mix", "BSDF", "fg:BSDF bg:BSDF mix:float"},
    {"ND_multiply_edfC", "multiply", "EDF", "in1:EDF in2:color3"},
    {"ND_layer_vdf", "layer", "BSDF", "top:BSDF base:VDF"},
    {"ND_oren_nayar_diffuse_bsdf", "oren_nayar_diffuse_bsdf", "BSDF", "weight:float"},
    // told apart by what goes in
    {"ND_magnitude_vector2", "magnitude", "float", "in:vector2"},
    {"ND_dotproduct_vector4", "dotproduct", "float", "in1:vector4 in2:vector4"},
    {"ND_extract_vector3", "extract", "float", "in:vector3 index:integer"},
    {"ND_separate3_vector3", "separate3", "multioutput", "in:vector3"},
    {"ND_separate4_color4", "separate4", "multioutput", "in:color4"},
    {"ND_convert_float_color3", "convert", "color3", "in:float"},
    {"ND_convert_boolean_float", "convert", "float", "in:boolean"},
    {"ND_swizzle_color3_float", "swizzle", "float", "in:color3 channels:string", 138},
    {"ND_creatematrix_vector3_matrix33", "creatematrix", "matrix33", "in1:vector3"},
    {"ND_combine2_vector2", "combine2", "vector2", "in1:float in2:float"},
    {"ND_combine2_color4CF", "combine2", "color4", "in1:color3 in2:float"},
    {"ND_combine2_vector4VF", "combine2", "vector4", "in1:vector3 in2:float"},
    {"ND_combine2_vector4VV", "combine2", "vector4", "in1:vector2 in2:vector2"},
    {"ND_combine3_color3", "combine3", "color3", "in1:float in2:float in3:float"},
    {"ND_transformmatrix_vector2M3", "transformmatrix", "vector2", "in:vector2 mat:matrix33"},
    {"ND_transformmatrix_vector3", "transformmatrix", "vector3", "in:vector3 mat:matrix33"},
    {"ND_transformmatrix_vector3M4", "transformmatrix", "vector3", "in:vector3 mat:matrix44"},
    // comparisons and choices
    {"ND_ifgreater_color3", "ifgreater", "color3", "value1:float in1:color3"},
    {"ND_ifgreater_color3I", "ifgreater", "color3", "value1:integer in1:color3"},
    {"ND_ifequal_floatB", "ifequal", "float", "value1:boolean"},
    {"ND_switch_vector3I", "switch", "vector3", "in1:vector3 which:integer"},
    {"ND_switch_vector3", "switch", "vector3", "in1:vector3 which:float"},
    {"ND_logical_and", "and", "boolean", "in1:boolean"},
    // odd ones
    {"ND_normalmap", "normalmap", "vector3", "in:vector3 scale:float", 138},
    {"ND_normalmap_float", "normalmap", "vector3", "in:vector3"},
    {"ND_normalmap_vector2", "normalmap", "vector3", "in:vector3 scale:vector2"},
    {"ND_displacement_float", "displacement", "displacementshader", "displacement:float"},
    {"ND_displacement_vector3", "displacement", "displacementshader", "displacement:vector3 scale:float"},
    {"ND_gltf_image_color3_color3_1_0", "gltf_image", "color3", "file:filename"},
    {"ND_gltf_normalmap_vector3_1_0", "gltf_normalmap", "vector3", "file:filename"},
    {"ND_randomcolor_integer", "randomcolor", "color3", "in:integer"},
    {"ND_ramp4_color3", "ramp4", "color3", "valuetl:color3"},
    {"ND_ramp", "ramp", "color4", "texcoord:vector2"},
};

TEST(NodeIds, areThoseOfMaterialX) {
    for (Row const& row : rows) {
        EXPECT_EQ(idOf(row), row.id) << row.category << " " << row.inputs;
    }
}

TEST(NodeIds, knowTheOldStandardSurface) {
    EXPECT_EQ(idOf({"", "standard_surface", "surfaceshader", ""}, "1.0.0"),
              "ND_standard_surface_surfaceshader_100");
    EXPECT_EQ(idOf({"", "standard_surface", "surfaceshader", ""}, "1.0.1"),
              "ND_standard_surface_surfaceshader");
}

} // namespace
} // namespace hipr::mtlx
