#include "plugin/hdHipr/primvars.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "pxr/base/gf/half.h"
#include "pxr/base/gf/vec2d.h"
#include "pxr/base/gf/vec2f.h"
#include "pxr/base/gf/vec2h.h"
#include "pxr/base/gf/vec2i.h"
#include "pxr/base/gf/vec3d.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/gf/vec3h.h"
#include "pxr/base/gf/vec3i.h"
#include "pxr/base/gf/vec4d.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/base/gf/vec4h.h"
#include "pxr/base/gf/vec4i.h"
#include "pxr/base/vt/array.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

template <class T, class = void> struct Element {
    static constexpr uint32_t components = 1;
    static void append(T const& value, std::vector<float>& out) { out.push_back(float(value)); }
};
template <class T> struct Element<T, std::void_t<decltype(T::dimension)>> {
    static constexpr uint32_t components = T::dimension;
    static void append(T const& value, std::vector<float>& out) {
        for (size_t c = 0; c < components; ++c) {
            out.push_back(float(value[c]));
        }
    }
};

template <class T> bool convert(VtValue const& value, hipr::Primvar& out) {
    out.components = Element<T>::components;
    if (value.IsHolding<VtArray<T>>()) {
        VtArray<T> const& array = value.UncheckedGet<VtArray<T>>();
        out.values.reserve(array.size() * Element<T>::components);
        for (size_t i = 0; i < array.size(); ++i) {
            Element<T>::append(array.cdata()[i], out.values);
        }
        return true;
    }
    if (value.IsHolding<T>()) {
        Element<T>::append(value.UncheckedGet<T>(), out.values);
        return true;
    }
    return false;
}

template <class... T> bool convertAny(VtValue const& value, hipr::Primvar& out) {
    return (convert<T>(value, out) || ...);
}

} // namespace

std::optional<hipr::Primvar> toPrimvar(TfToken const& name, VtValue const& value) {
    hipr::Primvar out;
    out.name = name.GetString();
    const bool known = convertAny<GfVec3f, GfVec2f, float, GfVec4f, int, bool, double, GfVec3d, GfVec2d,
                                  GfVec4d, GfHalf, GfVec3h, GfVec2h, GfVec4h, GfVec2i, GfVec3i, GfVec4i,
                                  unsigned char, unsigned int, int64_t, uint64_t>(value, out);
    if (!known || out.values.empty()) {
        return std::nullopt;
    }
    return out;
}

std::optional<glm::vec3> toColor(TfToken const& name, VtValue const& value) {
    const std::optional<hipr::Primvar> primvar = toPrimvar(name, value);
    if (!primvar) {
        return std::nullopt;
    }
    auto const& v = primvar->values;
    const glm::vec3 color = primvar->components < 3 ? glm::vec3(v[0]) : glm::vec3(v[0], v[1], v[2]);
    return finite(color) ? std::optional(color) : std::nullopt;
}

std::optional<hipr::Interpolation> toInterpolation(HdInterpolation interpolation) {
    switch (interpolation) {
    case HdInterpolationConstant:
        return hipr::Interpolation::Constant;
    case HdInterpolationUniform:
        return hipr::Interpolation::Uniform;
    case HdInterpolationVarying:
    case HdInterpolationVertex:
        return hipr::Interpolation::Vertex;
    case HdInterpolationFaceVarying:
        return hipr::Interpolation::FaceVarying;
    default:
        return std::nullopt;
    }
}

HdPrimvarDescriptor const& DescriptorChoice::choose(HdPrimvarDescriptorVector const& same,
                                                    std::vector<bool> const& fits,
                                                    std::optional<HdInterpolation> now) {
    TfToken const& name = same.front().name;
    size_t best = 0;
    int bestScore = -1;
    for (size_t i = 0; i < same.size(); ++i) {
        const HdInterpolation interpolation = same[i].interpolation;
        const bool outdated = _outdated.count({name, interpolation}) > 0;
        const int score = 4 * int(fits[i]) + 2 * int(!outdated) + int(now != interpolation);
        if (score > bestScore) {
            best = i;
            bestScore = score;
        }
    }
    for (HdPrimvarDescriptor const& other : same) {
        _outdated.insert({name, other.interpolation});
    }
    _outdated.erase({name, same[best].interpolation});
    return same[best];
}

std::vector<HdPrimvarDescriptorVector> byName(HdPrimvarDescriptorVector const& descriptors) {
    std::vector<HdPrimvarDescriptorVector> groups;
    for (HdPrimvarDescriptor const& descriptor : descriptors) {
        const auto known =
            std::find_if(groups.begin(), groups.end(), [&](HdPrimvarDescriptorVector const& g) {
                return g.front().name == descriptor.name;
            });
        if (known == groups.end()) {
            groups.push_back({descriptor});
        } else {
            known->push_back(descriptor);
        }
    }
    return groups;
}

bool finite(glm::vec3 const& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::vector<glm::vec3> toVec3s(VtValue const& value) {
    std::vector<glm::vec3> out;
    const auto convert = [](auto const& v) { return glm::vec3(float(v[0]), float(v[1]), float(v[2])); };
    appendArray<GfVec3f>(value, out, convert) || appendArray<GfVec3d>(value, out, convert) ||
        appendArray<GfVec3h>(value, out, convert);
    return out;
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
