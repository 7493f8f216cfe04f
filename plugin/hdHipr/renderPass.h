/// @file renderPass.h
/// HdHiprRenderPass: turns a render pass state into a frame for the render thread.
#pragma once

#include <vector>

#include "plugin/hdHipr/compat.h"
#include "pxr/imaging/hd/renderPass.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprRenderBuffer;
class HdHiprRenderParam;

class HdHiprRenderPass final : public HdRenderPass {
public:
    HdHiprRenderPass(HdRenderIndex* index, HdRprimCollection const& collection, HdHiprRenderParam& param);

    /// True once every pixel of every buffer is final and written.
    bool IsConverged() const override;

protected:
    void _Sync() override;
    void _MarkCollectionDirty() override;
    void _Execute(HdRenderPassStateSharedPtr const& state, TfTokenVector const& renderTags) override;

private:
    bool settingOn(const char* name) const;
    HdHiprRenderBuffer* bufferOf(HdRenderPassAovBinding const& binding) const;

    HdHiprRenderParam& _param;
    HdReprSelector _repr;
    unsigned int _renderTagVersion = 0;
    bool _nothingBound = false; ///< the last execution had no buffer to render into
};

PXR_NAMESPACE_CLOSE_SCOPE
