"""The scenes and edits that bench_edits.py measures. An edit is a dictionary as `hiprrecord --edits` reads it."""

from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
TEST_SCENES = HERE.parent.parent / "scenes"


@dataclass
class Scene:
    name: str
    stage: Path
    edits: list
    aspect: float = 9 / 16  # height / width


def over(path, *opinions):
    """Scene description that overrides attributes of one prim."""
    names = path.strip("/").split("/")
    return "\n".join([f'over "{name}"\n{{' for name in names] + list(opinions) + ["}"] * len(names)) + "\n"


def opinion(name, path, *opinions):
    return {"name": name, "usda": over(path, *opinions)}


def light(kind, value):
    """A light's attribute, under its old name and its new one."""
    type_, name = kind.split()
    return f"{type_} {name} = {value}\n{type_} inputs:{name} = {value}"


def room():
    def look(name, material, value):
        return opinion(name, f"/Room/Looks/{material}/Surface", value)

    added = ('over "Room"\n{\ndef Sphere "Added"\n{\ndouble radius = 0.3\nrel material:binding = </Room/Looks/Blue>\n'
             'double3 xformOp:translate = (0.9, 0.3, -2.2)\nuniform token[] xformOpOrder = ["xformOp:translate"]\n}\n}\n')
    return Scene("room", HERE / "room.usda", [
        opinion("move ball", "/Room/Ball", "double3 xformOp:translate = (-0.4, 0.45, -0.9)"),
        opinion("hide box", "/Room/Box", 'token visibility = "invisible"'),
        opinion("show box", "/Room/Box", 'token visibility = "inherited"'),
        {"name": "add sphere", "usda": added},
        {"name": "delete sphere", "remove": ["/Room/Added"]},
        opinion("vertex of crystal", "/Room/Crystal",
                "point3f[] points = [(0.15, 1.3, 0), (0.35, 0.45, 0), (0, 0.45, -0.35), (-0.35, 0.45, 0), (0, 0.45, 0.35), "
                "(0, 0, 0)]"),
        opinion("scale crystal", "/Room/Crystal", "float3 xformOp:scale = (1.3, 0.7, 1.3)"),
        {"name": "texture of picture", "usda": over(
            "/Room/Looks/Picture/Image", f"asset inputs:file = @{TEST_SCENES / 'textures/tile.1001.png'}@")},
        look("through glass", "Gem", "color3f inputs:diffuseColor = (0.1, 0.2, 0.7)"),
        opinion("only in mirror", "/Room/Behind", "double3 xformOp:translate = (2.3, 1.5, 6.8)"),
        opinion("only by shadow", "/Room/Blade", "double3 xformOp:translate = (1.05, 1.85, 4.9)"),
        look("off screen", "Side", "color3f inputs:diffuseColor = (0.05, 0.3, 0.75)"),
    ])


def still_life():
    def look(name, material, value):
        return opinion(name, f"/Still/Looks/{material}/Surface", value)

    return Scene("still_life", TEST_SCENES / "still_life.usda", [
        opinion("rotate ring", "/Still/Ring", "float3 xformOp:rotateXYZ = (40, 30, 8)"),
        opinion("move marble", "/Still/Marble", "double3 xformOp:translate = (-1.05, 0.46, 1.25)"),
        look("roughness of brass", "Brass", "float inputs:roughness = 0.5"),
        look("colour of plastic", "Plastic", "color3f inputs:diffuseColor = (0.1, 0.4, 0.1)"),
        look("opacity of glass", "Glass", "float inputs:opacity = 1"),
        opinion("rect light brighter", "/Still/Lights/Rim", light("float intensity", 14)),
        opinion("camera pan", "/Still/Camera", "float3 xformOp:rotateXYZ = (-9.4, 2.6, 0)"),
        opinion("camera dolly", "/Still/Camera", "double3 xformOp:translate = (0.2, 3.9, 14.5)"),
    ])


def lights():
    def edit(name, prim, *values):
        return opinion(name, f"/Bays/{prim}", *values)

    return Scene("lights", TEST_SCENES / "lights.usda", [
        edit("sphere brighter", "Sphere", light("float intensity", 18)),
        edit("sphere moved", "Sphere", "double3 xformOp:translate = (-4.7, 1.2, 0.2)"),
        edit("disk colour", "Disk", light("color3f color", "(1, 0.6, 0.6)")),
        edit("disk off", "Disk", 'token visibility = "invisible"'),
        edit("rect moved", "Rect", "double3 xformOp:translate = (1.2, 2.2, -1.0)"),
        edit("cylinder off", "Cylinder", 'token visibility = "invisible"'),
        edit("cylinder on", "Cylinder", 'token visibility = "inherited"'),
        edit("cylinder colour", "Cylinder", light("color3f color", "(1, 0.8, 0.7)")),
        edit("distant turned", "Sun", "float3 xformOp:rotateXYZ = (-45, 35, 0)"),
        edit("distant off", "Sun", 'token visibility = "invisible"'),
        edit("dome brighter", "Sky", light("float intensity", 0.16)),
    ], aspect=3 / 8)


SIDE = 50  # instances in a row of the field


def field(folder):
    """2,500 instances of a block under a textured dome."""
    places = [(0.5 * (i % SIDE - SIDE / 2), 0.1 + 0.05 * (7 * i % 5), 0.5 * (i // SIDE - SIDE / 2))
              for i in range(SIDE * SIDE)]
    stage = folder / "field.usda"

    def positions():
        return "point3f[] positions = [" + ", ".join(f"({x:g}, {y:g}, {z:g})" for x, y, z in places) + "]"

    stage.write_text((HERE / "field.usda.in").read_text()
                     .replace("%POSITIONS%", positions())
                     .replace("%INDICES%", ", ".join(["0"] * len(places)))
                     .replace("%TEXTURE%", str(TEST_SCENES / "textures/ramp.png")))
    one = 30 * SIDE + 21
    places[one] = (places[one][0] + 0.1, 0.9, places[one][2])
    return Scene("field", stage, [
        opinion("one of 2500 moved", "/Field/Blocks", positions()),
        opinion("one of 2500 hidden", "/Field/Blocks", f"int64[] invisibleIds = [{33 * SIDE + 30}]"),
        opinion("dome turned", "/Field/Sky", "float xformOp:rotateY = 60"),
    ])


def teapots(folder, assets):
    """Teapots of the usd-wg assets, under a dome and a distant light."""
    source = assets / "usd-wg/full_assets/Teapot/DrawModes.usd"
    if not source.exists():
        return None
    stage = folder / "teapots.usda"
    stage.write_text((HERE / "teapots.usda.in").read_text().replace("%SOURCE%", str(source)))
    return Scene("teapots", stage, [
        {"name": "another glaze", "variant": {"/World/UtahTeapot_CeramicLimeGreen_0": {"shadingVariant": "CeramicRed"}}},
        opinion("teapot turned", "/World/UtahTeapot_CeramicOrange_0",
                "matrix4d xformOp:transform = ((0, 0, 1, 0), (0, 1, 0, 0), (-1, 0, 0, 0), (-1.5, 0, 1.6, 1))"),
        {"name": "teapot out", "deactivate": ["/World/UtahTeapot_CeramicBlue_0"]},
        {"name": "teapot back", "activate": ["/World/UtahTeapot_CeramicBlue_0"]},
    ])


def all_scenes(folder, assets):
    """Every scene; those that do not exist as files are written to `folder`. The scenes in `assets` may be missing."""
    return [scene for scene in (room(), still_life(), lights(), field(folder), teapots(folder, assets)) if scene]
