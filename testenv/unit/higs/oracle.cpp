#include "testenv/unit/higs/oracle.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/quaternion.hpp>

namespace hipr::test {
namespace {

using Row2 = glm::dmat3x2; ///< two rows, three columns

/// A splat projected orthogonally onto the plane through d to which d is normal, the camera at the origin;
/// d and e span world space.
struct Tangent {
    glm::dvec3 d, e[2];
    glm::dmat2 covariance;
};

struct Shown {
    glm::dvec2 mean;
    glm::dmat2 covariance, inverse;
    double opacity, depth;
    glm::dvec3 color;
    glm::dvec3 relative;     ///< world space, from the camera
    glm::dmat3 worldInverse; ///< of the covariance
    std::optional<Tangent> exact;
    int cloud;
    uint32_t splat;
};

/// P_l^m with the Condon-Shortley phase, by its definition's recurrences.
double legendre(int l, int m, double x) {
    double pmm = 1;
    for (int i = 1; i <= m; ++i)
        pmm *= -(2.0 * i - 1) * std::sqrt(1 - x * x);
    if (l == m) return pmm;
    double previous = pmm, p = x * (2.0 * m + 1) * pmm;
    for (int n = m + 2; n <= l; ++n) {
        const double next = ((2.0 * n - 1) * x * p - (n + m - 1.0) * previous) / (n - m);
        previous = p;
        p = next;
    }
    return p;
}

double harmonic(int l, int m, const glm::dvec3& d) {
    const int a = std::abs(m);
    const double phi = std::atan2(d.y, d.x);
    const double k =
        std::sqrt((2.0 * l + 1) / (4 * glm::pi<double>()) * std::tgamma(l - a + 1) / std::tgamma(l + a + 1));
    const double p = k * legendre(l, a, glm::clamp(d.z, -1.0, 1.0));
    return m == 0 ? p : std::sqrt(2.0) * p * (m > 0 ? std::cos(a * phi) : std::sin(a * phi));
}

glm::dvec3 colorOf(const SplatCloud& cloud, size_t i, const glm::dvec3& d) {
    if (cloud.coefficients.empty()) return glm::dvec3(0.5);
    glm::dvec3 color(0.5);
    const size_t count = shCoefficients(cloud.shDegree);
    for (int l = 0; l <= int(cloud.shDegree); ++l)
        for (int m = -l; m <= l; ++m)
            color += harmonic(l, m, d) * glm::dvec3(cloud.coefficients[i * count + size_t(l * (l + 1) + m)]);
    return glm::max(color, 0.0);
}

glm::dmat3 covarianceOf(const SplatCloud& cloud, size_t i, double leastShare) {
    const glm::dquat q = cloud.orientations.empty() ? glm::dquat(1, 0, 0, 0)
                                                    : glm::normalize(glm::dquat(cloud.orientations[i]));
    glm::dvec3 s = cloud.scales.empty() ? glm::dvec3(1) : glm::dvec3(cloud.scales[i]);
    s = glm::sqrt(s * s + leastShare * glm::dot(s, s));
    const glm::dmat3 r = glm::mat3_cast(q);
    return r * glm::dmat3(s.x * s.x, 0, 0, 0, s.y * s.y, 0, 0, 0, s.z * s.z) * glm::transpose(r);
}

bool isParallel(const CameraDesc& camera) {
    return camera.projection[2][3] == 0.0;
}

/// Where a point of view space is seen, and the gradient of that.
void seePoint(const SplatScene& scene, const glm::dvec3& v, bool clamped, glm::dvec2* mean, Row2* gradient) {
    const glm::dmat4& p = scene.camera.projection;
    const glm::dvec2 half(0.5 * scene.width, 0.5 * scene.height);
    const double w = isParallel(scene.camera) ? 1.0 : -v.z;
    const glm::dvec2 ndc = isParallel(scene.camera)
                               ? glm::dvec2(p[0][0] * v.x + p[3][0], p[1][1] * v.y + p[3][1])
                               : glm::dvec2(p[0][0] * v.x, p[1][1] * v.y) / w - glm::dvec2(p[2][0], p[2][1]);
    *mean = half * (ndc + 1.0);
    *gradient = Row2(0.0);
    (*gradient)[0][0] = half.x * p[0][0] / w;
    (*gradient)[1][1] = half.y * p[1][1] / w;
    if (isParallel(scene.camera)) return;
    const glm::dvec2 at = clamped ? glm::clamp(ndc, -1.3, 1.3) : ndc;
    (*gradient)[2][0] = half.x * (at.x + p[2][0]) / w;
    (*gradient)[2][1] = half.y * (at.y + p[2][1]) / w;
}

Tangent tangentOf(const glm::dvec3& relative, const glm::dmat3& covariance) {
    Tangent t;
    t.d = glm::normalize(relative);
    t.e[0] =
        glm::normalize(glm::cross(t.d, std::abs(t.d.y) < 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
    t.e[1] = glm::cross(t.d, t.e[0]);
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            t.covariance[i][j] = glm::dot(t.e[i], covariance * t.e[j]) / glm::dot(relative, relative);
    return t;
}

/// Directions of world space to homogeneous pixels.
glm::dmat3 directionsToPixels(const SplatScene& scene) {
    const glm::dmat4 clip = scene.camera.projection * scene.camera.worldToView;
    glm::dmat3 h;
    for (int c = 0; c < 3; ++c)
        h[c] = {0.5 * scene.width * (clip[c].x + clip[c].w), 0.5 * scene.height * (clip[c].y + clip[c].w),
                clip[c].w};
    return h;
}

/// The Gaussian one of whose ellipses is the picture of one on the tangent plane: by the dual conic of that,
/// whose tangents are the lines l with l^T conic l = 0.
void seeTangent(const SplatScene& scene, const Tangent& t, glm::dvec2* mean, glm::dmat2* covariance) {
    const glm::dmat3 h = directionsToPixels(scene);
    const glm::dvec3 centre = h * t.d, a = h * t.e[0], b = h * t.e[1];
    const glm::dmat3 ellipse = t.covariance[0][0] * glm::outerProduct(a, a) +
                               t.covariance[1][1] * glm::outerProduct(b, b) +
                               t.covariance[0][1] * (glm::outerProduct(a, b) + glm::outerProduct(b, a));
    const double contour = std::min(2.0, 0.5 * centre.z * centre.z / ellipse[2][2]);
    const glm::dmat3 conic = (contour * ellipse - glm::outerProduct(centre, centre)) * -1.0;
    *mean = glm::dvec2(conic[2]) / conic[2][2];
    *covariance = (glm::outerProduct(*mean, *mean) - glm::dmat2(conic) / conic[2][2]) * (1.0 / contour);
}

/// False when the splat is not seen at all.
bool show(const SplatScene& scene, size_t cloudIndex, size_t i, Shown* s) {
    const SplatCloud& cloud = scene.clouds[cloudIndex];
    const glm::dmat4 toWorld = scene.transform(cloudIndex), toView = scene.camera.worldToView * toWorld;
    const glm::dvec4 position(glm::dvec3(cloud.positions[i]), 1);
    const glm::dvec3 view = toView * position;
    const auto record = cameraRecord(scene.camera);
    s->opacity = cloud.opacities.empty() ? 1.0 : std::min(1.0, double(cloud.opacities[i]));
    const glm::dmat4 viewToWorld = glm::inverse(scene.camera.worldToView);
    const bool parallel = isParallel(scene.camera);
    const glm::dvec3 origin = parallel ? glm::dvec3(record->origin) : glm::dvec3(viewToWorld[3]);
    s->relative = glm::dvec3(toWorld * position) - origin;
    s->depth = glm::dot(glm::dvec3(record->forward), s->relative);
    if (s->opacity < 1.0 / 255 || s->depth < record->nearDepth || s->depth > record->farDepth) return false;
    if (!parallel && !(view.z < 0)) return false;

    Row2 gradient;
    seePoint(scene, view, cloud.projection == SplatProjection::Perspective, &s->mean, &gradient);
    const glm::dmat3 linear(toView), worldLinear(toWorld);
    const glm::dmat3 covariance = linear * covarianceOf(cloud, i, 0) * glm::transpose(linear);
    glm::dmat2 sharp = gradient * covariance * glm::transpose(gradient);
    if (cloud.projection == SplatProjection::Tangential && !parallel) {
        const glm::dmat3 world = worldLinear * covarianceOf(cloud, i, 0) * glm::transpose(worldLinear);
        const Tangent tangent = tangentOf(s->relative, world);
        seeTangent(scene, tangent, &s->mean, &sharp);
        if (scene.exactTangents) s->exact = tangent;
    }
    const double dilation = scene.antialiased ? 0.1 : 0.3;
    s->covariance = sharp + glm::dmat2(dilation);
    s->inverse = glm::inverse(s->covariance);
    if (scene.antialiased)
        s->opacity *= std::sqrt(std::max(glm::determinant(sharp), 0.0) / glm::determinant(s->covariance));
    s->worldInverse = glm::inverse(worldLinear * covarianceOf(cloud, i, 1e-6) * glm::transpose(worldLinear));
    const glm::dvec3 direction = parallel ? glm::dvec3(record->direction) : s->relative;
    s->color = colorOf(cloud, i, glm::normalize(glm::inverse(worldLinear) * direction));
    s->cloud = int(cloudIndex);
    s->splat = uint32_t(i);
    return s->opacity >= 1.0 / 255;
}

SplatSorting sortingOf(const SplatScene& scene) {
    SplatSorting sorting = SplatSorting::ZDepth;
    for (const SplatCloud& cloud : scene.clouds)
        sorting = std::max(sorting, cloud.sorting);
    return sorting;
}

/// By what a splat is ordered in the list of the tile whose middle is at `pixel`.
double keyOf(const SplatScene& scene, const Shown& s, const glm::dvec2& pixel) {
    const SplatSorting sorting = sortingOf(scene);
    const auto record = cameraRecord(scene.camera);
    if (sorting == SplatSorting::ZDepth) return s.depth;
    if (sorting == SplatSorting::CameraDistance)
        return isParallel(scene.camera) ? s.depth : glm::length(s.relative);
    const glm::dvec2 ndc = 2.0 * pixel / glm::dvec2(scene.width, scene.height) - 1.0;
    const glm::dvec3 d =
        glm::normalize(glm::dvec3(record->direction) + ndc.x * glm::dvec3(record->directionX) +
                       ndc.y * glm::dvec3(record->directionY));
    const glm::dvec3 o = ndc.x * glm::dvec3(record->originX) + ndc.y * glm::dvec3(record->originY);
    const glm::dvec3 m = s.worldInverse * d;
    return std::max(glm::dot(m, s.relative - o) / glm::dot(m, d), 0.0);
}

bool inSquare(const Shown& s, const glm::dvec2& lo, const glm::dvec2& hi) {
    const double mid = 0.5 * (s.covariance[0][0] + s.covariance[1][1]);
    const double longest = mid + std::sqrt(std::max(mid * mid - glm::determinant(s.covariance), 0.0));
    const double radius = std::ceil(3 * std::sqrt(longest));
    return s.mean.x + radius >= lo.x && s.mean.x - radius < hi.x && s.mean.y + radius >= lo.y &&
           s.mean.y - radius < hi.y;
}

/// The squared distance from a splat's centre in standard deviations.
double distanceOf(const SplatScene& scene, const Shown& s, const glm::dvec2& at) {
    const glm::dvec2 d = at - s.mean;
    if (!s.exact) return glm::dot(d, s.inverse * d);
    const glm::dvec3 ray = glm::inverse(directionsToPixels(scene)) * glm::dvec3(at, 1);
    const double along = glm::dot(ray, s.exact->d); // rays point where W is positive
    if (along <= 0) return 1e30;
    const glm::dvec2 u(glm::dot(ray, s.exact->e[0]) / along, glm::dot(ray, s.exact->e[1]) / along);
    return glm::dot(u, glm::inverse(s.exact->covariance) * u);
}

OraclePixel blend(const SplatScene& scene, const std::vector<const Shown*>& ordered, const glm::dvec2& at,
                  double limit) {
    OraclePixel pixel;
    for (const Shown* s : ordered) {
        if (s->depth > limit) continue;
        const double alpha = s->opacity * std::exp(-0.5 * distanceOf(scene, *s, at));
        if (std::abs(alpha * 255 - 1) < 0.01) pixel.flips += pixel.transmittance / 255;
        if (alpha < 1.0 / 255) continue;
        const double after = pixel.transmittance * (1 - alpha);
        pixel.color += alpha * pixel.transmittance * s->color;
        if (std::abs(after - 0.5) < 1e-3) pixel.certain = false;
        if (pixel.transmittance >= 0.5 && after < 0.5) {
            pixel.depth = s->depth;
            pixel.cloud = s->cloud;
            pixel.splat = s->splat;
        }
        pixel.transmittance = after;
    }
    return pixel;
}

std::vector<Shown> allShown(const SplatScene& scene) {
    std::vector<Shown> shown;
    for (size_t c = 0; c < scene.clouds.size(); ++c)
        for (size_t i = 0; i < scene.clouds[c].size(); ++i)
            if (Shown s; show(scene, c, i, &s)) shown.push_back(s);
    return shown;
}

/// Least d^T inverse d over the points of a rectangle: 0, or on an edge, where it is a parabola.
double leastDistance(const Shown& s, const glm::dvec2& lo, const glm::dvec2& hi) {
    const glm::dvec2 a = lo - s.mean, b = hi - s.mean;
    if (a.x <= 0 && b.x >= 0 && a.y <= 0 && b.y >= 0) return 0;
    const glm::dmat2& m = s.inverse;
    double least = 1e300;
    const auto tryPoint = [&](const glm::dvec2& d) { least = std::min(least, glm::dot(d, m * d)); };
    for (const double x : {a.x, b.x})
        tryPoint({x, glm::clamp(-m[0][1] * x / m[1][1], a.y, b.y)});
    for (const double y : {a.y, b.y})
        tryPoint({glm::clamp(-m[0][1] * y / m[0][0], a.x, b.x), y});
    return least;
}

} // namespace

size_t oraclePairs(const SplatScene& scene, glm::uvec2 tile, bool boxes) {
    size_t pairs = 0;
    for (const Shown& s : allShown(scene)) {
        const double reach = 2 * std::log(255 * s.opacity);
        if (leastDistance(s, {0, 0}, {scene.width, scene.height}) > reach) continue; // not in the picture
        for (uint32_t y = 0; y < scene.height; y += tile.y)
            for (uint32_t x = 0; x < scene.width; x += tile.x) {
                const glm::dvec2 lo(x, y), hi = lo + glm::dvec2(tile);
                pairs += boxes ? inSquare(s, lo, hi) : leastDistance(s, lo, hi) <= reach;
            }
    }
    return pairs;
}

std::vector<OraclePixel> oraclePicture(const SplatScene& scene, glm::uvec2 tile, bool boxes) {
    const std::vector<Shown> shown = allShown(scene);
    std::vector<OraclePixel> picture(size_t(scene.width) * scene.height);
    for (uint32_t ty = 0; ty < scene.height; ty += tile.y)
        for (uint32_t tx = 0; tx < scene.width; tx += tile.x) {
            const glm::dvec2 lo(tx, ty), hi = lo + glm::dvec2(tile);
            std::vector<std::pair<double, const Shown*>> keyed;
            for (const Shown& s : shown)
                if (!boxes || inSquare(s, lo, hi)) keyed.emplace_back(keyOf(scene, s, 0.5 * (lo + hi)), &s);
            std::stable_sort(keyed.begin(), keyed.end(),
                             [](const auto& a, const auto& b) { return a.first < b.first; });
            std::vector<const Shown*> ordered;
            for (const auto& [key, s] : keyed)
                ordered.push_back(s);
            for (uint32_t y = ty; y < std::min(ty + tile.y, scene.height); ++y)
                for (uint32_t x = tx; x < std::min(tx + tile.x, scene.width); ++x) {
                    const size_t at = size_t(y) * scene.width + x;
                    const double limit =
                        scene.limits.empty() || scene.limits[at] == 0.f ? 1e30 : double(scene.limits[at]);
                    picture[at] = blend(scene, ordered, {x + 0.5, y + 0.5}, limit);
                }
        }
    return picture;
}

} // namespace hipr::test
