// Writes the .vdb files of testenv/scenes/volumes.usda: a cloud, and a fire with its smoke.
//     hipr-make-volumes FOLDER
#include <cmath>
#include <cstdio>
#include <exception>

#include "testenv/common/vdb_kit.h"

using hipr::test::VdbGrid;

namespace {

double lattice(int x, int y, int z) {
    uint32_t h = uint32_t(x) * 0x8da6b343u ^ uint32_t(y) * 0xd8163841u ^ uint32_t(z) * 0xcb1ab31fu;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return double(h ^ h >> 15) / 4294967295.0;
}

/// Smooth noise in 0..1.
double noise(const glm::dvec3& p) {
    const glm::dvec3 base = glm::floor(p), f = p - base, w = f * f * (3.0 - 2.0 * f);
    const glm::ivec3 c(base);
    double sum = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::ivec3 o(i & 1, i >> 1 & 1, i >> 2);
        const glm::dvec3 m = glm::mix(1.0 - w, w, glm::dvec3(o));
        sum += m.x * m.y * m.z * lattice(c.x + o.x, c.y + o.y, c.z + o.z);
    }
    return sum;
}

double turbulence(glm::dvec3 p) {
    double sum = 0;
    for (double weight = 0.5; weight > 0.02; weight *= 0.5, p = p * 2.03 + 17.0)
        sum += weight * noise(p);
    return sum;
}

constexpr double Spacing = 0.03;

/// Balls that stand for the billows of a cloud, eaten away by noise.
double cloud(glm::ivec3 at) {
    const glm::dvec3 p = glm::dvec3(at) * Spacing;
    const glm::dvec4 balls[] = {{0, 0, 0, 0.75},
                                {0.75, -0.1, 0.1, 0.55},
                                {-0.75, -0.12, 0, 0.5},
                                {0.25, 0.42, -0.1, 0.5},
                                {-0.3, 0.28, 0.2, 0.45}};
    double inside = -1;
    for (const glm::dvec4& ball : balls)
        inside = std::max(inside, ball.w - glm::length(p - glm::dvec3(ball)));
    return 12.0 * glm::clamp(4.0 * (inside + 0.55 * (turbulence(p * 3.1 + 5.0) - 0.55)), 0.0, 1.0);
}

/// A column of fire that narrows as it rises: 1 in its middle, 0 outside.
double flame(const glm::dvec3& p) {
    const double rise = p.y / 1.8;
    const glm::dvec3 q =
        p + 0.35 * rise * (glm::dvec3(turbulence(p * 2.3 + 3.0), 0.5, turbulence(p * 2.3 + 40.0)) - 0.5);
    const double width = 0.42 * (1 - 0.75 * rise) * (rise < 0.1 ? 0.6 + 4 * rise : 1.0);
    const double inside = 1 - std::hypot(q.x, q.z) / std::max(width, 1e-3);
    return glm::clamp(inside + 0.9 * (turbulence(glm::dvec3(p.x, p.y * 0.55, p.z) * 4.2) - 0.5), 0.0, 1.0) *
           glm::clamp(6 * (1 - rise), 0.0, 1.0);
}

VdbGrid grid(const char* name, glm::ivec3 lo, glm::ivec3 hi, std::function<double(glm::ivec3)> value) {
    VdbGrid made;
    made.name = name;
    made.kind = VdbGrid::Kind::Half;
    made.lo = lo;
    made.hi = hi;
    made.value = std::move(value);
    made.spacing = glm::dvec3(Spacing);
    return made;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: hipr-make-volumes FOLDER\n");
        return 2;
    }
    try {
        const std::string folder = argv[1];
        hipr::test::writeVdb(folder + "/cloud.vdb", {grid("density", {-48, -32, -30}, {48, 36, 32}, cloud)});
        const glm::ivec3 lo(-20, 0, -20), hi(20, 62, 20);
        hipr::test::writeVdb(
            folder + "/fire.vdb",
            {grid("density", lo, hi, [](glm::ivec3 p) { return 1.5 * flame(glm::dvec3(p) * Spacing); }),
             grid("temperature", lo, hi, [](glm::ivec3 p) {
                 const double f = flame(glm::dvec3(p) * Spacing);
                 return f > 0 ? 900 + 1700 * std::sqrt(f) : 0.0;
             })});
    } catch (const std::exception& e) {
        std::fprintf(stderr, "hipr-make-volumes: %s\n", e.what());
        return 1;
    }
    return 0;
}
