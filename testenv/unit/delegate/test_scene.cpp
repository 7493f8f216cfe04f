#include "testenv/unit/delegate/test_scene.h"

#include <algorithm>

#include "pxr/base/gf/frustum.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/imaging/hd/camera.h"
#include "pxr/imaging/pxOsd/tokens.h"
#include "pxr/usd/sdf/assetPath.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace {

const HdTupleType pointType{HdTypeFloatVec3, 1};

VtVec3fArray squarePoints(GfVec3f const& offset) {
    VtVec3fArray points{{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
    for (GfVec3f& point : points) {
        point += offset;
    }
    return points;
}

} // namespace

TestScene::Prim& TestScene::insertRprim(TfToken const& type, SdfPath const& id, SdfPath const& instancer) {
    Prim& prim = _prims[id];
    prim.type = type;
    prim.instancer = instancer;
#if PXR_VERSION < 2102
    GetRenderIndex().InsertRprim(type, this, id, instancer);
#else
    GetRenderIndex().InsertRprim(type, this, id);
#endif
    return prim;
}

TestScene::Prim& TestScene::addSquare(SdfPath const& id, GfVec3f const& color, SdfPath const& instancer) {
    Prim& prim = insertRprim(HdPrimTypeTokens->mesh, id, instancer);
    prim.topology = HdMeshTopology(PxOsdOpenSubdivTokens->none, PxOsdOpenSubdivTokens->rightHanded,
                                   VtIntArray{4}, VtIntArray{0, 1, 2, 3});
    prim.primvars[HdTokens->points] = {HdInterpolationVertex, VtValue(squarePoints(GfVec3f(0.f)))};
    prim.primvars[HdTokens->displayColor] = {HdInterpolationConstant, VtValue(VtVec3fArray{color})};
    return prim;
}

TestScene::Prim& TestScene::addSplats(SdfPath const& id, GfVec3f const& color, SdfPath const& instancer) {
    Prim& prim = insertRprim(hdhipr::particleFieldType(), id, instancer);
    const auto set = [&](char const* name, HdInterpolation interpolation, VtValue value) {
        prim.primvars[TfToken(name)] = {interpolation, std::move(value)};
    };
    const GfVec3f dc = (color - GfVec3f(0.5f)) / 0.28209479f; // of Y_0
    set("positions", HdInterpolationVertex, VtValue(VtVec3fArray{{-0.25f, 0, 0}, {0.25f, 0, 0}}));
    set("scales", HdInterpolationVertex, VtValue(VtVec3fArray(2, GfVec3f(0.1f))));
    set("radiance:sphericalHarmonicsDegree", HdInterpolationConstant, VtValue(0));
    set("radiance:sphericalHarmonicsCoefficients", HdInterpolationVertex, VtValue(VtVec3fArray(2, dc)));
    return prim;
}

TestScene::Prim& TestScene::addCurve(SdfPath const& id, GfVec3f const& color) {
    Prim& prim = insertRprim(HdPrimTypeTokens->basisCurves, id, SdfPath());
    prim.curves = HdBasisCurvesTopology(HdTokens->linear, TfToken(), HdTokens->nonperiodic, VtIntArray{3},
                                        VtIntArray());
    prim.primvars[HdTokens->points] = {
        HdInterpolationVertex, VtValue(VtVec3fArray{{-0.5f, -0.2f, 0}, {0, 0.2f, 0}, {0.5f, -0.2f, 0}})};
    prim.primvars[HdTokens->widths] = {HdInterpolationConstant, VtValue(VtFloatArray{0.2f})};
    prim.primvars[HdTokens->displayColor] = {HdInterpolationConstant, VtValue(VtVec3fArray{color})};
    return prim;
}

TestScene::Prim& TestScene::addPoints(SdfPath const& id, VtVec3fArray const& colors,
                                      SdfPath const& instancer) {
    Prim& prim = insertRprim(HdPrimTypeTokens->points, id, instancer);
    prim.primvars[HdTokens->points] = {HdInterpolationVertex,
                                       VtValue(VtVec3fArray{{-0.25f, 0, 0}, {0.25f, 0, 0}})};
    prim.primvars[HdTokens->widths] = {HdInterpolationVertex, VtValue(VtFloatArray(2, 0.4f))};
    prim.primvars[HdTokens->displayColor] = {HdInterpolationVertex, VtValue(colors)};
    return prim;
}

TestScene::Prim& TestScene::addInstancer(SdfPath const& id, SdfPath const& prototype,
                                         VtVec3fArray const& translations, SdfPath const& parent) {
    Prim& prim = _prims[id];
    prim.type = HdInstancerTokens->instancer;
    prim.instancer = parent;
    prim.primvars[TfToken("translate")] = {HdInterpolationInstance, VtValue(translations)};
    VtIntArray indices(translations.size());
    for (size_t i = 0; i < indices.size(); ++i) {
        indices[i] = int(i);
    }
    prim.indices[prototype] = indices;
#if PXR_VERSION < 2102
    GetRenderIndex().InsertInstancer(this, id, parent);
#else
    GetRenderIndex().InsertInstancer(this, id);
#endif
    return prim;
}

TestScene::Prim& TestScene::addDome(SdfPath const& id) {
    Prim& prim = _prims[id];
    prim.type = HdPrimTypeTokens->domeLight;
    prim.params[TfToken("intensity")] = VtValue(1.f);
    GetRenderIndex().InsertSprim(HdPrimTypeTokens->domeLight, this, id);
    return prim;
}

TestScene::Prim& TestScene::addSphereLightFarAway(SdfPath const& id) {
    Prim& prim = _prims[id];
    prim.type = HdPrimTypeTokens->sphereLight;
    prim.transform.SetTranslate(GfVec3d(0, 0, 1e5));
    GetRenderIndex().InsertSprim(HdPrimTypeTokens->sphereLight, this, id);
    return prim;
}

TestScene::Prim& TestScene::addMaterial(SdfPath const& id, GfVec3f const& color) {
    Prim& prim = _prims[id];
    prim.type = HdPrimTypeTokens->material;
    HdMaterialNode surface;
    surface.path = id.AppendChild(TfToken("surface"));
    surface.identifier = TfToken("UsdPreviewSurface");
    surface.parameters[TfToken("diffuseColor")] = VtValue(color);
    HdMaterialNetworkMap networks;
    networks.map[HdMaterialTerminalTokens->surface].nodes.push_back(surface);
    networks.terminals.push_back(surface.path);
    prim.resource = VtValue(networks);
    GetRenderIndex().InsertSprim(HdPrimTypeTokens->material, this, id);
    return prim;
}

TestScene::Prim& TestScene::addCamera(SdfPath const& id, double viewSize) {
    Prim& prim = _prims[id];
    prim.type = HdPrimTypeTokens->camera;
    const double half = viewSize / 2;
    GfFrustum frustum;
    frustum.SetProjectionType(GfFrustum::Orthographic);
    frustum.SetWindow(GfRange2d(GfVec2d(-half, -half), GfVec2d(half, half)));
    frustum.SetNearFar(GfRange1d(1, 100));
    frustum.SetPosition(GfVec3d(0, 0, 10));
    prim.params[TfToken("worldToViewMatrix")] = VtValue(frustum.ComputeViewMatrix());
    prim.params[TfToken("projectionMatrix")] = VtValue(frustum.ComputeProjectionMatrix());
    GetRenderIndex().InsertSprim(HdPrimTypeTokens->camera, this, id);
    return prim;
}

TestScene::Prim& TestScene::addComputation(SdfPath const& id) {
    Prim& prim = _prims[id];
    prim.type = HdPrimTypeTokens->extComputation;
    prim.params[TfToken("offset")] = VtValue(GfVec3f(0.f));
    GetRenderIndex().InsertSprim(HdPrimTypeTokens->extComputation, this, id);
    return prim;
}

TestScene::Prim& TestScene::addBuffer(SdfPath const& id, HdRenderBufferDescriptor const& descriptor) {
    Prim& prim = _prims[id];
    prim.type = HdPrimTypeTokens->renderBuffer;
    prim.buffer = descriptor;
    GetRenderIndex().InsertBprim(HdPrimTypeTokens->renderBuffer, this, id);
    return prim;
}

TestScene::Prim& TestScene::addVolume(SdfPath const& id, SdfPath const& instancer) {
    return insertRprim(HdPrimTypeTokens->volume, id, instancer);
}

TestScene::Prim& TestScene::addField(SdfPath const& id, std::string const& file, SdfPath const& volume,
                                     char const* name) {
    const TfToken type("openvdbAsset");
    Prim& field = _prims[id];
    field.type = type;
    field.params[TfToken("filePath")] = VtValue(SdfAssetPath(file));
    field.params[TfToken("fieldName")] = VtValue(TfToken(name));
    GetRenderIndex().InsertBprim(type, this, id);
    prim(volume).fields.emplace_back(TfToken(name), type, id);
    return field;
}

void TestScene::remove(SdfPath const& id) {
    const TfToken type = prim(id).type;
    if (type == HdPrimTypeTokens->mesh || type == HdPrimTypeTokens->volume ||
        type == hdhipr::particleFieldType()) {
        GetRenderIndex().RemoveRprim(id);
    } else if (type == HdInstancerTokens->instancer) {
        GetRenderIndex().RemoveInstancer(id);
    } else if (type == HdPrimTypeTokens->renderBuffer || type == "openvdbAsset") {
        GetRenderIndex().RemoveBprim(type, id);
    } else {
        GetRenderIndex().RemoveSprim(type, id);
    }
    _prims.erase(id);
}

VtValue TestScene::Get(SdfPath const& id, TfToken const& key) {
    const auto found = prim(id).primvars.find(key);
    return found == prim(id).primvars.end() ? param(id, key) : found->second.value;
}

HdPrimvarDescriptorVector TestScene::GetPrimvarDescriptors(SdfPath const& id, HdInterpolation interpolation) {
    HdPrimvarDescriptorVector list;
    for (auto const& [name, primvar] : prim(id).primvars) {
        if (primvar.interpolation == interpolation) {
            list.emplace_back(name, interpolation);
        }
    }
    return list;
}

size_t TestScene::SampleTransform(SdfPath const& id, size_t most, float* times, GfMatrix4d* values) {
    const GfMatrix4d samples[] = {prim(id).transform, prim(id).transform * prim(id).shutterMotion};
    for (size_t i = 0; i < std::min<size_t>(most, 2); ++i) {
        times[i] = float(i);
        values[i] = samples[i];
    }
    return 2;
}

size_t TestScene::SamplePrimvar(SdfPath const& id, TfToken const& key, size_t most, float* times,
                                VtValue* values) {
    const auto atClose = prim(id).primvarsAtClose.find(key);
    const VtValue atOpen = Get(id, key);
    const VtValue samples[] = {atOpen, atClose == prim(id).primvarsAtClose.end() ? atOpen : atClose->second};
    for (size_t i = 0; i < std::min<size_t>(most, 2); ++i) {
        times[i] = float(i);
        values[i] = samples[i];
    }
    return 2;
}

VtIntArray TestScene::GetInstanceIndices(SdfPath const& id, SdfPath const& prototype) {
    return prim(id).indices[prototype];
}

VtValue TestScene::GetLightParamValue(SdfPath const& id, TfToken const& name) {
    return name == "transform" ? VtValue(prim(id).transform) : param(id, name);
}

VtValue TestScene::param(SdfPath const& id, TfToken const& name) {
    const auto found = prim(id).params.find(name);
    return found == prim(id).params.end() ? VtValue() : found->second;
}

HdExtComputationOutputDescriptorVector TestScene::GetExtComputationOutputDescriptors(SdfPath const&) {
    return {{TfToken("moved"), pointType}};
}

HdExtComputationPrimvarDescriptorVector
TestScene::GetExtComputationPrimvarDescriptors(SdfPath const& id, HdInterpolation interpolation) {
    SdfPath const& computation = prim(id).computation;
    if (computation.IsEmpty() || interpolation != HdInterpolationVertex) {
        return {};
    }
    return {{HdTokens->points, interpolation, HdPrimvarRoleTokens->point, computation, TfToken("moved"),
             pointType}};
}

void TestScene::InvokeExtComputation(SdfPath const&, HdExtComputationContext* context) {
    const VtValue offset = context->GetInputValue(TfToken("offset"));
    context->SetOutputValue(TfToken("moved"), VtValue(squarePoints(offset.Get<GfVec3f>())));
}

PXR_NAMESPACE_CLOSE_SCOPE
