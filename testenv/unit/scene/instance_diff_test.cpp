// Which instances an edit changes, and that this is all that has to be refreshed.
#include <random>

#include <gtest/gtest.h>

#include "renderer/scene/instance_diff.h"

using namespace hipr;

namespace {

using Changes = std::vector<std::pair<uint32_t, Change>>;
constexpr uint32_t All = ChangedElement::AllInstances;

Changes changes(const InstancesDesc& before, const InstancesDesc& now) {
    Changes result;
    for (const InstanceChange& change : changedInstances(before, now))
        result.push_back({change.instance, change.change});
    return result;
}

/// Instances at these places on the x axis.
InstancesDesc at(const std::vector<float>& places) {
    InstancesDesc desc;
    for (float x : places)
        desc.transforms.push_back(glm::mat4x3({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {x, 0, 0}));
    return desc;
}

Primvar primvar(std::vector<float> values) {
    Primvar result;
    result.name = "temperature";
    result.components = 1;
    result.values = std::move(values);
    return result;
}

InstancesDesc at(const std::vector<float>& places, std::vector<float> values) {
    InstancesDesc desc = at(places);
    desc.primvars.push_back(primvar(std::move(values)));
    return desc;
}

} // namespace

TEST(InstanceDiff, EqualInstancesDoNotDiffer) {
    EXPECT_EQ(changes(at({1, 2, 3}, {4, 5, 6}), at({1, 2, 3}, {4, 5, 6})), Changes());
    EXPECT_EQ(changes({}, {}), Changes());
    EXPECT_EQ(changes(at({NAN, 2}, {1, NAN}), at({NAN, 2}, {1, NAN})), Changes());
}

TEST(InstanceDiff, NamesWhatMoved) {
    EXPECT_EQ(changes(at({1, 2, 3}), at({1, 7, 3})), (Changes{{1, Change::Transform}}));
    EXPECT_EQ(changes(at({1, 2}), at({3, 4})), (Changes{{0, Change::Transform}, {1, Change::Transform}}));
}

TEST(InstanceDiff, NamesWhoseCategoriesChanged) {
    InstancesDesc plain = at({1, 2, 3}), linked = plain, more = plain;
    linked.categories = {{}, {"lit"}};
    more.categories = {{}, {"lit"}, {"lit", "other"}};
    EXPECT_EQ(changes(plain, linked), (Changes{{1, Change::Linking}}));
    EXPECT_EQ(changes(linked, plain), (Changes{{1, Change::Linking}}));
    EXPECT_EQ(changes(linked, more), (Changes{{2, Change::Linking}}));
    plain.categories = {{}, {}, {}};
    EXPECT_EQ(changes(at({1, 2, 3}), plain), Changes());
}

TEST(InstanceDiff, NamesWhosePrimvarsChanged) {
    EXPECT_EQ(changes(at({1, 2, 3}, {4, 5, 6}), at({1, 2, 3}, {4, 5, 0})), (Changes{{2, Change::Primvar}}));
    EXPECT_EQ(changes(at({1, 2, 3}, {4, 5, 6}), at({1, 0, 3}, {4, 0, 6})),
              (Changes{{1, Change::Transform | Change::Primvar}}));
}

TEST(InstanceDiff, FollowsIndexedPrimvars) {
    InstancesDesc before = at({1, 2}, {4, 5}), now = before;
    before.primvars[0].indices = {0, 1};
    now.primvars[0].indices = {1, 1};
    EXPECT_EQ(changes(before, now), (Changes{{0, Change::Primvar}}));
    now.primvars[0].indices = {1, 0};
    now.primvars[0].values = {5, 4}; // the same, told otherwise
    EXPECT_EQ(changes(before, now), Changes());
}

TEST(InstanceDiff, NamesAddedAndRemovedOnesWhereverTheyAre) {
    EXPECT_EQ(changes(at({1, 2}), at({1, 2, 3, 4})), (Changes{{2, Change::Added}, {3, Change::Added}}));
    EXPECT_EQ(changes(at({1, 2, 3, 4}), at({1, 2})), (Changes{{2, Change::Removed}, {3, Change::Removed}}));
    EXPECT_EQ(changes(at({1, 2, 3, 4}, {1, 2, 3, 4}), at({1, 4}, {1, 4})),
              (Changes{{1, Change::Removed}, {2, Change::Removed}}));
    EXPECT_EQ(changes(at({2, 4}, {2, 4}), at({1, 2, 3, 4}, {1, 2, 3, 4})),
              (Changes{{0, Change::Added}, {2, Change::Added}}));
    EXPECT_EQ(changes(at({1, 2}), {}), (Changes{{0, Change::Removed}, {1, Change::Removed}}));
    EXPECT_EQ(changes({}, at({1})), (Changes{{0, Change::Added}}));
}

TEST(InstanceDiff, ComparesByIndexWhenSomeMoveAndOthersGo) {
    EXPECT_EQ(changes(at({1, 2, 3}), at({1, 7})), (Changes{{1, Change::Transform}, {2, Change::Removed}}));
    EXPECT_EQ(changes(at({1, 2}), at({1, 7, 3})), (Changes{{1, Change::Transform}, {2, Change::Added}}));
}

TEST(InstanceDiff, HonoursIdsThatAreGiven) {
    InstancesDesc before = at({1, 2, 3}), now = at({1, 3});
    EXPECT_EQ(changes(before, now), (Changes{{1, Change::Removed}}));
    now.instanceIds = {0, 1}; // what was number 2 says that it is 1
    EXPECT_EQ(changes(before, now), (Changes{{1, Change::Transform}, {2, Change::Removed}}));
    before.instanceIds = {10, 20, 30};
    now.instanceIds = {10, 30};
    EXPECT_EQ(changes(before, now), (Changes{{1, Change::Removed}}));
    now = before;
    now.instanceIds[1] = 99;
    EXPECT_EQ(changes(before, now), (Changes{{1, Change::Primvar}}));
}

TEST(InstanceDiff, APrimvarThatComesOrGoesConcernsAll) {
    EXPECT_EQ(changes(at({1, 2}), at({1, 2}, {4, 5})), (Changes{{All, Change::Primvar}}));
    EXPECT_EQ(changes(at({1, 2}, {4, 5}), at({1, 3})),
              (Changes{{1, Change::Transform}, {All, Change::Primvar}}));
    InstancesDesc renamed = at({1, 2}, {4, 5});
    renamed.primvars[0].name = "other";
    EXPECT_EQ(changes(at({1, 2}, {4, 5}), renamed), (Changes{{All, Change::Primvar}}));
    // Without a value for one instance it is ignored for all of them.
    EXPECT_EQ(changes(at({1, 2}, {4, 5}), at({1, 2}, {4})), (Changes{{All, Change::Primvar}}));
    EXPECT_EQ(changes(at({1}, {4}), at({1, 2}, {4})), (Changes{{1, Change::Added}, {All, Change::Primvar}}));
    EXPECT_EQ(changes(at({1, 2}, {4}), at({1, 2}, {4})), Changes());
}

/// Refreshing only what was named must turn the old instances into the new ones.
TEST(InstanceDiff, NamesEnoughInRandomEdits) {
    std::mt19937 random(1);
    const auto below = [&](size_t n) { return size_t(random() % n); };
    for (int round = 0; round < 2000; ++round) {
        std::vector<float> places, values;
        for (size_t i = 0, n = below(6); i < n; ++i)
            places.push_back(float(below(4))), values.push_back(float(below(2)));
        std::vector<float> newPlaces = places, newValues = values;
        for (size_t edits = below(4); edits > 0; --edits) {
            const size_t i = below(newPlaces.size() + 1);
            const long where = long(i);
            if (below(2) == 0 || i == newPlaces.size()) {
                newPlaces.insert(newPlaces.begin() + where, float(below(4)));
                newValues.insert(newValues.begin() + where, float(below(2)));
            } else if (below(2) == 0) {
                newPlaces.erase(newPlaces.begin() + where);
                newValues.erase(newValues.begin() + where);
            } else {
                newPlaces[i] = float(below(4)), newValues[i] = float(below(2));
            }
        }
        std::vector<bool> gone(places.size()), come(newPlaces.size());
        for (const auto& [instance, change] : changes(at(places, values), at(newPlaces, newValues))) {
            if (change != Change::Added) gone.at(instance) = true;
            if (change != Change::Removed) come.at(instance) = true;
        }
        std::vector<std::pair<float, float>> left, leftNow;
        for (size_t i = 0; i < places.size(); ++i)
            if (!gone[i]) left.push_back({places[i], values[i]});
        for (size_t i = 0; i < newPlaces.size(); ++i)
            if (!come[i]) leftNow.push_back({newPlaces[i], newValues[i]});
        ASSERT_EQ(left, leftNow) << "round " << round;
    }
}
