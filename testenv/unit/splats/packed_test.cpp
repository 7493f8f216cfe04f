// The packed .ply of PlayCanvas and SuperSplat.
#include <gmock/gmock.h>

#include "packed_kit.h"

namespace hipr::test {
namespace {

using testing::HasSubstr;

std::string replaced(std::string file, const std::string& what, const std::string& by) {
    const size_t at = file.find(what);
    EXPECT_NE(at, file.npos) << what;
    return file.replace(at, what.size(), by);
}

/// Within what the bits of the format can hold: positions of +-10, logarithms of scales of +-4.
void expectAsPacked(const SplatCloud& a, const SplatCloud& b) {
    ASSERT_EQ(a.size(), b.size());
    ASSERT_EQ(a.shDegree, b.shDegree);
    const uint32_t coefficients = shCoefficients(a.shDegree);
    for (size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR(a.opacities[i], b.opacities[i], 0.5f / 255 + 1e-6f);
        EXPECT_GT(std::abs(glm::dot(a.orientations[i], b.orientations[i])), 1.f - 3e-6f) << i;
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(a.positions[i][axis], b.positions[i][axis], 10.f / 1023 + 1e-5f);
            EXPECT_NEAR(std::log(a.scales[i][axis] / b.scales[i][axis]), 0.f, 4.f / 1023 + 1e-5f);
            for (uint32_t k = 0; k < coefficients; ++k)
                EXPECT_NEAR(a.coefficients[i * coefficients + k][axis],
                            b.coefficients[i * coefficients + k][axis], k == 0 ? 0.008f : 4.f / 256 + 1e-5f);
        }
    }
}

TEST(PackedPly, IsReadInBothByteOrdersAndAllDegrees) {
    for (const char* format : {"binary_little_endian", "binary_big_endian"})
        for (uint32_t degree = 0; degree <= 3; ++degree) {
            const SplatCloud cloud = randomCloud(600, degree, degree + 1); // the last chunk is not full
            expectAsPacked(readQuietly(packedFile(cloud, true, format)), cloud);
        }
}

TEST(PackedPly, OfOlderWritersHasNoRangesOfColours) {
    expectAsPacked(readQuietly(packedFile(randomCloud(300, 1), false)), randomCloud(300, 1));
}

TEST(PackedPly, NumbersAreThoseOfTheFormat) {
    std::vector<Column> columns = {{"packed_position", "uint", {double(0xffffffffu), 0}},
                                   {"packed_rotation", "uint", {0, double(2u << 30 | 1023u << 20)}},
                                   {"packed_scale", "uint", {double(2047u << 21), double(1023u << 11)}},
                                   {"packed_color", "uint", {double(0xff800033u), double(0x000000ffu)}}};
    PlyStyle style;
    style.before = "element chunk 1\n";
    for (const char* name : {"x", "y", "z", "scale_x", "scale_y", "scale_z", "r", "g", "b"})
        style.before += "property float min_" + std::string(name) + "\nproperty float max_" + name + "\n";
    for (const double number : {-1., 2., -3., 4., -5., 6., 0., 1., 0., 1., 0., 1., 0., 1., 0., 1., 0., 1.})
        style.bodyBefore += encoded(number, "float", style.format);
    style.after = "element sh 2\n";
    for (int n = 0; n < 9; ++n)
        style.after += "property uchar f_rest_" + std::to_string(n) + "\n";
    for (int byte = 0; byte < 18; ++byte)
        style.bodyAfter += char(byte == 0 ? 0 : byte == 3 ? 255 : 128);
    const SplatCloud cloud = readQuietly(plyFile(columns, style));
    ASSERT_EQ(cloud.size(), 2u);
    EXPECT_EQ(cloud.positions[0], glm::vec3(2, 4, 6));
    EXPECT_EQ(cloud.positions[1], glm::vec3(-1, -3, -5));
    // Nothing is left for the largest part, w: three parts of -1/2 sqrt 2 are more than a unit.
    EXPECT_NEAR(cloud.orientations[0].x, -std::sqrt(1.f / 3), 1e-6f);
    EXPECT_NEAR(cloud.orientations[0].w, 0.f, 1e-6f);
    EXPECT_NEAR(cloud.orientations[1].w / cloud.orientations[1].x, -1.f, 1e-3f);
    EXPECT_NEAR(cloud.orientations[1].x / cloud.orientations[1].z, 1.f, 1e-3f);
    EXPECT_NEAR(cloud.scales[0].x, std::exp(1.f), 1e-5f);
    EXPECT_NEAR(cloud.scales[0].y, 1.f, 1e-5f);
    EXPECT_NEAR(cloud.scales[1].y, std::exp(1.f), 1e-5f);
    EXPECT_NEAR(cloud.opacities[0], 0.2f, 1e-6f);
    const glm::vec3 first = 0.5f + 0.28209479f * cloud.coefficients[0];
    EXPECT_NEAR(first.x, 1.f, 1e-5f);
    EXPECT_NEAR(first.y, 128.f / 255, 1e-5f);
    EXPECT_NEAR(first.z, 0.f, 1e-5f);
    EXPECT_EQ(cloud.coefficients[1], glm::vec3(-4.f, 4.f, 0.015625f)); // channel by channel
    EXPECT_EQ(cloud.coefficients[2].x, 0.015625f);
}

TEST(PackedPly, CutOffAnywhereIsAnError) {
    const std::string file = packedFile(randomCloud(300, 1));
    for (size_t size = 0; size < file.size(); size += size < 1300 ? 1 : 17)
        EXPECT_NE(errorOf(file.substr(0, size)), "") << size << " bytes";
    EXPECT_THAT(errorOf(file.substr(0, file.size() - 1)), HasSubstr("cut off"));
    EXPECT_THAT(errorOf(file.substr(0, file.size() / 2)), HasSubstr("cut off"));
}

TEST(PackedPly, WhatDoesNotFitIsNamed) {
    const std::string file = packedFile(randomCloud(300, 1));
    EXPECT_EQ(errorOf(file), "");
    EXPECT_THAT(errorOf(replaced(file, "chunk 2", "chunk 1")), HasSubstr("too few chunks"));
    EXPECT_THAT(errorOf(replaced(file, "vertex 300", "vertex 18446744073709551615")),
                HasSubstr("too few chunks"));
    EXPECT_THAT(errorOf(replaced(file, "element chunk", "element piece")), HasSubstr("no element 'chunk'"));
    EXPECT_THAT(errorOf(replaced(file, "sh 300", "sh 299")), HasSubstr("of 299 instead of 300 splats"));
    EXPECT_THAT(errorOf(replaced(file, "vertex 300", "vertex 0")), HasSubstr("no splats"));
    EXPECT_THAT(errorOf(replaced(file, "max_scale_y", "max_scale")), HasSubstr("ranges of packed splats"));
    EXPECT_THAT(errorOf(replaced(file, "uint packed_scale", "float packed_scale")),
                HasSubstr("'packed_scale'"));
    EXPECT_THAT(errorOf(replaced(file, "packed_color", "packed_cold")), HasSubstr("'packed_color'"));
    EXPECT_THAT(errorOf(replaced(file, "uint packed_color", "list uchar uint packed_color")),
                HasSubstr("lists"));
    EXPECT_THAT(errorOf(replaced(file, "f_rest_8", "unused")), HasSubstr("8 properties f_rest_*"));
    EXPECT_THAT(errorOf(replaced(file, "uchar f_rest_3", "char f_rest_3")), HasSubstr("'f_rest_3'"));
    EXPECT_THAT(
        errorOf("ply\nformat ascii 1.0\nelement vertex 1\nproperty uint packed_position\nend_header\n1\n"),
        HasSubstr("packed splats as text"));
}

} // namespace
} // namespace hipr::test
