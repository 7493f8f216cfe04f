/// Edit scripts: what can be written, what it does to a stage, and what is said when it cannot be done.
#include <fstream>
#include <gmock/gmock.h>
#include <set>

#include "plugin/record/edits.h"
#include "plugin/record/failure.h"
#include "plugin/record/usdaText.h"
#include "pxr/base/tf/notice.h"
#include "pxr/base/tf/weakBase.h"
#include "pxr/usd/usd/attribute.h"
#include "pxr/usd/usd/notice.h"
#include "pxr/usd/usd/prim.h"
#include "pxr/usd/usd/relationship.h"
#include "pxr/usd/usd/variantSets.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::test {
namespace {

using record::applyEdit;
using record::Edit;
using record::parseEdits;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const char* const sceneText = R"(#usda 1.0
(subLayers = [@%FOLDER%/sub.usda@])
def Xform "World"
{
    def Mesh "Ball" (
        prepend variantSets = "shading"
        variants = { string shading = "grey" }
    )
    {
        double size = 1
        double moving.timeSamples = { 1: 10, 2: 20 }
        rel material:binding = </World/Looks/Gold>
        variantSet "shading" = {
            "grey" {
                int shade = 1
            }
            "red" {
                int shade = 2
            }
        }
    }
    def Scope "Looks"
    {
        def Material "Gold"
        {
            token outputs:surface.connect = </World/Looks/Gold/Surface.outputs:surface>
            def Shader "Surface"
            {
                token outputs:surface
            }
        }
    }
    def Xform "Empty" {}
    def "Borrowed" ( references = </Library/Thing> ) {}
}
def "Library"
{
    def "Thing"
    {
        def Cube "Inside" {}
    }
}
)";

/// The paths the stage says have changed, "!" in front of those that are composed anew.
class Heard : public TfWeakBase {
public:
    explicit Heard(const UsdStageRefPtr& stage)
        : _key(TfNotice::Register(TfCreateWeakPtr(this), &Heard::onChange, UsdStageWeakPtr(stage))) {}
    ~Heard() { TfNotice::Revoke(_key); }
    std::set<std::string> paths;

private:
    void onChange(const UsdNotice::ObjectsChanged& notice) {
        for (const SdfPath& path : notice.GetResyncedPaths())
            paths.insert("!" + path.GetString());
        for (const SdfPath& path : notice.GetChangedInfoOnlyPaths())
            paths.insert(path.GetString());
    }
    TfNotice::Key _key;
};

class Edits : public testing::Test {
protected:
    Edits() {
        std::string pattern = testing::TempDir() + "hipr_edits_XXXXXX";
        _folder = mkdtemp(pattern.data());
        write("sub.usda", record::completeUsda("over \"World\" { over \"Ball\" { double fromSub = 3 } }"));
        std::string text = sceneText;
        const std::string mark = "%FOLDER%";
        text.replace(text.find(mark), mark.size(), _folder);
        write("scene.usda", text);
        stage = UsdStage::Open(_folder + "/scene.usda");
        record::editLayer(stage);
    }
    ~Edits() override {
        for (const std::string& file : _files)
            std::remove(file.c_str());
        rmdir(_folder.c_str());
    }

    void write(const std::string& name, const std::string& text) {
        _files.push_back(_folder + "/" + name);
        std::ofstream(_files.back()) << text;
    }
    /// Applies all edits of a list written as JSON; returns what the last of them returned.
    bool apply(const std::string& edits) {
        bool changed = false;
        for (const Edit& edit : parseEdits("{\"edits\": [" + edits + "]}"))
            changed = applyEdit(stage, edit);
        return changed;
    }
    std::string complaint(const std::string& edits) {
        try {
            apply(edits);
        } catch (const record::Failure& failure) {
            EXPECT_EQ(failure.code(), record::ExitUsage);
            return failure.what();
        }
        return "no complaint";
    }
    template <class T> T value(const std::string& path, double time = 1) const {
        T result{};
        stage->GetAttributeAtPath(SdfPath(path)).Get(&result, time);
        return result;
    }
    UsdPrim prim(const std::string& path) const { return stage->GetPrimAtPath(SdfPath(path)); }

    UsdStageRefPtr stage;
    std::string folder() const { return _folder; }

private:
    std::string _folder;
    std::vector<std::string> _files;
};

