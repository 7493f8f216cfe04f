#include "testenv/edit/scene.h"

#include <stdexcept>

#include "plugin/record/edits.h"
#include "pxr/base/plug/registry.h"
#include "pxr/usd/sdf/changeBlock.h"
#include "pxr/usd/usd/stageLoadRules.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::test {

Scene::Scene(const std::string& name) {
    [[maybe_unused]] static const auto plugins = PlugRegistry::GetInstance().RegisterPlugins(HIPR_PLUGIN_DIR);
    const std::string path = HIPR_SOURCE_DIR "/testenv/edit/scenes/" + name;
    _stage = UsdStage::Open(path);
    if (!_stage) throw std::runtime_error("cannot open " + path);
    record::editLayer(_stage); // so that its making is no edit
    for (const SdfLayerHandle& layer : _stage->GetUsedLayers()) {
        _saved.emplace_back(layer, SdfLayer::CreateAnonymous());
        _saved.back().second->TransferContent(layer);
    }
}

Scene::~Scene() {
    reset();
}

UsdStageRefPtr Scene::reopened() const {
    const UsdStageRefPtr stage = UsdStage::Open(_stage->GetRootLayer(), _stage->GetSessionLayer());
    stage->MuteAndUnmuteLayers(_stage->GetMutedLayers(), {});
    stage->SetLoadRules(_stage->GetLoadRules());
    return stage;
}

void Scene::swapStage() {
    _stage = reopened();
}

void Scene::reset() {
    // Only what is needed: both of these have UsdImaging populate everything anew.
    if (!_stage->GetMutedLayers().empty()) _stage->MuteAndUnmuteLayers({}, _stage->GetMutedLayers());
    if (_stage->GetLoadRules() != UsdStageLoadRules::LoadAll())
        _stage->SetLoadRules(UsdStageLoadRules::LoadAll());
    const SdfChangeBlock block;
    for (const auto& [layer, content] : _saved)
        layer->TransferContent(content);
    view = View();
}

} // namespace hipr::test
