#include "plugin/record/materialCycles.h"

#include <unordered_map>

#include "plugin/record/diagnostics.h"
#include "pxr/usd/usd/attribute.h"
#include "pxr/usd/usd/editContext.h"
#include "pxr/usd/usd/prim.h"
#include "pxr/usd/usd/primRange.h"
#include "pxr/usd/usdShade/shader.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

namespace {

/// Depth-first search along connections, from each attribute to those it takes its value from.
class CycleSearch {
public:
    explicit CycleSearch(const UsdStageRefPtr& stage) : _stage(stage) {}

    /// Follows everything the inputs of a shader depend on.
    void visitShader(const UsdPrim& shader) {
        State& state = _shaders[shader.GetPath()];
        if (state != State::New) return;
        state = State::Open;
        for (const UsdAttribute& attribute : shader.GetAttributes())
            if (attribute.GetName().GetString().rfind("inputs:", 0) == 0) visitInput(attribute);
        _shaders[shader.GetPath()] = State::Done;
    }

private:
    enum class State { New, Open, Done };

    bool isShader(const UsdPrim& prim) const { return prim.IsA<UsdShadeShader>(); }

    void visitInput(const UsdAttribute& attribute) {
        SdfPathVector sources;
        attribute.GetConnections(&sources);
        SdfPathVector kept;
        for (const SdfPath& source : sources)
            if (follow(attribute, source)) kept.push_back(source);
        if (kept.size() == sources.size()) return;
        const UsdEditContext session(_stage, _stage->GetSessionLayer());
        attribute.SetConnections(kept);
        printWarning("material nodes feed each other in a circle: the connection of <" +
                     attribute.GetPath().GetString() + "> is left out");
    }

    /// False when the source leads back to something that is being followed.
    bool follow(const UsdAttribute& from, const SdfPath& source) {
        const UsdAttribute attribute = _stage->GetAttributeAtPath(source);
        if (!attribute) return true;
        const UsdPrim prim = attribute.GetPrim();
        if (isShader(prim) && source.GetName().rfind("outputs:", 0) == 0) {
            const auto found = _shaders.find(prim.GetPath());
            if (found != _shaders.end() && found->second == State::Open) return false;
            visitShader(prim);
            return true;
        }
        // A port of a node graph, or an input passed on: a cycle may also close here.
        State& state = _ports[source];
        if (state == State::Open || source == from.GetPath()) return false;
        if (state == State::Done) return true;
        state = State::Open;
        visitInput(attribute);
        _ports[source] = State::Done;
        return true;
    }

    UsdStageRefPtr _stage;
    std::unordered_map<SdfPath, State, SdfPath::Hash> _shaders, _ports;
};

} // namespace

void cutMaterialCycles(const UsdStageRefPtr& stage) {
    std::vector<UsdPrim> shaders;
    for (const UsdPrim& prim : stage->Traverse())
        if (prim.IsA<UsdShadeShader>()) shaders.push_back(prim);
    CycleSearch search(stage);
    for (const UsdPrim& shader : shaders)
        search.visitShader(shader);
}

} // namespace hipr::record
