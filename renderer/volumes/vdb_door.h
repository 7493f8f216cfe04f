/// @file vdb_door.h
/// What libhipr and its module that knows OpenVDB say to each other. Neither allocates what the other frees,
/// and no type of a library crosses: in a host of any kind the two may be bound to different allocators.
#pragma once

#include <cstddef>
#include <cstdint>

namespace hipr {

/// Which grid of which file: see readVdbFile() and readVdbMemory().
struct VdbRequest {
    const char* path;          ///< of the file, or its name in messages if there is data
    const unsigned char* data; ///< null: the file is opened
    size_t bytes;
    const char* grid; ///< "": any name
    int index;
};

/// Gets either start() and then bricks, or an error, or after some bricks an error, which counts.
class VdbReceiver {
public:
    /// latticeToObject: four columns of three.
    virtual void start(const char* grid, uint32_t channels, const double* latticeToObject) = 0;
    /// As FieldBuilder::add() wants it.
    virtual void brick(const int* at, const float* values, size_t count) = 0;
    virtual void error(const char* text) = 0;

protected:
    ~VdbReceiver() = default;
};

/// What is said of a grid, after its name, whose bricks are too many or too far apart.
constexpr char VdbTooLarge[] = " spans too much space to be rendered";

/// The one function of the module. Lets through no exception of its own or of the receiver. Thread-safe.
using ReadVdb = void (*)(const VdbRequest&, VdbReceiver&);
constexpr char VdbModuleFile[] = "hipr_vdb.so";
constexpr char ReadVdbName[] = "hiprReadVdb";

} // namespace hipr
