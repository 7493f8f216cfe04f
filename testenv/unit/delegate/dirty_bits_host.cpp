#include "testenv/unit/delegate/dirty_bits_rows.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace dirtybits {

namespace {

const Elements setting = {{Target::View, Change::Setting}};

Apply buffer(HdDirtyBits bits, bool resize) {
    return [=](World& world, bool make) {
        world.prim("/buffer").buffer.dimensions = GfVec3i(32, resize && make ? 48 : 32, 1);
        world.tracker().MarkBprimDirty(SdfPath("/buffer"), bits);
    };
}

/// Inserts a prim, or removes it.
template <class Insert> Apply insert(const char* path, Insert work) {
    return [=](World& world, bool make) {
        if (make) {
            work(world);
        } else {
            world.scene().remove(SdfPath(path));
        }
    };
}

template <class T> Apply set(const char* key, T made, T undone) {
    return [=](World& world, bool make) {
        world.host().delegate().SetRenderSetting(TfToken(key), VtValue(make ? made : undone));
    };
}

HdRprimCollection collection(TfToken const& repr = HdReprTokens->refined) {
    return HdRprimCollection(HdTokens->geometry, HdReprSelector(repr));
}

void exclude(World& world, bool make) {
    HdRprimCollection without = collection();
    if (make) {
        without.SetExcludePaths({SdfPath("/square")});
    }
    world.host().setCollection(without);
}

void addInstanced(World& world) {
    world.scene().addInstancer(SdfPath("/few"), SdfPath("/few.square"), {{1, 1, 0}, {2, 1, 0}});
    world.addSquare("/few.square", Target::Added, "/few");
}

void removeInstanced(World& world, bool make) {
    if (make) {
        addInstanced(world);
    } else {
        world.scene().remove(SdfPath("/few.square"));
        world.scene().remove(SdfPath("/few"));
    }
}

Row prim(const char* what, const char* edit, Apply apply, Elements made, Elements undone) {
    return {"", what, edit, std::move(apply), std::move(made), std::move(undone), false};
}

} // namespace

Section bufferSection() {
    const char* described = "size and format: the buffer is allocated again, empty, and filled from the film";
    return {"Render buffer",
            "A buffer is no element: the picture under way goes on, and is copied into it.",
            {
                {"HdRenderBuffer::DirtyDescription",
                 described,
                 "",
                 buffer(HdRenderBuffer::DirtyDescription, false),
                 {}},
                {"HdRenderBuffer::DirtyDescription",
                 described,
                 "it becomes higher; the viewport stays",
                 buffer(HdRenderBuffer::DirtyDescription, true),
                 {}},
                {"HdRenderBuffer::AllDirty", described, "", buffer(HdRenderBuffer::AllDirty, false), {}},
                {"HdRenderBuffer::Clean", "nothing; Hydra refuses to mark it", "", [](World&, bool) {}, {}},
            }};
}

Section primSection() {
    const Elements added = {{Target::Added, Change::Added}}, removed = {{Target::Added, Change::Removed}};
    const SdfPath path("/new");
    return {
        "Prims that come and go",
        "A new element is Added, whatever else is read of it. Nothing is marked: Hydra syncs new prims as a "
        "whole and finalizes removed ones.",
        {
            prim("a mesh", "it comes",
                 insert("/new",
                        [](World& world) {
                            world.addSquare("/new", Target::Added).transform.SetTranslate(GfVec3d(3, 3, 0));
                        }),
                 added, removed),
            prim("a cloud of splats", "it comes",
                 insert("/new", [=](World& world) { world.scene().addSplats(path, GfVec3f(0.5f)); }), added,
                 removed),
            prim("an instancer with a mesh", "both come", removeInstanced, added, removed),
            prim("an instancer without a mesh", "it comes",
                 insert("/new",
                        [=](World& world) {
                            world.scene().addInstancer(path, SdfPath("/none"), {{0, 0, 0}});
                        }),
                 {}, {}),
            prim("a light", "it comes",
                 insert("/new", [=](World& world) { world.scene().addSphereLightFarAway(path); }), added,
                 removed),
            prim("a material", "it comes",
                 insert("/new", [=](World& world) { world.scene().addMaterial(path, GfVec3f(0.5f)); }), added,
                 removed),
            prim("a camera that nobody looks through", "it comes",
                 insert("/new", [=](World& world) { world.scene().addCamera(path, 2.0); }), {}, {}),
            prim("a computation", "it comes",
                 insert("/new", [=](World& world) { world.scene().addComputation(path); }), {}, {}),
            prim("a render buffer that no AOV is bound to", "it comes",
                 insert("/new",
                        [=](World& world) {
                            world.scene().addBuffer(path, {GfVec3i(8, 8, 1), HdFormatFloat32Vec4, false});
                        }),
                 {}, {}),
        }};
}

