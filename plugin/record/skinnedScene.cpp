#include "plugin/record/skinnedScene.h"

#if PXR_VERSION < 2105

#include <algorithm>
#include <vector>

#include "pxr/base/gf/interval.h"
#include "pxr/base/gf/matrix4f.h"
#include "pxr/imaging/hd/renderIndex.h"
#include "pxr/usd/usdGeom/pointBased.h"
#include "pxr/usd/usdGeom/xformCache.h"
#include "pxr/usd/usdSkel/animQuery.h"
#include "pxr/usd/usdSkel/bindingAPI.h"
#include "pxr/usd/usdSkel/blendShapeQuery.h"
#include "pxr/usd/usdSkel/cache.h"
#include "pxr/usd/usdSkel/root.h"
#include "pxr/usd/usdSkel/skeleton.h"
#include "pxr/usd/usdSkel/skeletonQuery.h"
#include "pxr/usd/usdSkel/skinningQuery.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

namespace {

constexpr int evenSteps = 4;

/// One skinned mesh and all that its points depend on.
class Skin {
public:
    explicit Skin(const UsdPrim& prim) : _points(prim) {
        const UsdSkelRoot root = UsdSkelRoot::Find(prim);
        const UsdSkelSkeleton skeleton = UsdSkelBindingAPI(prim).GetInheritedSkeleton();
        if (!root || !skeleton || !_cache.Populate(root)) return;
        _skeleton = _cache.GetSkelQuery(skeleton);
        _skinning = _cache.GetSkinningQuery(prim);
        if (_skinning && _skinning.HasBlendShapes())
            _shapes = UsdSkelBlendShapeQuery(UsdSkelBindingAPI(prim));
        if (_shapes) {
            _shapeIndices = _shapes.ComputeBlendShapePointIndices();
            _shapeOffsets = _shapes.ComputeSubShapePointOffsets();
        }
    }
    bool valid() const { return _skeleton && _skinning; }

    /// Rising times in which the points are wanted over an interval.
    std::vector<double> times(const GfInterval& interval) const {
        std::vector<double> times;
        for (int i = 0; i <= evenSteps; ++i)
            times.push_back(interval.GetMin() + interval.GetSize() * i / evenSteps);
        std::vector<double> authored;
        const auto add = [&] { times.insert(times.end(), authored.begin(), authored.end()); };
        if (const UsdSkelAnimQuery& animation = _skeleton.GetAnimQuery()) {
            if (animation.GetJointTransformTimeSamplesInInterval(interval, &authored)) add();
            if (animation.GetBlendShapeWeightTimeSamplesInInterval(interval, &authored)) add();
        }
        if (_points.GetPointsAttr().GetTimeSamplesInInterval(interval, &authored)) add();
        std::sort(times.begin(), times.end());
        times.erase(std::unique(times.begin(), times.end()), times.end());
        return times;
    }

    VtVec3fArray pointsAt(double time) const {
        VtVec3fArray points;
        _points.GetPointsAttr().Get(&points, time);
        if (_shapes) addShapes(time, points);
        VtMatrix4dArray joints;
        if (!_skinning.HasJointInfluences() || !_skeleton.ComputeSkinningTransforms(&joints, time))
            return points;
        UsdGeomXformCache transforms(time);
        const GfMatrix4d toMesh = transforms.GetLocalToWorldTransform(_skeleton.GetPrim()) *
                                  transforms.GetLocalToWorldTransform(_points.GetPrim()).GetInverse();
        if (_skinning.IsRigidlyDeformed()) {
            GfMatrix4d moved;
            if (_skinning.ComputeSkinnedTransform(joints, &moved, time)) transform(moved * toMesh, points);
        } else if (_skinning.ComputeSkinnedPoints(joints, &points, time)) {
            transform(toMesh, points);
        }
        return points;
    }

private:
    static void transform(const GfMatrix4d& matrix, VtVec3fArray& points) {
        for (GfVec3f& point : points)
            point = GfVec3f(matrix.Transform(point));
    }

    void addShapes(double time, VtVec3fArray& points) const {
        const UsdSkelAnimQuery& animation = _skeleton.GetAnimQuery();
        VtFloatArray all, weights;
        if (!animation || !animation.ComputeBlendShapeWeights(&all, time)) return;
        const float none = 0.f;
        if (!_skinning.GetBlendShapeMapper())
            weights = all;
        else if (!_skinning.GetBlendShapeMapper()->Remap(all, &weights, 1, &none))
            return;
        VtFloatArray subWeights;
        VtUIntArray shapes, subShapes;
        if (_shapes.ComputeSubShapeWeights(weights, &subWeights, &shapes, &subShapes))
            _shapes.ComputeDeformedPoints(subWeights, shapes, subShapes, _shapeIndices, _shapeOffsets,
                                          TfMakeSpan(points));
    }

    UsdGeomPointBased _points;
    UsdSkelCache _cache;
    UsdSkelSkeletonQuery _skeleton;
    UsdSkelSkinningQuery _skinning;
    UsdSkelBlendShapeQuery _shapes;
    std::vector<VtIntArray> _shapeIndices;
    std::vector<VtVec3fArray> _shapeOffsets;
};

} // namespace

size_t SkinnedScene::SamplePrimvar(const SdfPath& id, const TfToken& key, size_t most, float* times,
                                   VtValue* values) {
    static const TfToken skinnedPoints("hipr:computed:points");
    if (key != skinnedPoints) return UsdImagingDelegate::SamplePrimvar(id, key, most, times, values);
    const SdfPath path = ConvertIndexPathToCachePath(id);
    const UsdPrim prim = path.IsPrimPath() && _stage ? _stage->GetPrimAtPath(path) : UsdPrim();
    if (!prim || prim.IsInMaster() || !prim.IsA<UsdGeomPointBased>()) return 0;
    const Skin skin(prim);
    if (!skin.valid()) return 0;
    const std::vector<double> wanted = skin.times(GetCurrentTimeSamplingInterval());
    for (size_t i = 0; i < std::min(most, wanted.size()); ++i) {
        times[i] = float(wanted[i] - GetTime().GetValue());
        values[i] = VtValue(skin.pointsAt(wanted[i]));
    }
    return wanted.size();
}

} // namespace hipr::record

#endif
