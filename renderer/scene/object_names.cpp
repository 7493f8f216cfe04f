// What the things in a scene are called, for kernels and for the manifests of Cryptomatte.
#include <set>

#include "renderer/api/cryptomatte.h"
#include "renderer/scene/gpu_scene.h"

namespace hipr {

namespace {

const std::string& assetOf(const ObjectDesc& desc) {
    return desc.asset.empty() ? desc.name : desc.asset;
}

} // namespace

/// But for the material's.
gpu::SlotNames ObjectTable::namesOf(const ObjectDesc& desc) {
    return {cryptomatteId(desc.name), 0.f, cryptomatteId(assetOf(desc)),
            desc.lightGroup.empty() ? gpu::NO_INDEX : _names.intern(desc.lightGroup)};
}

/// In the order of the material index table.
void ObjectTable::uploadNames(const MaterialTable* materials) {
    std::vector<gpu::SlotNames> names;
    names.reserve(_materialIndices.size());
    const float unbound = cryptomatteId(CryptomatteNoMaterial);
    for (const ObjectId id : order()) {
        const Entry& entry = _entries.at(id);
        for (uint32_t slot = 0; slot < entry.placed.materialCount; ++slot) {
            const bool bound = materials && slot < entry.desc->materials.size();
            names.push_back(entry.names);
            names.back().material = bound ? materials->cryptomatte(entry.desc->materials[slot]) : unbound;
        }
    }
    if (names.empty()) return;
    const uint64_t bytes = names.size() * sizeof(gpu::SlotNames);
    _slotNameTable.reserve(_device, bytes, "Instance tables");
    _device.upload(_slotNameTable.buffer(), names.data(), bytes);
}

std::vector<std::string> GpuScene::cryptomatteNames(AovKind kind) const {
    std::set<std::string> names;
    _objects.forObjects([&](const ObjectDesc& desc) {
        if (!desc.visible || desc.geometry == GeometryId::None) return;
        if (kind == AovKind::CryptoObject) names.insert(desc.name);
        if (kind == AovKind::CryptoAsset) names.insert(assetOf(desc));
        if (kind != AovKind::CryptoMaterial) return;
        names.insert(CryptomatteNoMaterial);
        for (const MaterialId id : desc.materials) {
            const auto found = _materialDescs.find(id);
            if (found != _materialDescs.end()) names.insert(found->second.name);
        }
    });
    return {names.begin(), names.end()};
}

} // namespace hipr
