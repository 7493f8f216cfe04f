/// @file elliptic.h
/// Areas and lengths that are elliptic integrals.
#pragma once

#include <glm/glm.hpp>

namespace hipr {

/// Carlson's complete symmetric integral of the second kind R_G(x, y, z), for finite values from 0 up: B. C.
/// Carlson, "Numerical computation of real or complex elliptic integrals", 1995; DLMF 19.21.10, 19.36(i).
double carlsonRG(double x, double y, double z);

/// Area of the image of the sphere of radius 1 under `m`.
double ellipsoidArea(const glm::dmat3& m);

/// Perimeter of the ellipse a cos(t) + b sin(t).
double ellipsePerimeter(const glm::dvec3& a, const glm::dvec3& b);

} // namespace hipr
