"""HiPR as a render engine of Blender.

Install: Preferences > Get Extensions > Install from Disk, with this folder as a zip, or put it into Blender's scripts/addons.
hdHipr must have been built against the OpenUSD of this Blender (docs/support.md). Its folder plugin/usd is looked for beside an
installed add-on, then in the environment variable PXR_PLUGINPATH_NAME, or is named in the add-on's preferences.
"""

import json
import os
from pathlib import Path

import bpy

bl_info = {"name": "HiPR", "blender": (5, 0, 0), "category": "Render",
           "description": "Path tracer that refreshes first what an edit shows"}

HERE = Path(__file__).resolve().parent
SETTINGS = json.loads((HERE / "settings.json").read_text())
# Of Blender's render passes, those that HiPR has: pass, Blender's switch, AOV, channels.
PASSES = (("Depth", "use_pass_z", "cameraDepth", 1, "Z", "VALUE"),
          ("Normal", "use_pass_normal", "normal", 3, "XYZ", "VECTOR"),
          ("DiffCol", "use_pass_diffuse_color", "albedo", 3, "RGB", "COLOR"))


def attribute(name: str) -> str:
    """The Python name of a setting."""
    return name.replace(":", "_")


def bl_property(row: dict):
    """A setting as a property of Blender's."""
    default, common = row["default"], {"name": row["label"], "description": row["help"]}
    if "choices" in row:
        return bpy.props.EnumProperty(items=[(choice, choice, "") for choice in row["choices"]], default=default, **common)
    if isinstance(default, bool):
        return bpy.props.BoolProperty(default=default, **common)
    low, high = row["range"]
    if isinstance(default, int):
        return bpy.props.IntProperty(default=default, min=int(low), max=int(high), **common)
    return bpy.props.FloatProperty(default=default, min=low, max=high, precision=4, **common)


class HiprSettings(bpy.types.PropertyGroup):
    """All settings of the renderer; scene.hipr."""
    __annotations__ = {attribute(row["name"]): bl_property(row) for row in SETTINGS}


class HiprPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__ or __name__
    __annotations__ = {"plugin_folder": bpy.props.StringProperty(
        name="Plugin folder", subtype="DIR_PATH", description="The folder plugin/usd of an hdHipr built for this Blender")}

    def draw(self, _context):
        self.layout.prop(self, "plugin_folder")


def plugin_folders():
    """Where the delegate may be, most particular first."""
    addon = bpy.context.preferences.addons.get(HiprPreferences.bl_idname)
    folders = [addon.preferences.plugin_folder] if addon and addon.preferences else []
    folders += os.environ.get("PXR_PLUGINPATH_NAME", "").split(os.pathsep)
    folders += [str(parent / "plugin" / "usd") for parent in HERE.parents[:5]]
    return [folder for folder in folders if folder and (Path(folder) / "hdHipr").is_dir()]


class HiprRenderEngine(bpy.types.HydraRenderEngine):
    bl_idname = "HIPR"
    bl_label = "HiPR"
    bl_info = "Path tracer that refreshes first what an edit shows"
    bl_delegate_id = "HdHiprRendererPlugin"
    bl_use_preview = True
    bl_use_gpu_context = False

    @classmethod
    def register(cls):
        if hasattr(bpy.utils, "expose_bundled_modules"):
            bpy.utils.expose_bundled_modules()
        import pxr.Plug
        folders = plugin_folders()
        if folders:
            pxr.Plug.Registry().RegisterPlugins(folders[:1])
        else:
            print("HiPR: no folder plugin/usd of hdHipr found; name it in the add-on's preferences")

    def get_render_settings(self, _engine_type):
        properties = bpy.context.scene.hipr
        settings = {row["name"]: getattr(properties, attribute(row["name"])) for row in SETTINGS}
        settings["aovToken:Combined"] = "color"
        for name, _switch, aov, *_channels in PASSES:
            settings["aovToken:" + name] = aov
        return settings

    def update_render_passes(self, scene, render_layer):
        self.register_pass(scene, render_layer, "Combined", 4, "RGBA", "COLOR")
        for name, switch, _aov, count, channels, kind in PASSES:
            if getattr(render_layer, switch):
                self.register_pass(scene, render_layer, name, count, channels, kind)


class HIPR_PT_settings(bpy.types.Panel):
    bl_label = "HiPR"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    COMPAT_ENGINES = {HiprRenderEngine.bl_idname}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES

    def draw(self, context):
        self.layout.use_property_split = True
        for row in SETTINGS:
            self.layout.prop(context.scene.hipr, attribute(row["name"]))


CLASSES = (HiprSettings, HiprPreferences, HiprRenderEngine, HIPR_PT_settings)
# Engines that Blender's own panels (camera, world, materials, lights) are for as well as this one.
SAME_PANELS_AS = "BLENDER_EEVEE"


def compatible_panels():
    """Blender's panels that make sense with this engine."""
    without = {"RENDER_PT_eevee", "RENDER_PT_simplify"}
    return [panel for panel in bpy.types.Panel.__subclasses__()
            if SAME_PANELS_AS in getattr(panel, "COMPAT_ENGINES", ()) and panel.__name__ not in without
            and "eevee" not in panel.__name__.lower()]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.hipr = bpy.props.PointerProperty(type=HiprSettings)
    for panel in compatible_panels():
        panel.COMPAT_ENGINES.add(HiprRenderEngine.bl_idname)


def unregister():
    for panel in bpy.types.Panel.__subclasses__():
        if panel is not HIPR_PT_settings:
            getattr(panel, "COMPAT_ENGINES", set()).discard(HiprRenderEngine.bl_idname)
    del bpy.types.Scene.hipr
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
