// The module that knows OpenVDB, which is much to compile, to link and to load: nothing else includes its
// headers.
#include <filesystem>
#include <fstream>
#include <istream>
#include <set>
#include <stdexcept>
#include <streambuf>
#include <tuple>

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include "renderer/api/volume.h"
#include "renderer/volumes/vdb_door.h"

namespace hipr {
namespace {

/// What is said as it is, unlike what OpenVDB throws.
struct Refusal : std::runtime_error {
    using std::runtime_error::runtime_error;
};

Refusal cutShort(const char* path) {
    return Refusal("'" + std::string(path) + "' is damaged: it ends too early");
}

/// Bytes in memory as a stream that can seek.
class MemoryBuffer : public std::streambuf {
public:
    MemoryBuffer(const unsigned char* data, size_t bytes) {
        char* begin = const_cast<char*>(reinterpret_cast<const char*>(data));
        setg(begin, begin, begin + bytes);
    }

protected:
    pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
        const off_type base = from == std::ios_base::beg   ? 0
                              : from == std::ios_base::cur ? gptr() - eback()
                                                           : egptr() - eback();
        const off_type to = base + offset;
        if (to < 0 || to > egptr() - eback()) return pos_type(off_type(-1));
        setg(eback(), eback() + to, egptr());
        return to;
    }
    pos_type seekpos(pos_type to, std::ios_base::openmode which) override {
        return seekoff(off_type(to), std::ios_base::beg, which);
    }
};

struct LessBrick {
    bool operator()(const glm::ivec3& a, const glm::ivec3& b) const {
        return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
    }
};
using BrickSet = std::set<glm::ivec3, LessBrick>;

/// The most bricks that tiles of one value may fill; a larger tile is somebody's mistake.
constexpr size_t MostBricks = 1u << 23;

/// The bricks that need the values of lattice points lo..hi. False: too many.
bool addBricks(const openvdb::Coord& lo, const openvdb::Coord& hi, BrickSet& bricks) {
    constexpr int Shift = 3;
    static_assert(FieldGrid::Cells == 1 << Shift);
    // The last points of a brick are the first ones of the next.
    const glm::ivec3 first((lo.x() - 1) >> Shift, (lo.y() - 1) >> Shift, (lo.z() - 1) >> Shift);
    const glm::ivec3 last(hi.x() >> Shift, hi.y() >> Shift, hi.z() >> Shift);
    const glm::dvec3 count = glm::dvec3(last) - glm::dvec3(first) + 1.0;
    if (count.x * count.y * count.z + double(bricks.size()) > double(MostBricks)) return false;
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x)
                bricks.insert({x, y, z});
    return true;
}

/// The bricks in which a grid may have values: those of its leaves and of its active tiles.
template <class Grid> bool findBricks(const Grid& grid, BrickSet& bricks) {
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
        const openvdb::CoordBBox box = leaf->getNodeBoundingBox();
        if (!addBricks(box.min(), box.max(), bricks)) return false;
    }
    auto tile = grid.cbeginValueOn();
    tile.setMaxDepth(decltype(tile)::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        const openvdb::CoordBBox box = tile.getBoundingBox();
        if (!addBricks(box.min(), box.max(), bricks)) return false;
    }
    return true;
}

template <class T> void put(const T& value, float*& out) {
    *out++ = float(value);
}
template <class T> void put(const openvdb::math::Vec3<T>& value, float*& out) {
    for (int c = 0; c < 3; ++c)
        *out++ = float(value[c]);
}

template <class Accessor> void fillBrick(Accessor& from, const glm::ivec3& brick, float* out) {
    const glm::ivec3 p = brick * FieldGrid::Cells;
    for (int z = 0; z < FieldGrid::Points; ++z)
        for (int y = 0; y < FieldGrid::Points; ++y)
            for (int x = 0; x < FieldGrid::Points; ++x)
                put(from.getValue({p.x + x, p.y + y, p.z + z}), out);
}

/// Index space to the space of the file. OpenVDB's matrices stand before their vectors: rows are what columns
/// are here.
glm::dmat4x3 latticeToObject(const openvdb::math::Transform& transform) {
    const openvdb::math::Mat4d m = transform.baseMap()->getAffineMap()->getMat4();
    glm::dmat4x3 out;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r)
            out[c][r] = m(c, r);
    return out;
}

bool usable(const glm::dmat4x3& m) {
    const double volume = glm::dot(glm::cross(m[0], m[1]), m[2]);
    return std::isfinite(volume) && volume != 0.0 && std::isfinite(m[3].x + m[3].y + m[3].z);
}

template <class Grid>
bool convertTo(const openvdb::GridBase& base, const std::string& name, VdbReceiver& to) {
    if (!base.isType<Grid>()) return false;
    const auto& grid = static_cast<const Grid&>(base);
    constexpr uint32_t Channels = openvdb::VecTraits<typename Grid::ValueType>::IsVec ? 3 : 1;
    BrickSet bricks;
    if (!findBricks(grid, bricks)) throw Refusal(name + VdbTooLarge);
    const glm::dmat4x3 matrix = latticeToObject(grid.transform());
    to.start(name.c_str(), Channels, &matrix[0][0]);
    auto accessor = grid.getConstUnsafeAccessor();
    std::vector<float> values(FieldGrid::BrickPoints * Channels);
    for (const glm::ivec3& brick : bricks) {
        fillBrick(accessor, brick, values.data());
        to.brick(&brick[0], values.data(), values.size());
    }
    return true;
}

