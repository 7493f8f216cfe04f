// The table of nodes in docs/materials.md is mtlxNodes().
#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "renderer/materialx/nodes.h"

namespace hipr::test {
namespace {

const char* const Head = "| Group | Nodes |\n|---|---|\n";

std::string expectedTable() {
    std::map<std::string, std::string> groups;
    for (const MtlxNode& node : mtlxNodes()) {
        std::string& nodes = groups[node.group];
        nodes += (nodes.empty() ? "" : ", ") + std::string(node.category);
    }
    std::string table = Head;
    for (const auto& [group, nodes] : groups)
        table += "| " + group + " | " + nodes + " |\n";
    return table;
}

TEST(MaterialsPage, HasTheTableOfNodes) {
    std::ifstream file(HIPR_SOURCE_DIR "/docs/materials.md");
    std::stringstream page;
    page << file.rdbuf();
    const bool there = page.str().find(expectedTable() + "\n") != std::string::npos;
    EXPECT_TRUE(there) << "docs/materials.md is to hold this table:\n" << expectedTable();
}

} // namespace
} // namespace hipr::test
