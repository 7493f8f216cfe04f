#include "plugin/record/stage.h"

#include <algorithm>
#include <cmath>

#include "plugin/record/diagnostics.h"
#include "plugin/record/failure.h"
#include "plugin/record/framing.h"
#include "plugin/record/instancedLights.h"
#include "plugin/record/materialCycles.h"
#include "pxr/base/tf/error.h"
#include "pxr/base/tf/errorMark.h"
#include "pxr/base/tf/stringUtils.h"
#include "pxr/usd/sdf/layer.h"
#include "pxr/usd/usd/editContext.h"
#include "pxr/usd/usd/primRange.h"
#include "pxr/usd/usd/stagePopulationMask.h"
#include "pxr/usd/usdGeom/bboxCache.h"
#include "pxr/usd/usdGeom/boundable.h"
#include "pxr/usd/usdGeom/camera.h"
#include "pxr/usd/usdGeom/metrics.h"
#include "pxr/usd/usdGeom/tokens.h"
#include "pxr/usd/usdRender/settings.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

namespace {

constexpr int defaultWidth = 960;
const char* const automaticCamera = "/HiprRecordCamera";

UsdStagePopulationMask populationMask(const std::vector<std::string>& paths) {
    UsdStagePopulationMask mask;
    for (const std::string& text : paths) {
        const SdfPath path = SdfPath::IsValidPathString(text) ? SdfPath(text) : SdfPath();
        if (!path.IsAbsoluteRootOrPrimPath() || !path.IsAbsolutePath())
            throw Failure(ExitUsage, "--mask: '" + text + "' is no absolute prim path");
        mask.Add(path);
    }
    mask.Add(SdfPath(automaticCamera));
    return mask;
}

SdfPath renderSettingsCamera(const UsdStageRefPtr& stage) {
    const UsdRenderSettings settings = UsdRenderSettings::GetStageRenderSettings(stage);
    SdfPathVector targets;
    if (settings && settings.GetCameraRel()) settings.GetCameraRel().GetForwardedTargets(&targets);
    for (const SdfPath& target : targets)
        if (UsdGeomCamera(stage->GetPrimAtPath(target))) return target;
    return SdfPath();
}

std::string cameraList(const std::vector<SdfPath>& cameras) {
    if (cameras.empty()) return "The stage has no cameras; leave --camera out to frame it automatically.";
    std::string text = "Cameras of the stage:";
    for (const SdfPath& camera : cameras)
        text += "\n  " + camera.GetString();
    return text;
}

SdfPath findCamera(const UsdStageRefPtr& stage, const std::string& wanted) {
    const std::vector<SdfPath> cameras = listCameras(stage);
    std::vector<SdfPath> found;
    for (const SdfPath& camera : cameras)
        if (camera.GetString() == wanted || camera.GetName() == wanted) found.push_back(camera);
    if (found.size() == 1) return found.front();
    const std::string problem = found.empty()
                                    ? "no camera '" + wanted + "'. "
                                    : "several cameras are called '" + wanted + "': give the path. ";
    throw Failure(ExitCamera, problem + cameraList(cameras));
}

bool isUsable(const GfRange3d& box) {
    if (box.IsEmpty()) return false;
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(box.GetMin()[i]) || !std::isfinite(box.GetMax()[i]) || box.GetSize()[i] > 1e30)
            return false;
    return true;
}

/// Lights have bounds from OpenUSD 21.11 on, but are not what a picture is to show.
bool isShape(const UsdPrim& prim) {
    return prim.IsA<UsdGeomBoundable>() && !TfStringEndsWith(prim.GetTypeName(), "Light");
}

