// .spz: numbers as they stand in the file against what they mean.
#include <gmock/gmock.h>

#include "spz_kit.h"

namespace hipr::test {
namespace {

using testing::HasSubstr;

/// The three parts of a version 3 orientation, each in -511..511, without the largest.
std::string smallestThree(uint32_t largest, std::array<int, 3> parts) {
    uint32_t bits = largest;
    for (const int part : parts)
        bits = bits << 10 | (part < 0 ? 512u : 0u) | uint32_t(std::abs(part));
    return little(bits, 4);
}

const std::string upright = smallestThree(3, {0, 0, 0});

SplatCloud one(const SpzHeader& header, const std::string& body) {
    return readQuietly(gzipped(header.bytes() + body));
}

TEST(Spz, NumbersMeanWhatTheFormatSays) {
    const SplatCloud cloud = one({}, spzBody(upright));
    EXPECT_EQ(cloud.positions[0], glm::vec3(1.f, -2.f, 0.5f));
    EXPECT_FLOAT_EQ(cloud.opacities[0], 0.2f);
    EXPECT_FLOAT_EQ(cloud.coefficients[0].x, 0.5f / 0.15f);
    EXPECT_FLOAT_EQ(cloud.coefficients[0].y, -0.5f / 0.15f);
    EXPECT_FLOAT_EQ(cloud.coefficients[0].z, -0.3f / 0.15f);
    EXPECT_FLOAT_EQ(cloud.scales[0].x, 1.f);
    EXPECT_FLOAT_EQ(cloud.scales[0].y, std::exp(1.f));
    EXPECT_FLOAT_EQ(cloud.scales[0].z, std::exp(-2.f));
    EXPECT_EQ(cloud.orientations[0], glm::quat(1.f, 0.f, 0.f, 0.f));
    EXPECT_EQ(cloud.shDegree, 0u);
}

TEST(Spz, AnyPartOfAnOrientationMayBeTheLargest) {
    const int a = 100, b = -200, c = 300;
    const float unit = std::sqrt(0.5f) / 511.f;
    const float rest = std::sqrt(1.f - unit * unit * float(a * a + b * b + c * c));
    for (uint32_t largest = 0; largest < 4; ++largest) {
        const glm::quat q = one({}, spzBody(smallestThree(largest, {a, b, c}))).orientations[0];
        const float parts[] = {q.x, q.y, q.z, q.w};
        const float others[] = {a * unit, b * unit, c * unit};
        for (uint32_t i = 0, next = 0; i < 4; ++i)
            EXPECT_NEAR(parts[i], i == largest ? rest : others[next++], 1e-6f) << largest << " " << i;
    }
}

TEST(Spz, Version2KeepsThreePartsOfOrientations) {
    SpzHeader header;
    header.version = 2;
    const glm::quat q = one(header, spzBody(little(191, 1) + little(64, 1) + little(127, 1))).orientations[0];
    EXPECT_NEAR(q.x, 191 / 127.5f - 1, 1e-4f);
    EXPECT_NEAR(q.y, 64 / 127.5f - 1, 1e-4f);
    EXPECT_NEAR(q.z, 127 / 127.5f - 1, 1e-4f);
    EXPECT_NEAR(q.w, std::sqrt(1 - q.x * q.x - q.y * q.y - q.z * q.z), 1e-4f);
}

TEST(Spz, Version1KeepsPositionsAsHalves) {
    SpzHeader header;
    header.version = 1;
    const std::string body = little(0x3c00, 2) + little(0xc100, 2) + little(0x0200, 2);
    const std::string file = body + spzBody(little(128, 1) + little(128, 1) + little(128, 1)).substr(9);
    EXPECT_EQ(one(header, file).positions[0], glm::vec3(1.f, -2.5f, std::ldexp(1.f, -15)));
}

TEST(Spz, CoefficientsGoChannelByChannelInside) {
    for (uint32_t degree = 1; degree <= 3; ++degree) {
        SpzHeader header;
        header.degree = degree;
        const SplatCloud cloud = one(header, spzBody(upright, degree));
        ASSERT_EQ(cloud.shDegree, degree);
        ASSERT_EQ(cloud.coefficients.size(), shCoefficients(degree));
        for (uint32_t k = 1; k < shCoefficients(degree); ++k)
            for (int channel = 0; channel < 3; ++channel) {
                const uint32_t byte = 128 + 3 * (3 * (k - 1) + uint32_t(channel));
                EXPECT_EQ(cloud.coefficients[k][channel], (float(byte & 0xff) - 128.f) / 128.f);
            }
    }
}

TEST(Spz, Degree4IsReadUpToDegree3) {
    SpzHeader header;
    header.degree = 4;
    Messages messages;
    const std::string file = gzipped(header.bytes() + spzBody(upright, 4));
    EXPECT_EQ(readSpz(view(file), messages.options()).coefficients.size(), 16u);
    ASSERT_EQ(messages.texts.size(), 1u);
    EXPECT_THAT(messages.texts[0], HasSubstr("degree 4"));
}

TEST(Spz, ManySplatsAreReadAttributeByAttribute) {
    SpzHeader header;
    header.count = 10000; // more than a block
    std::string body;
    for (uint32_t i = 0; i < header.count; ++i)
        body += little(i, 3) + little(0, 3) + little(0, 3);
    for (uint32_t i = 0; i < header.count; ++i)
        body += little(i % 256, 1);
    body += std::string(size_t(header.count) * (3 + 3), '\1');
    for (uint32_t i = 0; i < header.count; ++i)
        body += upright;
    const SplatCloud cloud = one(header, body);
    ASSERT_EQ(cloud.size(), 10000u);
    EXPECT_EQ(cloud.positions[9999].x, 9999.f / 4096.f);
    EXPECT_EQ(cloud.opacities[9999], float(9999 % 256) / 255.f);
    EXPECT_EQ(cloud.orientations[9999], glm::quat(1.f, 0.f, 0.f, 0.f));
}

TEST(BadSpz, OneErrorEach) {
    const auto error = [](const SpzHeader& header) {
        return errorOf(gzipped(header.bytes() + spzBody(upright)));
    };
    EXPECT_EQ(error({}), "");
    EXPECT_THAT(error({4}), HasSubstr("version 4"));
    EXPECT_THAT(error({0}), HasSubstr("version 0"));
    EXPECT_THAT(error({3, 0}), HasSubstr("no splats"));
    EXPECT_THAT(error({3, 2}), HasSubstr("cut off"));
    EXPECT_THAT(error({3, 4000000000u}), HasSubstr("announces 4000000000 splats"));
    EXPECT_THAT(error({3, 1, 5}), HasSubstr("invalid"));
    EXPECT_THAT(error({3, 1, 0, 25}), HasSubstr("invalid"));
    EXPECT_THAT(error({3, 1, 0, 12, 7}), HasSubstr("not a .spz"));
    const std::string file = gzipped(SpzHeader().bytes() + spzBody(upright));
    for (size_t size = 0; size < file.size() - 10; ++size) // what follows is gzip's end and checksum
        EXPECT_NE(errorOf(file.substr(0, size)), "") << size;
}

} // namespace
} // namespace hipr::test
