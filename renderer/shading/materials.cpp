#include "renderer/shading/materials.h"

#include <map>
#include <set>
#include <vector>

#include "renderer/shading/albedo.h"
#include "renderer/shading/material_inputs.h"
#include "renderer/shading/openpbr_albedo.h"

namespace hipr {

using gpu::InputNode;
using gpu::MaterialRecord;

namespace {

uint32_t doubled(uint32_t capacity, uint32_t least) {
    while (capacity < least)
        capacity = capacity ? capacity * 2 : 64;
    return capacity;
}

/// The rows of all materials of one model, in slots of one size: constants, then nodes. Grows by doubling.
class RowStore {
public:
    explicit RowStore(uint32_t inputs) : _inputs(inputs) {}

    uint32_t take() {
        if (_free.empty()) return _used++;
        const uint32_t slot = _free.back();
        _free.pop_back();
        return slot;
    }
    void giveBack(uint32_t slot) { _free.push_back(slot); }
    bool used() const { return _used > 0; }

    /// Makes room for all slots taken. Returns whether all rows are to be written anew.
    bool grow(Device& device) {
        if (_used <= _capacity) return false;
        const uint32_t capacity = doubled(_capacity, _used);
        _buffer = device.createBuffer(capacity * size(), MemoryUse::Device, "materials");
        _capacity = capacity;
        return true;
    }

    void write(Device& device, uint32_t slot, const MaterialRow& row, MaterialRecord& record) {
        const uint64_t constants = slot * size(), nodes = constants + _inputs * sizeof(glm::vec4);
        record.constants = _buffer.address() + constants;
        record.nodes = _buffer.address() + nodes;
        record.nodeCount = uint32_t(row.nodes.size());
        record.flags = row.flags;
        record.interior = row.interior;
        record.subsurface = row.subsurface;
        device.upload(_buffer, row.constants.data(), row.constants.size() * sizeof(glm::vec4), constants);
        if (!row.nodes.empty())
            device.upload(_buffer, row.nodes.data(), row.nodes.size() * sizeof(InputNode), nodes);
    }

private:
    uint64_t size() const { return _inputs * (sizeof(glm::vec4) + sizeof(InputNode)); }

    uint32_t _inputs;
    uint32_t _used = 0, _capacity = 0; ///< slots
    std::vector<uint32_t> _free;
    Buffer _buffer;
};

} // namespace

struct MaterialTable::Impl {
    struct Material {
        ResolvedMaterial inputs;
        uint32_t index, row;
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
    uint32_t capacity = 0; ///< records the buffer holds
    RowStore previewRows{gpu::PREVIEW_INPUT_COUNT}, openPbrRows{gpu::INPUT_COUNT};
    std::set<MaterialId> dirty, emissive;
    bool moved = false; ///< everything is to be written anew, even if a commit fails in between
    uint32_t textureVersion = 0;
    Buffer records, albedo, openPbrAlbedo;

    RowStore& rows(MaterialModel model) {
        return model == MaterialModel::OpenPbr ? openPbrRows : previewRows;
    }
    void grow();
    void write(Material& material);
    void releaseTextures(const ResolvedMaterial& inputs);
};

void MaterialTable::Impl::grow() {
    if (previewRows.grow(device)) moved = true;
    if (openPbrRows.grow(device)) moved = true;
    if (openPbrRows.used() && !openPbrAlbedo) {
        const std::vector<float>& table = openPbrAlbedoTable();
        openPbrAlbedo = device.createFrom(table.data(), table.size(), "materials");
    }
    if (used <= capacity) return;
    const uint32_t more = doubled(capacity, used);
    records = device.createBuffer(more * sizeof(MaterialRecord), MemoryUse::Device, "materials");
    capacity = more;
    moved = true;
}

void MaterialTable::Impl::write(Material& material) {
    const MaterialRow row = describeMaterial(material.inputs, textures);
    MaterialRecord record{};
    rows(material.inputs.model).write(device, material.row, row, record);
    material.nonOpaque = record.flags & gpu::MATERIAL_NON_OPAQUE;
    device.upload(records, &record, sizeof record, material.index * sizeof record);
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
        Impl::Material& material = known->second;
        _impl->releaseTextures(material.inputs);
        if (material.inputs.model != inputs.model) {
            _impl->rows(material.inputs.model).giveBack(material.row);
            material.row = _impl->rows(inputs.model).take();
        }
        material.inputs = std::move(inputs);
    } else {
        uint32_t index = _impl->used;
        if (_impl->freeIndices.empty()) {
            ++_impl->used;
        } else {
            index = _impl->freeIndices.back();
            _impl->freeIndices.pop_back();
        }
        const uint32_t row = _impl->rows(inputs.model).take();
        _impl->materials[id] = {std::move(inputs), index, row};
    }
    _impl->dirty.insert(id);
    if (isEmissive(_impl->materials[id].inputs))
        _impl->emissive.insert(id);
    else
        _impl->emissive.erase(id);
}

void MaterialTable::remove(MaterialId id) {
    const auto known = _impl->materials.find(id);
    if (id == MaterialId::None || known == _impl->materials.end()) return;
    _impl->releaseTextures(known->second.inputs);
    _impl->freeIndices.push_back(known->second.index);
    _impl->rows(known->second.inputs.model).giveBack(known->second.row);
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

bool MaterialTable::emissive(MaterialId id) const {
    return _impl->emissive.count(id) > 0;
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
}

} // namespace hipr
