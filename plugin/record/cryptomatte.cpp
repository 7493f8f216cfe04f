#include "plugin/record/cryptomatte.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "renderer/api/cryptomatte.h"
#include "renderer/api/film.h"

namespace hipr::record {

namespace {

const char* const stems[] = {"CryptoObject", "CryptoMaterial", "CryptoAsset"};

std::string layerAov(const std::string& stem, uint32_t layer) {
    return stem + "0" + std::to_string(layer);
}

std::string hexadecimal(const std::string& name) {
    char text[9];
    std::snprintf(text, sizeof text, "%08x", unsigned(cryptomatteBits(name)));
    return text;
}

/// Names that are no UTF-8 lose what is not.
std::string manifest(const std::vector<std::string>& names) {
    nlohmann::ordered_json ids = nlohmann::ordered_json::object();
    for (const std::string& name : names)
        ids[name] = hexadecimal(name);
    return ids.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// Of a layer, without its number.
std::string nameOf(const Layer& layer) {
    const std::string& name = layer.name.empty() ? layer.aov : layer.name;
    return name.substr(0, name.size() - 2);
}

} // namespace

std::string cryptomatteOf(const std::string& aov) {
    for (const char* stem : stems)
        for (uint32_t layer = 0; layer < CryptomatteLayers; ++layer)
            if (aov == layerAov(stem, layer)) return stem;
    return "";
}

std::vector<std::string> expandedAov(const std::string& aov) {
    std::vector<std::string> aovs;
    for (const char* stem : stems)
        for (uint32_t layer = 0; aov == stem && layer < CryptomatteLayers; ++layer)
            aovs.push_back(layerAov(stem, layer));
    if (aovs.empty()) aovs.push_back(aov);
    return aovs;
}

std::vector<std::pair<std::string, std::string>> cryptomatteMetadata(const Picture& picture) {
    std::vector<std::pair<std::string, std::string>> metadata;
    std::set<std::string> told;
    for (const Layer& layer : picture.layers) {
        const std::string stem = cryptomatteOf(layer.aov);
        if (stem.empty() || !told.insert(nameOf(layer)).second) continue;
        const std::string prefix = "cryptomatte/" + hexadecimal(nameOf(layer)).substr(0, 7) + "/";
        const auto names = picture.info.names.find(stem);
        metadata.emplace_back(prefix + "name", nameOf(layer));
        metadata.emplace_back(prefix + "hash", "MurmurHash3_32");
        metadata.emplace_back(prefix + "conversion", "uint32_to_float32");
        if (names != picture.info.names.end())
            metadata.emplace_back(prefix + "manifest", manifest(names->second));
    }
    return metadata;
}

} // namespace hipr::record
