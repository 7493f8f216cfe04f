// OpenVDB files of all kinds, and what is said of those that cannot be used.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/volumes/vdb_reader.h"
#include "testenv/common/vdb_kit.h"

namespace hipr::test {
namespace {

using ::testing::HasSubstr;
using Kind = VdbGrid::Kind;

std::string written(const std::string& name, const std::vector<VdbGrid>& grids) {
    const std::string path = ::testing::TempDir() + name + ".vdb";
    writeVdb(path, grids);
    return path;
}

std::string written(const std::string& name, Kind kind) {
    VdbGrid grid;
    grid.kind = kind;
    return written(name, std::vector<VdbGrid>{grid});
}

std::vector<unsigned char> bytesOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

float largest(const FieldGrid& grid) {
    return *std::max_element(grid.values.begin(), grid.values.end());
}

TEST(Vdb, ReadsNumbersOfEveryKind) {
    for (const Kind kind : {Kind::Float, Kind::Half, Kind::Double, Kind::Int, Kind::Bool}) {
        const FieldFile file = readVdbFile(written("kind", kind), {"density", 0});
        ASSERT_TRUE(file.grid) << file.error;
        EXPECT_EQ(file.grid->channels, 1u);
        EXPECT_EQ(largest(*file.grid), 1.f);
        EXPECT_EQ(file.warning, "");
    }
}

TEST(Vdb, MemoryGivesTheGridOfTheFile) {
    VdbGrid other;
    other.name = "temperature";
    other.value = [](glm::ivec3 p) { return 100.0 + p.x; };
    const std::string path = written("memory", {VdbGrid(), other});
    const std::vector<unsigned char> bytes = bytesOf(path);
    for (const char* name : {"density", "temperature"}) {
        const FieldFile a = readVdbFile(path, {name, 0});
        const FieldFile b = readVdbMemory(bytes.data(), bytes.size(), path, {name, 0});
        ASSERT_TRUE(a.grid && b.grid) << a.error << b.error;
        EXPECT_EQ(a.grid->values, b.grid->values);
        EXPECT_EQ(a.grid->index, b.grid->index);
        EXPECT_EQ(a.grid->latticeToObject, b.grid->latticeToObject);
    }
}

TEST(Vdb, IndexTellsGridsOfOneNameApart) {
    std::vector<VdbGrid> grids(2);
    grids[1].value = [](glm::ivec3) { return 5.0; };
    const std::string path = written("twins", grids);
    const FieldFile first = readVdbFile(path, {"density", 0}), second = readVdbFile(path, {"density", 1});
    ASSERT_TRUE(first.grid && second.grid) << first.error << second.error;
    EXPECT_EQ(largest(*first.grid) + largest(*second.grid), 6.f);
    EXPECT_THAT(readVdbFile(path, {"density", 2}).error, HasSubstr("number 2"));
}

TEST(Vdb, TilesOfOneValueShareABrick) {
    VdbGrid grid;
    grid.lo = glm::ivec3(-64);
    grid.hi = glm::ivec3(63);
    grid.tile = true;
    const FieldFile file = readVdbFile(written("tile", std::vector<VdbGrid>{grid}), {});
    ASSERT_TRUE(file.grid) << file.error;
    EXPECT_EQ(file.grid->bricks, glm::uvec3(17)); // those before the tile hold the way up to it
    EXPECT_EQ(file.grid->index.size(), 17u * 17 * 17);
    EXPECT_LT(file.grid->brickCount(), 1700u);
    EXPECT_EQ(file.grid->first, glm::ivec3(-72));
}

TEST(Vdb, SaysWhatIsWrong) {
    EXPECT_THAT(readVdbFile("/nowhere.vdb", {}).error, HasSubstr("cannot be read"));
    const std::string path = written("named", Kind::Float);
    EXPECT_THAT(readVdbFile(path, {"smoke", 0}).error, HasSubstr("has no grid 'smoke'; it has 'density'"));
    EXPECT_THAT(readVdbFile(written("level_set", Kind::LevelSet), {}).error, HasSubstr("level set"));
    EXPECT_THAT(readVdbFile(written("frustum", Kind::Frustum), {}).error, HasSubstr("not affine"));
    EXPECT_THAT(readVdbFile(written("mask", Kind::Mask), {}).error, HasSubstr("of type 'Tree_mask_5_4_3'"));
    EXPECT_THAT(readVdbFile(written("none", std::vector<VdbGrid>{}), {"density", 0}).error,
                HasSubstr("none at all"));

    VdbGrid broken;
    broken.value = [](glm::ivec3 p) {
        return p.x == 1 ? std::nan("") : p.x == 2 ? -3.0 : p.x == 3 ? INFINITY : 1.0;
    };
    const FieldFile file = readVdbFile(written("broken", std::vector<VdbGrid>{broken}), {});
    ASSERT_TRUE(file.grid);
    EXPECT_THAT(file.warning, HasSubstr("count as 0"));
    EXPECT_EQ(largest(*file.grid), 1.f);
}

void expectRefused(const FieldFile& file, size_t length, size_t whole) {
    EXPECT_TRUE(!file.grid && !file.error.empty()) << length << " of " << whole;
}

/// Any part of a file is an error and never the end of the process, in memory and on disk.
TEST(Vdb, RefusesFilesThatAreCutShort) {
    const std::vector<unsigned char> bytes = bytesOf(written("whole", Kind::Float));
    const std::string path = ::testing::TempDir() + "part.vdb";
    for (size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 60) {
        expectRefused(readVdbMemory(bytes.data(), length, "part", {}), length, bytes.size());
        std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), length);
        expectRefused(readVdbFile(path, {}), length, bytes.size());
    }
    EXPECT_THAT(readVdbMemory(bytes.data(), bytes.size() - 1, "part", {}).error,
                HasSubstr("'part' is damaged: it ends too early"));
}

/// As if it had been written to a pipe: the byte that says so follows five numbers of four bytes.
TEST(Vdb, ReadsFilesWithoutATable) {
    const std::string path = written("whole", Kind::Float);
    std::vector<unsigned char> bytes = bytesOf(path);
    bytes.at(20) = 0;
    for (const size_t missing : {0, 1}) {
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), bytes.size() - missing);
        const FieldFile file = readVdbFile(path, {});
        EXPECT_EQ(!file.grid, missing == 1) << file.error;
        EXPECT_EQ(file.error.empty(), missing == 0);
    }
}

TEST(Vdb, SaysWhereTheModuleIsMissing) {
    const VdbModule none = openVdbModule({"/nowhere", "/neither/here"});
    EXPECT_FALSE(none.read);
    EXPECT_THAT(none.error, HasSubstr("hipr_vdb.so, is not in '/nowhere' '/neither/here'"));
    const std::string folder = ::testing::TempDir();
    std::ofstream(folder + VdbModuleFile) << "no library";
    EXPECT_THAT(openVdbModule({"/nowhere", folder}).error, HasSubstr(VdbModuleFile));
    EXPECT_FALSE(openVdbModule({folder}).read);
    std::remove((folder + VdbModuleFile).c_str());
    EXPECT_TRUE(openVdbModule(vdbModuleFolders()).read);
}

} // namespace
} // namespace hipr::test
