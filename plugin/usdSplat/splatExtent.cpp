// The extent of splat prims that have none authored, for OpenUSD before 26.03.
#include "plugin/usdSplat/splatAttributes.h"
#include "plugin/usdSplat/splatLayer.h"
#include "pxr/base/gf/bbox3d.h"
#include "pxr/base/gf/quath.h"
#include "pxr/base/gf/vec3h.h"
#include "pxr/base/tf/registryManager.h"
#include "pxr/usd/usdGeom/boundable.h"
#include "pxr/usd/usdGeom/boundableComputeExtent.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace {

glm::vec3 toGlm(GfVec3f const& v) {
    return {v[0], v[1], v[2]};
}
glm::quat toGlm(GfQuatf const& q) {
    return {q.GetReal(), q.GetImaginary()[0], q.GetImaginary()[1], q.GetImaginary()[2]};
}

/// The values of an attribute in single or half precision. Others are none, as are fewer than `least`.
template <class Single, class Half, class Out>
void read(UsdPrim const& prim, TfToken const& name, UsdTimeCode time, size_t least, std::vector<Out>* out) {
    VtValue value;
    if (const UsdAttribute attribute = UsdSplatAttribute(prim, name)) {
        attribute.Get(&value, time);
    }
    if (value.IsHolding<VtArray<Single>>()) {
        for (Single const& one : value.UncheckedGet<VtArray<Single>>()) {
            out->push_back(toGlm(one));
        }
    } else if (value.IsHolding<VtArray<Half>>()) {
        for (Half const& one : value.UncheckedGet<VtArray<Half>>()) {
            out->push_back(toGlm(Single(one)));
        }
    }
    if (out->size() < least) {
        out->clear();
    }
}

bool computeExtent(UsdGeomBoundable const& boundable, UsdTimeCode const& time, GfMatrix4d const* transform,
                   VtVec3fArray* extent) {
    const UsdPrim prim = boundable.GetPrim();
    const hdhipr::SplatTokens tokens;
    hipr::SplatCloud cloud;
    read<GfVec3f, GfVec3h>(prim, tokens.positions, time, 0, &cloud.positions);
    read<GfVec3f, GfVec3h>(prim, tokens.scales, time, cloud.size(), &cloud.scales);
    read<GfQuatf, GfQuath>(prim, tokens.orientations, time, cloud.size(), &cloud.orientations);
    *extent = UsdSplatExtent(cloud);
    if (extent->empty()) {
        return false;
    }
    if (transform) {
        const GfRange3d box =
            GfBBox3d(GfRange3d((*extent)[0], (*extent)[1]), *transform).ComputeAlignedRange();
        *extent = {GfVec3f(box.GetMin()), GfVec3f(box.GetMax())};
    }
    return true;
}

} // namespace

TF_REGISTRY_FUNCTION(UsdGeomBoundable) {
    UsdGeomRegisterComputeExtentFunction(TfType::FindByName("UsdVolParticleField"), computeExtent);
}

PXR_NAMESPACE_CLOSE_SCOPE
