"""Runs inside usdview (testusdview --testScript): looks at the viewport, edits the stage, picks.

The viewport shows the 4 x 4 units of the front camera over its full height.
"""

import os
import sys
import time
import traceback

from pxr import Gf, Sdf, Usd, UsdGeom
from pxr.Usdviewq.qt import QtWidgets

import usd_tool

DEADLINE = 180.0  # seconds for one picture on a slow machine


class Viewer(object):
    def __init__(self, controller):
        self.controller = controller
        self.view = controller._stageView
        self.stage = controller._dataModel.stage

    def converge(self):
        """Lets usdview work until the picture of the present stage has converged."""
        for _ in range(5):  # the edit reaches the renderer with the next paint
            self.view.updateGL()
            QtWidgets.QApplication.processEvents()
        end = time.time() + DEADLINE
        while not self.view.IsRendererConverged():
            assert time.time() < end, "the picture did not converge within %g s" % DEADLINE
            QtWidgets.QApplication.processEvents()
            time.sleep(0.01)
        self.view.updateGL()

    def pixel_of(self, x, y):
        """Widget coordinates of a place in world units."""
        width, height = self.view.width(), self.view.height()
        unit = height / 4.0
        return int(0.5 * width + x * unit), int(0.5 * height - y * unit)

    def expect(self, what, **spots):
        """Checks colours; each keyword is a colour and its value a list of places."""
        image = self.controller.GrabViewportShot()
        for colour, places in spots.items():
            for place in places:
                pixel = image.pixelColor(*self.pixel_of(*place))
                got = usd_tool.colour_name(pixel.red(), pixel.green(), pixel.blue())
                assert got == colour, "%s: %s at %s, expected %s (%d %d %d)" % (
                    what, got, place, colour, pixel.red(), pixel.green(), pixel.blue())
        print("ok: " + what)

    def pick(self, x, y):
        inside, frustum = self.view.computePickFrustum(*self.pixel_of(x, y))
        assert inside
        return self.view.pick(frustum)[1]


# Places near the middles of the squares, off the axes that usdview draws.
RED, GREEN, BLUE, EMPTY = (-1.2, 0.2), (1.2, 0.2), (0.2, 1.6), (-1.2, -1.2)
SPLATS = (0.2, -0.5)


def check_picture(viewer):
    name = viewer.view.rendererDisplayName
    assert name == usd_tool.RENDERER, "usdview draws with " + name
    viewer.converge()
    viewer.expect("first picture", red=[RED], green=[GREEN], blue=[BLUE], grey=[EMPTY])


def check_move(viewer):
    red = viewer.stage.GetPrimAtPath("/World/Red")
    red.GetAttribute("xformOp:translate").Set(Gf.Vec3d(-1, -1.25, 0))
    viewer.converge()
    viewer.expect("after moving a prim", grey=[RED], red=[EMPTY], green=[GREEN], blue=[BLUE])


def check_visibility(viewer):
    blue = UsdGeom.Imageable(viewer.stage.GetPrimAtPath("/World/Blue"))
    blue.MakeInvisible()
    viewer.converge()
    viewer.expect("after hiding a prim", grey=[BLUE], green=[GREEN])
    blue.MakeVisible()
    viewer.converge()
    viewer.expect("after showing it again", blue=[BLUE], green=[GREEN])


def check_frame(viewer):
    viewer.controller.setFrame(2)
    viewer.converge()
    viewer.expect("in the next frame", grey=[GREEN], green=[(1.2, -0.8)], red=[EMPTY])


def check_pick(viewer):
    # One pick for a prim that moved, one for a prim that did not, one beside everything.
    for place, path in ((EMPTY, "/World/Red"), (BLUE, "/World/Blue"), ((0.2, -1.6), "")):
        got = viewer.pick(*place)
        assert got == (Sdf.Path(path) if path else Sdf.Path.emptyPath), "picked <%s>, expected <%s>" % (got, path)
        viewer.converge()
    print("ok: picks")


def check_splats(viewer):
    viewer.expect("before there are splats", grey=[SPLATS])
    cloud = viewer.stage.DefinePrim("/World/Cloud", "ParticleField3DGaussianSplat")
    cloud.GetAttribute("positions").Set([Gf.Vec3f(SPLATS[0], SPLATS[1], 0.5)])
    cloud.GetAttribute("scales").Set([Gf.Vec3f(0.08)])
    cloud.GetAttribute("radiance:sphericalHarmonicsDegree").Set(0)
    cloud.GetAttribute("radiance:sphericalHarmonicsCoefficients").Set([Gf.Vec3f(0.5, -0.5, -0.5) / 0.28209479])
    viewer.converge()
    viewer.expect("with splats", red=[SPLATS, EMPTY], blue=[BLUE])
    got = viewer.pick(*SPLATS)
    assert got == cloud.GetPath(), "picked <%s> instead of splats" % got
    # usdview frames what is selected by this, though no extent is authored.
    box = UsdGeom.BBoxCache(2, ["default"]).ComputeWorldBound(cloud).ComputeAlignedRange()
    assert Gf.IsClose(box.GetSize(), Gf.Vec3d(0.48), 1e-4), box
    print("ok: splats are picked and framed")


def check_camera_light(viewer):
    """A surface that does not emit, in a scene without lights."""
    plain = UsdGeom.Mesh.Define(viewer.stage, "/World/Plain")
    plain.CreateFaceVertexCountsAttr([4])
    plain.CreateFaceVertexIndicesAttr([0, 1, 2, 3])
    plain.CreatePointsAttr([(-1.4, -1.8, 1), (-1.0, -1.8, 1), (-1.0, -1.4, 1), (-1.4, -1.4, 1)])
    plain.CreateDisplayColorAttr([(0, 0, 1)])
    viewer.converge()
    # Its colour and what it mirrors of the camera's light; unlit it would be black, and so grey.
    viewer.expect("lit by the camera", mixed=[(-1.2, -1.6)], blue=[BLUE])


def check_settings(viewer):
    keys = [setting.key for setting in viewer.view.GetRendererSettingsList()]
    assert "convergedSamplesPerPixel" in keys, "settings: %s" % keys
    viewer.view.SetRendererSetting("convergedSamplesPerPixel",
                                   viewer.view.GetRendererSetting("convergedSamplesPerPixel"))
    assert viewer.view.IsRendererConverged(), "a setting that did not change restarted the picture"
    print("ok: settings")


def testUsdviewInputFunction(appController):
    viewer = Viewer(appController)
    try:
        # A few samples are enough for flat colours.
        viewer.view.SetRendererSetting("convergedSamplesPerPixel", 4)
        if usd_tool.RENDERER == "Embree":
            viewer.view.SetRendererSetting("enableAmbientOcclusion", False)
        for check in (check_picture, check_move, check_visibility, check_frame, check_pick):
            check(viewer)
        if usd_tool.RENDERER == "HiPR":  # others restart
            check_camera_light(viewer)
            check_splats(viewer)
            if os.environ.get("HIPR_TEST_OUT"):
                viewer.controller.GrabViewportShot().save(os.path.join(os.environ["HIPR_TEST_OUT"], "usdview.png"))
            check_settings(viewer)
    except Exception:
        traceback.print_exc()
        sys.stdout.flush()
        os._exit(1)  # usdview would swallow the exit code
    print("usdview_script passed")
    sys.stdout.flush()
