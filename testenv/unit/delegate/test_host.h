/// @file test_host.h
/// A host program in small: a delegate, a render index, buffers, and the loop every host runs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plugin/hdHipr/renderBuffer.h"
#include "plugin/hdHipr/renderDelegate.h"
#include "plugin/hdHipr/renderLoop.h"
#include "pxr/base/gf/vec4d.h"
#include "pxr/imaging/hd/engine.h"
#include "pxr/imaging/hd/renderPass.h"
#include "pxr/imaging/hd/renderPassState.h"
#include "testenv/unit/delegate/test_scene.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Looks along -Z at the square [-size/2, size/2] of the XY plane with an orthographic camera.
class TestHost {
public:
    static constexpr int width = 32, height = 32;

    explicit TestHost(std::vector<std::string> const& aovs = {"color", "primId", "instanceId", "elementId"},
                      int samples = 4);
    ~TestHost();

    TestScene& scene() { return *_scene; }
    HdHiprRenderDelegate& delegate() { return *_delegate; }
    HdRenderIndex& index() { return *_index; }
    HdRenderPass& pass() { return *_pass; }
    HdHiprRenderParam& param();
    hdhipr::RenderLoop& loop(); ///< of the delegate, which must have a device
    HdHiprRenderBuffer& buffer(std::string const& aov);

    void setViewSize(double size) { _viewSize = size; }
    void setCamera(SdfPath const& camera) { _camera = camera; } ///< a prim of the scene to look through
    /// Changes the picture's size and leaves the buffers alone.
    void setViewport(int w, int h) { _viewport = GfVec4d(0, 0, w, h); }
    /// Sees the scene through these matrices and no camera prim, instead of along -Z.
    void setMatrices(GfMatrix4d const& worldToView, GfMatrix4d const& projection);
    HdRenderPassState& state() { return *_state; }
    void setRenderTags(TfTokenVector const& tags) { _tags = tags; }
    /// Renders an AOV into a render buffer of the scene, too.
    void bind(std::string const& aov, SdfPath const& buffer);
    void setClearColor(GfVec4f const& color); ///< of the first AOV
    void setCollection(HdRprimCollection const& collection) { _pass->SetRprimCollection(collection); }

    /// One execution, as a host does per tick.
    void tick();
    /// Ticks until converged; false when that takes longer than a minute.
    bool render();

    /// Pixel at a position of the XY plane in units of the view: (-0.5, -0.5) bottom left .. (0.5, 0.5) top
    /// right.
    int readInt(std::string const& aov, double x, double y);
    GfVec4f readColor(double x, double y);

private:
    void lookAtPlane();
    size_t pixelIndex(double x, double y) const;

    std::unique_ptr<HdHiprRenderDelegate> _delegate;
    std::unique_ptr<HdRenderIndex> _index;
    std::unique_ptr<TestScene> _scene;
    HdEngine _engine;
    HdRenderPassSharedPtr _pass;
    HdRenderPassStateSharedPtr _state;
    std::vector<std::pair<std::string, HdHiprRenderBuffer*>> _buffers;
    TfTokenVector _tags{HdRenderTagTokens->geometry};
    double _viewSize = 1.0;
    SdfPath _camera;
    GfVec4d _viewport{0, 0, width, height};
    std::optional<std::pair<GfMatrix4d, GfMatrix4d>> _matrices;
};

PXR_NAMESPACE_CLOSE_SCOPE
