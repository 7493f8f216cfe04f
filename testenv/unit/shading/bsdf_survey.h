/// @file bsdf_survey.h
/// Everything the tests want to know about one surface seen from one direction.
#pragma once

#include "testenv/unit/shading/bsdf_kernel.h"
#include "testenv/unit/shading/sphere_grid.h"

namespace hipr::test {

struct Survey {
    double pdfIntegral = 0, acceptedPart = 0, largestPdf = 0;
    glm::dvec3 albedo{0.0}, sampledAlbedo{0.0}, weightSquares{0.0};
    double probability = 0; ///< of the chi-square test
    double worstMismatch = 0;
    size_t samples = 0;
    bool finite = true;
};

/// By quadrature over the sphere and by as many samples.
Survey survey(const SurfaceParameters& parameters, const glm::vec3& wo);

/// The directional albedo by `samples` samples.
glm::dvec3 sampledAlbedo(const SurfaceParameters& parameters, const glm::vec3& wo, size_t samples);

/// Expects that samples are distributed as their density says, and agree with evaluation.
void expectSamplesFollowThePdf(const NamedSurface& surface, double cosine);

/// Expects f(a, b) = f(b, a) for reflection.
void expectReciprocalReflection(const NamedSurface& surface);

/// The same for light refracted into an object of index `eta` and out of it. In basic radiance it is f over
/// eta^2 of the side the light is on that is reciprocal (Walter, section 5.1 and E. Veach's thesis,
/// section 5.2).
void expectReciprocalRefraction(const SurfaceParameters& glass, double eta);

} // namespace hipr::test
