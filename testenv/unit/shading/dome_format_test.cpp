// Pictures of an environment in each projection, made pixel by pixel from a function of direction, must show
// that function.
#include <cmath>
#include <functional>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "testenv/unit/shading/light_kernel.h"
#include "testenv/unit/shading/picture.h"
#include "testenv/unit/shading/sphere_grid.h"

namespace hipr::test {
namespace {

constexpr double Pi = 3.14159265358979323846;

glm::dvec3 sky(const glm::dvec3& d) {
    return 1.0 + 0.8 * d;
}

/// `direction`: of a pixel, by place in [-1, 1], x to the right and y up; 0 where the picture shows nothing.
Bytes draw(int width, int height, const std::function<glm::dvec3(double, double)>& direction) {
    std::vector<float> rgb;
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const glm::dvec3 d =
                direction(2.0 * (column + 0.5) / width - 1.0, 1.0 - 2.0 * (row + 0.5) / height);
            for (int c = 0; c < 3; ++c)
                rgb.push_back(d == glm::dvec3(0.0) ? 0.f : float(sky(d)[c]));
        }
    return encodeFloat("exr", width, height, 3, rgb);
}

/// What an orthographic camera at +Z sees in a ball of radius 1.
glm::dvec3 inBall(double x, double y) {
    const double squared = x * x + y * y;
    if (squared >= 1.0) return {0, 0, -1};
    const glm::dvec3 n(x, y, std::sqrt(1.0 - squared)), toCamera(0, 0, 1);
    return 2.0 * glm::dot(n, toCamera) * n - toCamera;
}

glm::dvec3 angular(double x, double y) {
    const double r = std::hypot(x, y), off = std::min(r, 1.0) * Pi;
    return {std::sin(off) * x / r, std::sin(off) * y / r, std::cos(off)};
}

/// Faces by where their middle looks, and what is to the right and up there.
glm::dvec3 inCross(double x, double y) {
    struct Face {
        int column, row;
        glm::dvec3 middle, right, up;
    };
    static const Face faces[] = {
        {1, 1, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},  {0, 1, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
        {2, 1, {-1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {1, 0, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}},
        {1, 2, {0, -1, 0}, {-1, 0, 0}, {0, 0, 1}}, {1, 3, {0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}};
    const double column = 1.5 * (x + 1.0), row = 2.0 * (1.0 - y);
    for (const Face& face : faces) {
        const double s = 2.0 * (column - face.column) - 1.0, t = 1.0 - 2.0 * (row - face.row);
        if (std::abs(s) <= 1.0 && std::abs(t) <= 1.0)
            return glm::normalize(face.middle + s * face.right + t * face.up);
    }
    return glm::dvec3(0.0);
}

/// `behind`: directions with a smaller z are not compared; a ball shows them at its rim, in few pixels.
void expectSky(DomeFormat format, const Bytes& picture, double behind) {
    LightDesc dome;
    dome.name = "/dome";
    dome.kind = LightKind::Dome;
    dome.texture = "sky.exr";
    dome.domeFormat = format;
    dome.transform = glm::rotate(glm::dmat4(1.0), 0.8, glm::normalize(glm::dvec3(1, 2, 0.5)));
    const LitScene scene({dome}, {{"sky.exr", picture}});
    const SphereGrid grid(8, 16, 8);
    const std::vector<LightOutcome> outcomes =
        scene.run(glm::vec3(0.f), glm::vec3(0, 0, 1), grid.points().size(), grid.points());
    size_t compared = 0;
    for (size_t i = 0; i < outcomes.size(); ++i) {
        const glm::dvec3 local = glm::transpose(glm::dmat3(dome.transform)) * glm::dvec3(grid.points()[i]);
        if (local.z < behind) continue;
        ++compared;
        const glm::dvec3 truth = sky(local);
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(double(outcomes[i].seen[c]), truth[c], 0.02)
                << local.x << ' ' << local.y << ' ' << local.z;
    }
    EXPECT_GT(compared, outcomes.size() / 2);
}

TEST(DomeFormats, MirroredBall) {
    expectSky(DomeFormat::MirroredBall, draw(512, 512, inBall), -0.9);
}

TEST(DomeFormats, Angular) {
    expectSky(DomeFormat::Angular, draw(512, 512, angular), -0.99);
}

TEST(DomeFormats, CubeMapVerticalCross) {
    expectSky(DomeFormat::CubeMapVerticalCross, draw(192, 256, inCross), -1.0);
}

TEST(DomeFormats, OfOneFileAreLoadedEachForItself) {
    LightDesc ball, latLong;
    ball.name = "/a", latLong.name = "/b";
    ball.kind = latLong.kind = LightKind::Dome;
    ball.texture = latLong.texture = "sky.exr";
    ball.domeFormat = DomeFormat::MirroredBall;
    const LitScene scene({ball, latLong}, {{"sky.exr", draw(256, 256, inBall)}});
    const glm::vec3 back(0.f, 0.f, 1.f);
    // The ball's centre shows +Z; so does the centre of the picture taken as latitude-longitude.
    EXPECT_NEAR(scene.run(glm::vec3(0.f), back, 1, {back})[0].seen.z, 3.6f, 0.05f);
}

} // namespace
} // namespace hipr::test