Section hostSection() {
    const Elements hidden = {{Target::Square, Change::Visibility}};
    Elements allHidden;
    for (Target target : {Target::Square, Target::Smooth, Target::Computed, Target::Many, Target::Nested,
                          Target::Cloud, Target::Clouds, Target::Fog, Target::Strand, Target::Dots}) {
        allHidden.push_back({target, Change::Visibility});
    }
    return {
        "Host and settings",
        "What is no prim. Tasks are the host's: their bits (`HdChangeTracker::DirtyType`, `DirtyParams`, "
        "`DirtyCollection`, `DirtyRenderTags`) reach the delegate as what the render pass is executed with.",
        {
            {"HdChangeTracker::DirtyCollection", "the collection of the render pass", "a mesh is excluded",
             exclude, hidden},
            {"HdChangeTracker::DirtyCollection",
             "the same",
             "the collection asks for hulls",
             [](World& world, bool make) {
                 world.host().setCollection(
                     collection(make ? HdReprTokens->smoothHull : HdReprTokens->refined));
             },
             {{Target::Smooth, Change::Geometry}}},
            {"HdChangeTracker::DirtyRenderTags", "the tags of the render pass", "only guides are shown",
             [](World& world, bool make) {
                 world.host().setRenderTags({make ? HdRenderTagTokens->guide : HdRenderTagTokens->geometry});
             },
             allHidden},
            {"HdChangeTracker::DirtyParams", "camera, viewport and AOVs of the render pass",
             "the viewport becomes smaller",
             [](World& world, bool make) { world.host().setViewport(make ? 16 : 32, make ? 16 : 32); },
             setting},
            {"HdChangeTracker::DirtyParams",
             "the same",
             "the clear colour changes",
             [](World& world, bool make) { world.host().setClearColor(GfVec4f(make ? 1.f : 0.f)); },
             {}},
            {"HdChangeTracker::DirtyType", "nothing", "", [](World&, bool) {}, {}},
            {"", "all settings", "`hipr:maxDepth` changes", set("hipr:maxDepth", 3, 8), setting},
            {"", "all settings", "`enableSceneLights` is switched off", set("enableSceneLights", false, true),
             setting},
            {"",
             "settings",
             "`convergedSamplesPerPixel` grows: the picture goes on",
             set("convergedSamplesPerPixel", 6, 4),
             {}},
            {"",
             "settings",
             "`hipr:mode` changes: what is rendered first is no part of the picture",
             set("hipr:mode", std::string("uniform"), std::string("delta")),
             {}},
        }};
}

std::vector<Absent> const& absentTypes() {
    static const std::vector<Absent> types = {
        {"field3dAsset", {}},
        {"texture",
         {"HdTexture::Clean", "HdTexture::DirtyTexture", "HdTexture::DirtyParams", "HdTexture::AllDirty"}},
        {"coordSys", {"HdCoordSys::Clean", "HdCoordSys::DirtyTransform", "HdCoordSys::AllDirty"}},
    };
    return types;
}

} // namespace dirtybits

PXR_NAMESPACE_CLOSE_SCOPE
