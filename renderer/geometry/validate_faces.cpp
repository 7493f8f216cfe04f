#include "renderer/geometry/cage.h"

#include <cmath>

namespace hipr::geometry {

namespace {

/// What validateFaces found, by kind.
struct FaceProblems {
    size_t negative = 0, tooSmall = 0, beyondIndices = 0, badIndex = 0, badPoint = 0, degenerate = 0;
};

std::string facesOf(size_t count, const MeshDesc& desc) {
    return std::to_string(count) + " of " + std::to_string(desc.faceVertexCounts.size()) + " faces";
}

/// One byte per point that is NaN or infinite; empty when all are finite, the common case.
std::vector<uint8_t> findBadPoints(const MeshDesc& desc) {
    std::vector<uint8_t> bad;
    for (size_t i = 0; i < desc.points.size(); ++i) {
        if (isFinite(desc.points[i])) continue;
        bad.resize(desc.points.size(), 0);
        bad[i] = 1;
    }
    return bad;
}

/// Appends faces to a Cage one by one, in authored order.
class FaceReader {
public:
    FaceReader(const MeshDesc& desc, Cage& cage) : _desc(desc), _cage(cage), _badPoints(findBadPoints(desc)) {
        const size_t faces = desc.faceVertexCounts.size();
        cage.polygons.faceStart.reserve(faces + 1);
        cage.faceSource.reserve(faces);
        cage.polygons.vertex.reserve(desc.faceVertexIndices.size());
        cage.cornerSource.reserve(desc.faceVertexIndices.size());
    }

    void read(uint32_t face) {
        const int count = _desc.faceVertexCounts[face];
        if (count < 0) {
            ++problems.negative;
            return;
        }
        const uint64_t first = cornersRead;
        cornersRead += uint64_t(count);
        if (cornersRead > _desc.faceVertexIndices.size()) {
            ++problems.beyondIndices;
        } else if (count < 3) {
            ++problems.tooSmall;
        } else if (verticesAreGood(first, count)) {
            append(face, uint32_t(first), uint32_t(count));
        }
    }

    FaceProblems problems;
    uint64_t cornersRead = 0; ///< sum of the counts so far

private:
    bool verticesAreGood(uint64_t first, int count) {
        const int* vertices = _desc.faceVertexIndices.data() + first;
        for (int i = 0; i < count; ++i) {
            if (vertices[i] < 0 || size_t(vertices[i]) >= _desc.points.size()) {
                ++problems.badIndex;
                return false;
            }
        }
        for (int i = 0; i < count && !_badPoints.empty(); ++i) {
            if (_badPoints[size_t(vertices[i])]) {
                ++problems.badPoint;
                return false;
            }
        }
        return true;
    }

    /// Turns left-handed faces round (keeping their first corner) and skips corners that repeat the one
    /// before.
    void append(uint32_t face, uint32_t first, uint32_t count) {
        std::vector<uint32_t>& vertex = _cage.polygons.vertex;
        const size_t start = vertex.size();
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t corner = first + (_desc.leftHanded && i > 0 ? count - i : i);
            const uint32_t v = uint32_t(_desc.faceVertexIndices[corner]);
            if (vertex.size() > start && vertex.back() == v) continue;
            vertex.push_back(v);
            _cage.cornerSource.push_back(corner);
        }
        while (vertex.size() > start + 1 && vertex.back() == vertex[start])
            dropLastCorner();
        if (vertex.size() < start + 3) {
            while (vertex.size() > start)
                dropLastCorner();
            ++problems.degenerate;
            return;
        }
        _cage.polygons.faceStart.push_back(uint32_t(vertex.size()));
        _cage.faceSource.push_back(face);
    }

    void dropLastCorner() {
        _cage.polygons.vertex.pop_back();
        _cage.cornerSource.pop_back();
    }

