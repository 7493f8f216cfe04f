#include "renderer/api/scene.h"

#include <iterator>
#include <utility>

namespace hipr {

std::string toString(Change change) {
    static constexpr const char* names[] = {"added",   "removed",  "transform", "geometry",
                                            "primvar", "material", "emission",  "visibility",
                                            "camera",  "setting",  "linking"};
    std::string text;
    for (size_t bit = 0; bit < std::size(names); ++bit)
        if (change & Change(1u << bit)) text += (text.empty() ? "" : ", ") + std::string(names[bit]);
    return text;
}

Change ChangedSet::kinds() const {
    Change kinds = Change::None;
    for (const ChangedElement& element : elements)
        kinds = kinds | element.change;
    return kinds;
}

// Later calls for the same id win because ops are applied in order; nothing is merged here.

void SceneEdit::record(Op op) {
    std::lock_guard<std::mutex> lock(_mutex);
    _ops.push_back(std::move(op));
}

void SceneEdit::setGeometry(GeometryId id, std::shared_ptr<const TriangleMesh> mesh) {
    record(GeometryOp{id, std::move(mesh)});
}
void SceneEdit::removeGeometry(GeometryId id) {
    record(GeometryOp{id, nullptr});
}
void SceneEdit::setSplats(SplatsId id, std::shared_ptr<const SplatCloud> cloud) {
    record(SplatsOp{id, std::move(cloud)});
}
void SceneEdit::removeSplats(SplatsId id) {
    record(SplatsOp{id, nullptr});
}
void SceneEdit::setField(FieldId id, std::shared_ptr<const FieldGrid> grid) {
    record(FieldOp{id, std::move(grid)});
}
void SceneEdit::removeField(FieldId id) {
    record(FieldOp{id, nullptr});
}
void SceneEdit::setVolume(VolumeId id, VolumeDesc desc) {
    record(VolumeOp{id, std::move(desc)});
}
void SceneEdit::removeVolume(VolumeId id) {
    record(VolumeOp{id, std::nullopt});
}
void SceneEdit::setVolumeLook(MaterialId id, VolumeLook look) {
    record(VolumeLookOp{id, look});
}
void SceneEdit::removeVolumeLook(MaterialId id) {
    record(VolumeLookOp{id, std::nullopt});
}
void SceneEdit::setMaterial(MaterialId id, MaterialDesc desc) {
    record(MaterialOp{id, std::move(desc)});
}
void SceneEdit::removeMaterial(MaterialId id) {
    record(MaterialOp{id, std::nullopt});
}
void SceneEdit::setLight(LightId id, LightDesc desc) {
    record(LightOp{id, std::move(desc)});
}
void SceneEdit::removeLight(LightId id) {
    record(LightOp{id, std::nullopt});
}
void SceneEdit::setObject(ObjectId id, ObjectDesc desc) {
    record(ObjectOp{id, std::move(desc)});
}
void SceneEdit::setInstances(ObjectId id, InstancesDesc desc) {
    record(InstancesOp{id, std::move(desc)});
}
void SceneEdit::removeObject(ObjectId id) {
    record(ObjectOp{id, std::nullopt});
}
void SceneEdit::setCamera(const CameraDesc& camera) {
    record(CameraOp{camera});
}

bool SceneEdit::empty() const {
    std::lock_guard<std::mutex> lock(_mutex);
    return _ops.empty();
}

void SceneEdit::clear() {
    std::lock_guard<std::mutex> lock(_mutex);
    _ops.clear();
}

void SceneEdit::append(SceneEdit& later) {
    std::vector<Op> ops = later.take();
    std::lock_guard<std::mutex> lock(_mutex);
    _ops.insert(_ops.end(), std::make_move_iterator(ops.begin()), std::make_move_iterator(ops.end()));
}

std::vector<SceneEdit::Op> SceneEdit::take() {
    std::lock_guard<std::mutex> lock(_mutex);
    return std::exchange(_ops, {});
}

} // namespace hipr