std::string usda(const std::string& text) {
    std::string escaped;
    for (const char c : text)
        escaped += c == '"' ? std::string("\\\"") : c == '\n' ? std::string("\\n") : std::string(1, c);
    return "{\"usda\": \"" + escaped + "\"}";
}

TEST_F(Edits, FieldsAreRead) {
    const std::vector<Edit> edits = parseEdits(R"({"edits": [
        {"name": "all of it", "at": {"samples": 8}, "time": 12.5, "camera": "/Cam2",
         "setting": {"hipr:maxDepth": 3, "hipr:pixelFilter": "box", "enableSceneLights": false}},
        {"at": {"seconds": 0.25}}, {}]})");
    ASSERT_EQ(edits.size(), 3u);
    EXPECT_EQ(edits[0].title(), "edit 1 'all of it'");
    EXPECT_EQ(edits[0].afterSamples, 8);
    EXPECT_EQ(edits[0].time, 12.5);
    EXPECT_EQ(edits[0].camera, "/Cam2");
    using Setting = std::pair<std::string, std::string>;
    EXPECT_THAT(edits[0].settings,
                ElementsAre(Setting("hipr:maxDepth", "3"), Setting("hipr:pixelFilter", "box"),
                            Setting("enableSceneLights", "false")));
    EXPECT_EQ(edits[1].title(), "edit 2");
    EXPECT_EQ(edits[1].afterSeconds, 0.25);
    EXPECT_FALSE(edits[1].afterSamples || edits[2].afterSeconds);
}

TEST_F(Edits, WhatIsWrittenWrongIsNamed) {
    EXPECT_THAT(complaint(R"({"name": "shift", "move": 1})"),
                AllOf(HasSubstr("edit 1 'shift'"), HasSubstr("'move'"), HasSubstr("rename")));
    EXPECT_THAT(complaint(R"({}, {"at": {"minutes": 1}})"), AllOf(HasSubstr("edit 2"), HasSubstr("minutes")));
    EXPECT_THAT(complaint(R"({"at": {"samples": 0}})"), HasSubstr("from 1 to"));
    EXPECT_THAT(complaint(R"({"at": {"seconds": -1}})"), HasSubstr("negative"));
    EXPECT_THAT(complaint(R"({"remove": "/World"})"), HasSubstr("'remove' takes a list"));
    EXPECT_THAT(complaint(R"({"remove": ["World"]})"), HasSubstr("'World' is no absolute prim path"));
    EXPECT_THAT(complaint(R"({"remove": ["/World.size"]})"), HasSubstr("no absolute prim path"));
    EXPECT_THAT(complaint(R"({"rename": {"/World": 3}})"), HasSubstr("takes text"));
    EXPECT_THAT(complaint(R"({"setting": {"hipr:seed": [1]}})"), HasSubstr("hipr:seed"));
    EXPECT_THAT(complaint(R"({"time": "noon"})"), HasSubstr("takes a number"));
    EXPECT_THAT(complaint("7"), HasSubstr("edit 1"));
    EXPECT_THAT(complaint("{"), HasSubstr("no JSON"));
    EXPECT_THROW(parseEdits("[]"), record::Failure);
    EXPECT_THROW(record::readEdits(folder() + "/none.json"), record::Failure);
}

TEST_F(Edits, NewOpinionsWinOverEarlierOnes) {
    apply(usda("over \"World\" { over \"Ball\" { double size = 2 \n double moving = 5 } def Xform \"New\" { "
               "int a = 1 } }"));
    EXPECT_EQ(value<double>("/World/Ball.size"), 2);
    EXPECT_EQ(value<double>("/World/Ball.moving"), 5) << "a default over the time samples of the scene";
    apply(usda("#usda 1.0\nover \"World\" { over \"Ball\" { double moving.timeSamples = { 1: 7 } } \n"
               "over \"New\" { int b = 2 } }"));
    EXPECT_EQ(value<double>("/World/Ball.size"), 2) << "what an edit does not speak of stays";
    EXPECT_EQ(value<double>("/World/Ball.moving"), 7);
    EXPECT_TRUE(prim("/World/New").IsDefined()) << "an over leaves what an earlier edit defined";
    EXPECT_EQ(value<int>("/World/New.a") + value<int>("/World/New.b"), 3);
    apply(usda("over \"World\" { over \"Ball\" { double moving.timeSamples = { 2: 8 } } }"));
    EXPECT_EQ(value<double>("/World/Ball.moving", 1), 7);
    EXPECT_EQ(value<double>("/World/Ball.moving", 2), 8);
    apply(usda("over \"World\" { over \"Ball\" { double moving = 9 } }"));
    EXPECT_EQ(value<double>("/World/Ball.moving", 2), 9)
        << "a default over the time samples of earlier edits";
}

