#include "renderer/higs/splat_pass.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <functional>

#include "renderer/higs/splat_stages.h"

namespace hipr {
namespace {

/// What has to be done again; each includes those before.
enum Work : int {
    Nothing,
    Raster,     ///< lists are as they were
    Placements, ///< some instances moved
    Everything,
};

bool useLanes(const Device& device, SplatKernels kernels) {
    const bool wanted =
        kernels == SplatKernels::Automatic ? device.info().cpu : kernels == SplatKernels::Lanes;
    return wanted && canRunLanes(device);
}

bool sameStores(const std::vector<SplatInstance>& a, const std::vector<SplatInstance>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const SplatInstance& x, const SplatInstance& y) { return x.store == y.store; });
}

bool same(const SplatInstance& a, const SplatInstance& b) {
    return a.objectToWorld == b.objectToWorld && a.primId == b.primId && a.instanceId == b.instanceId &&
           a.visible == b.visible;
}

/// Whether pictures have the same pixels, and the same of them are drawn.
bool samePixels(const SplatView& a, const SplatView& b) {
    return a.width == b.width && a.height == b.height && a.cropX == b.cropX && a.cropY == b.cropY &&
           a.cropWidth == b.cropWidth && a.cropHeight == b.cropHeight;
}

bool same(const SplatView& a, const SplatView& b) {
    return std::memcmp(&a.camera, &b.camera, sizeof(a.camera)) == 0 && samePixels(a, b) &&
           a.antialiased == b.antialiased && a.srgb == b.srgb;
}

gpu::SplatFrame frameRecord(const SplatView& view, SplatMode mode, bool profiling) {
    gpu::SplatFrame f{};
    const glm::uvec2 tile = binSize(mode), size(view.width, view.height);
    f.width = view.width;
    f.height = view.height;
    f.cropLo = glm::min(glm::uvec2(view.cropX, view.cropY), size);
    f.cropHi = {view.cropWidth ? std::min(view.cropX + view.cropWidth, view.width) : view.width,
                view.cropHeight ? std::min(view.cropY + view.cropHeight, view.height) : view.height};
    f.tileWidth = tile.x;
    f.tileHeight = tile.y;
    f.tileColumns = (view.width + tile.x - 1) / tile.x;
    f.tileRows = (view.height + tile.y - 1) / tile.y;
    f.nearDepth = view.camera.nearDepth;
    f.farDepth = view.camera.farDepth;
    const bool parallel = view.camera.directionX == glm::vec3(0) && view.camera.directionY == glm::vec3(0);
    f.flags = (view.antialiased ? gpu::FRAME_ANTIALIASED : 0u) | (view.srgb ? gpu::FRAME_SRGB : 0u) |
              (profiling ? gpu::FRAME_PROFILING : 0u) | (parallel ? gpu::FRAME_PARALLEL : 0u) |
              (mode == SplatMode::Flat16Aabb ? gpu::FRAME_SQUARES : 0u);
    return f;
}

} // namespace

const char* splatModeName(SplatMode mode) {
    switch (mode) {
    case SplatMode::Flat16Aabb:
        return "flat16-aabb";
    case SplatMode::Flat16Exact:
        return "flat16-exact";
    case SplatMode::Flat8Exact:
        return "flat8-exact";
    case SplatMode::Higs8:
        return "higs8";
    case SplatMode::Higs8Carry:
        return "higs8-carry";
    case SplatMode::Automatic:
        break;
    }
    return "automatic";
}

struct SplatPass::Impl {
    Impl(Device& device, const SplatPassOptions& options)
        : device(device), stages(device, useLanes(device, options.kernels), options.halfRecords) {}

    Device& device;
    SplatStages stages;
    SplatView view;
    std::vector<SplatInstance> instances;
    std::vector<uint32_t> placed; ///< instances that may show: the frame is about these alone
    std::vector<uint32_t> places; ///< index in `placed` by instance, or OutOfSight
    SplatBlocks blocks;           ///< of `placed`
    SplatMode wanted = SplatMode::Automatic;
    VkDeviceAddress depthLimit = 0;
    bool profiling = false;

