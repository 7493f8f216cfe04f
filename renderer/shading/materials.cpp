#include "renderer/shading/materials.h"

#include <map>
#include <set>
#include <vector>

#include "renderer/shading/albedo.h"
#include "renderer/shading/material_inputs.h"

namespace hipr {

using gpu::InputNode;
using gpu::MaterialRecord;

struct MaterialTable::Impl {
    struct Material {
        ResolvedMaterial inputs;
        uint32_t index;
        bool nonOpaque = false;
    };

    Impl(Device& device, NameTable& names, TextureStore& textures)
        : device(device), names(names), textures(textures) {}

    Device& device;
    NameTable& names;
    TextureStore& textures;
    std::map<MaterialId, Material> materials; ///< the fallback look is MaterialId::None
    std::vector<uint32_t> freeIndices;
    uint32_t used = 0;     ///< records in use or free below
    uint32_t capacity = 0; ///< records the buffers hold
    std::set<MaterialId> dirty;
    uint32_t textureVersion = 0;
    Buffer records, nodes, albedo;

    void grow();
    void write(Material& material);
    void releaseTextures(const ResolvedMaterial& inputs);
};

void MaterialTable::Impl::grow() {
    while (capacity < used)
        capacity = capacity ? capacity * 2 : 64;
    records = device.createBuffer(capacity * sizeof(MaterialRecord), MemoryUse::Device, "materials");
    nodes =
        device.createBuffer(capacity * gpu::INPUT_COUNT * sizeof(InputNode), MemoryUse::Device, "materials");
}

void MaterialTable::Impl::write(Material& material) {
    const uint64_t firstNode = uint64_t(material.index) * gpu::INPUT_COUNT * sizeof(InputNode);
    std::vector<InputNode> nodeTable;
    MaterialRecord record = describeMaterial(material.inputs, textures, nodeTable);
    record.inputNodes = nodes.address() + firstNode;
    material.nonOpaque = record.flags & gpu::MATERIAL_NON_OPAQUE;
    device.upload(records, &record, sizeof record, material.index * sizeof record);
    if (!nodeTable.empty())
        device.upload(nodes, nodeTable.data(), nodeTable.size() * sizeof(InputNode), firstNode);
}

void MaterialTable::Impl::releaseTextures(const ResolvedMaterial& inputs) {
    for (const ResolvedInput& input : inputs.inputs)
        if (input.kind == MaterialInput::Source::Texture) textures.release(input.texture);
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
    const auto known = _impl->materials.find(id);
    if (known != _impl->materials.end()) {
        _impl->releaseTextures(known->second.inputs);
        known->second.inputs = std::move(inputs);
    } else {
        uint32_t index = _impl->used;
        if (_impl->freeIndices.empty()) {
            ++_impl->used;
        } else {
            index = _impl->freeIndices.back();
            _impl->freeIndices.pop_back();
        }
        _impl->materials[id] = {std::move(inputs), index};
    }
    _impl->dirty.insert(id);
}

void MaterialTable::remove(MaterialId id) {
    const auto known = _impl->materials.find(id);
    if (id == MaterialId::None || known == _impl->materials.end()) return;
    _impl->releaseTextures(known->second.inputs);
    _impl->freeIndices.push_back(known->second.index);
    _impl->dirty.erase(id);
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

bool MaterialTable::emissive(MaterialId id) const {
    const auto known = _impl->materials.find(id);
    return known != _impl->materials.end() && isEmissive(known->second.inputs);
}

bool MaterialTable::commit() {
    const bool all = _impl->used > _impl->capacity || _impl->textureVersion != _impl->textures.version();
    if (_impl->used > _impl->capacity) _impl->grow();
    const bool any = all || !_impl->dirty.empty();
    for (auto& [id, material] : _impl->materials)
        if (all || _impl->dirty.count(id)) _impl->write(material);
    _impl->dirty.clear();
    _impl->textureVersion = _impl->textures.version();
    return any;
}

void MaterialTable::describe(gpu::SceneRecord& scene) const {
    scene.materials = _impl->records.address();
    scene.specularAlbedo = _impl->albedo.address();
}

} // namespace hipr
