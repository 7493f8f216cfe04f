// docs/features.md names tests as proofs: they exist.
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
    return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

/// "Suite.Name" of every test, and "Name/parameter" of those that have parameters with names.
std::set<std::string> allTests() {
    static const std::regex test(R"(TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\))"),
        scene(R"(Feature\{\s*"(\w+)\")");
    std::set<std::string> names;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(HIPR_SOURCE_DIR "/testenv")) {
        if (entry.path().extension() != ".cpp") continue;
        const std::string text = contentOf(entry.path());
        for (const std::smatch& match : matches(text, test)) {
            std::string suite = match[1];
            if (suite == "FeatureTest") continue;
            names.insert(suite + "." + match[2].str());
        }
        for (const std::smatch& match : matches(text, scene))
            names.insert("KnownColoursAtKnownPlaces/" + match[1].str());
    }
    return names;
}

TEST(FeaturesPage, ProofsExist) {
    static const std::regex proof(R"(`(\w+[./]\w+)`)");
    const std::set<std::string> tests = allTests();
    const std::string page = contentOf(HIPR_SOURCE_DIR "/docs/features.md");
    const std::vector<std::smatch> proofs = matches(page, proof);
    EXPECT_GT(proofs.size(), 50u);
    for (const std::smatch& match : proofs)
        EXPECT_TRUE(tests.count(match[1])) << "there is no test " << match[1];
}

} // namespace