/// World-space corners of the bounds of all shapes; corners of each one's own box fit closer than one box for
/// all.
std::vector<GfVec3d> shapeCorners(const UsdStageRefPtr& stage, const std::vector<std::string>& purposes,
                                  UsdTimeCode time) {
    TfTokenVector tokens;
    for (const std::string& purpose : purposes)
        tokens.emplace_back(purpose);
    UsdGeomBBoxCache cache(time, tokens, /*useExtentsHint=*/false);
    std::vector<GfVec3d> corners;
    UsdPrimRange prims = UsdPrimRange::Stage(stage, UsdTraverseInstanceProxies(UsdPrimDefaultPredicate));
    for (auto prim = prims.begin(); prim != prims.end(); ++prim) {
        if (!isShape(*prim)) continue;
        prim.PruneChildren(); // prototypes of a point instancer, skinned meshes: inside their parent's bounds
        const GfBBox3d bound = cache.ComputeWorldBound(*prim);
        if (!isUsable(bound.GetRange())) continue;
        for (size_t i = 0; i < 8; ++i)
            corners.push_back(bound.GetMatrix().Transform(bound.GetRange().GetCorner(i)));
    }
    if (corners.empty()) printWarning("the stage shows nothing to frame: looking at the origin");
    return corners;
}

SdfPath addAutomaticCamera(const UsdStageRefPtr& stage, const ViewRequest& request, UsdTimeCode time,
                           double aspect) {
    const UpAxis up = UsdGeomGetStageUpAxis(stage) == UsdGeomTokens->z ? UpAxis::Z : UpAxis::Y;
    const GfCamera camera = framePoints(shapeCorners(stage, request.purposes, time), up, aspect);
    SdfPath path(automaticCamera);
    while (stage->GetPrimAtPath(path))
        path = path.ReplaceName(TfToken(path.GetName() + "_"));
    const UsdEditContext session(stage, stage->GetSessionLayer());
    UsdGeomCamera::Define(stage, path).SetFromCamera(camera, UsdTimeCode::Default());
    return path;
}

double authoredAspect(const UsdStageRefPtr& stage, const SdfPath& path, UsdTimeCode time) {
    const GfCamera camera = UsdGeomCamera(stage->GetPrimAtPath(path)).GetCamera(time);
    const double aspect = camera.GetAspectRatio();
    if (std::isfinite(aspect) && aspect > 1e-3 && aspect < 1e3) return aspect;
    printWarning("camera " + path.GetString() + " has no usable aperture: the picture is square");
    return 1.0;
}

int roundedSize(double size) {
    return int(std::clamp(std::lround(size), 1l, 65536l));
}

} // namespace

UsdStageRefPtr openStage(const std::string& path, const std::vector<std::string>& mask) {
    TfErrorMark errors;
    UsdStageRefPtr stage = mask.empty() ? UsdStage::Open(path, UsdStage::LoadAll)
                                        : UsdStage::OpenMasked(path, populationMask(mask));
    if (stage) {
        cutMaterialCycles(stage);
        warnOfInstancedLights(stage);
        return stage;
    }
    std::string why;
    for (const TfError& error : errors)
        why += (why.empty() ? ": " : "; ") + error.GetCommentary();
    errors.Clear();
    throw Failure(ExitStage, "cannot open stage '" + path + "'" + why);
}

std::vector<SdfPath> listCameras(const UsdStageRefPtr& stage) {
    std::vector<SdfPath> cameras;
    for (const UsdPrim& prim : stage->Traverse())
        if (prim.IsA<UsdGeomCamera>()) cameras.push_back(prim.GetPath());
    return cameras;
}

View chooseView(const UsdStageRefPtr& stage, const ViewRequest& request, UsdTimeCode time) {
    View view;
    if (request.camera.empty()) {
        view.camera = renderSettingsCamera(stage);
        if (view.camera.IsEmpty()) {
            const std::vector<SdfPath> cameras = listCameras(stage);
            if (!cameras.empty()) view.camera = cameras.front();
        }
    } else if (request.camera != "auto") {
        view.camera = findCamera(stage, request.camera);
    }
    view.automatic = view.camera.IsEmpty();

    view.width = request.width > 0 ? request.width : defaultWidth;
    view.height = request.height;
    if (view.height <= 0) {
        const double aspect = view.automatic ? 16.0 / 9.0 : authoredAspect(stage, view.camera, time);
        view.height = roundedSize(view.width / aspect);
    }
    if (view.automatic)
        view.camera = addAutomaticCamera(stage, request, time, double(view.width) / view.height);
    return view;
}

double defaultFrame(const UsdStageRefPtr& stage) {
    return stage->HasAuthoredTimeCodeRange() ? stage->GetStartTimeCode() : 0.0;
}

} // namespace hipr::record