    const MeshDesc& _desc;
    Cage& _cage;
    std::vector<uint8_t> _badPoints;
};

void reportFaces(const MeshDesc& desc, const MessageSink& messages, const FaceReader& reader) {
    const FaceProblems& p = reader.problems;
    if (desc.faceVertexCounts.empty() || desc.points.empty()) {
        warn(messages, desc.name,
             "mesh is empty (" + std::to_string(desc.points.size()) + " points, " +
                 std::to_string(desc.faceVertexCounts.size()) + " faces); nothing to render");
        return;
    }
    if (reader.cornersRead != desc.faceVertexIndices.size()) {
        warn(messages, desc.name,
             "faceVertexCounts add up to " + std::to_string(reader.cornersRead) + " but there are " +
                 std::to_string(desc.faceVertexIndices.size()) + " faceVertexIndices; " +
                 (p.beyondIndices ? facesOf(p.beyondIndices, desc) + " dropped"
                                  : std::string("the surplus is ignored")));
    }
    const auto dropped = [&](size_t count, const char* reason) {
        if (count) warn(messages, desc.name, facesOf(count, desc) + " dropped: " + reason);
    };
    dropped(p.negative, "negative faceVertexCounts");
    dropped(p.tooSmall, "fewer than 3 vertices");
    dropped(p.badIndex, "faceVertexIndices outside the points array");
    dropped(p.badPoint, "points that are NaN or infinite");
    dropped(p.degenerate, "fewer than 3 different vertices");
}

/// Authored face index -> used once; counts what lies outside or comes twice.
struct FaceSetProblems {
    size_t outside = 0, repeated = 0;

    void report(const MeshDesc& desc, const MessageSink& messages, const char* what) const {
        if (outside) {
            warn(messages, desc.name,
                 std::to_string(outside) + " " + what + " ignored: no such face (the mesh has " +
                     std::to_string(desc.faceVertexCounts.size()) + ")");
        }
        if (repeated) {
            warn(messages, desc.name,
                 std::to_string(repeated) + " " + what + " ignored: face already listed");
        }
    }
};

void readHoles(const MeshDesc& desc, const MessageSink& messages, Cage& cage) {
    if (desc.holeFaces.empty()) return;
    FaceSetProblems problems;
    std::vector<uint8_t> isHole(desc.faceVertexCounts.size(), 0);
    for (const int face : desc.holeFaces) {
        if (face < 0 || size_t(face) >= isHole.size()) {
            ++problems.outside;
        } else {
            problems.repeated += isHole[size_t(face)];
            isHole[size_t(face)] = 1;
        }
    }
    problems.report(desc, messages, "hole indices");
    cage.faceIsHole.reserve(cage.faceSource.size());
    for (const uint32_t face : cage.faceSource)
        cage.faceIsHole.push_back(isHole[face]);
}

void readSubsets(const MeshDesc& desc, const MessageSink& messages, Cage& cage) {
    if (desc.subsets.empty()) return;
    FaceSetProblems problems;
    std::vector<uint16_t> slot(desc.faceVertexCounts.size(), 0);
    const size_t slots = std::min<size_t>(desc.subsets.size(), std::numeric_limits<uint16_t>::max());
    for (size_t s = 0; s < slots; ++s) {
        for (const int face : desc.subsets[s].faces) {
            if (face < 0 || size_t(face) >= slot.size()) {
                ++problems.outside;
            } else if (slot[size_t(face)] != 0) {
                ++problems.repeated;
            } else {
                slot[size_t(face)] = uint16_t(s + 1);
            }
        }
    }
    problems.report(desc, messages, "subset face indices");
    if (slots < desc.subsets.size()) {
        warn(messages, desc.name,
             std::to_string(desc.subsets.size() - slots) + " subsets beyond the first " +
                 std::to_string(slots) + " ignored");
    }
    cage.faceSlot.reserve(cage.faceSource.size());
    for (const uint32_t face : cage.faceSource)
        cage.faceSlot.push_back(slot[face]);
}

} // namespace

void warn(const MessageSink& messages, const std::string& mesh, const std::string& text) {
    if (messages) messages(Severity::Warning, mesh, text);
}

bool isFinite(const glm::vec3& point) {
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

Cage validateFaces(const MeshDesc& desc, const MessageSink& messages) {
    Cage cage;
    FaceReader reader(desc, cage);
    for (size_t face = 0; face < desc.faceVertexCounts.size(); ++face)
        reader.read(uint32_t(face));
    reportFaces(desc, messages, reader);
    readHoles(desc, messages, cage);
    readSubsets(desc, messages, cage);
    return cage;
}

} // namespace hipr::geometry
