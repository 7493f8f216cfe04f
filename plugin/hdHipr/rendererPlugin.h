/// @file rendererPlugin.h
/// HdHiprRendererPlugin: what Plug loads; makes render delegates.
#pragma once

#include "plugin/hdHipr/compat.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprRendererPlugin final : public hdhipr::RendererPluginBase {
public:
    HdHiprRendererPlugin() = default;

    HdRenderDelegate* CreateRenderDelegate() override;
    HdRenderDelegate* CreateRenderDelegate(HdRenderSettingsMap const& settings) override;
    void DeleteRenderDelegate(HdRenderDelegate* delegate) override;

protected:
    /// True when a usable Vulkan device exists, be it a software one.
    bool supported(std::string* why) const override;
};

PXR_NAMESPACE_CLOSE_SCOPE
