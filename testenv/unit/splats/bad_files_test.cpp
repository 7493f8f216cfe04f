// Broken and hostile files give one clear error each.
#include <fstream>

#include <gmock/gmock.h>

#include "splat_kit.h"

namespace hipr::test {
namespace {

using testing::HasSubstr;

std::string good(const char* format = "binary_little_endian") {
    return plyFile(columnsOf(randomCloud(100, 1)), {format});
}

std::string replaced(std::string file, const std::string& what, const std::string& by) {
    const size_t at = file.find(what);
    EXPECT_NE(at, file.npos) << what;
    return file.replace(at, what.size(), by);
}

/// The header of `good`, and nothing behind it.
std::string header(const char* format) {
    const std::string file = good(format);
    return file.substr(0, file.find("end_header\n") + 11);
}

TEST(BadPly, TheGoodOneIsGood) {
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
        EXPECT_EQ(errorOf(good(format)), "");
}

TEST(BadPly, CutOffAnywhereIsAnError) {
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        const std::string file = good(format);
        // The last number of a text may lose digits without anybody noticing.
        const size_t most = file.size() - (std::string(format) == "ascii" ? 40 : 1);
        for (size_t size = 0; size <= most; size += size < 1200 || size + 100 > most ? 1 : 13)
            EXPECT_NE(errorOf(file.substr(0, size)), "") << format << ", " << size << " bytes";
        EXPECT_THAT(errorOf(file.substr(0, file.size() / 2)), HasSubstr("cut off")) << format;
    }
}

TEST(BadPly, CountsThatTheFileCannotHoldAreNotBelieved) {
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
        for (const char* count : {"101", "100000", "4294967296", "1000000000000", "18446744073709551615"})
            EXPECT_THAT(errorOf(replaced(good(format), "vertex 100", std::string("vertex ") + count)),
                        HasSubstr("cut off"))
                << format << " " << count;
    for (const char* count : {"-1", "1e3", "18446744073709551616", "many", ""})
        EXPECT_THAT(errorOf(replaced(good(), "vertex 100", std::string("vertex ") + count)),
                    HasSubstr("without a valid count"))
            << count;
}

TEST(BadPly, CountsOfOtherElementsAreNotBelievedEither) {
    for (const char* format : {"ascii", "binary_little_endian"})
        for (const char* property :
             {"property float a", "property list uchar int a", "property list double int a"})
            EXPECT_NE(errorOf(replaced(good(format), "element vertex",
                                       "element face 18446744073709551615\n" + std::string(property) +
                                           "\nelement vertex")),
                      "")
                << format << " " << property;
}

TEST(BadPly, ListsThatAreTooLongAreAnError) {
    for (const auto& [type, count] :
         {std::pair("uint", 4e9), std::pair("float", 1e30), std::pair("float", 2.5), std::pair("int", -1.),
          std::pair("double", double(NAN))}) {
        PlyStyle style;
        style.before = std::string("element face 1\nproperty list ") + type + " int indices\n";
        style.bodyBefore = encoded(count, type, style.format);
        EXPECT_NE(errorOf(plyFile(columnsOf(randomCloud(100, 1)), style)), "") << type << " " << count;
    }
}

TEST(BadPly, MissingAndRepeatedPropertiesAreNamed) {
    for (const char* name : {"x", "rot_3", "scale_0", "opacity", "f_dc_1", "f_rest_4"})
        EXPECT_THAT(errorOf(replaced(good(), std::string(" ") + name + "\n", " other\n")),
                    HasSubstr("lacks the property '" + std::string(name) + "'"));
    EXPECT_THAT(errorOf(replaced(good(), " y\n", " x\n")), HasSubstr("'x' twice"));
    EXPECT_THAT(errorOf(replaced(good(), " f_rest_8\n", " unused\n")), HasSubstr("8 properties f_rest_*"));
    EXPECT_THAT(errorOf(replaced(good(), "float opacity", "list uchar float opacity")), HasSubstr("lists"));
    EXPECT_THAT(errorOf(replaced(good(), " vertex ", " vertices ")), HasSubstr("no element 'vertex'"));
}

TEST(BadPly, PointCloudsAreNamed) {
    EXPECT_THAT(
        errorOf("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
                "z\nend_header\n1 2 3\n"),
        HasSubstr("points or a mesh"));
}

TEST(BadPly, WrongTypesAndFormatsAreNamed) {
    EXPECT_THAT(errorOf(replaced(good(), "float x", "float16 x")), HasSubstr("unknown type 'float16'"));
    EXPECT_THAT(errorOf(replaced(good(), "float x", "x")), HasSubstr("neither a number nor a list"));
    EXPECT_THAT(errorOf(replaced(good(), "binary_little_endian", "binary_middle_endian")),
                HasSubstr("'binary_middle_endian'"));
    EXPECT_THAT(errorOf(replaced(good(), "endian 1.0", "endian 2.0")), HasSubstr("unknown PLY format"));
    EXPECT_THAT(errorOf(replaced(good(), "format binary_little_endian 1.0\n", "")),
                HasSubstr("without a format"));
    EXPECT_THAT(errorOf(replaced(good(), "comment", "remark\x01")), HasSubstr("'remark?'"));
    EXPECT_THAT(errorOf("ply\nproperty float x\nend_header\n"), HasSubstr("cannot be understood"));
    EXPECT_THAT(errorOf("plyometric exercise\n"), HasSubstr("no PLY file"));
    EXPECT_THAT(errorOf("ply\n" + std::string(3 << 20, 'a')), HasSubstr("without an end"));
}

TEST(BadPly, TextWhereBinaryIsAnnouncedAndTheOtherWayRound) {
    const std::string text = good("ascii"), binary = good();
    EXPECT_THAT(errorOf(replaced(text, "ascii", "binary_little_endian")), HasSubstr("holds text"));
    EXPECT_THAT(errorOf(replaced(text, "ascii", "binary_big_endian")), HasSubstr("holds text"));
    EXPECT_THAT(errorOf(replaced(binary, "binary_little_endian", "ascii")), HasSubstr("announces text"));
    EXPECT_THAT(errorOf(header("ascii") + "1 2 three\n" + std::string(9000, '1')),
                HasSubstr("announces text"));
}

TEST(BadPly, NothingIsAnError) {
    EXPECT_EQ(errorOf(""), "is empty");
    EXPECT_THAT(errorOf(replaced(header("ascii"), "vertex 100", "vertex 0")), HasSubstr("no splats"));
    EXPECT_THAT(errorOf("#usda 1.0\n"), HasSubstr("neither a .ply nor a .spz"));
}

TEST(BadPly, FilesThatCannotBeOpenedAreNamed) {
    const auto error = [](const std::string& path) {
        try {
            readSplatFile(path, {});
        } catch (const SplatFileError& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    EXPECT_THAT(error("/nonexistent/capture.ply"), HasSubstr("No such file"));
    EXPECT_EQ(error("/tmp"), "is no file");
    const std::string path = testing::TempDir() + "empty.ply";
    std::ofstream(path).close();
    EXPECT_EQ(error(path), "is empty");
    std::ofstream(path) << good();
    EXPECT_EQ(error(path), "");
}

} // namespace
} // namespace hipr::test
