// Files damaged at random: an error or a cloud that keeps its promises, never anything else.
#include "packed_kit.h"
#include "spz_kit.h"

namespace hipr::test {
namespace {

class Damage {
public:
    explicit Damage(uint32_t seed) : _random(seed) {}

    std::string apply(std::string file) {
        for (int times = 1 + int(below(3)); times > 0; --times) {
            const size_t at = below(chance(0.5) ? std::min<size_t>(file.size(), 700) : file.size());
            switch (below(6)) {
            case 0: // a bit
                if (!file.empty()) file[at] = char(file[at] ^ (1 << below(8)));
                break;
            case 1: // another byte
                if (!file.empty()) file[at] = char(below(256));
                break;
            case 2: // cut off
                file.resize(at);
                break;
            case 3: // a piece out
                file.erase(at, below(40));
                break;
            case 4: // a piece twice
                file.insert(at, file.substr(below(file.size() + 1), below(60)));
                break;
            case 5: // a digit becomes others
                replaceDigit(file, at);
                break;
            }
        }
        return file;
    }

    size_t below(size_t end) {
        return end == 0 ? 0 : std::uniform_int_distribution<size_t>(0, end - 1)(_random);
    }
    bool chance(double p) { return std::bernoulli_distribution(p)(_random); }

private:
    void replaceDigit(std::string& file, size_t from) {
        static const char* const numbers[] = {
            "0",   "-1",  "3",    "65536", "4294967295", "18446744073709551615",
            "nan", "inf", "1e99", "",      "999999999"};
        const size_t at = file.find_first_of("0123456789", from);
        if (at != file.npos) file.replace(at, 1, numbers[below(std::size(numbers))]);
    }

    std::mt19937 _random;
};

void expectPromisesKept(const SplatCloud& cloud, size_t fileBytes) {
    const size_t n = cloud.size();
    ASSERT_LE(cloud.shDegree, 3u);
    ASSERT_EQ(cloud.orientations.size(), n);
    ASSERT_EQ(cloud.scales.size(), n);
    ASSERT_EQ(cloud.opacities.size(), n);
    ASSERT_EQ(cloud.coefficients.size(), n * shCoefficients(cloud.shDegree));
    ASSERT_LE(n, fileBytes * 1032 / 14);
    for (size_t i = 0; i < n; ++i) {
        ASSERT_NEAR(glm::length(cloud.orientations[i]), 1.f, 1e-4f);
        ASSERT_GE(cloud.opacities[i], 0.f);
        ASSERT_LE(cloud.opacities[i], 1.f);
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_TRUE(std::isfinite(cloud.positions[i][axis]));
            ASSERT_GE(cloud.scales[i][axis], 0.f);
            ASSERT_TRUE(std::isfinite(cloud.scales[i][axis]));
        }
    }
    for (const glm::vec3& c : cloud.coefficients)
        ASSERT_TRUE(std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z));
}

/// Returns whether it could still be read.
bool readDamaged(const std::string& file) {
    try {
        Messages messages;
        const SplatCloud cloud = readSplats(view(file), messages.options());
        expectPromisesKept(cloud, file.size());
        return true;
    } catch (const SplatFileError& error) {
        EXPECT_NE(std::string(error.what()), "");
        return false;
    }
}

/// Damages each file many times; both outcomes have to come up, or the damage is none or too much.
void damage(const std::vector<std::string>& files, uint32_t seeds) {
    size_t readable = 0;
    for (uint32_t seed = 0; seed < seeds && !testing::Test::HasFatalFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Damage random(seed);
        readable += readDamaged(random.apply(files[seed % files.size()]));
    }
    EXPECT_GT(readable, seeds / 50);
    EXPECT_LT(readable, seeds - seeds / 50);
}

TEST(SplatFuzz, Ply) {
    std::vector<std::string> files;
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        files.push_back(plyFile(columnsOf(randomCloud(12, 0)), {format}));
        PlyStyle style{format};
        style.before = "element face 2\nproperty list uchar int indices\n";
        for (int face = 0; face < 2; ++face)
            for (int i = 0; i < 4; ++i)
                style.bodyBefore += encoded(i == 0 ? 3 : i, i == 0 ? "uchar" : "int", format);
        style.listAfter = "opacity";
        files.push_back(plyFile(columnsOf(randomCloud(5, 1)), style));
    }
    damage(files, 30000);
}

TEST(SplatFuzz, PackedPly) {
    damage({packedFile(randomCloud(9, 0)), packedFile(randomCloud(4, 1), false),
            packedFile(randomCloud(3, 3), true, "binary_big_endian")},
           15000);
}

TEST(SplatFuzz, Spz) {
    // Damaged inside and outside of the compression, so that it reaches the numbers and deflate's checks.
    std::vector<std::string> contents;
    for (uint32_t version : {2u, 3u}) {
        SpzHeader header;
        header.version = version;
        header.degree = version - 1;
        contents.push_back(header.bytes() + spzBody(std::string(version + 1, '\x40'), header.degree));
    }
    size_t readable = 0;
    constexpr uint32_t seeds = 6000;
    for (uint32_t seed = 0; seed < seeds && !testing::Test::HasFatalFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Damage random(seed);
        const bool inside = seed % 2 == 0;
        const std::string content = contents[random.below(2)];
        const std::string file = inside ? gzipped(random.apply(content)) : random.apply(gzipped(content));
        readable += readDamaged(file);
    }
    EXPECT_GT(readable, seeds / 50);
    EXPECT_LT(readable, seeds - seeds / 50);
}

} // namespace
} // namespace hipr::test
