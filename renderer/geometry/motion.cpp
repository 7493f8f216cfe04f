// Shapes of one mesh at several times.
#include "renderer/api/mesh.h"
#include "renderer/geometry/finish.h"

namespace hipr {

std::shared_ptr<const TriangleMesh> withMotion(const TriangleMesh& mesh,
                                               const std::vector<MeshShape>& shapes) {
    auto moving = std::make_shared<TriangleMesh>(mesh);
    moving->motion.clear();
    for (const auto& [time, shape] : shapes) {
        const bool alike = shape->positions.size() == mesh.positions.size() &&
                           shape->triangles.size() == mesh.triangles.size() &&
                           shape->segments == mesh.segments;
        if (!alike) return nullptr;
        // Polygons may be cut otherwise where their corners lie otherwise; then only what is told of vertices
        // fits.
        const bool normalsFit =
            shape->normals.size() == mesh.normals.size() &&
            shape->normalInterpolation == mesh.normalInterpolation &&
            (mesh.normalInterpolation == Interpolation::Vertex || shape->triangles == mesh.triangles);
        moving->motion.push_back({time, shape->positions, normalsFit ? shape->normals : mesh.normals});
        TriangleMesh box;
        box.positions = shape->positions;
        box.triangles = mesh.triangles;
        box.segments = mesh.segments;
        box.radii = mesh.radii;
        geometry::setBounds(box);
        moving->boundsMin = glm::min(moving->boundsMin, box.boundsMin);
        moving->boundsMax = glm::max(moving->boundsMax, box.boundsMax);
    }
    return moving;
}

} // namespace hipr
