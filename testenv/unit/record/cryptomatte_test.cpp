#include "plugin/record/cryptomatte.h"

#include <gmock/gmock.h>
#include <map>

namespace hipr::record {
namespace {

using testing::ElementsAre;

Picture pictureOf(const std::vector<std::pair<std::string, std::string>>& layers) {
    Picture picture;
    for (const auto& [aov, name] : layers) {
        picture.layers.push_back({aov, 4, false, {}});
        picture.layers.back().name = name;
    }
    picture.info.names["CryptoObject"] = {"/a \"b\" \\", "/\xc3\xa9", "bunny"};
    return picture;
}

std::map<std::string, std::string> metadataOf(const Picture& picture) {
    const auto pairs = cryptomatteMetadata(picture);
    return {pairs.begin(), pairs.end()};
}

TEST(Cryptomatte, ANameStandsForThreeLayers) {
    EXPECT_THAT(expandedAov("CryptoAsset"), ElementsAre("CryptoAsset00", "CryptoAsset01", "CryptoAsset02"));
    EXPECT_THAT(expandedAov("CryptoAsset01"), ElementsAre("CryptoAsset01"));
    EXPECT_THAT(expandedAov("color"), ElementsAre("color"));
    EXPECT_EQ(cryptomatteOf("CryptoMaterial02"), "CryptoMaterial");
    EXPECT_EQ(cryptomatteOf("CryptoMaterial03"), "");
    EXPECT_EQ(cryptomatteOf("CryptoMaterial"), "");
}

// The key is the beginning of the hash of the layers' name; names are escaped as JSON wants.
TEST(Cryptomatte, MetadataAreThoseOfTheSpecification) {
    const auto metadata =
        metadataOf(pictureOf({{"color", ""}, {"CryptoObject00", ""}, {"CryptoObject01", ""}}));
    ASSERT_EQ(metadata.size(), 4u);
    EXPECT_EQ(metadata.begin()->first, "cryptomatte/3ae39a5/conversion");
    EXPECT_EQ(metadata.at("cryptomatte/3ae39a5/name"), "CryptoObject");
    EXPECT_EQ(metadata.at("cryptomatte/3ae39a5/hash"), "MurmurHash3_32");
    EXPECT_EQ(metadata.at("cryptomatte/3ae39a5/conversion"), "uint32_to_float32");
    EXPECT_EQ(metadata.at("cryptomatte/3ae39a5/manifest"),
              "{\"/a \\\"b\\\" \\\\\":\"4753e905\",\"/\xc3\xa9\":\"4cb6bd6c\",\"bunny\":\"13851a76\"}");
}

TEST(Cryptomatte, LayersMayHaveOtherNames) {
    const auto metadata = metadataOf(pictureOf({{"CryptoObject00", "ids00"}, {"CryptoObject01", "ids01"}}));
    for (const auto& [key, value] : metadata)
        if (key.find("/name") != std::string::npos) {
            EXPECT_EQ(value, "ids");
        }
    EXPECT_EQ(metadata.size(), 4u);
}

} // namespace
} // namespace hipr::record
