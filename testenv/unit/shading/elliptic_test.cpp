// Areas of ellipsoids and ellipses, against known values and against quadrature.
#include "renderer/shading/elliptic.h"

#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace hipr::test {
namespace {

constexpr double Pi = glm::pi<double>();

/// Integral of |det m| |m^-T n| over all directions n, by the midpoint rule.
double areaByQuadrature(const glm::dmat3& m) {
    const glm::dmat3 inverseTransposed = glm::transpose(glm::inverse(m));
    constexpr int Rows = 512, Columns = 1024;
    double sum = 0.0;
    for (int j = 0; j < Rows; ++j)
        for (int i = 0; i < Columns; ++i) {
            const double theta = Pi * (j + 0.5) / Rows, phi = 2.0 * Pi * (i + 0.5) / Columns;
            const glm::dvec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                               std::cos(theta));
            sum += std::sin(theta) * glm::length(inverseTransposed * n);
        }
    return sum * (Pi / Rows) * (2.0 * Pi / Columns) * std::abs(glm::determinant(m));
}

/// The examples of Carlson's paper.
TEST(Elliptic, PublishedValues) {
    EXPECT_NEAR(carlsonRG(0.0, 16.0, 16.0), Pi, 1e-14);
    EXPECT_NEAR(carlsonRG(2.0, 3.0, 4.0), 1.7255030280692, 1e-13);
    EXPECT_NEAR(carlsonRG(0.0, 0.0796, 4.0), 1.0284758090288, 1e-13);
    EXPECT_EQ(carlsonRG(0.0, 0.0, 4.0), 1.0);
    EXPECT_EQ(carlsonRG(0.0, 0.0, 0.0), 0.0);
}

TEST(Elliptic, AreasOfEllipsoids) {
    EXPECT_NEAR(ellipsoidArea(glm::dmat3(2.0)), 16.0 * Pi, 1e-12);
    // Oblate with half axes 2, 2, 1.
    const double e = std::sqrt(0.75);
    const double oblate = 2.0 * Pi * 4.0 * (1.0 + 0.25 / e * std::atanh(e));
    EXPECT_NEAR(ellipsoidArea(glm::dmat3(glm::scale(glm::dmat4(1), glm::dvec3(2, 1, 2)))), oblate, 1e-12);
    // A disk, both sides; a needle.
    EXPECT_NEAR(ellipsoidArea(glm::dmat3(glm::scale(glm::dmat4(1), glm::dvec3(1, 1, 1e-9)))), 2.0 * Pi, 1e-6);
    EXPECT_NEAR(ellipsoidArea(glm::dmat3(glm::scale(glm::dmat4(1), glm::dvec3(1, 1e-4, 1e-4)))),
                Pi * Pi * 1e-4, 1e-9);
    for (const glm::dvec3 scale : {glm::dvec3(1, 2, 3), glm::dvec3(0.3, -4, 2), glm::dvec3(1, 1, 6)}) {
        glm::dmat3 shear(1.0);
        shear[1][0] = 0.7, shear[2][1] = -0.4;
        const glm::dmat3 m = shear * glm::dmat3(glm::rotate(glm::dmat4(1), 0.8, glm::dvec3(1, 2, 3))) *
                             glm::dmat3(glm::scale(glm::dmat4(1), scale));
        const double truth = areaByQuadrature(m);
        EXPECT_NEAR(ellipsoidArea(m), truth, 1e-5 * truth);
    }
}

TEST(Elliptic, PerimetersOfEllipses) {
    EXPECT_NEAR(ellipsePerimeter({3, 0, 0}, {0, 0, 3}), 6.0 * Pi, 1e-12);
    EXPECT_NEAR(ellipsePerimeter({3, 0, 0}, {0, 0, 0}), 12.0, 1e-12);
    const glm::dvec3 a(1.0, 0.3, -0.2), b(0.4, 2.0, 0.7);
    constexpr int Steps = 4096;
    double truth = 0.0;
    for (int i = 0; i < Steps; ++i) {
        const double t = 2.0 * Pi * (i + 0.5) / Steps;
        truth += glm::length(b * std::cos(t) - a * std::sin(t)) * 2.0 * Pi / Steps;
    }
    EXPECT_NEAR(ellipsePerimeter(a, b), truth, 1e-12 * truth);
}

} // namespace
} // namespace hipr::test
