#include "renderer/shading/dome_format.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/gtc/packing.hpp>
#include <tbb/parallel_for.h>

#include "renderer/shading/texels.h"
#include "shaders/shared/material.h"

namespace hipr {

namespace {

constexpr double Pi = 3.14159265358979323846;
constexpr uint32_t MostRows = 4096;

/// A part of a picture, rows from the bottom.
struct Region {
    double x, y, width, height;
};

/// Bilinear, not looking beyond the region; `at` in [-1, 1], x to the right and y up.
glm::vec4 sample(const Image& image, const Region& region, const glm::dvec2& at) {
    const auto place = [](double begin, double size, double share) {
        const double position = begin + (0.5 + 0.5 * share) * size - 0.5;
        return std::min(std::max(position, begin), begin + size - 1.0);
    };
    const double x = place(region.x, region.width, at.x), y = place(region.y, region.height, at.y);
    const auto x0 = uint32_t(x), y0 = uint32_t(y);
    const uint32_t x1 = std::min(x0 + 1, image.width - 1), y1 = std::min(y0 + 1, image.height - 1);
    const auto s = float(x - x0), t = float(y - y0);
    return glm::mix(glm::mix(image.texel(x0, y0), image.texel(x1, y0), s),
                    glm::mix(image.texel(x0, y1), image.texel(x1, y1), s), t);
}

/// The face of a vertical cross that shows `d`, by column and row from the top, and where on it.
glm::dvec2 crossFace(const glm::dvec3& d, int& column, int& row) {
    const glm::dvec3 a = glm::abs(d);
    if (a.x >= a.y && a.x >= a.z) { // left and right of the middle
        column = d.x > 0.0 ? 0 : 2, row = 1;
        return glm::dvec2(d.x > 0.0 ? d.z : -d.z, d.y) / a.x;
    }
    column = 1;
    if (a.y >= a.z) {
        row = d.y > 0.0 ? 0 : 2;
        return glm::dvec2(-d.x, d.y > 0.0 ? -d.z : d.z) / a.y;
    }
    row = d.z > 0.0 ? 1 : 3; // the back hangs below, upside down
    return glm::dvec2(-d.x, d.z > 0.0 ? d.y : -d.y) / a.z;
}

glm::vec4 radiance(const Image& image, DomeFormat format, const glm::dvec3& d) {
    if (format == DomeFormat::CubeMapVerticalCross) {
        int column = 0, row = 0;
        const glm::dvec2 at = crossFace(d, column, row);
        const double width = image.width / 3.0, height = image.height / 4.0;
        return sample(image, {column * width, (3 - row) * height, width, height}, at);
    }
    const Region all{0.0, 0.0, double(image.width), double(image.height)};
    const double off = std::acos(glm::clamp(d.z, -1.0, 1.0)), across = std::hypot(d.x, d.y);
    const double radius =
        format == DomeFormat::Angular ? off / Pi : std::sin(0.5 * off); // of the ball's normal
    return sample(image, all,
                  across > 0.0 ? glm::dvec2(d.x, d.y) * (radius / across) : glm::dvec2(radius, 0.0));
}

void store(Image& image, size_t texel, const glm::vec4& value) {
    unsigned char* out = &image.texels[texel * bytesPerTexel(image.format)];
    if (image.format == gpu::TEXEL_RGBA32F) {
        std::memcpy(out, &value, sizeof(value));
        return;
    }
    const uint64_t halves = glm::packHalf4x16(value);
    std::memcpy(out, &halves, sizeof(halves));
}

} // namespace

Image toLatLong(Image image, DomeFormat format) {
    if (format == DomeFormat::LatLong || image.width == 0 || image.height == 0) return image;
    Image out;
    out.height = format == DomeFormat::CubeMapVerticalCross ? image.height / 2 : image.height;
    out.height = std::min(std::max(out.height, 2u), MostRows);
    out.width = 2 * out.height;
    out.format = image.format == gpu::TEXEL_RGBA32F ? gpu::TEXEL_RGBA32F : gpu::TEXEL_RGBA16F;
    out.opaque = image.opaque;
    out.texels.resize(size_t(out.width) * out.height * bytesPerTexel(out.format));
    tbb::parallel_for(0u, out.height, [&](uint32_t y) {
        const double latitude = Pi * ((y + 0.5) / out.height - 0.5);
        for (uint32_t x = 0; x < out.width; ++x) {
            const double longitude = Pi - 2.0 * Pi * (x + 0.5) / out.width;
            const glm::dvec3 d(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                               std::cos(latitude) * std::cos(longitude));
            store(out, size_t(y) * out.width + x, radiance(image, format, d));
        }
    });
    return out;
}

} // namespace hipr
