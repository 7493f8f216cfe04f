/// @file path_tracer.h
/// The wavefront path tracer.
///
/// A batch is a list of tiles times sample ranges; every sample is one path and has one slot of PathState.
/// Kernels pass paths on through queues of rays:
///
///     raygen                                      one camera ray a slot
///     round: nearest -> [occluded -> shadow]      hits of the rays; light that arrived from the round
///     before,
///                                                 in scenes with mesh lights with `emission` before `shadow`
///            -> shade                             collects light, scatters; fills the shadow queue and the
///            other
///            -> prepare                           ray queue; sizes the next dispatches
///     With volumes, `volume` runs before `shade` and `volume shadow` before `shadow` (docs/volumes.md).
///     With a discovery, its kernels run before and behind `shade` (renderer/trace/discovery_passes.h).
///     resolve                                     adds the samples of each pixel to the film, in order; or
///     scout                                       compares them with the picture on display (renderer/hipr)
///
/// `nearest` and `occluded` are stages of a Traversal (renderer/accel). One that runs on the device is
/// recorded between the kernels, several rounds to a submission; one on the host (Embree) runs between
/// submissions on the same, mapped queues. Rounds end when the queues are empty.
///
/// Estimator: next event estimation and BSDF sampling, weighted by the power heuristic; emitters are ghosts
/// that rays collect and cross; Russian roulette from Settings::rouletteDepth. After the last bounce
/// (Settings::maxDepth) the BSDF sample is still traced, and collects light only, so that both halves of the
/// last bounce's estimate exist. A surface of presence below 1 lets paths through at random without counting
/// a bounce, and shadow rays through attenuated: they first test opaque instances, survivors then walk the
/// others hit by hit. So do shadow rays that were blocked if the light's shadows are coloured, end somewhere,
/// or are cast by some objects only; what gets through then is found by light samples alone. Both walks are
/// bounded (PATH_PASS_LIMIT, SHADOW_PASS_LIMIT in shaders/shared/trace.h).
///
/// Alpha is 1 where a sample saw a surface or the shape of a light, 0 where it saw only the sky or nothing.
///
/// Same picture whatever the batch: random numbers depend on (pixel, sample, event) alone, a path's
/// contributions are added by itself in the order of its events, and resolve sums the samples of a pixel in
/// order. Queue positions, which depend on timing, enter no result.
///
/// Profile: HIPR_PROFILE=1 submits every kernel by itself and prints the time of each step at the end.
#pragma once

#include <atomic>
#include <map>
#include <memory>

#include "renderer/trace/discovery_passes.h"
#include "renderer/trace/steps.h"
#include "renderer/trace/trace_kernels.h"
#include "renderer/trace/wavefront_buffers.h"

namespace hipr {

class PathTracer {
public:
    /// `capacity`: paths a batch can hold.
    PathTracer(Device& device, uint32_t capacity);

    /// Begins to compile, in the background, what a scene with these SCENE_* flags needs and was not needed
    /// before.
    void prepareFor(uint32_t sceneFlags);

    /// Whether all kernels are compiled that the scene of the last setup() needs; waits up to `patience` for
    /// it.
    bool ready(std::chrono::milliseconds patience) {
        return _kernels.ready(patience) && _shading && _shading->ready(patience) &&
               (!_volumeKernels || _volumeKernels->ready(patience)) &&
               (!_filmKernels || _filmKernels->ready(patience));
    }
    uint32_t capacity() const { return _buffers.capacity; }

    /// What the next batches render: addresses of scene and film, film size and settings are the caller's to
    /// fill in. `lpe`: of the film, count 0 without expressions. `sceneFlags`: SCENE_* and FILM_*.
    void setup(gpu::TraceRecord record, const gpu::LpeRecord& lpe, const gpu::CameraRecord& camera,
               const std::vector<glm::mat4x3>& cameraKeys, uint32_t sceneFlags);

    /// Renders the tiles and adds them to the film. False when `cancel` was seen: then the film is as before.
    /// `discovery`, if any, gets the weights of this batch.
    /// `changes`: if not null, what the tiles' sample 0 changed, one entry a tile (TraceRecord::changeScale
    /// must be above 0).
    bool trace(Traversal& traversal, const std::vector<gpu::TileWork>& tiles, uint32_t paths,
               const std::atomic<bool>& cancel, DiscoveryPasses* discovery = nullptr,
               std::vector<gpu::TileChange>* changes = nullptr);

    /// Traces the work's samples (sample 0 of their pixels) and compares them with the picture on display,
    /// which stays as it is. `results`: one a path, in the order of the slots. False when `cancel` was seen.
    bool scout(Traversal& traversal, const std::vector<gpu::TileWork>& work, uint32_t paths,
               const std::atomic<bool>& cancel, std::vector<gpu::ScoutResult>& results,
               DiscoveryPasses* discovery = nullptr);

    /// Finds the first hits of pixels [first, first + count), count <= capacity, and stores their AOVs.
    bool findFirstHits(Traversal& traversal, uint32_t first, uint32_t count, const std::atomic<bool>& cancel);

    /// Finds the tiles in which something that changed is seen, or was; needs the first hits of all pixels.
    void findActive(DiscoveryPasses& discovery, uint32_t pixels);

    /// Counts since the last call.
    gpu::TraceCounters takeCounters();

private:
    /// The discovery of a batch.
    struct Discovering {
        DiscoveryPasses* passes;
        bool scouts;
    };
    bool tracePaths(Steps& steps, const std::vector<gpu::TileWork>& work, uint32_t paths,
                    const std::atomic<bool>& cancel, const Discovering& discovery);
    void raygen(Steps& steps, const std::vector<gpu::TileWork>& tiles, uint32_t paths);
    void prepare(Steps& steps, uint32_t close, uint32_t clear);
    void prepareOnHost(uint32_t close, uint32_t clear);
    void dispatchQueue(Steps& steps, const char* name, const Kernel& kernel, uint32_t queue, uint32_t turn,
                       uint32_t first = 0);
    void discover(Steps& steps, const char* name, const Discovering& discovery, DiscoveryKernelId id,
                  uint32_t queue, uint32_t turn);
    void resolveShadows(Steps& steps, uint32_t turn);
    void passVolumes(Steps& steps, const char* name, VolumeKernelId id, uint32_t queue, uint32_t turn);
    const Kernel& kernel(KernelId id) { return _kernels.get(size_t(id)); }
    const Kernel& kernel(ShadingKernelId id) { return _shading->get(size_t(id)); }
    uint32_t queueCount(uint32_t queue);
    gpu::TraceKernelPush push() const { return {_record.address(), 0, 0, 0, 0}; }

    Device& _device;
    BackgroundKernels _kernels;
    /// By SCENE_SHADING_FEATURES. All samples of a picture come from one variant: the last bits of what
    /// another one computes may differ.
    std::map<uint32_t, std::unique_ptr<BackgroundKernels>> _shadingVariants;
    BackgroundKernels* _shading = nullptr;             ///< the scene's
    std::unique_ptr<BackgroundKernels> _volumeKernels; ///< once a scene had volumes
    std::unique_ptr<BackgroundKernels> _filmKernels;   ///< once a film had AOVs that need them
    WavefrontBuffers _buffers;
    Buffer _record, _camera, _cameraKeys;
    bool _countsNames = false; ///< the film has Cryptomatte AOVs
    bool _sortsLight = false;  ///< it has light path expressions
    VkDeviceAddress _scene = 0;
    uint32_t _sceneFlags = 0;
    Profile _profile;
};

} // namespace hipr
