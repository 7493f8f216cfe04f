/// @file fieldFile.h
/// Grids of OpenVDB files through ArResolver.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"
#include "renderer/api/scene.h"
#include "renderer/volumes/vdb_reader.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// The fields of the scene and the files they come from. While somebody holds the grid of a plain file, it is
/// not read again unless the file was written since. Thread-safe.
class ShownFields {
public:
    /// `id` becomes the grid of a file as `field` names it; without a file, or one that can be read, it is
    /// gone.
    void set(hipr::FieldId id, SdfPath const& field, std::string const& path, hipr::FieldChoice const& choice,
             hipr::SceneEdit& edit);
    void remove(hipr::FieldId id, hipr::SceneEdit& edit);
    /// Reads all files again.
    void readAgain(hipr::SceneEdit& edit);

private:
    struct Entry {
        SdfPath field;
        std::string path;
        hipr::FieldChoice choice;
    };
    std::mutex _mutex;
    std::map<hipr::FieldId, Entry> _entries;
};

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
