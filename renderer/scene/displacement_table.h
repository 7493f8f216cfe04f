/// @file displacement_table.h
/// Geometries as the materials of the objects that show them displace them.
#pragma once

#include <map>
#include <unordered_map>
#include <unordered_set>

#include "renderer/scene/displacer.h"
#include "renderer/scene/object_table.h"

namespace hipr {

/// Stands between an edit and the table of geometries. What is kept of a geometry there is what the renderer
/// sees; its mesh as it was set is kept here while the two differ. A geometry that several objects show is
/// displaced as the first of them (by its id) has it.
class DisplacementTable {
public:
    DisplacementTable(AssetReader assets, std::shared_ptr<const ColorManager> color, MessageSink messages)
        : _assets(std::move(assets)), _color(std::move(color)), _messages(std::move(messages)) {}

    /// Each notes a part of an edit. setGeometry() returns whether the mesh is kept here, and comes to the
    /// table of geometries with update().
    bool setGeometry(GeometryId id, const std::shared_ptr<const TriangleMesh>& mesh);
    void removeGeometry(GeometryId id);
    void setMaterial(MaterialId id, const MaterialDesc& desc);
    void removeMaterial(MaterialId id);
    void objectsChanged() { _stale = true; }
    /// Whether materials count at all.
    void setEnabled(bool enabled);

    /// Displaces what the edit changed, and reports it for the objects that show it. Costs nothing where
    /// nothing is displaced.
    void update(GeometryTable& geometries, ObjectTable& objects, ChangedSet& changed);

    /// Host memory of meshes that are kept here.
    uint64_t hostBytes() const;

private:
    using Slots = std::vector<std::shared_ptr<const Displacer>>;
    struct Entry {
        std::shared_ptr<const TriangleMesh> base;
        Slots slots; ///< what it is displaced by
    };
    Slots slotsOf(const ObjectDesc& object) const;
    std::map<GeometryId, Slots> wanted(const ObjectTable& objects) const;
    std::shared_ptr<const HostTexture> texture(const TextureDesc& desc, const std::string& subject);

    AssetReader _assets;
    std::shared_ptr<const ColorManager> _color;
    MessageSink _messages;
    std::unordered_map<MaterialId, std::shared_ptr<const Displacer>> _materials; ///< that displace
    std::map<GeometryId, Entry> _displaced;
    std::unordered_set<GeometryId> _replaced; ///< whose base is new since the last update()
    std::map<std::pair<std::string, std::string>, std::weak_ptr<const HostTexture>> _textures;
    bool _enabled = true, _stale = false;
};

} // namespace hipr
