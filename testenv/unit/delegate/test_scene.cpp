#include "testenv/unit/delegate/test_scene.h"

#include "pxr/base/gf/vec3f.h"
#include "pxr/imaging/pxOsd/tokens.h"

PXR_NAMESPACE_OPEN_SCOPE

TestScene::Prim& TestScene::addSquare(SdfPath const& id, GfVec3f const& color, SdfPath const& instancer) {
    Prim& prim = _prims[id];
    prim.type = HdPrimTypeTokens->mesh;
    prim.instancer = instancer;
    prim.topology = HdMeshTopology(PxOsdOpenSubdivTokens->none, PxOsdOpenSubdivTokens->rightHanded,
                                   VtIntArray{4}, VtIntArray{0, 1, 2, 3});
    prim.primvars[HdTokens->points] = {
        HdInterpolationVertex,
        VtValue(VtVec3fArray{{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}})};
    prim.primvars[HdTokens->displayColor] = {HdInterpolationConstant, VtValue(VtVec3fArray{color})};
#if PXR_VERSION < 2102
    GetRenderIndex().InsertRprim(HdPrimTypeTokens->mesh, this, id, instancer);
#else
    GetRenderIndex().InsertRprim(HdPrimTypeTokens->mesh, this, id);
#endif
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

void TestScene::remove(SdfPath const& id) {
    const TfToken type = prim(id).type;
    if (type == HdPrimTypeTokens->mesh) {
        GetRenderIndex().RemoveRprim(id);
    } else if (type == HdInstancerTokens->instancer) {
        GetRenderIndex().RemoveInstancer(id);
    } else {
        GetRenderIndex().RemoveSprim(type, id);
    }
    _prims.erase(id);
}

VtValue TestScene::Get(SdfPath const& id, TfToken const& key) {
    const auto found = prim(id).primvars.find(key);
    return found == prim(id).primvars.end() ? VtValue() : found->second.value;
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

VtIntArray TestScene::GetInstanceIndices(SdfPath const& id, SdfPath const& prototype) {
    return prim(id).indices[prototype];
}

VtValue TestScene::GetLightParamValue(SdfPath const& id, TfToken const& name) {
    if (name == "transform") {
        return VtValue(prim(id).transform);
    }
    const auto found = prim(id).params.find(name);
    return found == prim(id).params.end() ? VtValue() : found->second;
}

PXR_NAMESPACE_CLOSE_SCOPE
