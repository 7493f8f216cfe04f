// What hosts read of a picture.
#include "renderer/hipr/tile_aovs.h"
#include "renderer/trace/renderer_impl.h"

namespace hipr {

bool RendererImpl::readAov(const AovRequest& aov, void* dst, size_t words) {
    return guarded([&] {
        if (!isTileAov(aov.kind)) {
            if (!_film.read(aov, _schedule, dst, words)) return false;
            _splats.blend(aov, dst, _film.pixels());
            const float exposure = cameraExposure();
            if (aov.kind == AovKind::Color) scaleColors(static_cast<float*>(dst), 4, exposure);
            if (aov.kind == AovKind::Lpe) scaleColors(static_cast<float*>(dst), 3, exposure);
            if (aov.kind == AovKind::Variance) scaleColors(static_cast<float*>(dst), 3, exposure * exposure);
            return true;
        }
        if (!_film.holds(aov) || words != _film.pixels()) return false;
        fillTileAov(aov.kind, _schedule, static_cast<uint32_t*>(dst));
        return true;
    });
}

float RendererImpl::cameraExposure() const {
    return _scene.camera() && _settings.exposureCompensation ? _scene.camera()->exposure : 1.f;
}

/// Scales the first three components of each pixel.
void RendererImpl::scaleColors(float* pixels, size_t components, float scale) const {
    if (scale == 1.f) return;
    for (float* const end = pixels + components * _film.pixels(); pixels != end; pixels += components)
        for (int c = 0; c < 3; ++c)
            pixels[c] *= scale;
}

} // namespace hipr
