#include "testenv/unit/shading/sphere_grid.h"

#include <algorithm>
#include <cmath>

namespace hipr::test {

namespace {
constexpr double Pi = 3.14159265358979323846;
}

glm::vec3 direction(double cosine, double azimuth) {
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return glm::vec3(glm::dvec3(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine));
}

SphereGrid::SphereGrid(int rows, int columns, int fine) : _rows(rows), _columns(columns), _fine(fine) {
    for (int bin = 0; bin < bins(); ++bin)
        for (int k = 0; k < fine * fine; ++k) {
            const double polar = Pi * (bin / columns + (k / fine + 0.5) / fine) / rows;
            const double turn = (bin % columns + (k % fine + 0.5) / fine) / columns;
            _points.push_back(direction(std::cos(polar), 2.0 * Pi * turn));
            _areas.push_back(std::sin(polar) * 2.0 * Pi * Pi / (double(bins()) * fine * fine));
        }
}

size_t SphereGrid::binOf(const glm::vec3& d) const {
    const double polar = std::acos(std::clamp(double(d.z), -1.0, 1.0)) / Pi;
    const double turn = std::atan2(double(d.y), double(d.x)) / (2.0 * Pi);
    const int row = std::min(int(polar * _rows), _rows - 1);
    return size_t(row * _columns + std::min(int((turn < 0.0 ? turn + 1.0 : turn) * _columns), _columns - 1));
}

} // namespace hipr::test
