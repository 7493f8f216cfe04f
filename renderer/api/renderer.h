/// @file renderer.h
/// The renderer: scene edits in, AOVs out. See docs/example.cpp for a complete program.
///
/// Threading: SceneEdit may be filled from any thread. commit(), setFilm(), setSettings(), render() and readAov()
/// are called by one thread at a time (a host's render thread). cancel() and progress() may be called from any thread.
#pragma once

#include <array>
#include <atomic>
#include <iosfwd>
#include <memory>

#include "renderer/api/film.h"
#include "renderer/api/scene.h"
#include "renderer/api/settings.h"

namespace hipr {

/// A Vulkan device as `devices()` lists it.
struct DeviceInfo {
    uint32_t index = 0;
    std::string name, driver;
    bool cpu = false;        ///< a software implementation (lavapipe)
    bool rayQuery = false;   ///< VK_KHR_ray_query with hardware or driver support
    bool usable = false;     ///< has everything the renderer needs
    std::string missing;     ///< what it lacks when not usable
    uint64_t memoryBytes = 0;
};
std::vector<DeviceInfo> devices();

struct RendererOptions {
    /// Index or part of a name; empty: $HIPR_DEVICE, else the best device (discrete, integrated, then CPU).
    std::string device;
    /// Vulkan validation layers; their messages arrive as errors. Also switched on by HIPR_VALIDATION=1.
    bool validation = false;
    MessageSink messages;    ///< default: standard error
    AssetReader assets;      ///< default: reads files
};

/// Bytes held, by kind.
struct MemoryReport {
    struct Row { std::string kind; uint64_t bytes; };
    std::vector<Row> rows;
    uint64_t total() const { uint64_t t = 0; for (const Row& r : rows) t += r.bytes; return t; }
};

struct Progress {
    uint32_t samplesDone = 0;   ///< samples every pixel has
    uint32_t samplesTotal = 0;
    uint64_t pathsTraced = 0;
    uint64_t raysTraced = 0;    ///< nearestRays + shadowRays
    uint64_t nearestRays = 0;   ///< of camera, bounces, and walks through transparent surfaces
    uint64_t shadowRays = 0;
    double seconds = 0;         ///< time spent in renderBatch() since the last restart
    double fraction = 0;        ///< of all samples of all pixels, 0..1
    bool pictureShown = false;  ///< every pixel of the film holds a picture, of this scene or an earlier one
    bool firstHitsDone = false; ///< the first-hit AOVs show the current scene

    // HiPR, since the last restart
    uint32_t tiles = 0;              ///< of the picture
    uint32_t tilesDiscovered = 0;    ///< in which the edit was found to show
    uint64_t scoutPaths = 0;         ///< traced to find them
    double scheduleSeconds = 0;      ///< spent on finding and ordering them
    double firstRevealSeconds = 0;   ///< from the edit to its first refreshed tiles; 0: not yet
    bool converged = false;     ///< no more will come: all samples are done, or there is nothing that can be rendered
    bool failed = false;        ///< the device or the memory gave out, a message said so, and nothing is rendered any more
};

class Renderer {
public:
    /// Returns null, with the reason in `error`, when no usable Vulkan device exists.
    static std::unique_ptr<Renderer> create(const RendererOptions& options, std::string* error);
    virtual ~Renderer() = default;

    virtual const DeviceInfo& device() const = 0;

    /// A fresh id for any kind of element; thread-safe.
    uint32_t newId() { return ++_lastId; }
    template <class Id> Id newId() { return Id(newId()); }

    /// Applies an edit (and empties it). Samples are discarded when anything changed.
    virtual ChangedSet commit(SceneEdit& edit) = 0;

    /// Reads the files of all textures (those of lights and displacement too) and IES profiles again, and discards
    /// all samples. Where there are none, nothing happens.
    virtual ChangedSet reloadTextures() = 0;

    /// Each discards all samples if, and only if, the value differs in a way that changes the picture. The set then
    /// has one element, of kind Change::Setting; otherwise it is empty.
    virtual ChangedSet setFilm(const FilmDesc& film) = 0;
    virtual ChangedSet setSettings(const Settings& settings) = 0;

    /// Renders one batch of work (a few tens of milliseconds on an interactive scene). Returns false when converged,
    /// cancelled or nothing can be rendered. The film always holds whole samples.
    virtual bool renderBatch() = 0;

    /// Makes a running renderBatch() return within one tile batch; sticky until resume().
    void cancel() { _cancel.store(true); }
    void resume() { _cancel.store(false); }
    bool cancelled() const { return _cancel.load(); }

    virtual Progress progress() const = 0;

    /// Copies an AOV of the film, rows bottom-up (first row is the bottom of the picture), tightly packed,
    /// `words` 4-byte words. Returns false when the film has no such AOV or the size does not match.
    virtual bool readAov(const AovRequest& aov, void* dst, size_t words) = 0;

    virtual MemoryReport memory() const = 0;

    /// The names whose ids the AOV CryptoObject, CryptoMaterial or CryptoAsset may hold, sorted: what its manifest
    /// lists. To be called by the thread that commits.
    virtual std::vector<std::string> cryptomatteNames(AovKind kind) const = 0;

    /// Writes everything the renderer holds of the scene, sorted by name, one fact per line: objects with their
    /// geometry, placements and materials, materials, lights, camera, settings. Ids, addresses and the order of edits
    /// do not show: scenes that must render alike give the same text. To be called by the thread that commits.
    virtual void dumpScene(std::ostream& out) const = 0;

protected:
    std::atomic<bool> _cancel{false};

private:
    std::atomic<uint32_t> _lastId{0};
};

} // namespace hipr