TEST_F(Edits, ListEditsAreCombined) {
    apply(usda("over \"World\" { over \"Ball\" ( prepend apiSchemas = [\"A\"] ) {} }") + "," +
          usda("over \"World\" { over \"Ball\" ( prepend apiSchemas = [\"B\"] ) {} }"));
    EXPECT_THAT(prim("/World/Ball").GetAppliedSchemas(), ElementsAre("B", "A"));
}

TEST_F(Edits, OnlyWhatDiffersIsComposedAnew) {
    apply(usda("def Xform \"First\" { def Xform \"Below\" { double x = 1 } }"));
    Heard move(stage);
    EXPECT_TRUE(apply(usda("over \"First\" { over \"Below\" { double x = 2 } }")));
    EXPECT_THAT(move.paths, ElementsAre("/First/Below.x"));
    Heard add(stage);
    EXPECT_TRUE(apply(usda("def Xform \"Second\" {}")));
    EXPECT_THAT(add.paths, ElementsAre("!/Second"));
}

TEST_F(Edits, SayingTheSameAgainChangesNothing) {
    const std::string same = usda("def Xform \"First\" { double x = 1 }");
    EXPECT_TRUE(apply(same));
    EXPECT_FALSE(apply(same));
    EXPECT_FALSE(apply("{}"));
    EXPECT_FALSE(apply(R"({"setting": {"hipr:seed": 4}, "camera": "/Cam"})")) << "the caller's business";
}

TEST_F(Edits, RelativeAssetPathsAreThoseOfTheScene) {
    write("texture.png", "");
    apply(usda("def \"First\" { asset file = @./texture.png@ \n asset[] more = [@./texture.png@] }"));
    EXPECT_EQ(value<SdfAssetPath>("/First.file").GetResolvedPath(), folder() + "/texture.png");
}

TEST_F(Edits, UsdaMayStandOnOneLine) {
    const char* const line =
        R"(def "A" { string s = "}{" ; asset f = @a}b.png@; rel r = </B> } def "B" {} # } c)";
    const std::string text = record::completeUsda(line);
    EXPECT_TRUE(SdfLayer::CreateAnonymous(".usda")->ImportFromString(text)) << text;
    EXPECT_THAT(text, HasSubstr("\"}{\" ; asset f = @a}b.png@; rel r = </B> \n}\n def \"B\""));
    EXPECT_THAT(text, HasSubstr("# } c\n"));
    EXPECT_THAT(record::completeUsda(R"(s = 'it\'s }' t = { 1: {} , 2: """ " } """ })"),
                HasSubstr("'it\\'s }' t = { 1: {\n} , 2: \"\"\" \" } \"\"\" \n}\n"));
}

