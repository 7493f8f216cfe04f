/// What is wrong in a document is told once, and the rest of it opens.
#include "plugin/mtlxFile/document.h"
#include "testenv/unit/mtlxFile/documents.h"

#include "pxr/usd/sdf/attributeSpec.h"
#include "pxr/usd/sdf/primSpec.h"
#include "pxr/usd/usd/stage.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* good = R"(<constant name="good" type="float"/>)";

struct Bad {
    const char* name;
    const char* elements;
    const char* message;
    const char* without = ""; ///< this property is not there, or not connected
};

std::ostream& operator<<(std::ostream& out, Bad const& bad) {
    return out << bad.name;
}

class BadDocuments : public MtlxDocuments, public testing::WithParamInterface<Bad> {
protected:
    TestWarnings warnings;
};

TEST_P(BadDocuments, AreToldOnceAndTheRestOpens) {
    Bad const& bad = GetParam();
    const SdfLayerRefPtr layer = open(std::string(good) + bad.elements);
    ASSERT_TRUE(layer);
    EXPECT_TRUE(layer->GetPrimAtPath(SdfPath("/MaterialX/NodeGraphs/good")));
    EXPECT_THAT(warnings.texts(), ElementsAre(AllOf(HasSubstr("a.mtlx"), HasSubstr(bad.message))));
    if (*bad.without) {
        const SdfAttributeSpecHandle spec =
            layer->GetAttributeAtPath(SdfPath(std::string("/MaterialX/NodeGraphs/") + bad.without));
        EXPECT_FALSE(spec && (spec->HasDefaultValue() || spec->HasConnectionPaths())) << bad.without;
    }
    EXPECT_TRUE(UsdStage::Open(layer)) << "composes without recursion";
}

INSTANTIATE_TEST_SUITE_P(
    All, BadDocuments,
    testing::Values(
        Bad{"MissingInclude", R"(<xi:include href="none.mtlx"/>)", "includes 'none.mtlx', which cannot be"},
        Bad{"IncludesItself", R"(<xi:include href="a.mtlx"/>)", "includes itself through 'a.mtlx'"},
        Bad{"NoName", R"(<constant type="float"/>)", R"(<constant name=""> has no name)"},
        Bad{"SameName", R"(<constant name="good" type="color3"/>)", "has the name of another element"},
        Bad{"SamePath", R"(<constant name="a.b" type="float"/><constant name="a_b" type="float"/>)",
            "would have the path of another element"},
        Bad{"MissingNode",
            R"(<sin name="n" type="float"><input name="in" type="float" nodename="none"/></sin>)",
            R"(<input name="in"> of <sin name="n"> is connected to 'none', which is not there)",
            "n.inputs:in"},
        Bad{"NodeOutsideOfItsGraph",
            R"(<nodegraph name="g"><sin name="n" type="float"><input name="in" type="float" nodename="good"/>
               </sin></nodegraph>)",
            "is connected to 'good', which is not there", "g/n.inputs:in"},
        Bad{"Cycle",
            R"(<sin name="n" type="float"><input name="in" type="float" nodename="m"/></sin>
               <cos name="m" type="float"><input name="in" type="float" nodename="n"/></cos>)",
            R"(<input name="in"> of <cos name="m"> closes a cycle)", "m.inputs:in"},
        Bad{"CycleInGraph",
            R"(<nodegraph name="g"><sin name="n" type="float"><input name="in" type="float" nodename="n"/>
               </sin></nodegraph>)",
            "closes a cycle", "g/n.inputs:in"},
        Bad{"CycleThroughGraph",
            R"(<nodegraph name="g"><input name="x" type="float" nodename="n"/></nodegraph>
               <sin name="n" type="float"><input name="in" type="float" nodegraph="g"/></sin>)",
            "closes a cycle", "n.inputs:in"},
        Bad{"DefinitionOfItself",
            R"(<nodedef name="ND_x" node="x"><output name="out" type="float"/></nodedef>
               <nodegraph name="NG_x" nodedef="ND_x"><x name="n" type="float"/>
               <output name="out" type="float" nodename="n"/></nodegraph><x name="y" type="float"/>)",
            "is implemented by itself"},
        Bad{"NoInterface",
            R"(<nodegraph name="g"><sin name="n" type="float"><input name="in" type="float" interfacename="x"/>
               </sin></nodegraph>)",
            "has the interface name 'x', which its graph lacks", "g/n.inputs:in"},
        Bad{"BadNumber", R"(<sin name="n" type="float"><input name="in" type="float" value="half"/></sin>)",
            "has the value 'half', which is no float", "n.inputs:in"},
        Bad{"TooFewNumbers",
            R"(<sin name="n" type="color3"><input name="in" type="color3" value="1, 2"/></sin>)",
            "has the value '1, 2', which is no color3", "n.inputs:in"},
        Bad{"MaterialOfLook", R"(<look name="l"><materialassign name="a" material="none" geom="/"/></look>)",
            "assigns a material that is not there: 'none'"},
        Bad{"GeometryOfLook", R"(<collection name="c" includegeom="/a*"/><look name="l"/>)",
            "names '/a*', which is no path"}),
    [](testing::TestParamInfo<Bad> const& info) { return info.param.name; });

/// Deeper than the stack, and too many to look each up among all others.
TEST(LongDocuments, OpenInTime) {
    constexpr int length = 100000;
    std::string text = "<materialx version=\"1.38\"><nodegraph name=\"g\">";
    for (int i = 0; i < length; ++i) {
        text += "<sin name=\"n" + std::to_string(i) +
                "\" type=\"float\"><input name=\"in\" type=\"float\" nodename=\"n" +
                std::to_string((i + 1) % length) + "\"/></sin>";
    }
    text += "</nodegraph>";
    for (int i = 0; i < length; ++i) {
        text += "<a>";
    }
    for (int i = 0; i < length; ++i) {
        text += "</a>";
    }
    std::vector<std::string> told;
    hipr::mtlx::Surroundings surroundings;
    surroundings.message = [&told](std::string const& message) { told.push_back(message); };
    const hipr::mtlx::Document document(text + "</materialx>", "a.mtlx", surroundings);
    EXPECT_EQ(document.elements().size(), 1u);
    EXPECT_THAT(told, ElementsAre(HasSubstr("has no name"), HasSubstr("closes a cycle")));
}

class NoDocuments : public BadDocuments {};

TEST_F(NoDocuments, AreEmptyLayers) {
    const std::pair<std::string, char const*> files[] = {
        {file("cut.mtlx", "<materialx version=\"1.38\">\n<constant name=\"c\">\n<in"),
         "cut.mtlx:3: no valid XML"},
        {file("empty.mtlx", ""), "empty.mtlx:1: no valid XML"},
        {file("other.mtlx", "<html/>"), "other.mtlx: has no <materialx>"}};
    for (auto const& [path, message] : files) {
        TestWarnings told;
        const SdfLayerRefPtr layer = SdfLayer::FindOrOpen(path);
        ASSERT_TRUE(layer) << path;
        EXPECT_TRUE(layer->GetPrimAtPath(SdfPath("/MaterialX/Materials")));
        EXPECT_THAT(told.texts(), ElementsAre(HasSubstr(message)));
    }
}

} // namespace
