#include "renderer/shading/dome.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace hipr {

namespace {

constexpr uint32_t MostColumns = 1024, MostRows = 512;
constexpr double Pi = 3.14159265358979323846;

struct Grid {
    uint32_t width, height;
    std::vector<double> values;
    double& at(uint32_t x, uint32_t y) { return values[size_t(y) * width + x]; }
    double at(uint32_t x, uint32_t y) const { return values[size_t(y) * width + x]; }
};

/// Integral of sin over the polar angle of rows [first, last) of `count`.
double rowWeight(uint32_t first, uint32_t last, uint32_t count) {
    return std::cos(Pi * first / count) - std::cos(Pi * last / count);
}

/// Luminance of every texel, and the mean radiance over the sphere.
Grid luminances(const Image& image, glm::dvec3& mean) {
    Grid grid{image.width, image.height, std::vector<double>(size_t(image.width) * image.height)};
    std::vector<glm::dvec3> rows(image.height);
    tbb::parallel_for(0u, image.height, [&](uint32_t y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const glm::dvec3 rgb = glm::max(glm::dvec3(image.texel(x, y)), glm::dvec3(0.0));
            grid.at(x, y) = glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
            rows[y] += rgb;
        }
    });
    for (uint32_t y = 0; y < image.height; ++y)
        mean += rows[y] * (rowWeight(y, y + 1, image.height) / (2.0 * image.width));
    return grid;
}

/// Mean of the bilinearly interpolated picture over each texel's square: weights 1/8, 6/8, 1/8 along both
/// axes; columns wrap around, rows end.
Grid bilinearMeans(const Grid& in) {
    Grid out{in.width, in.height, std::vector<double>(in.values.size())};
    tbb::parallel_for(0u, in.height, [&](uint32_t y) {
        const uint32_t up = std::min(y + 1, in.height - 1), down = y ? y - 1 : 0;
        const auto column = [&](uint32_t x) {
            return (in.at(x, up) + 6.0 * in.at(x, y) + in.at(x, down)) / 8.0;
        };
        for (uint32_t x = 0; x < in.width; ++x)
            out.at(x, y) =
                (column((x + 1) % in.width) + 6.0 * column(x) + column((x + in.width - 1) % in.width)) / 8.0;
    });
    return out;
}

/// Sums texels into cells. A texel that a cell boundary cuts counts for both sides: a density may be too high
/// there, but not 0 where there is light.
Grid cellWeights(const Grid& texels) {
    Grid cells{std::min(texels.width, MostColumns), std::min(texels.height, MostRows), {}};
    cells.values.resize(size_t(cells.width) * cells.height);
    tbb::parallel_for(0u, cells.height, [&](uint32_t j) {
        const uint32_t y0 = uint32_t(uint64_t(j) * texels.height / cells.height);
        const uint32_t y1 = uint32_t((uint64_t(j + 1) * texels.height + cells.height - 1) / cells.height);
        for (uint32_t i = 0; i < cells.width; ++i) {
            const uint32_t x0 = uint32_t(uint64_t(i) * texels.width / cells.width);
            const uint32_t x1 = uint32_t((uint64_t(i + 1) * texels.width + cells.width - 1) / cells.width);
            double sum = 0.0;
            for (uint32_t y = y0; y < y1; ++y)
                for (uint32_t x = x0; x < x1; ++x)
                    sum += texels.at(x, y);
            cells.at(i, j) = sum / (double(x1 - x0) * (y1 - y0)) * rowWeight(j, j + 1, cells.height);
        }
    });
    return cells;
}

/// Appends the n + 1 cumulative sums of `weights`, scaled to end at exactly 1; uniform when they are all 0.
void appendCumulative(const double* weights, uint32_t n, std::vector<float>& out) {
    double total = 0.0;
    for (uint32_t i = 0; i < n; ++i)
        total += weights[i];
    double sum = 0.0;
    for (uint32_t i = 0; i < n; ++i) {
        out.push_back(float(total > 0.0 ? sum / total : double(i) / n));
        sum += weights[i];
    }
    out.push_back(1.f);
}

} // namespace

DomeTable buildDomeTable(const Image& image) {
    DomeTable table;
    glm::dvec3 mean(0.0);
    const Grid cells = cellWeights(bilinearMeans(luminances(image, mean)));
    table.mean = glm::vec3(mean);
    std::vector<double> rows(cells.height);
    double total = 0.0;
    for (uint32_t y = 0; y < cells.height; ++y) {
        for (uint32_t x = 0; x < cells.width; ++x)
            rows[y] += cells.at(x, y);
        total += rows[y];
    }
    if (!(total > 0.0)) return table;
    table.width = cells.width;
    table.height = cells.height;
    appendCumulative(rows.data(), cells.height, table.values);
    for (uint32_t y = 0; y < cells.height; ++y)
        appendCumulative(cells.values.data() + size_t(y) * cells.width, cells.width, table.values);
    return table;
}

} // namespace hipr
