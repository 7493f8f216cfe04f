#include "pxr/imaging/cameraUtil/conformWindow.h"
#include "pxr/imaging/hd/camera.h"
#include "pxr/imaging/hd/extComputation.h"
#include "testenv/unit/delegate/dirty_bits_rows.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace dirtybits {

namespace {

const Elements camera = {{Target::View, Change::Camera}}, moved = {{Target::Lamp, Change::Transform}},
               emission = {{Target::Lamp, Change::Emission}}, material = {{Target::Red, Change::Material}};

void switchOff(TestScene::Prim& prim, bool make) {
    prim.visible = !make;
}

/// An edit of a parameter of the surface shader of a material.
Edit surface(const char* name, GfVec3f made, GfVec3f undone) {
    return [=](TestScene::Prim& prim, bool make) {
        auto networks = prim.resource.UncheckedGet<HdMaterialNetworkMap>();
        auto& nodes = networks.map[HdMaterialTerminalTokens->surface].nodes;
        nodes[0].parameters[TfToken(name)] = VtValue(make ? made : undone);
        prim.resource = VtValue(networks);
    };
}

const Edit repaint = surface("diffuseColor", GfVec3f(0.1f, 0.1f, 0.8f), GfVec3f(0.8f, 0.1f, 0.1f));

/// Empties the network and fills it again.
void disconnect(TestScene::Prim& prim, bool make) {
    if (!make) {
        prim.resource = prim.params[TfToken("kept")];
    } else if (!prim.resource.UncheckedGet<HdMaterialNetworkMap>().map.empty()) {
        prim.params[TfToken("kept")] = std::exchange(prim.resource, VtValue(HdMaterialNetworkMap()));
    }
}

GfMatrix4d seenFrom(double z) {
    return GfMatrix4d(1.0).SetTranslate(GfVec3d(0, 0, -z));
}

/// An orthographic projection of 8 units in height.
GfMatrix4d projection(double aspect) {
    GfMatrix4d matrix(1.0);
    matrix.SetDiagonal(GfVec4d(0.25 / aspect, 0.25, -2.0 / 99, 1));
    matrix[3][2] = -101.0 / 99;
    return matrix;
}

/// The same, on a camera whose aspect is not the picture's, so that the policy matters.
void conform(TestScene::Prim& prim, bool make) {
    prim.params[HdCameraTokens->windowPolicy] = VtValue(make ? CameraUtilCrop : CameraUtilFit);
}

void openLens(TestScene::Prim& prim, bool make) {
    prim.params[TfToken("focalLength")] = VtValue(5.f);
    prim.params[TfToken("focusDistance")] = VtValue(8.f);
    prim.params[TfToken("fStop")] = VtValue(make ? 2.8f : 0.f);
}

/// An input of a computation, and what UsdImaging marks with it on the mesh that gets its values.
Apply computeElsewhere(HdDirtyBits ofMesh) {
    return [=](World& world, bool make) {
        world.prim("/computation").params[TfToken("offset")] = VtValue(GfVec3f(0, make ? 0.5f : 0.f, 0));
        world.tracker().MarkSprimDirty(SdfPath("/computation"), HdExtComputation::DirtySceneInput);
        world.tracker().MarkRprimDirty(SdfPath("/computed"), ofMesh);
    };
}

Row unread(const char* bit, const char* why, Apply apply) {
    return {bit, why, "", std::move(apply), {}};
}

} // namespace

Section lightSection() {
    const auto light = [](HdDirtyBits bits, Edit edit) { return sprim("/lamp", bits, std::move(edit)); };
    return {
        "Light",
        "An element is the light.",
        {
            {"HdLight::DirtyTransform", "the transform", "it moves", light(HdLight::DirtyTransform, move),
             moved},
            {"HdLight::DirtyParams", "all parameters, the texture's path and visibility",
             "its intensity changes", light(HdLight::DirtyParams, param("intensity", 2.f, 1.f)), emission},
            {"HdLight::DirtyParams",
             "the same",
             "it is switched off",
             light(HdLight::DirtyParams, switchOff),
             {{Target::Lamp, Change::Visibility}}},
            {"HdLight::DirtyShadowParams", "all parameters", "it becomes larger",
             light(HdLight::DirtyShadowParams, param("radius", 1.f, 0.5f)), emission},
            {"HdLight::DirtyShadowParams", "the same", "`shadow:enable` is switched off",
             light(HdLight::DirtyShadowParams, param("shadow:enable", false, true)), emission},
            {"HdLight::DirtyCollection",
             "all parameters; where the light is linked, before 24.08, all objects read their categories",
             "`lightLink` names a collection",
             light(HdLight::DirtyCollection, param("lightLink", TfToken("some"), TfToken())), emission},
            {"HdLight::DirtyCollection", "the same", "a square comes into the collection of a linked light",
             [](World& world, bool make) {
                 world.prim("/lamp").params[TfToken("shadowLink")] = VtValue(TfToken("some"));
                 world.prim("/square").categories = categories(make);
                 world.tracker().MarkSprimDirty(SdfPath("/lamp"), HdLight::DirtyCollection);
                 if (PXR_VERSION >= 2408) {
                     world.tracker().MarkRprimDirty(SdfPath("/square"), HdChangeTracker::DirtyCategories);
                 }
             },
             Elements{{Target::Lamp, Change::Emission}, {Target::Square, Change::Linking}},
             Elements{{Target::Square, Change::Linking}}},
            {"HdLight::AllDirty", "everything; only what differs is a change", "it moves",
             light(HdLight::AllDirty, move), moved},
            unread("HdLight::Clean", "nothing; Hydra refuses to mark it", [](World&, bool) {}),
        }};
}

