#include "renderer/scene/mesh_lights.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "renderer/shading/light_shape.h"

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

bool ObjectTable::anyLights() const {
    return std::any_of(_entries.begin(), _entries.end(),
                       [](const auto& entry) { return entry.second.desc && entry.second.desc->light; });
}

void ObjectTable::profilesChanged(ChangedSet& changed) {
    for (const auto& [id, entry] : _entries)
        if (entry.desc && entry.desc->light && !entry.desc->light->shaping.iesFile.empty())
            note(changed, id, entry, Change::Emission);
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

void MeshLights::spread(Entry& entry, const ObjectTable::Emitter& emitter, const Geometry& geometry,
                        const MaterialTable& materials) {
    std::vector<float> luminances;
    for (uint32_t slot = 0; slot < geometry.slotCount && slot < emitter.desc->materials.size(); ++slot)
        luminances.push_back(materials.emittedLuminance(emitter.desc->materials[slot]));
    if (entry.mesh == geometry.mesh && entry.luminances == luminances) return;
    entry.mesh = geometry.mesh;
    entry.spread = spreadOverTriangles(*geometry.mesh, luminances);
    entry.luminances = std::move(luminances);
    entry.sums = Buffer();
    if (entry.spread.weight > 0.0)
        entry.sums = _device.createFrom(entry.spread.sums.data(), entry.spread.sums.size(), "light tables");
    entry.spread.sums = {};
}

/// What an object's light asks for, but for what cannot be, which is told.
void MeshLights::readLight(Entry& entry, const ObjectDesc& object, bool moves) {
    if (sameLight(entry.asked, object.light) && entry.moves == moves) return;
    entry.asked = entry.light = object.light;
    entry.moves = moves;
    const char* problem = nullptr;
    if (entry.asked && !hasFiniteNumbers(*entry.asked)) {
        problem = "a value of its light is not finite; it shines as its material says";
        entry.light = nullptr;
    } else if (entry.asked && moves) {
        SurfaceLight found = *entry.asked; // what rays that meet it by chance can follow
        found.diffuse = found.specular = 1.f;
        found.shadow = {};
        found.shadowLink.clear();
        if (found == *entry.asked) return;
        problem = "it moves while the shutter is open: its light's diffuse and specular multipliers, shadows "
                  "and shadow linking have no effect";
        entry.light = std::make_shared<const SurfaceLight>(std::move(found));
    }
    if (problem) _device.messages()(Severity::Warning, object.name, problem);
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
        const bool moves = objects.records()[emitter.first].keyCount > 0 || geometry.keys > 1;
        Entry& entry = _entries[emitter.id];
        entry.used = true;
        readLight(entry, *emitter.desc, moves);
        if (moves && !entry.light) continue;
        spread(entry, emitter, geometry, *materials);
        if (!(entry.spread.weight > 0.0)) continue;
        for (uint32_t i = emitter.first; i < emitter.first + emitter.count; ++i)
            _lights.push_back(lightOf(entry, *emitter.desc, i, objects.records()[i].objectToWorld));
    }
    for (auto it = _entries.begin(); it != _entries.end();)
        it = it->second.used ? std::next(it) : _entries.erase(it);
}

MeshLight MeshLights::lightOf(const Entry& entry, const ObjectDesc& object, uint32_t instance,
                              const glm::mat4x3& objectToWorld) {
    MeshLight light;
    light.instance = instance;
    if (!entry.moves) {
        light.triangleCount = uint32_t(entry.mesh->triangles.size());
        light.distribution = entry.sums.address();
    }
    const WorldBox box = transformed(entry.spread.box, objectToWorld);
    light.bounds.lo = box.min, light.bounds.hi = box.max;
    light.bounds.spread = glm::pi<double>(); // both sides emit
    light.bounds.emission = glm::half_pi<double>();
    light.bounds.power = glm::two_pi<double>() * entry.spread.worldWeight(objectToWorld);
    if (entry.light) {
        light.light = entry.light;
        light.name = object.name;
        light.objectToWorld = objectToWorld;
    }
    return light;
}

} // namespace hipr
