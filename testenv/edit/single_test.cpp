// Every row of the table by itself: the edit in a running viewer gives the picture of a viewer that was
// started on the edited scene, bit for bit, and so does taking it back.
#include <cstdlib>
#include <gtest/gtest.h>

#include "renderer/trace/machine.h"
#include "testenv/edit/edits.h"
#include "testenv/edit/viewer.h"

namespace hipr::test {
namespace {

class SingleEdit : public testing::TestWithParam<Row> {
protected:
    /// One viewer and one stage for all rows: what one edit leaves behind is there when the next comes.
    struct Running {
        MachineReuse reuse;
        Scene scene;
        Viewer viewer;
        Picture base = freshPicture(scene);

        Running() {
            viewer.tick(scene.stage(), scene.view);
            viewer.picture(); // so that the first edit finds something to edit
        }
    };
    static void TearDownTestSuite() { running.reset(); }
    static std::unique_ptr<Running> running;

    static Picture render() {
        running->viewer.tick(running->scene.stage(), running->scene.view);
        return running->viewer.picture();
    }
    void SetUp() override {
        if (!running) running = std::make_unique<Running>();
    }
    void TearDown() override {
        if (HasFailure()) running.reset(); // the next row shall not suffer
    }
    static void expectSame(const Picture& live, const Picture& fresh, const char* when) {
        const std::string difference = live.differenceTo(fresh);
        EXPECT_EQ(difference, "") << when;
        const char* const folder = std::getenv("HIPR_TEST_OUT");
        if (difference.empty() || !folder) return;
        const std::string name =
            std::string(folder) + "/" + testing::UnitTest::GetInstance()->current_test_info()->name();
        live.save(name + "-live.ppm");
        fresh.save(name + "-fresh.ppm");
    }
};

std::unique_ptr<SingleEdit::Running> SingleEdit::running;

TEST_P(SingleEdit, EqualsFresh) {
    const Row& row = GetParam();
    if (PXR_VERSION < 2102 && !row.untold.empty()) GTEST_SKIP() << row.untold;
    Scene& scene = running->scene;
    Picture before = running->base;
    if (row.before) {
        row.before(scene);
        before = render();
    }
    row.edit(scene);
    const Picture live = render(), fresh = freshPicture(scene);
    expectSame(live, fresh, "after the edit");
    // Renaming changes names only; all other edits must show, or the row would prove nothing.
    Picture named = before;
    if (named.prims.size() == fresh.prims.size()) named.prims = fresh.prims;
    named.scene = fresh.scene;
    for (size_t i = 0; i < named.layers.size() && i < fresh.layers.size(); ++i)
        if (named.layers[i].aov.rfind("Crypto", 0) == 0) named.layers[i] = fresh.layers[i];
    EXPECT_EQ(!named.differenceTo(fresh).empty(), row.shows) << "whether the edit changes the picture";
    scene.reset();
    if (!row.backUntold.empty()) scene.swapStage();
    expectSame(render(), running->base, "after the edit was taken back");
}

/// Samples are not thrown away: the one setting where a running viewer may hold more than a fresh one.
TEST(Samples, MoreGoOnAndFewerKeepWhatIsThere) {
    MachineReuse reuse;
    Scene scene;
    Viewer viewer;
    const auto render = [&](int samples) {
        scene.view.settings["convergedSamplesPerPixel"] = PXR_NS::VtValue(samples);
        viewer.tick(scene.stage(), scene.view);
        return viewer.picture();
    };
    render(1);
    const Picture three = render(3);
    EXPECT_EQ(three.differenceTo(freshPicture(scene)), "");
    Picture two = render(2);
    two.scene = three.scene; // but for the setting
    EXPECT_EQ(two.differenceTo(three), "");
}

std::string rowName(const testing::TestParamInfo<Row>& info) {
    return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(All, SingleEdit, testing::ValuesIn(allRows()), rowName);

} // namespace
} // namespace hipr::test