Section materialSection() {
    const auto network = [](HdDirtyBits bits, Edit edit) { return sprim("/red", bits, std::move(edit)); };
    return {"Material",
            "An element is the material; what it shows on is found from there. Meshes are not touched.",
            {
                {"HdMaterial::DirtyResource", "the whole network", "its colour changes",
                 network(HdMaterial::DirtyResource, repaint), material},
                {"HdMaterial::DirtyResource",
                 "the same",
                 "it begins to glow",
                 network(HdMaterial::DirtyResource, surface("emissiveColor", GfVec3f(1.f), GfVec3f(0.f))),
                 {{Target::Red, Change::Material | Change::Emission}}},
                {"HdMaterial::DirtyResource", "the same",
                 "its network loses the surface, so meshes show displayColor",
                 network(HdMaterial::DirtyResource, disconnect), Elements{{Target::Red, Change::Removed}},
                 Elements{{Target::Red, Change::Added}}},
                {"HdMaterial::DirtyParams", "the whole network", "its colour changes",
                 network(HdMaterial::DirtyParams, repaint), material},
                {"HdMaterial::AllDirty", "the whole network", "its colour changes",
                 network(HdMaterial::AllDirty, repaint), material},
                unread("HdMaterial::Clean", "nothing; Hydra refuses to mark it", [](World&, bool) {}),
            }};
}

Section cameraSection() {
    const auto view = [](HdDirtyBits bits, Edit edit) { return sprim("/camera", bits, std::move(edit)); };
    return {
        "Camera",
        "A camera prim is no element. Hydra keeps its matrices for the render pass state, and a change is "
        "found when the pass is executed. The element, without an id, is the view.",
        {
            {"HdCamera::DirtyViewMatrix", "the view, by Hydra", "the camera moves",
             view(HdCamera::DirtyViewMatrix, param("worldToViewMatrix", seenFrom(12), seenFrom(10))), camera},
            {"HdCamera::DirtyProjMatrix", "the projection, by Hydra", "the picture becomes wider",
             view(HdCamera::DirtyProjMatrix, param("projectionMatrix", projection(1.5), projection(2))),
             camera},
            {"HdCamera::DirtyWindowPolicy", "the policy, by Hydra",
             "the window is cropped where the aspects differ", view(HdCamera::DirtyWindowPolicy, conform),
             camera},
            {"HdCamera::DirtyClipPlanes", "the planes, by Hydra", "a clipping plane is added",
             view(HdCamera::DirtyClipPlanes,
                  param("clipPlanes", std::vector<GfVec4d>{{0, 0, 1, 0}}, std::vector<GfVec4d>())),
             camera},
            {"HdCamera::DirtyParams", "lens, exposure, shutter; where the camera is while that is open",
             "the lens is opened", view(HdCamera::DirtyParams, openLens), camera},
            {"HdCamera::DirtyParams", "the same; no sample is taken again", "the exposure is longer",
             view(HdCamera::DirtyParams, param("exposure", 1.f, 0.f)), camera},
            {"HdCamera::AllDirty", "everything; only what differs is a change", "the camera moves",
             view(HdCamera::AllDirty, param("worldToViewMatrix", seenFrom(12), seenFrom(10))), camera},
            unread("HdCamera::Clean", "nothing; Hydra refuses to mark it", [](World&, bool) {}),
        }};
}

Section computationSection() {
    const char *byHydra = "the description, by Hydra",
               *bySync = "nothing: meshes ask for values as they sync",
               *skinning = "the same; a computed mesh computes again when its transform or primvars, which "
                           "skinning reads, are marked";
    const Elements reshaped = {{Target::Computed, Change::Geometry}};
    const auto only = [](HdDirtyBits bits) { return sprim("/computation", bits); };
    return {
        "ExtComputation",
        "A computation is no element: the mesh that its values belong to is, when it reads them. Hydra 20.08 "
        "does not tell the mesh by itself; who edits a computation marks the mesh too, as UsdImaging does.",
        {
            {"HdExtComputation::DirtySceneInput", bySync, "an input changes, and the mesh gets DirtyPoints",
             computeElsewhere(HdChangeTracker::DirtyPoints), reshaped},
            {"HdExtComputation::DirtySceneInput", skinning,
             "an input changes, and the mesh gets DirtyTransform",
             computeElsewhere(HdChangeTracker::DirtyTransform), reshaped},
            {"HdExtComputation::DirtySceneInput", skinning,
             "an input changes, and the mesh gets DirtyPrimvar",
             computeElsewhere(HdChangeTracker::DirtyPrimvar), reshaped},
            unread("HdExtComputation::DirtySceneInput", bySync, only(HdExtComputation::DirtySceneInput)),
            unread("HdExtComputation::DirtyCompInput", bySync, only(HdExtComputation::DirtyCompInput)),
            unread("HdExtComputation::DirtyInputDesc", byHydra, only(HdExtComputation::DirtyInputDesc)),
            unread("HdExtComputation::DirtyOutputDesc", byHydra, only(HdExtComputation::DirtyOutputDesc)),
            unread("HdExtComputation::DirtyElementCount", byHydra, only(HdExtComputation::DirtyElementCount)),
            unread("HdExtComputation::DirtyDispatchCount", byHydra,
                   only(HdExtComputation::DirtyDispatchCount)),
            unread("HdExtComputation::DirtyKernel",
                   "nothing: a kernel is for GPUs; values are computed by the scene delegate",
                   only(HdExtComputation::DirtyKernel)),
            unread("HdExtComputation::AllDirty", "the description, by Hydra",
                   only(HdExtComputation::AllDirty)),
            unread("HdExtComputation::Clean", "nothing; Hydra refuses to mark it", [](World&, bool) {}),
        }};
}

} // namespace dirtybits

PXR_NAMESPACE_CLOSE_SCOPE
