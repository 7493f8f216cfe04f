/// @file types.h
/// Ids, messages and small value types shared by the whole public API.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace hipr {

/// Ids are handed out by Scene::newId() and are never reused within a Scene.
enum class GeometryId : uint32_t { None = 0 };
enum class MaterialId : uint32_t { None = 0 };
enum class LightId : uint32_t { None = 0 };
enum class ObjectId : uint32_t { None = 0 };
enum class SplatsId : uint32_t { None = 0 };
enum class FieldId : uint32_t { None = 0 };
enum class VolumeId : uint32_t { None = 0 };

enum class Severity { Info, Warning, Error };

/// Receives every message the renderer has for its user. `subject` is the name of the element the message
/// is about (the prim path in a Hydra host), or empty. May be called from any thread.
using MessageSink = std::function<void(Severity, const std::string& subject, const std::string& text)>;

/// Reads a whole asset (texture). Returns an empty vector when it cannot be read. Called from commit().
/// A Hydra host reads through ArResolver so that packages (.usdz) and custom resolvers work.
using AssetReader = std::function<std::vector<unsigned char>(const std::string& path)>;

/// How a primvar's values map onto a mesh. Uniform: one per face. Vertex (and varying): one per point.
/// FaceVarying: one per face corner. Instance values live in InstancesDesc.
enum class Interpolation : uint32_t { Constant, Uniform, Vertex, FaceVarying };

/// A named array of 1..4-component float tuples. `indices`, when not empty, maps elements to values.
struct Primvar {
    std::string name;
    Interpolation interpolation = Interpolation::Constant;
    uint32_t components = 3;      ///< floats per value, 1..4
    std::vector<float> values;    ///< components * (number of values)
    std::vector<int> indices;     ///< optional; same length as the element count of `interpolation`
    bool linear = false;          ///< Vertex only: USD's `varying`, which subdivision refines linearly
    bool operator==(const Primvar& o) const {
        return name == o.name && interpolation == o.interpolation && components == o.components &&
               values == o.values && indices == o.indices && linear == o.linear;
    }
};

} // namespace hipr
