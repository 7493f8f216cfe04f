#include "plugin/record/aovLayers.h"

#include <algorithm>
#include <cstddef>

#include "plugin/record/cryptomatte.h"

namespace hipr::record {

namespace {

bool isGeometricVector(const std::string& aov) {
    static const char* const names[] = {"normal", "Neye", "Peye", "P", "N", "motion", "velocity"};
    return std::find(std::begin(names), std::end(names), aov) != std::end(names);
}

std::string componentLetters(const std::string& aov, int components, bool integer) {
    if (components == 1) {
        if (integer) return "I";
        return aov == "depth" || aov == "cameraDepth" ? "Z" : "V";
    }
    return isGeometricVector(aov) ? "XYZW" : "RGBA";
}

} // namespace

std::vector<std::string> aovChannelNames(const std::string& aov, int components, bool integer,
                                         const std::string& layer) {
    const std::string letters = componentLetters(aov, components, integer);
    const std::string name = layer.empty() ? aov : layer;
    std::string prefix;
    if (name != "color") {
        prefix = name + ".";
        std::replace(prefix.begin(), prefix.end(), ':', '.');
    }
    std::vector<std::string> names;
    for (int i = 0; i < components; ++i)
        names.push_back(prefix + letters[size_t(i)]);
    return names;
}

bool isColour(const std::string& aov, int components) {
    return components >= 3 && aov != "variance" && aov != "patchCoord" && aov.rfind("primvars:", 0) != 0 &&
           !isGeometricVector(aov) && cryptomatteOf(aov).empty();
}

} // namespace hipr::record
