#include "testenv/unit/delegate/test_host.h"

#include <chrono>
#include <stdexcept>
#include <thread>

#include "plugin/hdHipr/renderParam.h"
#include "pxr/base/gf/frustum.h"
#include "pxr/imaging/hd/camera.h"
#include "pxr/imaging/hd/task.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace {

class PassTask final : public HdTask {
public:
    PassTask(HdRenderPassSharedPtr pass, HdRenderPassStateSharedPtr state, TfTokenVector tags)
        : HdTask(SdfPath("/pass")), _pass(std::move(pass)), _state(std::move(state)), _tags(std::move(tags)) {
    }
    void Sync(HdSceneDelegate*, HdTaskContext*, HdDirtyBits* bits) override {
        _pass->Sync();
        *bits = HdChangeTracker::Clean;
    }
    void Prepare(HdTaskContext*, HdRenderIndex*) override {}
    void Execute(HdTaskContext*) override { _pass->Execute(_state, _tags); }
    TfTokenVector const& GetRenderTags() const override { return _tags; }

private:
    HdRenderPassSharedPtr _pass;
    HdRenderPassStateSharedPtr _state;
    TfTokenVector _tags;
};

} // namespace

TestHost::TestHost(std::vector<std::string> const& aovs, int samples)
    : _delegate(std::make_unique<HdHiprRenderDelegate>()),
      _index(HdRenderIndex::New(_delegate.get(), HdDriverVector())),
      _scene(std::make_unique<TestScene>(_index.get())) {
    _delegate->SetRenderSetting(TfToken("convergedSamplesPerPixel"), VtValue(samples));
    const HdRprimCollection everything(HdTokens->geometry, HdReprSelector(HdReprTokens->refined));
    _pass = _delegate->CreateRenderPass(_index.get(), everything);
    _state = _delegate->CreateRenderPassState();
    HdRenderPassAovBindingVector bindings;
    for (std::string const& name : aovs) {
        const HdAovDescriptor descriptor = _delegate->GetDefaultAovDescriptor(TfToken(name));
        auto* buffer = static_cast<HdHiprRenderBuffer*>(
            _delegate->CreateBprim(HdPrimTypeTokens->renderBuffer, SdfPath("/buffer")));
        buffer->Allocate(GfVec3i(width, height, 1), descriptor.format, descriptor.multiSampled);
        HdRenderPassAovBinding binding;
        binding.aovName = TfToken(name);
        binding.renderBuffer = buffer;
        binding.clearValue = descriptor.clearValue;
        bindings.push_back(binding);
        _buffers.emplace_back(name, buffer);
    }
    _state->SetAovBindings(bindings);
}

TestHost::~TestHost() {
    _pass.reset();
    for (auto const& [name, buffer] : _buffers) {
        _delegate->DestroyBprim(buffer);
    }
    _scene.reset();
    _index.reset();
}

HdHiprRenderParam& TestHost::param() {
    return *static_cast<HdHiprRenderParam*>(_delegate->GetRenderParam());
}

hdhipr::RenderLoop& TestHost::loop() {
    return *param().loop();
}

HdHiprRenderBuffer& TestHost::buffer(std::string const& aov) {
    for (auto const& [name, buffer] : _buffers) {
        if (name == aov) {
            return *buffer;
        }
    }
    throw std::out_of_range("no buffer for " + aov);
}

void TestHost::bind(std::string const& aov, SdfPath const& buffer) {
    HdRenderPassAovBindingVector bindings = _state->GetAovBindings();
    bindings.emplace_back();
    bindings.back().aovName = TfToken(aov);
    bindings.back().renderBufferId = buffer;
    _state->SetAovBindings(bindings);
}

void TestHost::setClearColor(GfVec4f const& color) {
    HdRenderPassAovBindingVector bindings = _state->GetAovBindings();
    bindings.front().clearValue = VtValue(color);
    _state->SetAovBindings(bindings);
}

void TestHost::setMatrices(GfMatrix4d const& worldToView, GfMatrix4d const& projection) {
    _matrices = {worldToView, projection};
}

void TestHost::tick() {
    if (_matrices) {
        _state->SetCameraFramingState(_matrices->first, _matrices->second, _viewport, {});
    } else if (_camera.IsEmpty()) {
        lookAtPlane();
    } else {
        const HdSprim* camera = _index->GetSprim(HdPrimTypeTokens->camera, _camera);
        _state->SetCameraAndViewport(static_cast<HdCamera const*>(camera), _viewport);
    }
    HdTaskSharedPtrVector tasks{std::make_shared<PassTask>(_pass, _state, _tags)};
    _engine.Execute(_index.get(), &tasks);
}

void TestHost::lookAtPlane() {
    const double half = _viewSize / 2;
    GfFrustum frustum;
    frustum.SetProjectionType(GfFrustum::Orthographic);
    frustum.SetWindow(GfRange2d(GfVec2d(-half, -half), GfVec2d(half, half)));
    frustum.SetNearFar(GfRange1d(1, 100));
    frustum.SetPosition(GfVec3d(0, 0, 10));
    _state->SetCameraFramingState(frustum.ComputeViewMatrix(), frustum.ComputeProjectionMatrix(), _viewport,
                                  {});
}

bool TestHost::render() {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    for (;;) {
        tick();
        if (_pass->IsConverged()) {
            return true;
        }
        if (std::chrono::steady_clock::now() > deadline) {
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

size_t TestHost::pixelIndex(double x, double y) const {
    return size_t((y + 0.5) * height) * width + size_t((x + 0.5) * width);
}

int TestHost::readInt(std::string const& aov, double x, double y) {
    const int value = static_cast<const int*>(buffer(aov).Map())[pixelIndex(x, y)];
    buffer(aov).Unmap();
    return value;
}

GfVec4f TestHost::readColor(double x, double y) {
    const GfVec4f value = static_cast<const GfVec4f*>(buffer("color").Map())[pixelIndex(x, y)];
    buffer("color").Unmap();
    return value;
}

PXR_NAMESPACE_CLOSE_SCOPE
