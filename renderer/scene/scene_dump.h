/// @file scene_dump.h
/// A scene as text: one fact per line, for people with grep and for tests that compare two scenes.
#pragma once

#include <deque>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "renderer/api/scene.h"

namespace hipr {

/// Collects facts about named elements and writes them sorted by kind and name:
///     object /World/Ball visible true
/// Numbers are exact (floats in hexadecimal notation) and arrays are told by their content's hash, so that
/// equal text means equal data. Nothing in it depends on ids, addresses or the order of edits.
class SceneDump {
public:
    class Element {
    public:
        /// One line: kind, name, and these words.
        template <class... Words> void fact(const Words&... words) {
            _text += _head;
            (put(words), ...);
            _text += '\n';
        }

    private:
        friend class SceneDump;
        void put(const char* word);
        void put(const std::string& word); ///< in quotes when it is empty or holds spaces
        void put(bool value) { put(value ? "true" : "false"); }
        void put(int value) { put(std::to_string(value).c_str()); }
        void put(uint32_t value) { put(std::to_string(value).c_str()); }
        void put(size_t value) { put(std::to_string(value).c_str()); }
        void put(double value);
        void put(float value) { put(double(value)); }
        /// A vector or matrix of glm, in memory order.
        template <class T, class Value = typename T::value_type> void put(const T& tuple) {
            for (size_t i = 0; i < sizeof(T) / sizeof(Value); ++i)
                put(reinterpret_cast<const Value*>(&tuple)[i]);
        }

        std::string _head, _text;
    };

    /// A new element, also when there is one of that name already.
    Element& element(const std::string& kind, const std::string& name);
    void write(std::ostream& out) const;

private:
    std::deque<Element> _elements; ///< references to them stay valid
};

/// Materials as people know them.
struct MaterialNames {
    std::map<MaterialId, std::string> names;
    std::map<uint32_t, MaterialId> indices; ///< the material of each record but the fallback look's
    std::string byId(MaterialId id) const;
    std::string byIndex(uint32_t index) const;
};

/// A 64-bit hash (FNV-1a) as hexadecimal digits.
std::string contentHash(const void* data, size_t bytes);
template <class T> std::string contentHash(const std::vector<T>& values) {
    return contentHash(values.data(), values.size() * sizeof(T));
}

void dumpCamera(SceneDump& dump, const CameraDesc& camera);
void dumpMesh(SceneDump& dump, const TriangleMesh& mesh);
void dumpMaterial(SceneDump& dump, const MaterialDesc& material, bool nonOpaque);
void dumpLight(SceneDump& dump, const LightDesc& light, bool emits);
/// What lights and surfaces that are lights have in common.
void dumpLightControls(SceneDump::Element& out, const LightShaping& shaping, const LightShadow& shadow,
                       const std::string& lightLink, const std::string& shadowLink);

} // namespace hipr
