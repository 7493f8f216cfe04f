#include "renderer/geometry/cage.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hipr::geometry {

namespace {

constexpr int MaxRefineLevel = 8;
constexpr float InfinitelySharp = 10.f;
/// More triangles than this from one mesh are taken for a mistake: refinement would need tens of gigabytes.
constexpr double MaxRefinedTriangles = double(1u << 26);
/// OpenSubdiv numbers the corners of a face with 16 bits.
constexpr uint32_t MaxFaceSize = 65535;

bool isVertex(const MeshDesc& desc, int index) {
    return index >= 0 && size_t(index) < desc.points.size();
}

/// USD gives either one sharpness per crease or one per crease edge.
bool creaseSizesFit(const MeshDesc& desc) {
    size_t vertices = 0, edges = 0;
    for (const int length : desc.creaseLengths) {
        if (length < 2) return false;
        vertices += size_t(length);
        edges += size_t(length) - 1;
    }
    return vertices == desc.creaseIndices.size() &&
           (desc.creaseWeights.size() == desc.creaseLengths.size() || desc.creaseWeights.size() == edges);
}

void readCreases(const MeshDesc& desc, const MessageSink& messages, Cage& cage) {
    if (desc.creaseLengths.empty() && desc.creaseIndices.empty()) return;
    if (!creaseSizesFit(desc)) {
        warn(messages, desc.name,
             "creases ignored: " + std::to_string(desc.creaseIndices.size()) + " indices, " +
                 std::to_string(desc.creaseLengths.size()) + " lengths and " +
                 std::to_string(desc.creaseWeights.size()) + " sharpnesses do not fit each other");
        return;
    }
    const bool perCrease = desc.creaseWeights.size() == desc.creaseLengths.size();
    size_t first = 0, edge = 0, bad = 0;
    for (size_t crease = 0; crease < desc.creaseLengths.size(); ++crease) {
        const size_t last = first + size_t(desc.creaseLengths[crease]) - 1;
        for (size_t i = first; i < last; ++i, ++edge) {
            const float weight = desc.creaseWeights[perCrease ? crease : edge];
            const int v0 = desc.creaseIndices[i], v1 = desc.creaseIndices[i + 1];
            if (isVertex(desc, v0) && isVertex(desc, v1) && v0 != v1 && !std::isnan(weight)) {
                cage.creases.push_back(
                    {uint32_t(v0), uint32_t(v1), std::clamp(weight, 0.f, InfinitelySharp)});
            } else {
                ++bad;
            }
        }
        first = last + 1;
    }
    if (bad) {
        warn(messages, desc.name,
             std::to_string(bad) +
                 " crease edges ignored: vertices outside the points array or NaN sharpness");
    }
}

void readCorners(const MeshDesc& desc, const MessageSink& messages, Cage& cage) {
    if (desc.cornerIndices.size() != desc.cornerWeights.size()) {
        warn(messages, desc.name,
             "corners ignored: " + std::to_string(desc.cornerIndices.size()) + " indices but " +
                 std::to_string(desc.cornerWeights.size()) + " sharpnesses");
        return;
    }
    size_t bad = 0;
    for (size_t i = 0; i < desc.cornerIndices.size(); ++i) {
        const float weight = desc.cornerWeights[i];
        if (isVertex(desc, desc.cornerIndices[i]) && !std::isnan(weight)) {
            cage.corners.push_back(
                {uint32_t(desc.cornerIndices[i]), std::clamp(weight, 0.f, InfinitelySharp)});
        } else {
            ++bad;
        }
    }
    if (bad) {
        warn(messages, desc.name,
             std::to_string(bad) + " corners ignored: vertices outside the points array or NaN sharpness");
    }
}

double refinedTriangles(const Cage& cage, int level) {
    const double faces = double(cage.polygons.faceCount());
    // A Catmull-Clark or bilinear step turns an n-gon into n quads, a Loop step a triangle into four.
    const double firstLevel =
        cage.scheme == SubdivisionScheme::Loop ? 4.0 * faces : 2.0 * double(cage.polygons.vertex.size());
    return firstLevel * std::pow(4.0, level - 1);
}

void readScheme(const MeshDesc& desc, const MessageSink& messages, Cage& cage) {
    cage.scheme = desc.scheme;
    if (cage.scheme != SubdivisionScheme::Loop) return;
    size_t others = 0;
    for (size_t face = 0; face < cage.polygons.faceCount(); ++face)
        others += cage.polygons.faceSize(face) != 3;
    if (others == 0) return;
    cage.scheme = SubdivisionScheme::CatmullClark;
    warn(messages, desc.name,
         "loop subdivision needs triangles, but " + std::to_string(others) + " of " +
             std::to_string(cage.polygons.faceCount()) + " faces are not; catmullClark is used");
}

void readRefineLevel(const MeshDesc& desc, const MessageSink& messages, Cage& cage) {
    const auto lower = [&](int level, const std::string& reason) {
        warn(messages, desc.name,
             "refine level " + std::to_string(desc.refineLevel) + " changed to " + std::to_string(level) +
                 ": " + reason);
        cage.refineLevel = level;
    };
    cage.refineLevel = desc.refineLevel;
    if (desc.refineLevel < 0 || desc.refineLevel > MaxRefineLevel) {
        lower(std::clamp(desc.refineLevel, 0, MaxRefineLevel),
              "levels 0 to " + std::to_string(MaxRefineLevel) + " are supported");
    }
    int level = cage.refineLevel;
    while (level > 0 && refinedTriangles(cage, level) > MaxRefinedTriangles)
        --level;
    if (level < cage.refineLevel) lower(level, "it would make more than 67 million triangles");
    uint32_t largest = 0;
    for (size_t face = 0; face < cage.polygons.faceCount(); ++face) {
        largest = std::max(largest, cage.polygons.faceSize(face));
    }
    if (cage.refineLevel > 0 && largest > MaxFaceSize) {
        lower(0, "a face has " + std::to_string(largest) + " vertices");
    }
}

} // namespace

void validateSubdivision(const MeshDesc& desc, const MessageSink& messages, Cage& cage) {
    readScheme(desc, messages, cage);
    if (cage.scheme == SubdivisionScheme::None) return;
    readRefineLevel(desc, messages, cage);
    readCreases(desc, messages, cage);
    readCorners(desc, messages, cage);
}

} // namespace hipr::geometry
