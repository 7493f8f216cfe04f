/// @file film.h
/// Pixels: sums over samples, the first hit of every pixel centre, and the AOVs that follow from either.
#pragma once

#include <array>
#include <vector>

#include "renderer/api/film.h"
#include "renderer/hipr/schedule.h"
#include "renderer/shading/names.h"
#include "renderer/trace/light_paths.h"
#include "renderer/trace/reprojection.h"
#include "renderer/vulkan/device.h"
#include "shaders/shared/scene.h"
#include "shaders/shared/trace.h"

namespace hipr {

/// After a restart the pixels keep their old picture until their first new sample.
class FilmBuffers {
public:
    FilmBuffers(Device& device, NameTable& names)
        : _device(device), _names(names), _lightPaths(device, names) {}

    /// Allocates and clears; every AOV then holds what it shows where nothing is seen. A film without pixels
    /// is fine; one too large for the renderer or the memory gives an error message and counts as such.
    void setDesc(const FilmDesc& desc);
    const FilmDesc& desc() const { return _desc; }
    /// The size that is rendered.
    uint32_t width() const { return _width; }
    uint32_t height() const { return _height; }
    uint64_t pixels() const { return uint64_t(_width) * _height; }
    /// Whether first hits are to be found: an AOV shows them, or discovery needs them.
    bool wantsFirstHits() const { return !_firstHits.empty() || _keepsHits || _keepsDepths; }

    /// Whether first hits are kept as well as shown, those of the scene before the last edit too. Returns
    /// whether that is new; first hits then have to be found anew, if they are wanted at all.
    bool keepHits(bool keep);
    /// The first hits, which are complete, become those before the edit.
    void retireHits();
    /// Forgets those before the edit: the picture is of another view.
    void dropPreviousHits() { _hasPrevious = false; }
    /// Whether the depths of first hits are kept, which hide what is drawn over the picture. Returns the
    /// same.
    bool keepDepths(bool keep);
    /// gpu::TraceRecord::opaqueDepths, or 0.
    VkDeviceAddress depths() const { return _depths ? _depths.address() : 0; }
    /// Address of the gpu::VisibilityRecords from before the edit, or 0.
    VkDeviceAddress previousHits() const { return _hasPrevious ? _previousHits.address() : 0; }

    /// Whether what modes that look for edits need is kept: pictures from before them, and what pixels see.
    /// From then on, where it was not kept before.
    void keepPictures(bool keep);
    /// Carries what is on display to another camera: see Reprojection::carry(). All of it is in the old
    /// picture then, and depths() are those of what was carried.
    bool carry(Reprojection& reprojection, const TileSchedule& schedule, const gpu::CameraRecord& before,
               const gpu::CameraRecord& after, std::vector<gpu::CarriedStrip>& strips);

    void describe(gpu::TraceRecord& record) const;
    /// Its light path expressions.
    gpu::LpeRecord lightPaths() const { return _lightPaths.record(); }
    /// Which of SCENE_SHADING_FEATURES its AOVs need.
    uint32_t shadingFeatures() const { return _lightPaths.any() ? gpu::FILM_SORTS_LIGHT : 0; }

    /// Whether what samples differ from their mean by is summed up although no AOV asks for it; takes effect
    /// with the next first samples.
    void keepSpreads(bool keep);

    bool holds(const AovRequest& aov) const;
    /// Whether an AOV tells what things are called.
    bool wantsNames() const;
    /// See Renderer::readAov(); for AOVs that are not of tiles (renderer/hipr/tile_aovs.h).
    bool read(const AovRequest& aov, const TileSchedule& schedule, void* dst, size_t words) const;

private:
    struct FirstHitAov {
        AovRequest request;
        Buffer values;
    };
    void clear();
    void allocate();
    void refuse(const std::string& reason);
    Buffer filled(uint64_t bytes, uint32_t word);
    template <class Value>
    void readMeans(Value gpu::FilmPixel::*sum, Value gpu::OldPixel::*old, const TileSchedule& schedule,
                   float* dst) const;
    template <class T> const T* hostCopy(const Buffer& buffer, std::vector<T>& copy) const;
    void createHits();
    void createPictures();
    void createSpreads();
    void readVariance(float* dst) const;
    void readLightPath(const std::string& expression, float* dst) const;
    void readCryptomatte(const AovRequest& aov, float* dst) const;

    Device& _device;
    NameTable& _names;
    FilmDesc _desc; ///< as asked for
    uint32_t _width = 0, _height = 0;
    Buffer _sums, _oldPicture, _firstSamples, _visibility, _previousHits, _depths, _targets, _spreads;
    Buffer _carried, _seen, _seenAfter, _lists;
    std::array<Buffer, gpu::CRYPTOMATTE_KINDS> _cryptomattes;
    LightPaths _lightPaths;
    bool _keepsHits = false, _keepsDepths = false, _hasPrevious = false, _keepsPictures = false,
         _keepsSpreads = false;
    std::vector<FirstHitAov> _firstHits;
};

} // namespace hipr
