#include "plugin/hdHipr/rendererPlugin.h"

#include <algorithm>

#include "plugin/hdHipr/renderDelegate.h"
#include "pxr/imaging/hd/rendererPluginRegistry.h"
#include "renderer/api/renderer.h"

PXR_NAMESPACE_OPEN_SCOPE

TF_REGISTRY_FUNCTION(TfType) {
    HdRendererPluginRegistry::Define<HdHiprRendererPlugin>();
}

HdRenderDelegate* HdHiprRendererPlugin::CreateRenderDelegate() {
    return new HdHiprRenderDelegate();
}

HdRenderDelegate* HdHiprRendererPlugin::CreateRenderDelegate(HdRenderSettingsMap const& settings) {
    return new HdHiprRenderDelegate(settings);
}

void HdHiprRendererPlugin::DeleteRenderDelegate(HdRenderDelegate* delegate) {
    delete delegate;
}

bool HdHiprRendererPlugin::supported(std::string* why) const {
    // Hosts ask again and again; the devices of a machine do not change while it runs.
    static const bool usable = [] {
        const auto devices = hipr::devices();
        return std::any_of(devices.begin(), devices.end(), [](auto const& device) { return device.usable; });
    }();
    if (!usable && why) {
        *why = "no usable Vulkan device (`hipr devices` tells what each one lacks)";
    }
    return usable;
}

PXR_NAMESPACE_CLOSE_SCOPE
