#include "renderer/scene/mesh_lights.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace hipr {
namespace {

/// The box of a box under an affine map.
WorldBox transformed(const WorldBox& box, const glm::mat4x3& m) {
    const glm::vec3 half = 0.5f * (box.max - box.min);
    const glm::vec3 centre = m * glm::vec4(box.min + half, 1.f);
    const glm::vec3 h = glm::abs(m[0]) * half.x + glm::abs(m[1]) * half.y + glm::abs(m[2]) * half.z;
    const glm::vec3 slack = 1e-5f * (glm::abs(centre) + h); // for rounding
    return {centre - h - slack, centre + h + slack};
}

} // namespace

std::vector<ObjectTable::Emitter> ObjectTable::emitters(const MaterialTable& materials) const {
    std::vector<Emitter> emitters;
    if (!materials.anyEmissive()) return emitters;
    for (const ObjectId id : _order) {
        const Entry& entry = _entries.at(id);
        if (entry.placed.count == 0) continue;
        const std::vector<MaterialId>& slots = entry.desc->materials;
        const auto end = slots.begin() + long(std::min<size_t>(slots.size(), entry.placed.materialCount));
        if (std::any_of(slots.begin(), end, [&](MaterialId m) { return materials.emissive(m); }))
            emitters.push_back({id, &*entry.desc, entry.placed.first, entry.placed.count});
    }
    return emitters;
}

double TriangleSpread::worldWeight(const glm::mat4x3& objectToWorld) const {
    // Area vectors go by the cofactors of the linear part.
    const glm::dmat3 m(objectToWorld);
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const glm::dmat3 squares = cofactors * directions * glm::transpose(cofactors);
    return std::sqrt(weight * (squares[0][0] + squares[1][1] + squares[2][2]));
}

TriangleSpread spreadOverTriangles(const TriangleMesh& mesh, const std::vector<float>& luminances) {
    TriangleSpread spread;
    std::vector<double> weights(mesh.triangles.size(), 0.0);
    for (size_t i = 0; i < weights.size(); ++i) {
        const size_t slot = mesh.triangleSlot.empty() ? 0 : mesh.triangleSlot[i];
        if (slot >= luminances.size() || !(luminances[slot] > 0.f)) continue;
        const glm::uvec3& t = mesh.triangles[i];
        const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
        const glm::dvec3 normal = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
        const double doubled = glm::length(normal);
        if (!(doubled > 0.0) || !std::isfinite(doubled)) continue;
        weights[i] = 0.5 * doubled * double(luminances[slot]);
        spread.weight += weights[i];
        const glm::dvec3 n = normal / doubled;
        spread.directions += glm::outerProduct(n, n) * weights[i];
        spread.box.add({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))});
    }
    if (!(spread.weight > 0.0) || !std::isfinite(spread.weight)) return {};
    spread.sums.reserve(weights.size() + 1);
    spread.sums.push_back(0.f);
    double sum = 0.0;
    for (const double w : weights)
        spread.sums.push_back(float(std::min((sum += w) / spread.weight, 1.0)));
    // The last one that emits ends at 1, and so do those behind it.
    for (size_t i = weights.size(); i > 0; --i) {
        spread.sums[i] = 1.f;
        if (weights[i - 1] > 0.0) break;
    }
    return spread;
}

MeshLights::Entry& MeshLights::entryOf(const ObjectTable::Emitter& emitter, const Geometry& geometry,
                                       const MaterialTable& materials) {
    std::vector<float> luminances;
    for (uint32_t slot = 0; slot < geometry.slotCount && slot < emitter.desc->materials.size(); ++slot)
        luminances.push_back(materials.emittedLuminance(emitter.desc->materials[slot]));
    Entry& entry = _entries[emitter.id];
    entry.used = true;
    if (entry.mesh == geometry.mesh && entry.luminances == luminances) return entry;
    TriangleSpread spread = spreadOverTriangles(*geometry.mesh, luminances);
    Buffer sums;
    if (spread.weight > 0.0)
        sums = _device.createFrom(spread.sums.data(), spread.sums.size(), "light tables");
    spread.sums = {};
    entry = {geometry.mesh, std::move(luminances), std::move(spread), std::move(sums), true};
    return entry;
}

void MeshLights::commit(const ObjectTable& objects, const GeometryTable& geometries,
                        const MaterialTable* materials) {
    _lights.clear();
    for (auto& [id, entry] : _entries)
        entry.used = false;
    const std::vector<ObjectTable::Emitter> emitters =
        materials ? objects.emitters(*materials) : std::vector<ObjectTable::Emitter>();
    for (const ObjectTable::Emitter& emitter : emitters) {
        const Geometry& geometry = *geometries.find(emitter.desc->geometry);
        // What moves while the shutter is open is nowhere long enough to be aimed at: rays find it by chance.
        if (objects.records()[emitter.first].keyCount > 0 || geometry.keys > 1) continue;
        const Entry& entry = entryOf(emitter, geometry, *materials);
        if (!(entry.spread.weight > 0.0)) continue;
        for (uint32_t i = emitter.first; i < emitter.first + emitter.count; ++i) {
            const glm::mat4x3& objectToWorld = objects.records()[i].objectToWorld;
            MeshLight light;
            light.instance = i;
            light.triangleCount = uint32_t(entry.mesh->triangles.size());
            light.distribution = entry.sums.address();
            const WorldBox box = transformed(entry.spread.box, objectToWorld);
            light.bounds.lo = box.min, light.bounds.hi = box.max;
            light.bounds.spread = glm::pi<double>(); // both sides emit
            light.bounds.emission = glm::half_pi<double>();
            light.bounds.power = glm::two_pi<double>() * entry.spread.worldWeight(objectToWorld);
            _lights.push_back(light);
        }
    }
    for (auto it = _entries.begin(); it != _entries.end();)
        it = it->second.used ? std::next(it) : _entries.erase(it);
}

} // namespace hipr
