// Random descriptions, mostly wrong: whatever goes in, what comes out keeps TriangleMesh's promises.
#include <limits>

#include "random_values.h"
#include "test_mesh.h"

namespace hipr::test {
namespace {

class RandomMesh : RandomValues {
public:
    explicit RandomMesh(uint32_t seed)
        : RandomValues(seed, 0.005,
                       {std::nanf(""), std::numeric_limits<float>::infinity(), 1e30f, -1e30f, 1e-40f}) {}

    MeshDesc make() {
        MeshDesc desc;
        desc.name = "/fuzz";
        makeFaces(desc);
        for (int i = integer(0, 3); i > 0; --i)
            desc.holeFaces.push_back(anyIndex(desc.faceVertexCounts.size()));
        desc.subsets.resize(size_t(integer(0, 3)));
        for (FaceSubset& subset : desc.subsets) {
            for (int i = integer(0, 4); i > 0; --i)
                subset.faces.push_back(anyIndex(desc.faceVertexCounts.size()));
        }
        for (int i = integer(0, 4); i > 0; --i)
            desc.primvars.push_back(makePrimvar(desc, i));
        desc.leftHanded = chance(0.5);
        desc.flatNormals = chance(0.1);
        desc.scheme = SubdivisionScheme(integer(0, 3));
        desc.refineLevel = chance(0.05) ? integer(-2, 0) : integer(0, 3);
        desc.boundary = BoundaryInterpolation(integer(0, 2));
        desc.faceVaryingLinear = FaceVaryingInterpolation(integer(0, 5));
        desc.triangleSubdivision = TriangleSubdivision(integer(0, 1));
        makeSharpness(desc);
        return desc;
    }

    void makePoints(MeshDesc& desc) {
        for (glm::vec3& p : desc.points)
            p = glm::vec3(coordinate(), coordinate(), coordinate());
    }

private:
    int anyIndex(size_t size) {
        if (chance(0.02)) return integer(-2, int(size) + 1);
        return size == 0 ? 0 : integer(0, int(size) - 1);
    }

    void makeFaces(MeshDesc& desc) {
        desc.points.resize(size_t(integer(chance(0.05) ? 0 : 4, 12)));
        makePoints(desc);
        const bool trianglesOnly = chance(0.3);
        for (int faces = integer(0, 12); faces > 0; --faces) {
            const int count = trianglesOnly ? 3 : chance(0.03) ? integer(-1, 2) : integer(3, 9);
            desc.faceVertexCounts.push_back(count);
            for (int i = 0; i < count; ++i)
                desc.faceVertexIndices.push_back(anyIndex(desc.points.size()));
        }
        if (chance(0.05)) desc.faceVertexCounts.push_back(chance(0.5) ? 4 : 2147483647);
        if (chance(0.05)) desc.faceVertexIndices.push_back(0);
    }

    Primvar makePrimvar(const MeshDesc& desc, int number_) {
        Primvar primvar;
        primvar.name = chance(0.3) ? "normals" : "p" + std::to_string(number_);
        primvar.interpolation = Interpolation(integer(0, 3));
        primvar.components = chance(0.5) ? 3 : uint32_t(integer(chance(0.05) ? 0 : 1, chance(0.05) ? 5 : 4));
        primvar.linear = chance(0.3);
        const size_t sizes[] = {1, desc.faceVertexCounts.size(), desc.points.size(),
                                desc.faceVertexIndices.size()};
        const size_t elements = sizes[size_t(primvar.interpolation)];
        const size_t values = chance(0.1) ? size_t(integer(0, 20)) : elements;
        for (size_t i = values * primvar.components; i > 0; --i)
            primvar.values.push_back(number());
        if (chance(0.4)) {
            for (size_t i = chance(0.1) ? 3 : elements; i > 0; --i)
                primvar.indices.push_back(anyIndex(values));
        }
        return primvar;
    }

    void makeSharpness(MeshDesc& desc) {
        for (int crease = integer(0, 3); crease > 0; --crease) {
            const int length = chance(0.05) ? integer(-1, 1) : integer(2, 4);
            desc.creaseLengths.push_back(length);
            for (int i = 0; i < length; ++i)
                desc.creaseIndices.push_back(anyIndex(desc.points.size()));
            desc.creaseWeights.push_back(chance(0.3) ? 10.f : 3.f * number());
        }
        for (int corner = integer(0, 2); corner > 0; --corner) {
            desc.cornerIndices.push_back(anyIndex(desc.points.size()));
            desc.cornerWeights.push_back(chance(0.5) ? 10.f : number());
        }
        if (chance(0.05)) desc.cornerWeights.push_back(1.f);
    }
};

void expectPromisesKept(const TriangleMesh& mesh, const MeshDesc& desc) {
    ASSERT_EQ(mesh.triangleFace.size(), mesh.triangles.size());
    for (const glm::vec3& p : mesh.positions)
        ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        ASSERT_LT(mesh.triangleFace[t], desc.faceVertexCounts.size());
        for (int k = 0; k < 3; ++k) {
            ASSERT_LT(mesh.triangles[t][k], mesh.positions.size());
            ASSERT_NE(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
            const glm::vec3 p = mesh.positions[mesh.triangles[t][k]];
            ASSERT_TRUE(glm::min(p, mesh.boundsMin) == mesh.boundsMin &&
                        glm::max(p, mesh.boundsMax) == mesh.boundsMax);
        }
    }
    ASSERT_TRUE(mesh.triangleSlot.empty() || mesh.triangleSlot.size() == mesh.triangles.size());
    for (const uint16_t slot : mesh.triangleSlot)
        ASSERT_LE(slot, desc.subsets.size());
    if (!mesh.normals.empty()) {
        ASSERT_EQ(mesh.normals.size(), mesh.normalInterpolation == Interpolation::Vertex
                                           ? mesh.positions.size()
                                           : mesh.triangles.size() * 3);
    }
    for (const glm::vec3& n : mesh.normals)
        ASSERT_NEAR(glm::length(n), 1.f, 1e-4f);
    for (const TrianglePrimvar& primvar : mesh.primvars) {
        const size_t sizes[] = {1, mesh.triangles.size(), mesh.positions.size(), mesh.triangles.size() * 3};
        ASSERT_EQ(primvar.values.size(), sizes[size_t(primvar.interpolation)] * primvar.components);
        for (const float v : primvar.values)
            ASSERT_TRUE(std::isfinite(v)) << primvar.name;
    }
}

TEST(Fuzz, AnyDescriptionGivesAMeshThatKeepsItsPromises) {
    for (uint32_t seed = 0; seed < 5000 && !testing::Test::HasFatalFailure(); ++seed) {
        SCOPED_TRACE(seed);
        RandomMesh random(seed);
        MeshDesc desc = random.make();
        Messages messages;
        const auto mesh = buildTriangleMesh(desc, messages.sink());
        expectPromisesKept(*mesh, desc);
        random.makePoints(desc);
        expectPromisesKept(*updatePoints(*mesh, desc, messages.sink()), desc);
    }
}

} // namespace
} // namespace hipr::test
