#include "renderer/shading/categories.h"

#include <algorithm>

namespace hipr {

uint32_t CategoryTable::category(const std::string& name) {
    if (name.empty()) return gpu::NO_INDEX;
    const auto [found, isNew] = _categories.try_emplace(name, uint32_t(_categories.size()));
    _changed |= isNew;
    return found->second;
}

uint32_t CategoryTable::markOf(const std::string& name) {
    if (name.empty()) return gpu::NO_INDEX;
    uint32_t hash =
        2166136261u; // FNV-1a: std::hash differs between libraries, and with it the picture's noise
    for (const char c : name)
        hash = (hash ^ uint8_t(c)) * 16777619u;
    return 1u << (hash ^ hash >> 16) % 31; // the last bit stands for no name
}

uint32_t CategoryTable::set(std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    const auto [found, isNew] = _sets.try_emplace(std::move(names), uint32_t(_sets.size()));
    _changed |= isNew;
    if (isNew)
        for (const std::string& name : found->first)
            category(name);
    return found->second;
}

void CategoryTable::commit() {
    if (!_changed) return;
    _changed = false;
    _words = (uint32_t(_categories.size()) + 31) / 32;
    const uint32_t stride = 1 + _words;
    std::vector<uint32_t> bits(_sets.size() * stride);
    for (const auto& [names, set] : _sets)
        for (const std::string& name : names) {
            const uint32_t category = _categories.at(name);
            bits[set * stride] |= markOf(name);
            bits[set * stride + 1 + category / 32] |= 1u << category % 32;
        }
    _table = _device.createFrom(bits.data(), bits.size(), "light tables");
}

void CategoryTable::describe(gpu::SceneRecord& scene) const {
    scene.categorySets = _table.address();
    scene.categoryWords = _words;
}

} // namespace hipr
