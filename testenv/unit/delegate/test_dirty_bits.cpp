/// Every dirty bit of Hydra becomes what docs/dirty_bits.md says.
#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testenv/unit/delegate/dirty_bits.h"

PXR_NAMESPACE_USING_DIRECTIVE
using namespace PXR_NS::dirtybits;

PXR_NAMESPACE_OPEN_SCOPE
namespace dirtybits {

void PrintTo(Element const& element, std::ostream* out) {
    *out << "{target " << int(element.target) << ": " << hipr::toString(element.change);
    if (element.instance != hipr::ChangedElement::AllInstances) {
        *out << ", instance " << element.instance;
    }
    *out << "}";
}

} // namespace dirtybits
PXR_NAMESPACE_CLOSE_SCOPE

namespace {

/// All bits that the headers of OpenUSD 20.08's pxr/imaging/hd name.
const std::set<std::string>& bitsOfHydra() {
    static const std::set<std::string> bits = [] {
        const std::vector<std::pair<std::string, std::vector<const char*>>> classes = {
            {"HdChangeTracker",
             {"Clean",
              "InitRepr",
              "Varying",
              "AllDirty",
              "DirtyPrimID",
              "DirtyExtent",
              "DirtyDisplayStyle",
              "DirtyPoints",
              "DirtyPrimvar",
              "DirtyMaterialId",
              "DirtyTopology",
              "DirtyTransform",
              "DirtyVisibility",
              "DirtyNormals",
              "DirtyDoubleSided",
              "DirtyCullStyle",
              "DirtySubdivTags",
              "DirtyWidths",
              "DirtyInstancer",
              "DirtyInstanceIndex",
              "DirtyRepr",
              "DirtyRenderTag",
              "DirtyComputationPrimvarDesc",
              "DirtyCategories",
              "DirtyVolumeField",
              "AllSceneDirtyBits",
              "NewRepr",
              "CustomBitsBegin",
              "CustomBitsEnd",
              "DirtyType",
              "DirtyParams",
              "DirtyCollection",
              "DirtyRenderTags"}},
            {"HdLight",
             {"Clean", "DirtyTransform", "DirtyParams", "DirtyShadowParams", "DirtyCollection", "AllDirty"}},
            {"HdMaterial", {"Clean", "DirtyParams", "DirtyResource", "AllDirty"}},
            {"HdCamera",
             {"Clean", "DirtyViewMatrix", "DirtyProjMatrix", "DirtyWindowPolicy", "DirtyClipPlanes",
              "DirtyParams", "AllDirty"}},
            {"HdExtComputation",
             {"Clean", "DirtyInputDesc", "DirtyOutputDesc", "DirtyElementCount", "DirtySceneInput",
              "DirtyCompInput", "DirtyKernel", "DirtyDispatchCount", "AllDirty"}},
            {"HdRenderBuffer", {"Clean", "DirtyDescription", "AllDirty"}},
            {"HdField", {"Clean", "DirtyTransform", "DirtyParams", "AllDirty"}},
            {"HdTexture", {"Clean", "DirtyTexture", "DirtyParams", "AllDirty"}},
            {"HdCoordSys", {"Clean", "DirtyTransform", "AllDirty"}},
        };
        std::set<std::string> names;
        for (auto const& [owner, list] : classes) {
            for (const char* name : list) {
                names.insert(owner + "::" + name);
            }
        }
        return names;
    }();
    return bits;
}

/// Bits of an instancer are some of an rprim's.
const std::set<std::string> instancerBits = {
    "HdChangeTracker::DirtyPrimvar", "HdChangeTracker::DirtyTransform", "HdChangeTracker::DirtyInstanceIndex",
    "HdChangeTracker::DirtyInstancer"};

std::set<std::string> bitsOf(Section const& section) {
    std::set<std::string> bits;
    for (Row const& row : section.rows) {
        bits.insert(row.bit);
    }
    bits.erase("");
    return bits;
}

void check(World& world, Row const& row) {
    row.apply(world, true);
    EXPECT_THAT(world.render(), testing::UnorderedElementsAreArray(row.made)) << "made";
    if (row.again) {
        const double restarted = world.restarted();
        row.apply(world, true);
        EXPECT_THAT(world.render(), testing::IsEmpty()) << "equal values";
        EXPECT_EQ(world.restarted(), restarted) << "the picture started again";
    }
    row.apply(world, false);
    EXPECT_THAT(world.render(), testing::UnorderedElementsAreArray(row.undone.value_or(row.made)))
        << "taken back";
}

} // namespace

