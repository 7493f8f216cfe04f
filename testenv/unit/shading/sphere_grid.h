/// @file sphere_grid.h
/// The sphere in bins of polar angle by azimuth, each with a grid of points for quadrature.
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace hipr::test {

class SphereGrid {
public:
    SphereGrid(int rows, int columns, int fine);

    int bins() const { return _rows * _columns; }
    size_t binOf(const glm::vec3& direction) const;
    size_t binOfPoint(size_t point) const { return point / size_t(_fine * _fine); }
    const std::vector<glm::vec3>& points() const { return _points; }
    /// Solid angle that a point stands for.
    double area(size_t point) const { return _areas[point]; }

private:
    int _rows, _columns, _fine;
    std::vector<glm::vec3> _points;
    std::vector<double> _areas;
};

/// A direction by the cosine of its polar angle and its azimuth.
glm::vec3 direction(double cosine, double azimuth);

} // namespace hipr::test