    int work = Everything;       ///< Work
    bool newPicture = true;      ///< the pixels of the picture, or of the crop, hold anything
    bool listsComplete = false;  ///< the lists are those of all tiles
    std::vector<uint32_t> moved; ///< indices of instances, for Placements
    SplatStatistics statistics;
    std::vector<uint32_t> drawn;

    /// Commands that belong together, and are timed together.
    struct Step {
        const char* name;
        std::function<void(VkCommandBuffer)> record;
        bool mayStop = false; ///< a frame may be cancelled before it
    };

    static constexpr uint32_t OutOfSight = ~0u;

    bool doing(int what) const { return work == what; }
    void need(int what) { work = std::max(work, what); }
    void noteMoved(uint32_t instance) {
        moved.push_back(instance);
        need(isFlat(mode()) ? Everything : Placements);
    }
    SplatMode mode() const { return wanted == SplatMode::Automatic ? SplatMode::Higs8Carry : wanted; }
    bool movedIntoSight() const;
    void place();
    void setUp();
    void project(VkCommandBuffer cmd) const;
    std::vector<Step> steps(bool again) const;
    bool run(const std::vector<Step>& steps, const std::atomic<bool>* cancel);
    bool attempts(const std::atomic<bool>* cancel, gpu::SplatState* state);
    bool render(const std::atomic<bool>* cancel);
    void report(const gpu::SplatState& state);
    void tally();
};

/// Whether an instance moved that the blocks do not hold.
bool SplatPass::Impl::movedIntoSight() const {
    return std::any_of(moved.begin(), moved.end(),
                       [&](uint32_t i) { return places[i] == OutOfSight && mayShow(instances[i], view); });
}

/// Leaves out what cannot be seen.
void SplatPass::Impl::place() {
    placed.clear();
    places.assign(instances.size(), OutOfSight);
    std::vector<size_t> sizes;
    for (uint32_t i = 0; i < instances.size(); ++i) {
        if (!mayShow(instances[i], view)) continue;
        places[i] = uint32_t(placed.size());
        placed.push_back(i);
        sizes.push_back(instances[i].store->size());
    }
    blocks = splatBlocks(sizes);
}

void SplatPass::Impl::setUp() {
    if (doing(Placements) && movedIntoSight()) work = Everything;
    if (doing(Everything)) place();
    std::vector<gpu::SplatPlacement> placements;
    SplatSorting sorting = SplatSorting::ZDepth; // one for all lists: the most demanding that is asked for
    for (size_t i = 0; i < placed.size(); ++i) {
        const SplatInstance& instance = instances[placed[i]];
        placements.push_back(splatPlacement(instance, view, blocks.firstSplat[i]));
        sorting = std::max(sorting, instance.store->sorting());
    }
    gpu::SplatFrame frame = frameRecord(view, mode(), profiling);
    frame.placementCount = uint32_t(placed.size());
    frame.splatCount = blocks.firstSplat.back();
    frame.sorting = uint32_t(sorting);
    frame.depthLimit = depthLimit;
    stages.setUp(mode(), frame, placements, blocks.blocks, view.camera);
}

void SplatPass::Impl::project(VkCommandBuffer cmd) const {
    stages.clear(cmd, !doing(Placements));
    if (newPicture) stages.forgetEmpty(cmd);
    computeBarrier(cmd);
    if (doing(Everything)) stages.project(cmd, 0, uint32_t(blocks.blocks.size()));
    if (!doing(Placements)) return;
    const auto each = [&](auto stage) {
        for (const uint32_t i : moved)
            if (places[i] != OutOfSight)
                (stages.*stage)(cmd, blocks.firstBlock[places[i]], blocks.firstBlock[places[i] + 1]);
    };
    each(&SplatStages::touch); // where they were
    computeBarrier(cmd);
    each(&SplatStages::project);
    computeBarrier(cmd);
    each(&SplatStages::touch); // where they are
}

