#include "testenv/unit/shading/bsdf_survey.h"

#include <cmath>

#include <gtest/gtest.h>

#include "testenv/unit/sampling/statistics.h"

namespace hipr::test {

namespace {

const SphereGrid& sphere() {
    static const SphereGrid grid(16, 24, 20);
    return grid;
}

} // namespace

Survey survey(const SurfaceParameters& parameters, const glm::vec3& wo) {
    const SphereGrid& grid = sphere();
    const std::vector<Outcome> outcomes = runBsdf(parameters, wo, grid.points());
    Survey s;
    s.samples = outcomes.size();
    std::vector<double> counts(size_t(grid.bins())), expected(size_t(grid.bins()));
    const double n = double(s.samples);
    for (size_t i = 0; i < outcomes.size(); ++i) {
        const Outcome& o = outcomes[i];
        expected[grid.binOfPoint(i)] += double(o.pdf) * grid.area(i) * n;
        s.pdfIntegral += double(o.pdf) * grid.area(i);
        s.albedo += glm::dvec3(o.f) * grid.area(i);
        s.finite = s.finite && std::isfinite(o.f.x + o.f.y + o.f.z + o.pdf + o.sampledPdf + o.weight.x);
        if (o.sampledPdf > 0.f) {
            ++counts[grid.binOf(o.sampled)];
            s.acceptedPart += 1.0 / n;
        }
        if (o.failed()) continue;
        s.sampledAlbedo += glm::dvec3(o.weight) / n;
        s.weightSquares += glm::dvec3(o.weight) * glm::dvec3(o.weight) / n;
        for (int c = 0; c < 3; ++c) {
            const double product = double(o.weight[c]) * o.sampledPdf;
            s.worstMismatch = std::max(s.worstMismatch, std::abs(product - o.sampledF[c]) / (product + 1e-6));
        }
        s.worstMismatch = std::max(s.worstMismatch, std::abs(double(o.sampledPdf) / o.sampledEvalPdf - 1.0));
    }
    s.probability = chiSquareProbability(counts, expected);
    return s;
}

glm::dvec3 sampledAlbedo(const SurfaceParameters& parameters, const glm::vec3& wo, size_t samples) {
    // Random vectors of low discrepancy: M. Roberts, "The Unreasonable Effectiveness of Quasirandom
    // Sequences".
    constexpr double Golden = 1.1673039782614187; // of four dimensions: x^5 = x + 1
    std::vector<glm::vec4> u(samples);
    for (size_t i = 0; i < samples; ++i)
        for (int c = 0; c < 4; ++c) {
            const double value = 0.5 + double(i + 1) / std::pow(Golden, c + 1);
            u[i][c] = std::min(float(value - std::floor(value)), 0.99999994f);
        }
    const std::vector<glm::vec3> wos(samples, wo);
    glm::dvec3 sum(0.0);
    for (const Outcome& o : runBsdf(parameters, wos, wos, u))
        if (!o.failed()) sum += glm::dvec3(o.weight);
    return sum / double(samples);
}

void expectSamplesFollowThePdf(const NamedSurface& surface, double cosine) {
    const Survey s = survey(surface.parameters, direction(cosine, 0.7));
    const auto where = ::testing::Message() << surface.name << ", cosine " << cosine;
    EXPECT_TRUE(s.finite) << where;
    // 100 tests: one in 300 runs of a right sampler would fall below; the numbers are fixed, so none does.
    EXPECT_GT(s.probability, 3e-5) << where;
    EXPECT_LT(s.worstMismatch, 1e-4) << where;
    const double noise =
        4.5 * std::sqrt(std::max(1e-6, s.acceptedPart * (1 - s.acceptedPart)) / double(s.samples));
    EXPECT_NEAR(s.pdfIntegral, s.acceptedPart, noise + 4e-3) << where;
}

void expectReciprocalReflection(const NamedSurface& surface) {
    std::vector<glm::vec3> a, b;
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j) {
            a.push_back(direction(0.03 + 0.96 * i / 39.0, 0.3));
            b.push_back(direction(0.03 + 0.96 * j / 39.0, 0.3 + 0.157 * ((i * 7 + j) % 40)));
        }
    const std::vector<glm::vec4> u(a.size(), glm::vec4(0.5f));
    const std::vector<Outcome> there = runBsdf(surface.parameters, a, b, u);
    const std::vector<Outcome> back = runBsdf(surface.parameters, b, a, u);
    for (size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double f = there[i].f[c] / b[i].z, g = back[i].f[c] / a[i].z;
            ASSERT_NEAR(f, g, 2e-4 * std::max(f, g) + 1e-6) << surface.name << " " << a[i].z << " " << b[i].z;
        }
}

void expectReciprocalRefraction(const SurfaceParameters& glass, double eta) {
    SurfaceParameters inside = glass;
    inside.frontFacing = 0;
    std::vector<glm::vec3> a, b, flippedA, flippedB;
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j) {
            a.push_back(direction(0.1 + 0.88 * i / 19.0, 0.3));
            b.push_back(direction(-0.1 - 0.88 * j / 19.0, 3.5 + 0.02 * i));
            // Seen from the inside the surface's frame is turned over: the viewer is always above.
            flippedA.push_back(-a.back());
            flippedB.push_back(-b.back());
        }
    const std::vector<glm::vec4> u(a.size(), glm::vec4(0.5f));
    const std::vector<Outcome> in = runBsdf(glass, a, b, u), out = runBsdf(inside, flippedB, flippedA, u);
    int positive = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        const double f = in[i].f.x / std::abs(b[i].z) / (eta * eta), g = out[i].f.x / a[i].z;
        ASSERT_NEAR(f, g, 1e-3 * std::max(f, g) + 1e-6) << a[i].z << " " << b[i].z;
        positive += f > 0.0;
    }
    EXPECT_GT(positive, 100);
}

} // namespace hipr::test
