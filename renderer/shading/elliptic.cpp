#include "renderer/shading/elliptic.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/gtc/constants.hpp>

namespace hipr {
namespace {

/// R_F and R_D of three values, of which at most one of the first two is 0.
struct CarlsonPair {
    double rf, rd;
};

/// Duplication until the values are so near to their mean that a series of fifth order is exact to rounding.
CarlsonPair carlsonFD(double x, double y, double z) {
    double sum = 0.0, factor = 1.0; // of R_D
    for (int i = 0; i < 40; ++i) {
        const double mean = (x + y + z) / 3.0;
        if (std::max({std::abs(mean - x), std::abs(mean - y), std::abs(mean - z)}) < 1e-3 * mean) break;
        const double sx = std::sqrt(x), sy = std::sqrt(y), sz = std::sqrt(z);
        const double lambda = sx * sy + sx * sz + sy * sz;
        sum += factor / (sz * (z + lambda));
        factor *= 0.25;
        x = 0.25 * (x + lambda), y = 0.25 * (y + lambda), z = 0.25 * (z + lambda);
    }
    const double a = (x + y + z) / 3.0, fx = 1.0 - x / a, fy = 1.0 - y / a, fz = -fx - fy;
    const double e2 = fx * fy - fz * fz, e3 = fx * fy * fz;
    const double rf = (1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 * e2 * e3 / 44.0) / std::sqrt(a);
    const double d = (x + y + 3.0 * z) / 5.0, dx = 1.0 - x / d, dy = 1.0 - y / d, dz = -(dx + dy) / 3.0;
    const double xy = dx * dy, zz = dz * dz;
    const double d2 = xy - 6.0 * zz, d3 = (3.0 * xy - 8.0 * zz) * dz, d4 = 3.0 * (xy - zz) * zz,
                 d5 = xy * zz * dz;
    const double series = 1.0 - 3.0 * d2 / 14.0 + d3 / 6.0 + 9.0 * d2 * d2 / 88.0 - 3.0 * d4 / 22.0 -
                          9.0 * d2 * d3 / 52.0 + 3.0 * d5 / 26.0;
    return {rf, 3.0 * sum + factor * series / (d * std::sqrt(d))};
}

/// Eigenvalues of a symmetric matrix that has none below 0: O. K. Smith, "Eigenvalues of a symmetric 3 x 3
/// matrix", 1961.
glm::dvec3 eigenvalues(const glm::dmat3& m) {
    const double mean = (m[0][0] + m[1][1] + m[2][2]) / 3.0;
    const glm::dmat3 rest = m - glm::dmat3(mean);
    double squares = 0.0;
    for (int c = 0; c < 3; ++c)
        squares += glm::dot(rest[c], rest[c]);
    const double p = std::sqrt(squares / 6.0);
    if (!(p > 0.0)) return glm::dvec3(mean);
    const double r = std::min(std::max(0.5 * glm::determinant(rest * (1.0 / p)), -1.0), 1.0);
    const double phi = std::acos(r) / 3.0, third = 2.0 * glm::pi<double>() / 3.0;
    const glm::dvec3 values =
        mean + 2.0 * p * glm::dvec3(std::cos(phi), std::cos(phi + third), std::cos(phi - third));
    return glm::max(values, glm::dvec3(0.0));
}

} // namespace

double carlsonRG(double x, double y, double z) {
    // With the middle one as the third all terms of the sum are positive.
    if (x > y) std::swap(x, y);
    if (y > z) std::swap(y, z);
    if (x > y) std::swap(x, y);
    std::swap(y, z);
    if (!(z > 0.0)) return 0.5 * std::sqrt(y); // x is 0 too
    const auto [rf, rd] = carlsonFD(x, y, z);
    return 0.5 * (z * rf - (x - z) * (y - z) * rd / 3.0 + std::sqrt(x * y / z));
}

double ellipsoidArea(const glm::dmat3& m) {
    // 4 pi R_G of the products of two squared half axes (DLMF 19.33.1), which are what the cofactors stretch
    // by.
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const glm::dvec3 squares = eigenvalues(glm::transpose(cofactors) * cofactors);
    return 4.0 * glm::pi<double>() * carlsonRG(squares.x, squares.y, squares.z);
}

double ellipsePerimeter(const glm::dvec3& a, const glm::dvec3& b) {
    // 8 R_G of 0 and the squared half axes (DLMF 19.30.5).
    const double aa = glm::dot(a, a), bb = glm::dot(b, b), ab = glm::dot(a, b);
    const double mean = 0.5 * (aa + bb), half = std::hypot(0.5 * (aa - bb), ab);
    return 8.0 * carlsonRG(0.0, std::max(mean - half, 0.0), mean + half);
}

} // namespace hipr
