// Random sequences of edits, in one viewer that is never made anew: after each sequence the picture is that
// of a fresh one. HIPR_EDIT_SEED is the seed of the first sequence, HIPR_EDIT_SEQUENCES how many there are.
#include <cstdlib>
#include <gtest/gtest.h>

#include "renderer/trace/machine.h"
#include "testenv/edit/random_edits.h"
#include "testenv/edit/viewer.h"

namespace hipr::test {
namespace {

constexpr int EditsEach = 12;

unsigned fromEnvironment(const char* name, unsigned fallback) {
    const char* const text = std::getenv(name);
    return text ? unsigned(std::strtoul(text, nullptr, 10)) : fallback;
}

/// `wait`: whether every edit's picture is waited for, or edits come while the one before is still rendered.
void playAll(bool wait) {
    const unsigned first = fromEnvironment("HIPR_EDIT_SEED", 1);
    const unsigned sequences = fromEnvironment("HIPR_EDIT_SEQUENCES", 8);
    MachineReuse reuse;
    Scene scene;
    Viewer viewer;
    for (unsigned i = 0; i < sequences; ++i) {
        RandomEdits edits(first + i);
        std::string history;
        for (int e = 0; e < EditsEach; ++e) {
            edits.applyOne(scene);
            history += " " + edits.last();
            viewer.tick(scene.stage(), scene.view);
            if (wait) viewer.picture();
        }
        const std::string difference = viewer.picture().differenceTo(freshPicture(scene));
        ASSERT_EQ(difference, "") << "HIPR_EDIT_SEED=" << first + i << ", edits:" << history;
        scene.reset();
        scene.swapStage();
    }
}

TEST(RandomSequences, EqualFreshWhenEachEditIsShown) {
    playAll(true);
}

TEST(RandomSequences, EqualFreshWhenEditsComeWhileRendering) {
    playAll(false);
}

} // namespace
} // namespace hipr::test
