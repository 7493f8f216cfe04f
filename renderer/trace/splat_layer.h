/// @file splat_layer.h
/// The splats of the scene in the picture: drawn once per view, blended over the path-traced picture when it
/// is read.
///
/// Splats lie over what paths see through a pixel's centre: those in front of its first hit add their colour
/// and let the picture behind shine through by their transmittance; those behind it are not seen. Depth and
/// ids come from the splat at which the transmittance falls below 1/2, where there is one.
///
/// Where splats or the camera move while the shutter is open, colours are the mean of several moments, each
/// drawn before what hides it at the frame's own moment. Depth and ids are those of the frame.
#pragma once

#include <future>
#include <map>
#include <memory>

#include "renderer/api/film.h"
#include "renderer/api/settings.h"
#include "renderer/higs/splat_pass.h"
#include "renderer/scene/splat_table.h"
#include "renderer/trace/splat_motion.h"

namespace hipr {

class SplatLayer {
public:
    /// `pass`: outlives the layer, which makes it when it is first needed and leaves it without splats.
    SplatLayer(Device& device, std::unique_ptr<SplatPass>& pass) : _device(device), _pass(pass) {}
    ~SplatLayer();
    SplatLayer(const SplatLayer&) = delete;
    SplatLayer& operator=(const SplatLayer&) = delete;

    /// What stands in the scene; draws again what has changed.
    void setScene(const SplatTable& table, const std::vector<SplatPlacement>& placements);
    void setView(const gpu::CameraRecord& camera, uint32_t width, uint32_t height);
    /// How the camera of the view moves while the shutter is open.
    void setMotion(const CameraDesc& camera, const Shutter& shutter);
    void setSettings(const Settings& settings);
    /// Depths of what is opaque: see SplatPass::setDepthLimit(). To be called again when they have changed.
    void setDepths(VkDeviceAddress cameraDepths);

    /// Whether there are splats to draw.
    bool present() const { return !_instances.empty() && !_failed; }
    /// Whether all is compiled; waits up to `patience` for it.
    bool ready(std::chrono::milliseconds patience);
    /// Whether render() has to draw the frame's own moment.
    bool pending() const { return present() && _pending; }
    /// Whether it has then to draw others of the shutter: once what hides splats is known.
    bool blurring() const { return present() && !_pending && _momentsDrawn < _moments; }
    /// Draws one moment; false when `cancel` was seen: parts of the picture may be drawn then. Memory that is
    /// exhausted gives one message and a picture without splats until setScene() or another film.
    bool render(const std::atomic<bool>& cancel);

    /// Puts the splats over what the film holds of an AOV of so many pixels. A film that splats were not
    /// drawn for yet stays as it is.
    void blend(const AovRequest& aov, void* values, uint64_t pixels) const;

    /// Device memory of the clouds.
    uint64_t bytes() const;
    /// Of the last render().
    const SplatStatistics* statistics() const { return _ready ? &_pass->statistics() : nullptr; }

private:
    struct Stored {
        uint32_t revision = 0;
        std::shared_ptr<const SplatStore> store; ///< null: there was no memory for it
    };
    void prepare();
    bool drawFrame(const std::atomic<bool>& cancel);
    bool drawMoment(const std::atomic<bool>& cancel);
    /// Premultiplied colour, then transmittance.
    glm::vec4 shownColor(size_t pixel) const;
    void updateStores(const SplatTable& table);
    void blendColor(float* rgba) const;
    void blendAlbedo(float* rgb) const;
    glm::vec3 shownPoint(size_t pixel) const; ///< in world space
    void blendPositions(glm::vec3* positions) const;
    void blendDepth(AovKind kind, float* depths) const;
    const gpu::SplatPixel* fetch();
    size_t pixelCount() const { return size_t(_view.width) * _view.height; }
    void fail(const char* reason);

    Device& _device;
    std::map<SplatsId, Stored> _stores;
    std::vector<SplatInstance> _instances;
    SplatView _view;
    SplatMode _mode = SplatMode::Automatic;
    VkDeviceAddress _depths = 0;
    std::future<std::unique_ptr<SplatPass>> _compiling;
    std::unique_ptr<SplatPass>& _pass;
    const gpu::SplatPixel* _shown = nullptr; ///< what was drawn, while `_drawn`
    std::vector<gpu::SplatPixel> _pixels;    ///< a copy of what the pass drew, where the host needs one
    std::vector<gpu::SplatPixel> _frame;     ///< a copy of the frame's own moment, where others follow
    SplatMotion _motion;
    SplatMean _mean;
    uint32_t _moments = 0;      ///< that are wanted; 0: nothing moves
    uint32_t _momentsDrawn = 0; ///< all: the mean is shown
    bool _elsewhere = false;    ///< the pass was told of another moment
    bool _pending = false, _failed = false, _drawn = false, _ready = false;
};

} // namespace hipr
