/// @file vdb_kit.h
/// OpenVDB files for tests, written by OpenVDB itself.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace hipr::test {

/// A grid with values at the points lo..hi of its lattice.
struct VdbGrid {
    enum class Kind { Float, Half, Double, Int, Bool, Vec3, LevelSet, Frustum, Mask };

    std::string name = "density";
    Kind kind = Kind::Float;
    glm::ivec3 lo{0}, hi{7};
    std::function<double(glm::ivec3)> value = [](glm::ivec3) { return 1.0; }; ///< of triples: the first, then
                                                                              ///< twice and three times it
    glm::dvec3 spacing{0.1}, offset{0.0};
    double degrees = 0.0; ///< turned about y before it is moved
    bool tile = false;    ///< of floats: one value (that at lo) filled in by OpenVDB as it likes best
};

/// Throws what OpenVDB throws.
void writeVdb(const std::string& path, const std::vector<VdbGrid>& grids);

/// Values of the first grid of a file at points of its space, as OpenVDB interpolates them trilinearly.
std::vector<float> sampleVdb(const std::string& path, const std::vector<glm::dvec3>& points);

} // namespace hipr::test
