/// @file vdb_reader.h
/// Grids of OpenVDB files -> FieldGrid. OpenVDB comes with a module that is loaded when the first file is
/// read: without volumes nobody needs it, and where it is missing every file is an error that says so.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "renderer/api/volume.h"
#include "renderer/volumes/vdb_door.h"

namespace hipr {

/// Which grid of a file.
struct FieldChoice {
    std::string grid; ///< empty: any name
    int index = 0;    ///< among the grids of that name, in the order of the file's table
};

/// Either a grid, or none and an error. `warning`: what is wrong with the grid, if anything.
struct FieldFile {
    std::shared_ptr<const FieldGrid> grid;
    std::string error, warning;
};

/// The module that knows OpenVDB, or why there is none.
struct VdbModule {
    ReadVdb read = nullptr;
    std::string error; ///< empty if there is one
};

/// Opens the module that lies in the first of these folders that has one.
VdbModule openVdbModule(const std::vector<std::string>& folders);

/// Where it is looked for: beside the binary that libhipr is part of (the plugin), and in `../plugin/usd`
/// (programs in `bin`).
std::vector<std::string> vdbModuleFolders();

/// Reads fog volumes of numbers of any precision (1 channel) and of triples of them (3 channels); logical
/// values count as 0 and 1. Transforms must be affine. Blocks; thread-safe.
FieldFile readVdbFile(const std::string& path, const FieldChoice& choice);

/// The same from memory. `name`: of the file, for messages. All grids are read, only one is kept: for large
/// files that lie on disk readVdbFile() is faster.
FieldFile readVdbMemory(const unsigned char* data, size_t bytes, const std::string& name,
                        const FieldChoice& choice);

} // namespace hipr