TEST_F(Edits, UsdaThatCannotBeReadIsSaid) {
    EXPECT_THAT(complaint(R"({}, {"name": "typo", "usda": "over World {"})"),
                AllOf(HasSubstr("edit 2 'typo'"), HasSubstr("usda")));
}

TEST_F(Edits, PrimsAreRemovedForGood) {
    EXPECT_TRUE(apply(R"({"remove": ["/World/Ball"]})"));
    EXPECT_FALSE(prim("/World/Ball")) << "neither the root layer nor the sublayer keeps it";
    apply(usda("over \"World\" { def Xform \"Ball\" {} }"));
    EXPECT_EQ(prim("/World/Ball").GetTypeName(), "Xform");
    EXPECT_FALSE(stage->GetAttributeAtPath(SdfPath("/World/Ball.size")));
}

TEST_F(Edits, RenamedPrimsKeepWhatPointsAtThem) {
    EXPECT_TRUE(
        apply(R"({"rename": {"/World/Looks/Gold": "/World/Empty/Brass", "/World/Ball": "/World/Orb"}})"));
    EXPECT_FALSE(prim("/World/Looks/Gold"));
    SdfPathVector targets;
    prim("/World/Orb").GetRelationship(TfToken("material:binding")).GetTargets(&targets);
    EXPECT_THAT(targets, ElementsAre(SdfPath("/World/Empty/Brass")));
    stage->GetAttributeAtPath(SdfPath("/World/Empty/Brass.outputs:surface")).GetConnections(&targets);
    EXPECT_THAT(targets, ElementsAre(SdfPath("/World/Empty/Brass/Surface.outputs:surface")));
    EXPECT_EQ(value<double>("/World/Orb.fromSub"), 3);
}

TEST_F(Edits, PrimsTakeAlongWhatTheyBringInThemselves) {
    apply(usda("class \"_Kind\" { int kind = 1 \n def \"Part\" {} }"
               "over \"World\" { def \"Heir\" (inherits = </_Kind>) {} }"));
    EXPECT_TRUE(apply(R"({"rename": {"/World/Heir": "/World/Son"}})"));
    EXPECT_FALSE(prim("/World/Heir"));
    EXPECT_EQ(value<int>("/World/Son.kind"), 1);
    EXPECT_THAT(complaint(R"({"remove": ["/World/Son/Part"]})"), HasSubstr("deactivate it instead"));
    EXPECT_TRUE(apply(R"({"remove": ["/World/Son", "/World/Borrowed"]})"));
    EXPECT_FALSE(prim("/World/Son"));
    EXPECT_FALSE(prim("/World/Borrowed"));
    EXPECT_TRUE(prim("/_Kind/Part"));
}

TEST_F(Edits, PathsThatCannotBeEditedAreNamed) {
    EXPECT_THAT(complaint(R"({"name": "x", "remove": ["/Nothing"]})"),
                AllOf(HasSubstr("edit 1 'x'"), HasSubstr("</Nothing>")));
    EXPECT_THAT(complaint(R"({"deactivate": ["/Nothing"]})"), HasSubstr("</Nothing>"));
    EXPECT_THAT(complaint(R"({"remove": ["/World/Borrowed/Inside"]})"), HasSubstr("deactivate it instead"));
    EXPECT_TRUE(prim("/World/Borrowed/Inside"));
    EXPECT_THAT(complaint(R"({"rename": {"/World/Ball": "/World/Looks"}})"), HasSubstr("already"));
    EXPECT_THAT(complaint(R"({"rename": {"/World/Ball": "/Gone/Ball"}})"), HasSubstr("</Gone>"));
    EXPECT_THAT(complaint(R"({"rename": {"/World": "/World/Looks/World"}})"), HasSubstr("below itself"));
}

TEST_F(Edits, PrimsGoOutAndComeBack) {
    EXPECT_TRUE(apply(R"({"deactivate": ["/World/Ball", "/World/Borrowed/Inside"]})"));
    EXPECT_FALSE(prim("/World/Ball").IsActive());
    EXPECT_TRUE(apply(R"({"activate": ["/World/Ball"]})"));
    EXPECT_TRUE(prim("/World/Ball").IsActive());
    EXPECT_FALSE(prim("/World/Borrowed/Inside").IsActive());
}

TEST_F(Edits, VariantsAreChosen) {
    EXPECT_EQ(value<int>("/World/Ball.shade"), 1);
    EXPECT_TRUE(apply(R"({"variant": {"/World/Ball": {"shading": "red"}}})"));
    EXPECT_EQ(value<int>("/World/Ball.shade"), 2);
    EXPECT_THAT(complaint(R"({"variant": {"/World/Ball": {"shading": "pink"}}})"),
                AllOf(HasSubstr("'pink'"), HasSubstr("grey, red")));
    EXPECT_THAT(complaint(R"({"variant": {"/World/Ball": {"size": "big"}}})"), HasSubstr("'size'"));
}

TEST_F(Edits, LayersAreMutedByTheEndOfTheirPath) {
    EXPECT_TRUE(apply(R"({"mute": ["sub.usda"]})"));
    EXPECT_FALSE(stage->GetAttributeAtPath(SdfPath("/World/Ball.fromSub")));
    EXPECT_TRUE(apply(R"({"unmute": ["./sub.usda"]})"));
    EXPECT_EQ(value<double>("/World/Ball.fromSub"), 3);
    EXPECT_THAT(complaint(R"({"mute": ["none.usda"]})"),
                AllOf(HasSubstr("'none.usda'"), HasSubstr("/sub.usda")));
    EXPECT_THAT(complaint(R"({"mute": ["scene.usda"]})"), HasSubstr("root layer"));
}

} // namespace
} // namespace hipr::test
