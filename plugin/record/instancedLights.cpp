#include "plugin/record/instancedLights.h"

#if PXR_VERSION < 2308
#include <set>

#include "plugin/record/diagnostics.h"
#include "pxr/usd/usd/primRange.h"
#include "pxr/usd/usdGeom/pointInstancer.h"
#if PXR_VERSION < 2111
#include "pxr/usd/usdLux/light.h"
#else
#include "pxr/usd/usdLux/lightAPI.h"
#endif
#endif

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

#if PXR_VERSION < 2308
namespace {

bool isLight(const UsdPrim& prim) {
#if PXR_VERSION < 2111
    return prim.IsA<UsdLuxLight>();
#else
    return prim.HasAPI<UsdLuxLightAPI>();
#endif
}

UsdPrim prototypeOf(const UsdPrim& instance) {
#if PXR_VERSION < 2011
    return instance.GetMaster();
#else
    return instance.GetPrototype();
#endif
}

/// Looks into every prototype once, however many instances it has.
class LightSearch {
public:
    /// Looks through `root`, which a reader of the stage finds at `shownAt`.
    void visit(const UsdPrim& root, const SdfPath& shownAt, bool instanced) {
        if (!_visited.emplace(root.GetPath(), instanced).second) return;
        const auto shown = [&](const UsdPrim& prim) {
            return prim.GetPath().ReplacePrefix(root.GetPath(), shownAt);
        };
        for (const UsdPrim& prim : UsdPrimRange(root)) {
            if (instanced && isLight(prim)) lights.insert(shown(prim));
            if (prim.IsInstance()) visit(prototypeOf(prim), shown(prim), true);
            if (prim.IsA<UsdGeomPointInstancer>()) visitPrototypes(UsdGeomPointInstancer(prim));
        }
    }

    std::set<SdfPath> lights;

private:
    void visitPrototypes(const UsdGeomPointInstancer& instancer) {
        SdfPathVector paths;
        instancer.GetPrototypesRel().GetForwardedTargets(&paths);
        for (const SdfPath& path : paths)
            if (const UsdPrim prototype = instancer.GetPrim().GetStage()->GetPrimAtPath(path))
                visit(prototype, path, true);
    }

    std::set<std::pair<SdfPath, bool>> _visited;
};

} // namespace

void warnOfInstancedLights(const UsdStageRefPtr& stage) {
    LightSearch search;
    search.visit(stage->GetPseudoRoot(), SdfPath::AbsoluteRootPath(), false);
    if (search.lights.empty()) return;
    const size_t more = search.lights.size() - 1;
    printWarning(
        "light <" + search.lights.begin()->GetString() + ">" +
        (more ? " and " + std::to_string(more) + " more" : "") +
        " inside instances: OpenUSD before 23.08 gives renderers one light in the place of all instances");
}
#else
void warnOfInstancedLights(const UsdStageRefPtr&) {}
#endif

} // namespace hipr::record
