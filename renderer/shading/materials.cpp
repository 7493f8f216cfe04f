#include "renderer/shading/materials.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "renderer/api/cryptomatte.h"
#include "renderer/shading/albedo.h"
#include "renderer/shading/material_inputs.h"
#include "renderer/shading/material_traits.h"
#include "renderer/shading/openpbr_albedo.h"
#include "renderer/shading/row_store.h"
#include "renderer/shading/stretched_albedo.h"

namespace hipr {

using gpu::InputNode;
using gpu::MaterialRecord;

namespace {

template <class T> void append(std::vector<char>& bytes, const std::vector<T>& values) {
    const char* data = reinterpret_cast<const char*>(values.data());
    bytes.insert(bytes.end(), data, data + values.size() * sizeof(T));
}

uint64_t rowBytes(const ResolvedMaterial& m) {
    return (m.inputs.size() + m.stepConstants.size()) * sizeof(glm::vec4) +
           m.reads.size() * sizeof(InputNode) + m.steps.size() * sizeof(gpu::GraphStep);
}

/// SCENE_HAS_* of a scene with this material.
uint32_t featuresOf(const ResolvedMaterial& m) {
    const bool graph = std::any_of(m.steps.begin(), m.steps.end(), [](const gpu::GraphStep& step) {
        return (step.code & 0xff) != gpu::GRAPH_READ;
    });
    const bool directions = std::any_of(m.steps.begin(), m.steps.end(), [](const gpu::GraphStep& step) {
        const uint32_t target = step.code >> 16;
        return target >= gpu::INPUT_COAT_NORMAL && target <= gpu::INPUT_COAT_TANGENT;
    });
    return (m.model == MaterialModel::OpenPbr ? gpu::SCENE_HAS_OPENPBR : 0) |
           (graph ? gpu::SCENE_HAS_GRAPHS : 0) | (directions ? gpu::SCENE_HAS_DIRECTIONS : 0) |
           (m.priority != 0 ? gpu::SCENE_HAS_NESTING : 0);
}

} // namespace

struct MaterialTable::Impl {
    struct Material {
        ResolvedMaterial inputs;
        uint32_t index;
        RowSlot row;
        uint32_t features = 0; ///< SCENE_HAS_*
        bool nonOpaque = false;
        std::vector<char> program; ///< what the row holds behind its constants
        uint64_t written = 0;      ///< where it was written; 0: not yet
        float cryptomatte = 0.f;
    };

    Impl(Device& device, NameTable& names, TextureStore& textures)
        : device(device), names(names), textures(textures) {}

    Device& device;
    NameTable& names;
    TextureStore& textures;
    std::map<MaterialId, Material> materials; ///< the fallback look is MaterialId::None
    std::vector<uint32_t> freeIndices;
    uint32_t used = 0;     ///< records in use or free below
    uint32_t capacity = 0; ///< records the buffer holds
    RowStore rows;
    bool openPbrUsed = false, stretchedUsed = false;
    std::set<MaterialId> dirty, emissive;
    bool moved = false; ///< everything is to be written anew, even if a commit fails in between
    uint32_t textureVersion = 0;
    Buffer records, albedo, openPbrAlbedo, stretchedAlbedo;