template <class... Grids>
bool convertToAny(const openvdb::GridBase& grid, const std::string& name, VdbReceiver& to) {
    return (convertTo<Grids>(grid, name, to) || ...);
}

void convert(const openvdb::GridBase& grid, const std::string& name, VdbReceiver& to) {
    if (!grid.transform().isLinear())
        throw Refusal(name + " has a transform that is not affine (a frustum), which is not supported");
    if (grid.getGridClass() == openvdb::GRID_LEVEL_SET)
        throw Refusal(name + " is a level set, not a fog volume");
    if (!usable(latticeToObject(grid.transform())))
        throw Refusal(name + " has a transform that is not finite or has no volume");
    if (!convertToAny<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid, openvdb::Int64Grid,
                      openvdb::BoolGrid, openvdb::Vec3SGrid, openvdb::Vec3DGrid, openvdb::Vec3IGrid>(
            grid, name, to))
        throw Refusal(name + " is of type '" + grid.type() + "', which is not supported");
}

/// Finds the grid that is asked for among those of a file, whichever way these are told.
class Search {
public:
    explicit Search(const VdbRequest& request) : _request(request) {}

    /// Whether it is this one, which is told after all before it.
    bool found(const std::string& grid) {
        _names.insert(grid);
        return (!*_request.grid || grid == _request.grid) && _index++ == _request.index;
    }
    std::string described(const std::string& grid) const {
        return "grid '" + grid + "' of '" + _request.path + "'";
    }
    Refusal missing() const {
        std::string names;
        for (const std::string& name : _names)
            names += (names.empty() ? "; it has '" : ", '") + name + "'";
        const std::string number = _request.index > 0 ? " number " + std::to_string(_request.index) : "";
        return Refusal("'" + std::string(_request.path) + "' has no grid '" + _request.grid + "'" + number +
                       (names.empty() ? "; it has none at all" : names));
    }

private:
    const VdbRequest& _request;
    int _index = 0;
    std::set<std::string> _names;
};

template <class T> T next(std::istream& in) {
    T value{};
    in.read(reinterpret_cast<char*>(&value), sizeof value);
    return value;
}

/// Whether the grids of a file can be read one by one, which those written to a pipe cannot. OpenVDB takes
/// what memory holds for what it missed beyond the end of a file, so that files that are cut short are to be
/// found before.
bool hasTable(std::istream& in, uint64_t bytes, const char* path) {
    const auto magic = next<int64_t>(in);
    const auto version = next<uint32_t>(in), major = next<uint32_t>(in), minor = next<uint32_t>(in);
    const auto offsets = next<char>(in);
    if (magic != openvdb::OPENVDB_MAGIC || version < openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION ||
        !offsets)
        return false;
    in.ignore(36); // its UUID
    openvdb::io::setVersion(in, {major, minor}, version);
    openvdb::MetaMap().readMeta(in);
    for (auto count = next<int32_t>(in); count > 0; --count) {
        openvdb::io::GridDescriptor grid;
        grid.read(in);
        if (uint64_t(grid.getEndPos()) > bytes) throw cutShort(path);
        grid.seekToEnd(in);
    }
    return true;
}

/// Reads all grids of a stream that throws at its end, and keeps one.
void readStream(std::istream& in, const VdbRequest& request, VdbReceiver& to) {
    openvdb::io::Stream archive(in, false);
    Search search(request);
    for (const openvdb::GridBase::Ptr& grid : *archive.getGrids())
        if (search.found(grid->getName())) return convert(*grid, search.described(grid->getName()), to);
    throw search.missing();
}

/// Reads the table of a file that has one, and the one grid.
void readGrid(const VdbRequest& request, VdbReceiver& to) {
    openvdb::io::File file(request.path);
    file.open(false);
    Search search(request);
    for (auto it = file.beginName(); it != file.endName(); ++it) {
        const std::string name = openvdb::io::GridDescriptor::stripSuffix(
            openvdb::io::GridDescriptor::stringAsUniqueName(it.gridName()));
        if (search.found(name)) return convert(*file.readGrid(it.gridName()), search.described(name), to);
    }
    throw search.missing();
}

void read(std::streambuf& buffer, uint64_t bytes, const VdbRequest& request, VdbReceiver& to) {
    std::istream in(&buffer);
    in.exceptions(std::ios::failbit | std::ios::badbit);
    const bool table = hasTable(in, bytes, request.path);
    if (table && !request.data) return readGrid(request, to);
    in.seekg(0);
    readStream(in, request, to);
}

void read(const VdbRequest& request, VdbReceiver& to) {
    if (request.data) {
        MemoryBuffer buffer(request.data, request.bytes);
        return read(buffer, request.bytes, request, to);
    }
    std::filebuf file;
    if (!file.open(request.path, std::ios::in | std::ios::binary))
        throw Refusal("'" + std::string(request.path) + "' cannot be read");
    read(file, std::filesystem::file_size(request.path), request, to);
}

} // namespace
} // namespace hipr

extern "C" __attribute__((visibility("default"))) void hiprReadVdb(const hipr::VdbRequest& request,
                                                                   hipr::VdbReceiver& to) {
    try {
        openvdb::initialize();
        hipr::read(request, to);
    } catch (const hipr::Refusal& e) {
        to.error(e.what());
    } catch (const std::ios_base::failure&) {
        to.error(hipr::cutShort(request.path).what());
    } catch (const std::exception& e) {
        to.error(("'" + std::string(request.path) + "' cannot be read as OpenVDB: " + e.what()).c_str());
    }
}
