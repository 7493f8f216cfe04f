"""The files that hosts get (plugin/hosts): the add-on for Blender against a stand-in for Blender's module, Houdini's JSON."""

import importlib.util
import json
import os
import re
import sys
import types
import unittest
from pathlib import Path
from unittest import mock

HOSTS = Path(os.environ["HIPR_HOST_FILES"])
SOURCE = Path(os.environ["HIPR_SOURCE_DIR"])
DELEGATE = "HdHiprRendererPlugin"


class Property:
    """What bpy.props.*Property(...) gives: its kind and arguments."""

    def __init__(self, kind, **arguments):
        self.kind, self.arguments = kind, arguments


def blender():
    """As much of bpy as the add-on touches."""
    bpy = types.ModuleType("bpy")
    bpy.registered = []
    panel = type("Panel", (), {})
    bpy.panels = [type(name, (panel,), {"COMPAT_ENGINES": {engine}})
                  for name, engine in (("DATA_PT_lens", "BLENDER_EEVEE"), ("RENDER_PT_eevee_sampling", "BLENDER_EEVEE"),
                                       ("CYCLES_PT_own", "CYCLES"))]
    bpy.types = types.SimpleNamespace(Panel=panel, PropertyGroup=type("PropertyGroup", (), {}),
                                      AddonPreferences=type("AddonPreferences", (), {}),
                                      HydraRenderEngine=type("HydraRenderEngine", (), {}), Scene=type("Scene", (), {}))
    bpy.props = types.SimpleNamespace(**{kind + "Property": lambda kind=kind, **a: Property(kind, **a)
                                         for kind in ("Bool", "Int", "Float", "Enum", "String", "Pointer")})
    bpy.utils = types.SimpleNamespace(register_class=bpy.registered.append, unregister_class=bpy.registered.remove)
    bpy.context = types.SimpleNamespace(preferences=types.SimpleNamespace(addons={}), scene=types.SimpleNamespace())
    return bpy


class BlenderAddon(unittest.TestCase):
    def setUp(self):
        self.bpy = blender()
        patch = mock.patch.dict(sys.modules, {"bpy": self.bpy})
        patch.start()
        self.addCleanup(patch.stop)
        spec = importlib.util.spec_from_file_location("hdhipr", HOSTS / "blender" / "hdhipr" / "__init__.py")
        self.addon = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(self.addon)

    def defaults(self):
        return {name: p.arguments["default"] for name, p in self.addon.HiprSettings.__annotations__.items()}

    def test_has_every_setting_of_the_manual(self):
        manual = re.findall(r"^\| `([^`]+)` \|", (SOURCE / "docs" / "settings.md").read_text(), re.M)
        self.assertEqual([row["name"] for row in self.addon.SETTINGS], manual)
        self.assertEqual(len(self.defaults()), len(manual))

    def test_properties_have_the_right_kind(self):
        properties = self.addon.HiprSettings.__annotations__
        self.assertEqual(properties["hipr_mode"].kind, "Enum")
        self.assertEqual([item[0] for item in properties["hipr_mode"].arguments["items"]], ["delta", "paper", "uniform"])
        self.assertEqual(properties["enableSceneLights"].kind, "Bool")
        self.assertEqual((properties["hipr_maxDepth"].kind, properties["hipr_maxDepth"].arguments["min"]), ("Int", 1))
        self.assertEqual(properties["hipr_floor"].kind, "Float")

    def test_hands_over_what_the_user_chose(self):
        values = self.defaults()
        values["hipr_mode"] = "uniform"
        self.bpy.context.scene.hipr = types.SimpleNamespace(**values)
        settings = self.addon.HiprRenderEngine().get_render_settings("FINAL")
        self.assertEqual(settings["hipr:mode"], "uniform")
        self.assertEqual(settings["aovToken:Combined"], "color")
        for row in self.addon.SETTINGS:
            if row["name"] != "hipr:mode":
                self.assertEqual(settings[row["name"]], row["default"])

    def test_registers_and_leaves_nothing_behind(self):
        self.addon.register()
        self.assertIn(self.addon.HiprRenderEngine, self.bpy.registered)
        self.assertEqual(self.bpy.types.Scene.hipr.kind, "Pointer")
        used = {panel.__name__ for panel in self.bpy.types.Panel.__subclasses__() if "HIPR" in panel.COMPAT_ENGINES}
        self.assertEqual(used, {"DATA_PT_lens", "HIPR_PT_settings"})
        self.addon.unregister()
        self.assertEqual(self.bpy.registered, [])
        self.assertFalse(hasattr(self.bpy.types.Scene, "hipr"))

    def test_names_the_delegate_and_its_folder(self):
        self.assertEqual(self.addon.HiprRenderEngine.bl_delegate_id, DELEGATE)
        with mock.patch.dict(os.environ, {"PXR_PLUGINPATH_NAME": str(HOSTS.parent / "plugin" / "usd")}):
            self.assertEqual(self.addon.plugin_folders()[0], str(HOSTS.parent / "plugin" / "usd"))

    def test_passes_are_aovs(self):
        asked = []
        engine = self.addon.HiprRenderEngine()
        engine.register_pass = lambda scene, layer, name, count, *rest: asked.append((name, count))
        engine.update_render_passes(None, types.SimpleNamespace(use_pass_z=True, use_pass_normal=False,
                                                                use_pass_diffuse_color=True))
        self.assertEqual(asked, [("Combined", 4), ("Depth", 1), ("DiffCol", 3)])


class Houdini(unittest.TestCase):
    def test_names_the_delegate(self):
        renderers = json.loads((HOSTS / "houdini" / "UsdRenderers.json").read_text())
        self.assertEqual(list(renderers), [DELEGATE])
        self.assertTrue(renderers[DELEGATE]["valid"])
        self.assertIn(DELEGATE, (SOURCE / "plugin" / "hdHipr" / "plugInfo.json.in").read_text())


if __name__ == "__main__":
    unittest.main()
