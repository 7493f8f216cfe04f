/// @file renderDelegate.h
/// HdHiprRenderDelegate: makes the prims, owns the settings and the door to the renderer.
#pragma once

#include <memory>
#include <mutex>

#include "plugin/hdHipr/compat.h"
#include "renderer/api/settings.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprRenderParam;

class HdHiprRenderDelegate final : public hdhipr::RenderDelegateBase {
public:
    HdHiprRenderDelegate();
    explicit HdHiprRenderDelegate(HdRenderSettingsMap const& settings);
    ~HdHiprRenderDelegate() override;

    HdRenderParam* GetRenderParam() const override;
    HdResourceRegistrySharedPtr GetResourceRegistry() const override { return _resources; }

    TfTokenVector const& GetSupportedRprimTypes() const override;
    TfTokenVector const& GetSupportedSprimTypes() const override;
    TfTokenVector const& GetSupportedBprimTypes() const override;

    void DestroyInstancer(HdInstancer* instancer) override;
    void DestroyRprim(HdRprim* rprim) override;
    HdSprim* CreateSprim(TfToken const& type, SdfPath const& id) override;
    HdSprim* CreateFallbackSprim(TfToken const& type) override;
    void DestroySprim(HdSprim* sprim) override;
    HdBprim* CreateBprim(TfToken const& type, SdfPath const& id) override;
    HdBprim* CreateFallbackBprim(TfToken const& type) override;
    void DestroyBprim(HdBprim* bprim) override;
    HdRenderPassSharedPtr CreateRenderPass(HdRenderIndex* index,
                                           HdRprimCollection const& collection) override;
    void CommitResources(HdChangeTracker* tracker) override;

    HdAovDescriptor GetDefaultAovDescriptor(TfToken const& name) const override;
    TfToken GetMaterialBindingPurpose() const override;

    /// Settings of the table restart the picture when, and only when, their value changes. Other keys are
    /// kept for GetRenderSetting and have no effect; unknown keys that begin with `hipr:` are reported.
    /// Some keys are no settings but doors for recorders and tests: `hipr:publishEveryBatch` (bool; see
    /// RenderLoop); `hipr:publishNow`, which reads as true once the buffers, the denoised one too, show all
    /// samples there are; `hipr:command` (string), which runs one of hdhipr::commands() where OpenUSD has no
    /// commands; `hipr:sceneDump`, which reads as the text of hipr::Renderer::dumpScene();
    /// `hipr:cryptomatte:CryptoObject` and its like, which read as hipr::Renderer::cryptomatteNames(); and
    /// `hipr:dataWindow` (GfVec4f: xmin, ymin, xmax, ymax), the part of the camera's picture that fills the
    /// buffers, in place of what the viewport says, for hosts whose Hydra has no framing.
    void SetRenderSetting(TfToken const& key, VtValue const& value) override;
    VtValue GetRenderSetting(TfToken const& key) const override;
    using HdRenderDelegate::GetRenderSetting;
    HdRenderSettingDescriptorList GetRenderSettingDescriptors() const override;

    /// percentDone (0..100), numCompletedSamples, totalClockTime (seconds), hipr:paths, hipr:rays,
    /// hipr:device, peakMemory (bytes of this process) and hipr:memory:<kind> (bytes). hipr:pictures counts
    /// what has been published to the buffers, hipr:denoiseTime is the seconds that the last denoised picture
    /// took.
    VtDictionary GetRenderStats() const override;

    bool IsPauseSupported() const override {
        return true;
    }
    bool Pause() override;
    bool Resume() override;
    bool IsStopSupported() const override {
        return true;
    }
    bool Restart() override;

protected:
    HdRprim* createRprim(TfToken const& type, SdfPath const& id, SdfPath const& instancerId) override;
    HdInstancer* createInstancer(HdSceneDelegate* delegate, SdfPath const& id,
                                 SdfPath const& parentId) override;
    bool runCommand(TfToken const& name, VtDictionary const& arguments) override;
    bool stopRendering() override;
    bool renderingStopped() const override;
    bool renderingPaused() const override;

private:
    bool storeSetting(TfToken const& key, VtValue const& value);

    hipr::Settings _settings;
    std::unique_ptr<HdHiprRenderParam> _param;
    HdResourceRegistrySharedPtr _resources;
};

PXR_NAMESPACE_CLOSE_SCOPE
