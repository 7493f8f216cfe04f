/// @file scene_kit.h
/// Small scenes and pictures for tests, through the public API.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/trace/renderer_impl.h"

namespace hipr::test {

/// An AOV of the film, pixel (0, 0) at the bottom left.
template <class T> struct Picture {
    uint32_t width = 0, height = 0;
    std::vector<T> values;
    const T& at(uint32_t x, uint32_t y) const { return values.at(x + y * width); }
};
using ColorPicture = Picture<glm::vec4>;

struct Message {
    Severity severity;
    std::string subject, text;
};

/// Two triangles in the xy plane, [-0.5, 0.5]^2, facing +z.
std::shared_ptr<const TriangleMesh> quadMesh(std::vector<TrianglePrimvar> primvars = {});
/// A latitude-longitude sphere of radius 1 with smooth normals, facing outwards.
std::shared_ptr<const TriangleMesh> sphereMesh(uint32_t rings = 32);

MaterialInput constantColor(glm::vec3 color);
MaterialInput constantValue(float value);
/// Reflects `color` in all directions alike: no specular lobe.
MaterialDesc matte(glm::vec3 color);
/// Reflects 90 % of the light, perfectly smooth.
MaterialDesc mirror();

/// A dome, equally bright all around.
LightDesc skyLight(float intensity = 1.f);
/// A square light that shines straight down.
LightDesc lampAbove(glm::dvec3 at, float size, float intensity);

/// The default ones, but for the number of samples.
Settings withSamples(int samples);
/// Each pixel has what lies in it and nothing else.
Settings boxFiltered(int samples, const std::string& mode = "delta");
/// Tiles of 8 pixels, of which even small pictures have many.
Settings smallTiles(const std::string& mode, int samples = 3);

/// Seen from `eye` towards `target`, y up.
CameraDesc lookAt(glm::dvec3 eye, glm::dvec3 target, double verticalDegrees = 40, double aspect = 1);
glm::mat4x3 translation(float x, float y, float z);
glm::mat4x3 scaling(float x, float y, float z);
/// The same, moved there.
glm::mat4x3 placed(glm::mat4x3 m, float x, float y, float z);

/// A renderer with a scene, and everything it said.
class Stage {
public:
    explicit Stage(Settings settings = {}, RendererInternals internals = {});
    ~Stage(); ///< expects the validation layer to have been silent, if it was there

    /// `desc`: what else there is to say of the object.
    ObjectId add(std::shared_ptr<const TriangleMesh> mesh, MaterialDesc material,
                 std::vector<glm::mat4x3> transforms = {glm::mat4x3(1.f)}, ObjectDesc desc = {});
    LightId add(LightDesc light);
    void film(uint32_t width, uint32_t height, std::vector<AovRequest> aovs = {{AovKind::Color, {}}});
    void settings(const Settings& settings);

    /// Commits `edit` and renders to the last sample.
    void render();
    ColorPicture color();
    template <class T> Picture<T> read(AovKind kind, const std::string& primvar = "") {
        Picture<T> picture{_film.width, _film.height, std::vector<T>(size_t(_film.width) * _film.height)};
        const bool found = renderer->readAov({kind, primvar}, picture.values.data(),
                                             picture.values.size() * sizeof(T) / sizeof(float));
        if (!found) picture.values.clear();
        return picture;
    }

    std::vector<Message> messages();

    std::unique_ptr<RendererImpl> renderer;
    SceneEdit edit;

private:
    FilmDesc _film;
    std::mutex _mutex;
    std::vector<Message> _messages;
};

/// A matte square of 9 by 9 at y = -1, facing up.
void addFloor(Stage& stage);

/// Whether two pictures are equal to the last bit.
bool sameBits(const ColorPicture& a, const ColorPicture& b);
/// Mean of all pixels.
glm::vec4 mean(const ColorPicture& picture);
/// Writes a PPM with the sRGB curve into $HIPR_TEST_OUT, if set, to look at.
void save(const ColorPicture& picture, const std::string& name);

} // namespace hipr::test