/// `again`: the lists had no room; splats are projected and tiles marked already.
std::vector<SplatPass::Impl::Step> SplatPass::Impl::steps(bool again) const {
    std::vector<Step> all;
    const auto add = [&](const char* name, auto stage) {
        all.push_back({name, [this, stage](VkCommandBuffer cmd) { (stages.*stage)(cmd); }});
    };
    if (again)
        add("project", &SplatStages::clearState);
    else
        all.push_back({"project", [this](VkCommandBuffer cmd) { project(cmd); }});
    if (!doing(Raster) || !listsComplete) {
        add("count", &SplatStages::count);
        add("scan", &SplatStages::scan);
        add("fill", &SplatStages::fill);
        add("sort", &SplatStages::sort);
        if (stages.masksApart()) add("masks", &SplatStages::masks);
    }
    if (mode() == SplatMode::Higs8) add("partial", &SplatStages::partials);
    constexpr uint32_t Band = 16; // whole macro-tiles
    for (uint32_t row = 0; row < stages.pixelRows(); row += Band) {
        const uint32_t rows = std::min(Band, stages.pixelRows() - row);
        const char* const name = mode() == SplatMode::Higs8 ? "compose" : "raster";
        all.push_back({name, [=](VkCommandBuffer cmd) { stages.raster(cmd, row, rows); }, true});
    }
    return all;
}

bool SplatPass::Impl::run(const std::vector<Step>& steps, const std::atomic<bool>* cancel) {
    for (size_t begin = 0, end; begin < steps.size(); begin = end) {
        if (cancel && *cancel) return false;
        end = begin + 1;
        while (end < steps.size() && !profiling && !(cancel && steps[end].mayStop))
            ++end;
        const auto start = std::chrono::steady_clock::now();
        const std::clock_t processorStart = std::clock();
        device.run([&](VkCommandBuffer cmd) {
            for (size_t i = begin; i < end; ++i) {
                const bool sameStage = i != begin && std::strcmp(steps[i].name, steps[i - 1].name) == 0;
                if (!sameStage) computeBarrier(cmd);
                steps[i].record(cmd);
            }
        });
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
        statistics.totalMs += time.count();
        if (!profiling) continue;
        auto& rows = statistics.stages;
        if (rows.empty() || std::strcmp(rows.back().name, steps[begin].name) != 0)
            rows.push_back({steps[begin].name, 0, 0});
        rows.back().ms += time.count();
        rows.back().processorMs += 1e3 * double(std::clock() - processorStart) / CLOCKS_PER_SEC;
    }
    return true;
}

/// Renders until the lists have room.
bool SplatPass::Impl::attempts(const std::atomic<bool>* cancel, gpu::SplatState* state) {
    setUp();
    while (true) {
        if (!run(steps(statistics.attempts > 0), cancel)) return false;
        ++statistics.attempts;
        *state = stages.state();
        statistics.visible += state->visible;
        if (!state->overflow) return true;
        stages.makeRoom(*state);
    }
}

void SplatPass::Impl::report(const gpu::SplatState& state) {
    const gpu::SplatFrame& frame = stages.frame();
    for (const SplatInstance& instance : instances)
        statistics.splats += instance.store->size();
    statistics.projected = frame.splatCount;
    statistics.pairs = state.pairs;
    statistics.largestList = state.largestList;
    statistics.batches = state.batches;
    const uint64_t pairBytes = isFlat(mode()) ? sizeof(gpu::SplatTilePair) : sizeof(gpu::SplatPair);
    statistics.sortBytes = 2 * pairBytes * state.sortMoves;
    if (mode() == SplatMode::Higs8)
        statistics.partialBytes = uint64_t(state.batches) * gpu::SPLAT_MACRO_WIDTH * gpu::SPLAT_MACRO_HEIGHT *
                                  sizeof(gpu::SplatPartial);
    drawn.resize(size_t(frame.tileColumns) * frame.tileRows);
    device.download(stages.buffers().tileMask.buffer(), drawn.data(), drawn.size() * sizeof(uint32_t));
}

