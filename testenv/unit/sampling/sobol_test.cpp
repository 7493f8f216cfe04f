#include <algorithm>
#include <cmath>
#include <set>

#include <glm/glm.hpp>

#include "hipr_sampling_test_kernels.h"
#include "testenv/unit/sampling/gpu.h"
#include "testenv/unit/sampling/statistics.h"

namespace hipr::test {
namespace {

struct Push {
    VkDeviceAddress points, offsets;
    glm::uvec2 pixel;
    uint32_t samples, count, dimensionSet, seed, filterKind;
    float filterWidth;
};

struct Result {
    std::vector<glm::vec4> points;
    std::vector<glm::vec2> offsets;
};

const Kernel& kernel() {
    static const Kernel made(testDevice(), spirv::sobol_spv, spirv::sobol_spv_size, sizeof(Push),
                             "sobol test");
    return made;
}

Result draw(uint32_t samples, uint32_t pixels = 1, uint32_t set = 0, uint32_t seed = 0,
            glm::uvec2 pixel = {17, 5}, uint32_t filter = 0, float width = 0.f) {
    const uint32_t count = samples * pixels;
    const Buffer points = emptyBuffer<glm::vec4>(count), offsets = emptyBuffer<glm::vec2>(count);
    dispatch(kernel(),
             Push{points.address(), offsets.address(), pixel, samples, count, set, seed, filter, width},
             count);
    return {toHost<glm::vec4>(points, count), toHost<glm::vec2>(offsets, count)};
}

/// Whether every box of the elementary partition 2^a x 2^b holds the same number of points.
bool stratified(const std::vector<glm::vec4>& p, int dx, int dy, int a, int b) {
    std::vector<size_t> boxes(size_t(1) << (a + b));
    for (const glm::vec4& v : p)
        ++boxes[(size_t(v[dx] * float(1 << a)) << b) + size_t(v[dy] * float(1 << b))];
    return std::all_of(boxes.begin(), boxes.end(), [&](size_t n) { return n == p.size() / boxes.size(); });
}

/// Sobol dimensions 0 and 1 form a (0, 2)-sequence: every elementary interval of area 1 / n holds one of n
/// points, for every aligned block of samples.
TEST(Sobol, FirstTwoDimensionsAreAZeroTwoSequence) {
    for (const uint32_t set : {0u, 1u, 7u}) {
        const Result all = draw(1024, 1, set, 3);
        for (int block = 0; block < 4; ++block) {
            const std::vector<glm::vec4> points(all.points.begin() + block * 256,
                                                all.points.begin() + (block + 1) * 256);
            for (int a = 0; a <= 8; ++a)
                EXPECT_TRUE(stratified(points, 0, 1, a, 8 - a))
                    << "set " << set << " block " << block << " a " << a;
        }
    }
}

TEST(Sobol, EveryDimensionIsStratifiedAlone) {
    const std::vector<glm::vec4> points = draw(512, 1, 2).points;
    for (int d = 0; d < 4; ++d)
        EXPECT_TRUE(stratified(points, d, d == 0 ? 1 : 0, 9, 0)) << d;
}

/// Joint stratification of all four numbers: the Sobol sequence has a 2^2 x 2^2 x 2^2 x 2^2 grid of one point
/// each after 2^(8 + t) samples with t = 3 for these dimensions (Joe and Kuo's table), so at most 2^3 in any
/// box.
TEST(Sobol, FourDimensionsAreStratifiedJointly) {
    const std::vector<glm::vec4> points = draw(2048, 1, 4).points;
    std::vector<int> boxes(256);
    for (const glm::vec4& v : points)
        ++boxes[size_t(v.x * 4) * 64 + size_t(v.y * 4) * 16 + size_t(v.z * 4) * 4 + size_t(v.w * 4)];
    for (const int n : boxes)
        EXPECT_EQ(n, 8);
}

TEST(Sobol, ScrambledPointsAreUniform) {
    // One sample each of many pixels: scrambling alone makes these uniform.
    constexpr uint32_t Pixels = 1 << 16;
    const std::vector<glm::vec4> points = draw(1, Pixels, 1).points;
    for (int d = 0; d < 4; ++d) {
        std::vector<double> counts(256), expected(256, Pixels / 256.0);
        double sum = 0.0;
        for (const glm::vec4& v : points) {
            ++counts[size_t(v[d] * 256.f)];
            sum += v[d];
        }
        EXPECT_GT(chiSquareProbability(counts, expected), 1e-4) << d;
        EXPECT_NEAR(sum / Pixels, 0.5, 4.0 / std::sqrt(12.0 * Pixels)) << d;
    }
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
    const double n = double(a.size());
    for (size_t i = 0; i < a.size(); ++i)
        sa += a[i], sb += b[i], saa += a[i] * a[i], sbb += b[i] * b[i], sab += a[i] * b[i];
    return (sab - sa * sb / n) / std::sqrt((saa - sa * sa / n) * (sbb - sb * sb / n));
}

TEST(Sobol, PixelsDimensionsSetsAndSeedsAreUncorrelated) {
    constexpr uint32_t Pixels = 1 << 16;
    const auto column = [](const std::vector<glm::vec4>& p, int d, size_t from = 0) {
        std::vector<double> out;
        for (size_t i = from; i < p.size(); ++i)
            out.push_back(p[i][d]);
        return out;
    };
    const std::vector<glm::vec4> base = draw(1, Pixels).points;
    const double limit = 4.5 / std::sqrt(double(Pixels));
    const std::vector<glm::vec4> otherSet = draw(1, Pixels, 1).points,
                                 otherSeed = draw(1, Pixels, 0, 1).points,
                                 below = draw(1, Pixels, 0, 0, {17, 6}).points;
    for (int d = 0; d < 4; ++d) {
        std::vector<double> own = column(base, d), neighbour = column(base, d, 1);
        EXPECT_LT(std::abs(correlation(own, column(otherSet, d))), limit) << "sets, dimension " << d;
        EXPECT_LT(std::abs(correlation(own, column(otherSeed, d))), limit) << "seeds, dimension " << d;
        EXPECT_LT(std::abs(correlation(own, column(below, d))), limit) << "rows, dimension " << d;
        for (int e = 0; e < d; ++e)
            EXPECT_LT(std::abs(correlation(own, column(base, e))), limit) << "dimensions " << d << " " << e;
        own.pop_back();
        EXPECT_LT(std::abs(correlation(own, neighbour)), limit) << "columns, dimension " << d;
    }
}

/// Samples of one path must not repeat from set to set: their order is shuffled.
TEST(Sobol, SetsPairUpFreely) {
    const std::vector<glm::vec4> a = draw(256, 1, 0).points, b = draw(256, 1, 1).points;
    std::set<std::pair<int, int>> cells;
    for (size_t i = 0; i < a.size(); ++i)
        cells.insert({int(a[i].x * 16), int(b[i].x * 16)});
    EXPECT_GT(cells.size(), 120u); // 162 for random pairs, 16 for equal order
}

TEST(Sobol, IsAFunctionOfItsArguments) {
    const Result a = draw(64, 4, 3, 9), b = draw(64, 4, 3, 9);
    EXPECT_EQ(a.points, b.points);
    const std::vector<glm::vec4> second = draw(64, 1, 3, 9, {18, 5}).points; // pixel by itself
    EXPECT_TRUE(std::equal(second.begin(), second.end(), a.points.begin() + 64));
    for (const glm::vec4& v : draw(4096, 16, 5, 77).points)
        for (int d = 0; d < 4; ++d)
            ASSERT_TRUE(v[d] >= 0.f && v[d] < 1.f);
}

/// Integrates a smooth function: the error must fall faster than that of random numbers.
TEST(Sobol, ConvergesFasterThanRandom) {
    double squared = 0.0;
    constexpr uint32_t Pixels = 64, Samples = 1024;
    const std::vector<glm::vec4> points = draw(Samples, Pixels, 6).points;
    for (uint32_t p = 0; p < Pixels; ++p) {
        double sum = 0.0;
        for (uint32_t i = 0; i < Samples; ++i) {
            const glm::vec4 v = points[p * Samples + i];
            sum += double(v.x) * v.y * v.z * v.w;
        }
        const double error = sum / Samples - 1.0 / 16.0;
        squared += error * error / Pixels;
    }
    const double random = std::sqrt((1.0 / 81.0 - 1.0 / 256.0) / Samples);
    EXPECT_LT(std::sqrt(squared), 0.1 * random);
}

/// Densities on [-1/2, 1/2] of the filters, by their definitions.
double filterDensity(uint32_t kind, double x) {
    const double pi = 3.14159265358979323846;
    switch (kind) {
    case 0:
        return 1.0;
    case 1:
        return 2.0 - 4.0 * std::abs(x);
    case 2:
        return 6.0 / std::sqrt(2.0 * pi) * std::exp(-18.0 * x * x) / 0.9973002039367398;
    default:
        return 1.0 + (0.48829 * std::cos(2 * pi * x) + 0.14128 * std::cos(4 * pi * x) +
                      0.01168 * std::cos(6 * pi * x)) /
                         0.35875;
    }
}

TEST(Filter, OffsetsFollowTheFilter) {
    constexpr uint32_t Count = 1 << 17, Bins = 64;
    const float ownWidth[] = {1.f, 2.f, 3.f, 3.3f};
    for (uint32_t kind = 0; kind < 4; ++kind)
        for (const float width : {0.f, 1.5f}) {
            const float full = width > 0.f ? width : ownWidth[kind];
            const Result drawn = draw(1, Count, 0, 0, {0, 0}, kind, width);
            for (int axis = 0; axis < 2; ++axis) {
                std::vector<double> counts(Bins), expected(Bins);
                for (const glm::vec2& offset : drawn.offsets) {
                    const double x = double(offset[axis]) / full + 0.5;
                    ASSERT_TRUE(x >= 0.0 && x <= 1.0) << kind;
                    ++counts[std::min(size_t(x * Bins), size_t(Bins - 1))];
                }
                for (uint32_t b = 0; b < Bins; ++b)
                    for (int k = 0; k < 64; ++k)
                        expected[b] +=
                            Count * filterDensity(kind, (b + (k + 0.5) / 64) / Bins - 0.5) / (Bins * 64.0);
                EXPECT_GT(chiSquareProbability(counts, expected), 1e-4)
                    << "filter " << kind << " axis " << axis;
            }
        }
}

TEST(Statistics, ChiSquareAgreesWithTables) {
    // Upper 5 % points of the chi-square distribution.
    EXPECT_NEAR(gammaQ(0.5, 3.841 / 2), 0.05, 1e-4);
    EXPECT_NEAR(gammaQ(5.0, 18.307 / 2), 0.05, 1e-4);
    EXPECT_NEAR(gammaQ(50.0, 124.342 / 2), 0.05, 1e-4);
    EXPECT_EQ(chiSquareProbability({10, 0}, {0, 10}), 0.0);
    EXPECT_LT(chiSquareProbability({60, 40, 50, 50}, {40, 60, 50, 50}), 1e-3);
}

} // namespace
} // namespace hipr::test
