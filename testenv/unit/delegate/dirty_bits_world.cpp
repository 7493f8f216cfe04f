#include <gtest/gtest.h>

#include "pxr/imaging/pxOsd/tokens.h"
#include "testenv/common/vdb_kit.h"
#include "testenv/unit/delegate/dirty_bits.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace dirtybits {

World::World() : _host({"color", "primId"}) {
    const GfVec3f grey(0.5f);
    scene().addDome(SdfPath("/dome"));
    scene().addBuffer(SdfPath("/buffer"),
                      {GfVec3i(TestHost::width, TestHost::height, 1), HdFormatFloat32, false});
    _host.bind("depth", SdfPath("/buffer"));
    scene().addCamera(SdfPath("/camera"), 8.0);
    _host.setCamera(SdfPath("/camera"));
    render();

    scene().addSphereLightFarAway(SdfPath("/lamp")).transform.SetTranslate(GfVec3d(0, 3, 3));
    learn(Target::Lamp);
    scene().addMaterial(SdfPath("/red"), GfVec3f(0.8f, 0.1f, 0.1f));
    learn(Target::Red);
    scene().addMaterial(SdfPath("/green"), GfVec3f(0.1f, 0.8f, 0.1f));
    render();

    addSquare("/square", Target::Square).material = SdfPath("/red");
    prim("/square").primvars[HdTokens->normals] = {HdInterpolationVertex,
                                                   VtValue(VtVec3fArray(4, GfVec3f(0, 0, 1)))};
    prim("/square").primvars[HdTokens->widths] = {HdInterpolationVertex, VtValue(VtFloatArray(4, 1.f))};
    learn(Target::Square);

    TestScene::Prim& smooth = addSquare("/smooth", Target::Smooth);
    smooth.topology = HdMeshTopology(PxOsdOpenSubdivTokens->catmullClark, PxOsdOpenSubdivTokens->rightHanded,
                                     VtIntArray{4}, VtIntArray{0, 1, 2, 3});
    smooth.transform.SetTranslate(GfVec3d(2, 0, 0));
    smooth.refineLevel = 2;
    learn(Target::Smooth);

    scene().addComputation(SdfPath("/computation"));
    addSquare("/computed", Target::Computed).computation = SdfPath("/computation");
    prim("/computed").transform.SetTranslate(GfVec3d(-2, 0, 0));
    learn(Target::Computed);

    addSquare("/hidden", Target::Hidden).visible = false;
    learn(Target::Hidden);

    TestScene::Prim& many = scene().addInstancer(SdfPath("/many"), SdfPath("/many.square"),
                                                 {{-2, 2, 0}, {0, 2, 0}, {2, 2, 0}, {3, 2, 0}});
    many.indices[SdfPath("/many.square")] = {0, 1, 2};
    many.primvars[HdTokens->displayColor] = {HdInterpolationInstance, VtValue(VtVec3fArray(4, grey))};
    addSquare("/many.square", Target::Many, "/many");
    learn(Target::Many);

    scene().addInstancer(SdfPath("/outer"), SdfPath("/inner"), {{-1, 0, 0}, {1, 0, 0}});
    scene().addInstancer(SdfPath("/inner"), SdfPath("/inner.square"), {{0, -2, 0}, {0, -3, 0}},
                         SdfPath("/outer"));
    addSquare("/inner.square", Target::Nested, "/inner");
    learn(Target::Nested);

    scene().addCurve(SdfPath("/strand"), grey).transform.SetTranslate(GfVec3d(-3, 3, 0));
    learn(Target::Strand);
    scene().addPoints(SdfPath("/dots"), VtVec3fArray(2, grey)).transform.SetTranslate(GfVec3d(3, -3, 0));
    learn(Target::Dots);

    addFog();
    _expected = Target::Cloud;
    scene().addSplats(SdfPath("/cloud"), GfVec3f(0.8f, 0.5f, 0.1f)).transform.SetTranslate(GfVec3d(0, 3, 0));
    render();
    scene().addInstancer(SdfPath("/clouds"), SdfPath("/clouds.cloud"), {{-2, -1, 0}, {2, -1, 0}});
    _expected = Target::Clouds;
    scene().addSplats(SdfPath("/clouds.cloud"), GfVec3f(0.1f, 0.5f, 0.8f), SdfPath("/clouds"));
    render();
}

/// A volume of one field, and a material with a volume terminal.
void World::addFog() {
    hipr::test::VdbGrid density, thin;
    thin.name = "thin";
    thin.value = [](glm::ivec3) { return 0.5; };
    const std::string file = testing::TempDir() + "dirty_bits.vdb";
    hipr::test::writeVdb(file, {density, thin});
    TestScene::Prim& fog = scene().addVolume(SdfPath("/fog"));
    fog.transform.SetTranslate(GfVec3d(-3, -3, 0));
    fog.primvars[TfToken("hipr:volume:density")] = {HdInterpolationConstant, VtValue(1.f)};
    scene().addField(SdfPath("/fog.density"), file, SdfPath("/fog"));
    learn(Target::Fog);

    HdMaterialNode medium{SdfPath("/mist/medium"), TfToken("ND_absorption_vdf"), {}};
    medium.parameters[TfToken("absorption")] = VtValue(GfVec3f(1.f));
    HdMaterialNetworkMap networks;
    networks.map[HdMaterialTerminalTokens->volume].nodes = {medium};
    networks.terminals = {medium.path};
    scene().addMaterial(SdfPath("/mist"), GfVec3f(0.5f)).resource = VtValue(networks);
    learn(Target::Mist);
}

TestScene::Prim& World::addSquare(const char* path, Target target, const char* instancer) {
    _expected = target;
    return scene().addSquare(SdfPath(path), GfVec3f(0.5f), *instancer ? SdfPath(instancer) : SdfPath());
}

/// Renders what was added last, and gives its element a name.
void World::learn(Target target) {
    _expected = target;
    render();
}

Elements World::render() {
    const uint64_t before = changes();
    if (!_host.render()) {
        throw std::runtime_error("the picture does not converge");
    }
    Elements elements;
    if (changes() == before) {
        return elements;
    }
    for (hipr::ChangedElement const& changed : _host.loop().lastChanged().elements) {
        const bool view = std::holds_alternative<std::monostate>(changed.element);
        auto known =
            view ? _targets.emplace(changed.element, Target::View).first : _targets.find(changed.element);
        if (known == _targets.end()) {
            known = _targets.emplace(changed.element, _expected.value_or(Target::Added)).first;
            _expected.reset();
        }
        elements.push_back({known->second, changed.change, changed.instance});
    }
    return elements;
}

} // namespace dirtybits

PXR_NAMESPACE_CLOSE_SCOPE