/// Draws once more to count; not timed.
void SplatPass::Impl::tally() {
    device.run([&](VkCommandBuffer cmd) { stages.tally(cmd, uint32_t(statistics.batches)); });
    std::vector<glm::uvec2> blends(drawn.size());
    device.download(stages.buffers().blends.buffer(), blends.data(), blends.size() * sizeof(blends[0]));
    for (const glm::uvec2& tile : blends) {
        statistics.blendsTried += tile.x;
        statistics.blendsDone += tile.y;
    }
}

bool SplatPass::Impl::render(const std::atomic<bool>* cancel) {
    statistics = {};
    if (doing(Nothing) || view.width == 0 || view.height == 0) {
        drawn.assign(drawn.size(), 0);
        return true;
    }
    gpu::SplatState state{};
    bool done = false;
    try {
        done = attempts(cancel, &state);
    } catch (...) {
        work = Everything;
        throw;
    }
    if (!done) { // which tiles were touched is not known any more
        work = Everything;
        return false;
    }
    report(state);
    if (profiling && canRunLanes(device)) tally();
    listsComplete = !doing(Placements);
    work = Nothing;
    newPicture = false;
    moved.clear();
    return true;
}

SplatPass::SplatPass(Device& device, const SplatPassOptions& options)
    : _impl(std::make_unique<Impl>(device, options)) {
    _impl->wanted = options.mode;
    for (const bool limited : {false, true})
        _impl->stages.compile(_impl->mode(), limited, false);
}
SplatPass::~SplatPass() = default;

void SplatPass::setView(const SplatView& view) {
    if (same(view, _impl->view)) return;
    if (!samePixels(view, _impl->view)) _impl->newPicture = true;
    _impl->view = view;
    _impl->need(Everything);
}

void SplatPass::setInstances(std::vector<SplatInstance> instances) {
    Impl& d = *_impl;
    if (!sameStores(instances, d.instances))
        d.need(Everything);
    else
        for (uint32_t i = 0; i < instances.size(); ++i) {
            if (!same(instances[i], d.instances[i])) d.noteMoved(i);
        }
    d.instances = std::move(instances);
}

void SplatPass::place(uint32_t instance, const glm::mat4x3& objectToWorld) {
    SplatInstance& placed = _impl->instances[instance];
    if (placed.objectToWorld == objectToWorld) return;
    placed.objectToWorld = objectToWorld;
    _impl->noteMoved(instance);
}

void SplatPass::setMode(SplatMode mode) {
    Impl& d = *_impl;
    const SplatMode before = d.mode();
    d.wanted = mode;
    if (d.mode() != before) d.need(Everything);
}

SplatMode SplatPass::mode() const {
    return _impl->mode();
}

void SplatPass::setDepthLimit(VkDeviceAddress cameraDepths) {
    Impl& d = *_impl;
    if (cameraDepths == 0 && d.depthLimit == 0) return;
    d.depthLimit = cameraDepths;
    d.need(d.doing(Placements) ? Everything : Raster);
}

void SplatPass::setProfiling(bool on) {
    _impl->profiling = on;
}

bool SplatPass::render(const std::atomic<bool>* cancel) {
    return _impl->render(cancel);
}

const Buffer& SplatPass::pixels() const {
    return _impl->stages.buffers().pixels.buffer();
}
const std::vector<uint32_t>& SplatPass::drawnTiles() const {
    return _impl->drawn;
}
uint32_t SplatPass::tileColumns() const {
    return _impl->stages.frame().tileColumns;
}
const SplatStatistics& SplatPass::statistics() const {
    return _impl->statistics;
}

} // namespace hipr
