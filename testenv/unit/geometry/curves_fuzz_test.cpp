// Random curves, mostly wrong: whatever goes in, what comes out keeps TriangleMesh's promises.
#include <algorithm>
#include <limits>
#include <set>

#include "random_values.h"
#include "renderer/api/curves.h"
#include "test_mesh.h"

namespace hipr::test {
namespace {

constexpr float Infinity = std::numeric_limits<float>::infinity();

class RandomCurves : RandomValues {
public:
    explicit RandomCurves(uint32_t seed)
        : RandomValues(seed, 0.01, {std::nanf(""), Infinity, 1e30f, -1e30f, 3e38f, -3e38f, 1e-40f}) {}

    CurvesDesc make() {
        CurvesDesc desc;
        desc.name = "/fuzz";
        desc.basis = CurveBasis(integer(0, 3));
        desc.wrap = CurveWrap(integer(0, desc.basis == CurveBasis::Linear ? 3 : 2));
        desc.refineLevel = chance(0.01) ? integer(-3, 9) : integer(0, 1);
        desc.width = chance(0.3) ? 0.001f : number();
        makeCounts(desc);
        for (int i = integer(0, 2); i > 0; --i)
            desc.hiddenCurves.push_back(integer(-1, int(desc.vertexCounts.size())));
        for (int i = integer(0, 4); i > 0; --i)
            desc.primvars.push_back(makePrimvar(desc, i));
        return desc;
    }

    void makePoints(CurvesDesc& desc) {
        for (glm::vec3& p : desc.points)
            p = {coordinate(), coordinate(), coordinate()};
    }

private:
    void makeCounts(CurvesDesc& desc) {
        int controls = 0;
        for (int curves = integer(0, 8); curves > 0; --curves) {
            const int count = chance(0.05) ? integer(-2, 1) : integer(2, 9);
            desc.vertexCounts.push_back(count);
            controls += std::max(count, 0);
        }
        // Sums that no 32 bits hold: where the last of these ends, counting begins anew.
        for (int times = chance(0.1) ? integer(1, 5) : 0; times > 0; --times)
            desc.vertexCounts.insert(desc.vertexCounts.begin() + integer(0, int(desc.vertexCounts.size())),
                                     2147483647);
        desc.points.resize(size_t(chance(0.1) ? integer(0, 30) : controls));
        makePoints(desc);
        if (!chance(0.3)) return;
        for (int i = chance(0.1) ? integer(0, 30) : controls; i > 0; --i)
            desc.pointIndices.push_back(chance(0.01) ? integer(-2, 40)
                                                     : integer(0, std::max(int(desc.points.size()) - 1, 0)));
    }

    Primvar makePrimvar(const CurvesDesc& desc, int number_) {
        Primvar primvar;
        primvar.name = number_ == 1 && chance(0.8)   ? "widths"
                       : number_ == 2 && chance(0.2) ? "normals"
                                                     : "p" + std::to_string(number_);
        primvar.interpolation = Interpolation(integer(0, 3));
        primvar.components = primvar.name == "widths" ? 1
                             : chance(0.5)            ? 3
                                                      : uint32_t(integer(chance(0.1) ? 0 : 1, 5));
        primvar.linear = chance(0.3);
        const size_t varying = std::min(varyingCount(desc), size_t(100));
        const size_t sizes[] = {1, desc.vertexCounts.size(), primvar.linear ? varying : desc.points.size(),
                                varying};
        const size_t elements = sizes[size_t(primvar.interpolation)];
        const size_t values = chance(0.1) ? size_t(integer(0, 20)) : elements;
        for (size_t i = values * primvar.components; i > 0; --i)
            primvar.values.push_back(chance(0.9) ? float(integer(0, 3)) * 0.001f : number());
        for (size_t i = chance(0.3) ? elements : 0; i > 0; --i)
            primvar.indices.push_back(chance(0.01) ? integer(-1, 40)
                                                   : integer(0, std::max(int(values) - 1, 0)));
        return primvar;
    }
};

void expectTriangles(const TriangleMesh& mesh) {
    ASSERT_TRUE(mesh.segments.empty() && mesh.radii.empty());
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            ASSERT_LT(t[k], mesh.positions.size());
}

void expectSegments(const TriangleMesh& mesh) {
    ASSERT_EQ(mesh.radii.size(), mesh.positions.size());
    for (const uint32_t first : mesh.segments) {
        ASSERT_GT(first, 0u);
        ASSERT_LT(first + 2, mesh.positions.size());
    }
    for (const float r : mesh.radii)
        ASSERT_TRUE(r >= 0.f && std::isfinite(r)) << r;
}

void expectPromisesKept(const TriangleMesh& mesh, const CurvesDesc& desc) {
    mesh.radii.empty() ? expectTriangles(mesh) : expectSegments(mesh);
    ASSERT_EQ(mesh.triangleFace.size(), mesh.primitiveCount());
    for (const uint32_t curve : mesh.triangleFace)
        ASSERT_LT(curve, desc.vertexCounts.size());
    for (const glm::vec3& p : mesh.positions)
        ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    ASSERT_TRUE(glm::all(glm::lessThanEqual(mesh.boundsMin, mesh.boundsMax)));
    if (mesh.empty()) return; // nobody reads its primvars
    for (const TrianglePrimvar& primvar : mesh.primvars) {
        const size_t primitives = mesh.radii.empty() ? mesh.triangleFace.size() : desc.vertexCounts.size();
        const size_t sizes[] = {1, primitives, mesh.positions.size(), 0};
        ASSERT_EQ(primvar.values.size(), sizes[size_t(primvar.interpolation)] * primvar.components)
            << primvar.name;
    }
}

TEST(CurvesFuzz, AnyDescriptionGivesAMeshThatKeepsItsPromises) {
    size_t round = 0, tubes = 0;
    for (uint32_t seed = 0; seed < 5000 && !testing::Test::HasFatalFailure(); ++seed) {
        SCOPED_TRACE(seed);
        RandomCurves random(seed);
        CurvesDesc desc = random.make();
        Messages messages;
        const auto mesh = buildCurves(desc, messages.sink());
        expectPromisesKept(*mesh, desc);
        EXPECT_EQ(std::set<std::string>(messages.texts.begin(), messages.texts.end()).size(),
                  messages.texts.size())
            << "told twice";
        (mesh->segments.empty() ? tubes : round) += mesh->empty() ? 0 : 1;
        desc.form = curveForm(desc);
        random.makePoints(desc);
        expectPromisesKept(*buildCurves(desc, messages.sink()), desc);
    }
    EXPECT_GT(round, 300u);
    EXPECT_GT(tubes, 300u);
}

TEST(CurvesFuzz, CountsThatNoPointsAnswerToAreDropped) {
    CurvesDesc desc;
    desc.name = "/long";
    desc.vertexCounts = {2, 2147483647, 2147483647, 4};
    desc.points.assign(6, glm::vec3(0.f));
    desc.points[1].x = 1.f;
    Messages messages;
    const auto mesh = buildCurves(desc, messages.sink());
    ASSERT_FALSE(mesh->empty());
    EXPECT_EQ(*std::max_element(mesh->triangleFace.begin(), mesh->triangleFace.end()), 0u);
    ASSERT_EQ(messages.texts.size(), 1u);
    EXPECT_EQ(messages.texts[0],
              "/long: 3 curves dropped: their control points are beyond the end of the points");
}

} // namespace
} // namespace hipr::test