    void grow();
    void write(Material& material);
    void releaseTextures(const ResolvedMaterial& inputs);
};

void MaterialTable::Impl::grow() {
    if (rows.grow(device)) moved = true;
    if (!openPbrAlbedo && openPbrUsed) {
        const std::vector<float>& table = openPbrAlbedoTable();
        openPbrAlbedo = device.createFrom(table.data(), table.size(), "materials");
    }
    if (!stretchedAlbedo && stretchedUsed) stretchedAlbedo = stretchedAlbedoTable(device);
    if (used <= capacity) return;
    const uint32_t more = doubledCapacity(capacity, used);
    records = device.createBuffer(more * sizeof(MaterialRecord), MemoryUse::Device, "materials");
    capacity = more;
    moved = true;
}

/// An edit of values alone rewrites the row's constants alone.
void MaterialTable::Impl::write(Material& material) {
    const MaterialRow row = describeMaterial(material.inputs, textures);
    const uint64_t address = rows.address(material.row);
    std::vector<char> bytes, program;
    append(bytes, row.constants);
    append(program, row.nodes);
    append(program, row.steps);
    MaterialRecord record{};
    record.interior = row.interior;
    record.subsurface = row.subsurface;
    record.constants = address;
    record.nodes = address + bytes.size();
    record.steps = record.nodes + row.nodes.size() * sizeof(InputNode);
    record.stepCount = uint32_t(row.steps.size());
    record.presenceSteps = row.presenceSteps;
    record.flags = row.flags;
    record.priority = row.priority;
    if (moved || material.written != record.nodes || material.program != program) append(bytes, program);
    rows.write(device, material.row, bytes.data(), bytes.size());
    material.program = std::move(program);
    material.written = record.nodes;
    material.nonOpaque = record.flags & gpu::MATERIAL_NON_OPAQUE;
    device.upload(records, &record, sizeof record, material.index * sizeof record);
}

void MaterialTable::Impl::releaseTextures(const ResolvedMaterial& inputs) {
    for (const ResolvedRead& read : inputs.reads)
        if (read.textured) textures.release(read.texture);
}

MaterialTable::MaterialTable(Device& device, NameTable& names, TextureStore& textures)
    : _impl(std::make_unique<Impl>(device, names, textures)) {
    const std::vector<glm::vec2>& albedo = specularAlbedoTable();
    _impl->albedo = device.createFrom(albedo.data(), albedo.size(), "materials");

    MaterialDesc fallback;
    fallback.name = "fallback look";
    fallback.diffuseColor.source = fallback.opacity.source = MaterialInput::Source::Primvar;
    fallback.diffuseColor.primvar = "displayColor";
    fallback.opacity.primvar = "displayOpacity";
    fallback.opacityMode = OpacityMode::Presence;
    set(MaterialId::None, fallback);
}

MaterialTable::~MaterialTable() = default;

void MaterialTable::set(MaterialId id, const MaterialDesc& desc) {
    // New textures are acquired before old ones are released, so that those in both stay loaded.
    ResolvedMaterial inputs = resolveMaterial(desc, _impl->names, _impl->textures, _impl->device.messages());
    _impl->openPbrUsed |= inputs.model == MaterialModel::OpenPbr;
    _impl->stretchedUsed |= isStretched(inputs.inputs);
    const auto known = _impl->materials.find(id);
    if (known != _impl->materials.end()) {
        Impl::Material& material = known->second;
        _impl->releaseTextures(material.inputs);
        material.row = _impl->rows.take(rowBytes(inputs), material.row);
        material.inputs = std::move(inputs);
    } else {
        uint32_t index = _impl->used;
        if (_impl->freeIndices.empty()) {
            ++_impl->used;
        } else {
            index = _impl->freeIndices.back();
            _impl->freeIndices.pop_back();
        }
        const RowSlot row = _impl->rows.take(rowBytes(inputs));
        _impl->materials[id] = {std::move(inputs), index, row, 0, false, {}, 0, 0.f};
    }
    Impl::Material& material = _impl->materials[id];
    material.features = featuresOf(material.inputs);
    material.cryptomatte = cryptomatteId(desc.name);
    _impl->dirty.insert(id);
    if (isEmissive(material.inputs))
        _impl->emissive.insert(id);
    else
        _impl->emissive.erase(id);
}

void MaterialTable::remove(MaterialId id) {
    const auto known = _impl->materials.find(id);
    if (id == MaterialId::None || known == _impl->materials.end()) return;
    _impl->releaseTextures(known->second.inputs);
    _impl->freeIndices.push_back(known->second.index);
    _impl->rows.giveBack(known->second.row);
    _impl->dirty.erase(id);
    _impl->emissive.erase(id);
    _impl->materials.erase(known);
}

uint32_t MaterialTable::index(MaterialId id) const {
    const auto known = _impl->materials.find(id);
    return known == _impl->materials.end() ? Fallback : known->second.index;
}

bool MaterialTable::nonOpaque(MaterialId id) const {
    const auto known = _impl->materials.find(id);
    return id != MaterialId::None && known != _impl->materials.end() && known->second.nonOpaque;
}

std::map<uint32_t, MaterialId> MaterialTable::indices() const {
    std::map<uint32_t, MaterialId> result;
    for (const auto& [id, material] : _impl->materials)
        if (id != MaterialId::None) result[material.index] = id;
    return result;
}

float MaterialTable::cryptomatte(MaterialId id) const {
    const auto known = _impl->materials.find(id);
    const bool found = id != MaterialId::None && known != _impl->materials.end();
    return found ? known->second.cryptomatte : cryptomatteId(CryptomatteNoMaterial);
}

bool MaterialTable::emissive(MaterialId id) const {
    return _impl->emissive.count(id) > 0;
}

uint32_t MaterialTable::features() const {
    uint32_t features = 0;
    for (const auto& [id, material] : _impl->materials)
        features |= material.features;
    return features;
}

bool MaterialTable::anyEmissive() const {
    return !_impl->emissive.empty();
}

float MaterialTable::emittedLuminance(MaterialId id) const {
    return emissive(id) ? hipr::emittedLuminance(_impl->materials.at(id).inputs) : 0.f;
}

bool MaterialTable::commit() {
    _impl->grow();
    const bool all = _impl->moved || _impl->textureVersion != _impl->textures.version();
    const bool any = all || !_impl->dirty.empty();
    for (auto& [id, material] : _impl->materials)
        if (all || _impl->dirty.count(id)) _impl->write(material);
    _impl->dirty.clear();
    _impl->moved = false;
    _impl->textureVersion = _impl->textures.version();
    return any;
}

void MaterialTable::describe(gpu::SceneRecord& scene) const {
    scene.materials = _impl->records.address();
    scene.specularAlbedo = _impl->albedo.address();
    scene.openPbrAlbedo = _impl->openPbrAlbedo ? _impl->openPbrAlbedo.address() : 0;
    scene.stretchedAlbedo = _impl->stretchedAlbedo ? _impl->stretchedAlbedo.address() : 0;
}

} // namespace hipr
