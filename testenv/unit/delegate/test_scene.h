/// @file test_scene.h
/// A scene delegate that holds a handful of prims in a map, so that a test can edit any of them and mark any
/// bit.
#pragma once

#include <map>

#include "plugin/hdHipr/compat.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/imaging/hd/basisCurvesTopology.h"
#include "pxr/imaging/hd/extComputationContext.h"
#include "pxr/imaging/hd/tokens.h"

PXR_NAMESPACE_OPEN_SCOPE

class TestScene final : public HdSceneDelegate {
public:
    struct Primvar {
        HdInterpolation interpolation;
        VtValue value;
    };
    struct Prim {
        TfToken type;
        HdMeshTopology topology;
        HdBasisCurvesTopology curves;
        GfMatrix4d transform{1.0};
        bool visible = true, doubleSided = true;
        TfToken renderTag = HdRenderTagTokens->geometry;
        SdfPath material, instancer;
        std::map<TfToken, Primvar> primvars;
        VtArray<TfToken> categories;                      ///< collections of lights that it is in
        std::vector<VtArray<TfToken>> instanceCategories; ///< of an instancer
        std::map<TfToken, VtValue> params;                ///< of a light, camera, computation or field
        HdVolumeFieldDescriptorVector fields;             ///< of a volume
        std::map<SdfPath, VtIntArray> indices;            ///< of an instancer, by prototype
        VtValue resource;                                 ///< of a material
        PxOsdSubdivTags tags;
        int refineLevel = 0;
        HdReprSelector repr;
        SdfPath computation; ///< that gives the points
        HdRenderBufferDescriptor buffer;
        HdCullStyle cullStyle = HdCullStyleDontCare;
        GfMatrix4d shutterMotion{1.0};              ///< from the opening of the shutter to its closing
        std::map<TfToken, VtValue> primvarsAtClose; ///< of the shutter; absent: as at its opening
    };

    explicit TestScene(HdRenderIndex* index) : HdSceneDelegate(index, SdfPath::AbsoluteRootPath()) {}

    /// Adds a unit square in the XY plane, facing +Z, centred at the origin, of one colour.
    Prim& addSquare(SdfPath const& id, GfVec3f const& color, SdfPath const& instancer = SdfPath());
    /// Adds a cloud of two round splats of one colour, at x = -0.25 and 0.25.
    Prim& addSplats(SdfPath const& id, GfVec3f const& color, SdfPath const& instancer = SdfPath());
    /// Adds a bent line of three points in the XY plane, 0.2 wide.
    Prim& addCurve(SdfPath const& id, GfVec3f const& color);
    /// Adds two points at x = -0.25 and 0.25, 0.4 wide, each of its colour.
    Prim& addPoints(SdfPath const& id, VtVec3fArray const& colors, SdfPath const& instancer = SdfPath());
    /// Adds a volume without fields.
    Prim& addVolume(SdfPath const& id, SdfPath const& instancer = SdfPath());
    /// Adds a field and gives it to a volume for what `name` says.
    Prim& addField(SdfPath const& id, std::string const& file, SdfPath const& volume,
                   char const* name = "density");
    /// Adds an instancer of `prototype` with a translation per instance.
    Prim& addInstancer(SdfPath const& id, SdfPath const& prototype, VtVec3fArray const& translations,
                       SdfPath const& parent = SdfPath());
    /// Adds a dome light of radiance 1, in which a white diffuse surface shows 1.
    Prim& addDome(SdfPath const& id);
    /// Adds a lamp whose light does not arrive: without any light the renderer would add its own.
    Prim& addSphereLightFarAway(SdfPath const& id);
    /// Adds a UsdPreviewSurface of one diffuse colour without a specular lobe's help.
    Prim& addMaterial(SdfPath const& id, GfVec3f const& color);

    /// Adds a camera that sees what a TestHost without a camera sees.
    Prim& addCamera(SdfPath const& id, double viewSize);
    /// Adds a computation of points: those of the unit square, moved by its input "offset".
    Prim& addComputation(SdfPath const& id);
    /// Adds a render buffer to the index.
    Prim& addBuffer(SdfPath const& id, HdRenderBufferDescriptor const& descriptor);

