#include "plugin/mtlxFile/value.h"

#include <map>
#include <vector>

#include "pxr/base/gf/matrix3d.h"
#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/gf/vec2f.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/base/tf/stringUtils.h"
#include "pxr/base/vt/array.h"
#include "pxr/usd/sdf/assetPath.h"
#include "pxr/usd/sdf/types.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

using Value = std::optional<VtValue>;
using Read = Value (*)(std::string const& text);

/// Numbers between commas or blanks; nothing when one is none.
template <class T> std::optional<std::vector<T>> numbers(std::string const& text) {
    std::vector<T> values;
    for (std::string const& word : TfStringTokenize(text, ", \t\r\n")) {
        char* end = nullptr;
        const double value = strtod(word.c_str(), &end);
        if (*end != '\0' || (std::is_integral_v<T> && value != double(T(value)))) {
            return std::nullopt;
        }
        values.push_back(T(value));
    }
    return values;
}

template <class T> Value readNumber(std::string const& text) {
    const auto values = numbers<T>(text);
    return values && values->size() == 1 ? Value(VtValue(values->front())) : std::nullopt;
}

/// Of a type with operator[] for its components.
template <class Vec> Value readVec(std::string const& text) {
    const auto values = numbers<float>(text);
    if (!values || values->size() != Vec::dimension) {
        return std::nullopt;
    }
    return VtValue(Vec(values->data()));
}

template <class Matrix, size_t Rows> Value readMatrix(std::string const& text) {
    const auto values = numbers<double>(text);
    if (!values || values->size() != Rows * Rows) {
        return std::nullopt;
    }
    Matrix matrix;
    std::copy(values->begin(), values->end(), matrix.GetArray());
    return VtValue(matrix);
}

template <class T> Value readNumbers(std::string const& text) {
    const auto values = numbers<T>(text);
    return values ? Value(VtValue(VtArray<T>(values->begin(), values->end()))) : std::nullopt;
}

template <class Vec> Value readVecs(std::string const& text) {
    const auto values = numbers<float>(text);
    if (!values || values->size() % Vec::dimension) {
        return std::nullopt;
    }
    VtArray<Vec> vectors;
    for (size_t i = 0; i < values->size(); i += Vec::dimension) {
        vectors.push_back(Vec(values->data() + i));
    }
    return VtValue(vectors);
}

Value readBool(std::string const& text) {
    const std::string word = TfStringTrim(text);
    return word == "true" || word == "false" ? Value(VtValue(word == "true")) : std::nullopt;
}

Value readString(std::string const& text) {
    return VtValue(text);
}

Value readStrings(std::string const& text) {
    VtStringArray strings;
    for (std::string const& word : TfStringTokenize(text, ",")) {
        strings.push_back(TfStringTrim(word));
    }
    return VtValue(strings);
}

Value readFile(std::string const& text) {
    return VtValue(SdfAssetPath(text));
}

struct Type {
    SdfValueTypeName name;
    Read read;
};

/// Nothing for shaders and closures, and for types that a document defines itself.
Type const* find(std::string const& type) {
    static auto const& usd = *SdfValueTypeNames;
    static const std::map<std::string, Type> types = {
        {"boolean", {usd.Bool, readBool}},
        {"integer", {usd.Int, readNumber<int>}},
        {"float", {usd.Float, readNumber<float>}},
        {"color2", {usd.Float2, readVec<GfVec2f>}},
        {"color3", {usd.Color3f, readVec<GfVec3f>}},
        {"color4", {usd.Color4f, readVec<GfVec4f>}},
        {"vector2", {usd.Float2, readVec<GfVec2f>}},
        {"vector3", {usd.Float3, readVec<GfVec3f>}},
        {"vector4", {usd.Float4, readVec<GfVec4f>}},
        {"matrix33", {usd.Matrix3d, readMatrix<GfMatrix3d, 3>}},
        {"matrix44", {usd.Matrix4d, readMatrix<GfMatrix4d, 4>}},
        {"string", {usd.String, readString}},
        {"geomname", {usd.String, readString}},
        {"filename", {usd.Asset, readFile}},
        {"integerarray", {usd.IntArray, readNumbers<int>}},
        {"floatarray", {usd.FloatArray, readNumbers<float>}},
        {"color2array", {usd.Float2Array, readVecs<GfVec2f>}},
        {"color3array", {usd.Color3fArray, readVecs<GfVec3f>}},
        {"color4array", {usd.Color4fArray, readVecs<GfVec4f>}},
        {"vector2array", {usd.Float2Array, readVecs<GfVec2f>}},
        {"vector3array", {usd.Float3Array, readVecs<GfVec3f>}},
        {"vector4array", {usd.Float4Array, readVecs<GfVec4f>}},
        {"stringarray", {usd.StringArray, readStrings}},
        {"geomnamearray", {usd.StringArray, readStrings}},
    };
    const auto found = types.find(type);
    return found == types.end() ? nullptr : &found->second;
}

} // namespace

SdfValueTypeName mtlxType(std::string const& type) {
    Type const* known = find(type);
    return known ? known->name : SdfValueTypeNames->Token;
}

std::optional<VtValue> mtlxValue(std::string const& type, std::string const& text) {
    Type const* known = find(type);
    return known ? known->read(text) : std::nullopt;
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
