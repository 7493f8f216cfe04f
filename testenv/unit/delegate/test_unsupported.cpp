/// What a scene asks for and does not get is named once, with its prim; what nobody asks for is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testenv/unit/delegate/test_host.h"
#include "testenv/unit/delegate/test_warnings.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// Messages are said once in the life of a process, so every test has prims of its own name.
struct Unsupported : testing::Test {
    Unsupported() : host({"color"}, 1) {
        host.setViewSize(3.0);
        host.scene().addDome(SdfPath("/dome"));
    }
    TestScene::Prim& square(char const* name) { return host.scene().addSquare(SdfPath(name), GfVec3f(0.5f)); }

    TestHost host;
    TestWarnings warnings;
};

TEST_F(Unsupported, cullStylesOfPrims) {
    square("/cull_nothing").cullStyle = HdCullStyleNothing;
    square("/cull_back").cullStyle = HdCullStyleBack;
    square("/cull_front").cullStyle = HdCullStyleFrontUnlessDoubleSided;
    ASSERT_TRUE(host.render());
    EXPECT_THAT(warnings.texts(), testing::UnorderedElementsAre(
                                      AllOf(HasSubstr("</cull_back>"), HasSubstr("all faces are drawn")),
                                      HasSubstr("</cull_front>")));
    host.scene().tracker().MarkRprimDirty(SdfPath("/cull_back"), HdChangeTracker::DirtyCullStyle);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(warnings.texts().size(), 2u);
}

TEST_F(Unsupported, aCullStyleOfTheView) {
    square("/seen");
    host.state().SetCullStyle(HdCullStyleBackUnlessDoubleSided);
    ASSERT_TRUE(host.render());
    ASSERT_TRUE(host.render());
    EXPECT_THAT(warnings.texts(), ElementsAre(HasSubstr("culling faces")));
}

} // namespace