TEST(DirtyBits, AllHaveARow) {
    std::set<std::string> named;
    for (Section const& section : allSections()) {
        named.merge(bitsOf(section));
    }
    for (Absent const& absent : absentTypes()) {
        named.insert(absent.bits.begin(), absent.bits.end());
    }
    EXPECT_EQ(named, bitsOfHydra());
    std::set<std::string> ofInstancers = bitsOf(instancerSection());
    ofInstancers.erase("HdChangeTracker::AllDirty");
    EXPECT_EQ(ofInstancers, instancerBits);
}

TEST(DirtyBits, BecomeWhatTheTableSays) {
    World world;
    for (Section const& section : allSections()) {
        for (Row const& row : section.rows) {
            SCOPED_TRACE(std::string(section.title) + ", " + row.bit + ": " + row.edit);
            check(world, row);
        }
    }
}

TEST(DirtyBits, AreNotLeftOnAPrimThatHasSynced) {
    World world;
    for (Section const& section :
         {meshSection(), curvesSection(), pointsSection(), particleFieldSection(), volumeSection()}) {
        for (Row const& row : section.rows) {
            row.apply(world, true);
            world.render();
            row.apply(world, false);
            world.render();
        }
    }
    for (const char* path : {"/square", "/smooth", "/computed", "/many.square", "/inner.square", "/strand",
                             "/dots", "/cloud", "/clouds.cloud", "/fog"}) {
        const HdDirtyBits bits = world.tracker().GetRprimDirtyBits(SdfPath(path));
        EXPECT_EQ(HdChangeTracker::StringifyDirtyBits(bits & ~HdChangeTracker::Varying),
                  HdChangeTracker::StringifyDirtyBits(HdChangeTracker::Clean))
            << path;
    }
}

TEST(DirtyBits, OfABufferLeaveItFilledWithTheSamePicture) {
    World world;
    world.render();
    const auto pixels = [&] {
        HdBprim* prim = world.host().index().GetBprim(HdPrimTypeTokens->renderBuffer, SdfPath("/buffer"));
        auto* buffer = static_cast<HdHiprRenderBuffer*>(prim);
        const float* data = static_cast<const float*>(buffer->Map());
        const std::vector<float> result(data, data + TestHost::width * TestHost::height);
        buffer->Unmap();
        return result;
    };
    const std::vector<float> before = pixels();
    EXPECT_GT(std::set<float>(before.begin(), before.end()).size(), 1u);
    world.tracker().MarkBprimDirty(SdfPath("/buffer"), HdRenderBuffer::DirtyDescription);
    EXPECT_THAT(world.render(), testing::IsEmpty());
    EXPECT_EQ(pixels(), before);
}

TEST(DirtyBits, OfOtherTypesDoNotCome) {
    HdHiprRenderDelegate delegate;
    for (Absent const& absent : absentTypes()) {
        for (TfTokenVector const* types :
             {&delegate.GetSupportedRprimTypes(), &delegate.GetSupportedSprimTypes(),
              &delegate.GetSupportedBprimTypes()}) {
            EXPECT_EQ(std::count(types->begin(), types->end(), TfToken(absent.type)), 0) << absent.type;
        }
    }
}

TEST(DirtyBits, AreInTheRenderStats) {
    World world;
    world.prim("/square").transform.SetTranslate(GfVec3d(0, 0, 1));
    world.prim("/square").material = SdfPath("/green");
    world.tracker().MarkRprimDirty(SdfPath("/square"),
                                   HdChangeTracker::DirtyTransform | HdChangeTracker::DirtyMaterialId);
    world.render();
    const VtDictionary stats = world.host().delegate().GetRenderStats();
    EXPECT_EQ(stats.find("hipr:changedElements")->second.Get<size_t>(), 2u);
    EXPECT_EQ(stats.find("hipr:lastChange")->second.Get<std::string>(), "transform, material");
    EXPECT_EQ(stats.find("hipr:changes")->second.Get<uint64_t>(), world.changes());
}

TEST(DirtyBits, PageIsTheTable) {
    std::ifstream file(HIPR_SOURCE_DIR "/docs/dirty_bits.md");
    std::stringstream committed;
    committed << file.rdbuf();
    if (committed.str() != page()) {
        std::ofstream("dirty_bits.md") << page();
    }
    EXPECT_EQ(committed.str(), page())
        << "Copy the dirty_bits.md that this test has written over docs/dirty_bits.md.";
}
