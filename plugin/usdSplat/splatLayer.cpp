#include "plugin/usdSplat/splatLayer.h"

#include <algorithm>

#include "pxr/base/gf/quatf.h"
#include "pxr/usd/sdf/attributeSpec.h"
#include "pxr/usd/sdf/primSpec.h"
#include "pxr/usd/sdf/types.h"
#include "renderer/splats/bounds.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace {

GfVec3f toGf(glm::vec3 const& v) {
    return GfVec3f(v.x, v.y, v.z);
}
GfQuatf toGf(glm::quat const& q) {
    return GfQuatf(q.w, q.x, q.y, q.z);
}
float toGf(float value) {
    return value;
}

/// The values as an array of USD; the vector's memory is given back.
template <class T> auto taken(std::vector<T>& values) {
    VtArray<decltype(toGf(values.front()))> array(values.size());
    std::transform(values.begin(), values.end(), array.data(), [](T const& value) { return toGf(value); });
    std::vector<T>().swap(values);
    return array;
}

void addAttribute(SdfPrimSpecHandle const& prim, char const* name, SdfValueTypeName const& type,
                  VtValue const& value, SdfVariability variability = SdfVariabilityVarying) {
    SdfAttributeSpec::New(prim, name, type, variability)->SetDefaultValue(value);
}

template <class T>
void addArray(SdfPrimSpecHandle const& prim, char const* name, SdfValueTypeName const& type,
              std::vector<T>& values) {
    if (!values.empty()) {
        auto array = taken(values);
        addAttribute(prim, name, type, VtValue::Take(array));
    }
}

/// The turn about X that makes an axis Y, in degrees.
float turnOf(UsdSplatUp up) {
    switch (up) {
    case UsdSplatUp::MinusY:
        return 180.f;
    case UsdSplatUp::Z:
        return -90.f;
    case UsdSplatUp::MinusZ:
        return 90.f;
    case UsdSplatUp::Y:
        break;
    }
    return 0.f;
}

void turn(SdfPrimSpecHandle const& prim, UsdSplatUp up) {
    if (up == UsdSplatUp::Y) {
        return;
    }
    addAttribute(prim, "xformOp:rotateX", SdfValueTypeNames->Float, VtValue(turnOf(up)));
    addAttribute(prim, "xformOpOrder", SdfValueTypeNames->TokenArray,
                 VtValue(VtTokenArray{TfToken("xformOp:rotateX")}), SdfVariabilityUniform);
}

} // namespace

VtVec3fArray UsdSplatExtent(hipr::SplatCloud const& cloud) {
    constexpr float reach = 3.f; // the support of UsdVol's Gaussian kernel, in standard deviations
    const hipr::SplatBox box = hipr::splatBox(cloud, reach);
    return box.empty() ? VtVec3fArray() : VtVec3fArray{toGf(box.lo), toGf(box.hi)};
}

std::optional<UsdSplatUp> UsdSplatUpNamed(std::string const& name) {
    constexpr std::pair<char const*, UsdSplatUp> names[] = {
        {"y", UsdSplatUp::Y}, {"-y", UsdSplatUp::MinusY}, {"z", UsdSplatUp::Z}, {"-z", UsdSplatUp::MinusZ}};
    for (auto const& [known, up] : names) {
        if (name == known) {
            return up;
        }
    }
    return std::nullopt;
}

SdfLayerRefPtr UsdSplatMakeLayer(hipr::SplatCloud&& cloud, UsdSplatUp up) {
    const SdfLayerRefPtr layer = SdfLayer::CreateAnonymous("splats.usda");
    const SdfPrimSpecHandle prim =
        SdfPrimSpec::New(layer, "Splats", SdfSpecifierDef, "ParticleField3DGaussianSplat");
    layer->SetDefaultPrim(prim->GetNameToken());
    addAttribute(prim, "extent", SdfValueTypeNames->Float3Array, VtValue(UsdSplatExtent(cloud)));
    addArray(prim, "positions", SdfValueTypeNames->Point3fArray, cloud.positions);
    addArray(prim, "orientations", SdfValueTypeNames->QuatfArray, cloud.orientations);
    addArray(prim, "scales", SdfValueTypeNames->Float3Array, cloud.scales);
    addArray(prim, "opacities", SdfValueTypeNames->FloatArray, cloud.opacities);
    addAttribute(prim, "radiance:sphericalHarmonicsDegree", SdfValueTypeNames->Int,
                 VtValue(int(cloud.shDegree)), SdfVariabilityUniform);
    addArray(prim, "radiance:sphericalHarmonicsCoefficients", SdfValueTypeNames->Float3Array,
             cloud.coefficients);
    turn(prim, up);
    return layer;
}

PXR_NAMESPACE_CLOSE_SCOPE