    Prim& prim(SdfPath const& id) { return _prims.at(id); }
    HdChangeTracker& tracker() { return GetRenderIndex().GetChangeTracker(); }
    void remove(SdfPath const& id);

    HdMeshTopology GetMeshTopology(SdfPath const& id) override { return prim(id).topology; }
    HdBasisCurvesTopology GetBasisCurvesTopology(SdfPath const& id) override { return prim(id).curves; }
    PxOsdSubdivTags GetSubdivTags(SdfPath const& id) override { return prim(id).tags; }
    GfMatrix4d GetTransform(SdfPath const& id) override { return prim(id).transform; }
    bool GetVisible(SdfPath const& id) override { return prim(id).visible; }
    bool GetDoubleSided(SdfPath const& id) override { return prim(id).doubleSided; }
    TfToken GetRenderTag(SdfPath const& id) override { return prim(id).renderTag; }
    SdfPath GetMaterialId(SdfPath const& id) override { return prim(id).material; }
    VtValue GetMaterialResource(SdfPath const& id) override { return prim(id).resource; }
    HdDisplayStyle GetDisplayStyle(SdfPath const& id) override {
        return HdDisplayStyle(prim(id).refineLevel);
    }
    HdCullStyle GetCullStyle(SdfPath const& id) override { return prim(id).cullStyle; }
    size_t SampleTransform(SdfPath const& id, size_t most, float* times, GfMatrix4d* values) override;
    size_t SampleInstancerTransform(SdfPath const& id, size_t most, float* times,
                                    GfMatrix4d* values) override {
        return SampleTransform(id, most, times, values);
    }
    size_t SamplePrimvar(SdfPath const& id, TfToken const& key, size_t most, float* times,
                         VtValue* values) override;
    GfMatrix4d GetInstancerTransform(SdfPath const& id) override { return prim(id).transform; }
    VtValue Get(SdfPath const& id, TfToken const& key) override;
    HdPrimvarDescriptorVector GetPrimvarDescriptors(SdfPath const& id,
                                                    HdInterpolation interpolation) override;
    VtArray<TfToken> GetCategories(SdfPath const& id) override { return prim(id).categories; }
    std::vector<VtArray<TfToken>> GetInstanceCategories(SdfPath const& id) override {
        return prim(id).instanceCategories;
    }
    VtIntArray GetInstanceIndices(SdfPath const& id, SdfPath const& prototype) override;
    VtValue GetLightParamValue(SdfPath const& id, TfToken const& name) override;
    VtValue GetCameraParamValue(SdfPath const& id, TfToken const& name) override { return param(id, name); }
    HdVolumeFieldDescriptorVector GetVolumeFieldDescriptors(SdfPath const& id) override {
        return prim(id).fields;
    }
    HdReprSelector GetReprSelector(SdfPath const& id) override { return prim(id).repr; }
    HdRenderBufferDescriptor GetRenderBufferDescriptor(SdfPath const& id) override { return prim(id).buffer; }
    TfTokenVector GetExtComputationSceneInputNames(SdfPath const&) override { return {TfToken("offset")}; }
    VtValue GetExtComputationInput(SdfPath const& id, TfToken const& name) override {
        return param(id, name);
    }
    HdExtComputationOutputDescriptorVector GetExtComputationOutputDescriptors(SdfPath const&) override;
    HdExtComputationPrimvarDescriptorVector
    GetExtComputationPrimvarDescriptors(SdfPath const& id, HdInterpolation interpolation) override;
    void InvokeExtComputation(SdfPath const& id, HdExtComputationContext* context) override;
#if PXR_VERSION >= 2102
    SdfPath GetInstancerId(SdfPath const& id) override {
        return prim(id).instancer;
    }
#endif

private:
    Prim& insertRprim(TfToken const& type, SdfPath const& id, SdfPath const& instancer);
    VtValue param(SdfPath const& id, TfToken const& name);

    std::map<SdfPath, Prim> _prims;
};

PXR_NAMESPACE_CLOSE_SCOPE
