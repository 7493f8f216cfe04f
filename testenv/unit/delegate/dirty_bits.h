/// @file dirty_bits.h
/// What every dirty bit of Hydra becomes: one table, which the tests check against the delegate and from
/// which docs/dirty_bits.md is made.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "testenv/unit/delegate/test_host.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace dirtybits {

/// What a changed element of the scene below is. View: camera, film and settings, which have no id.
enum class Target {
    View,
    Square,
    Smooth,
    Computed,
    Hidden,
    Many,
    Nested,
    Cloud,
    Clouds,
    Fog,
    Mist,
    Strand,
    Dots,
    Added,
    Lamp,
    Red
};

/// One element of an expected ChangedSet.
struct Element {
    Target target;
    hipr::Change change;
    uint32_t instance = hipr::ChangedElement::AllInstances;
    bool operator==(Element const& o) const {
        return target == o.target && change == o.change && instance == o.instance;
    }
};
using Elements = std::vector<Element>;

/// A host whose scene has one prim of each kind, all synced and rendered.
class World {
public:
    World();

    TestHost& host() { return _host; }
    TestScene& scene() { return _host.scene(); }
    HdChangeTracker& tracker() { return scene().tracker(); }
    TestScene::Prim& prim(const char* path) { return scene().prim(SdfPath(path)); }
    /// Adds a square whose object is to be known as `target` once it has been rendered.
    TestScene::Prim& addSquare(const char* path, Target target, const char* instancer = "");

    /// What rendering the edits made so far has changed; nothing when the picture was left alone.
    Elements render();
    /// Whether rendering without further edits would start the picture again.
    uint64_t changes() { return _host.loop().stats().changes; }
    double restarted() { return _host.loop().stats().progress.firstRevealSeconds; }

private:
    using Id = decltype(hipr::ChangedElement::element);
    void learn(Target target);
    void addFog();

    TestHost _host;
    std::map<Id, Target> _targets;
    std::optional<Target> _expected; ///< the next element that has no name yet
};

/// An edit, which bit tells of it, and what becomes of that.
struct Row {
    const char* bit;   ///< as it is written in C++; empty: no bit tells, but a prim, a setting or the host
    const char* reads; ///< what the delegate reads again, or why it does not
    const char* edit;  ///< empty: the bit is marked and nothing else
    /// Makes the edit, or takes it back, and marks the bit. Done again it changes no value.
    std::function<void(World&, bool make)> apply;
    Elements made;                       ///< what making it changes
    std::optional<Elements> undone = {}; ///< what taking it back changes, where that is something else
    bool again = true;                   ///< it can be applied twice
};

/// The rows of one type of prim.
struct Section {
    const char *title, *text;
    std::vector<Row> rows;
};

Section meshSection();
Section curvesSection();
Section pointsSection();
Section particleFieldSection();
Section volumeSection();
Section fieldSection(); ///< and volume terminals of materials
Section instancerSection();
Section lightSection();
Section materialSection();
Section cameraSection();
Section computationSection();
Section bufferSection();
Section primSection(); ///< prims that come and go
Section hostSection(); ///< render pass, film, settings

/// A prim type that the delegate does not take, and the bits that therefore never come.
struct Absent {
    const char* type;
    std::vector<const char*> bits;
};
std::vector<Absent> const& absentTypes();

inline std::vector<Section> allSections() {
    return {meshSection(),     curvesSection(), pointsSection(),      particleFieldSection(),
            volumeSection(),   fieldSection(),  instancerSection(),   lightSection(),
            materialSection(), cameraSection(), computationSection(), bufferSection(),
            primSection(),     hostSection()};
}

/// docs/dirty_bits.md.
std::string page();

} // namespace dirtybits

PXR_NAMESPACE_CLOSE_SCOPE
