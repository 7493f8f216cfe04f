#include "renderer/scene/culling.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include "shaders/shared/scene.h"

namespace hipr {

uint32_t cullFlags(CullStyle style, bool doubleSided) {
    if (style == CullStyle::BackUnlessDoubleSided && !doubleSided) style = CullStyle::Back;
    if (style == CullStyle::FrontUnlessDoubleSided && !doubleSided) style = CullStyle::Front;
    if (style == CullStyle::Back) return gpu::INSTANCE_CULL_BACK;
    return style == CullStyle::Front ? gpu::INSTANCE_CULL_FRONT : 0;
}

/// Faces are compared, not triangles: the two sides of a square may have other diagonals.
bool hasFacesBackToBack(const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) return false;
    std::map<std::array<float, 3>, uint32_t> places;
    std::vector<uint32_t> place;
    for (const glm::vec3& p : mesh.positions)
        place.push_back(places.try_emplace({p.x, p.y, p.z}, uint32_t(places.size())).first->second);
    std::map<uint32_t, std::set<uint32_t>> faces;
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
        for (int corner = 0; corner < 3; ++corner)
            faces[mesh.triangleFace[i]].insert(place[mesh.triangles[i][corner]]);
    std::set<std::set<uint32_t>> seen;
    return std::any_of(faces.begin(), faces.end(),
                       [&](const auto& face) { return !seen.insert(face.second).second; });
}

} // namespace hipr
