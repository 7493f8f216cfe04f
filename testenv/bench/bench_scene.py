"""Writes the scene that compare_cycles.py renders: a room of UsdPreviewSurface materials under one disk light, in USD."""

import math
import struct
import zlib
from pathlib import Path

MATERIALS = {
    # name: (diffuseColor, roughness, metallic)
    "wall": ((0.7, 0.7, 0.7), 1.0, 0.0),
    "red": ((0.7, 0.15, 0.1), 0.6, 0.0),
    "plastic": ((0.1, 0.3, 0.6), 0.25, 0.0),
    "gold": ((0.9, 0.65, 0.3), 0.3, 1.0),
}


def normal_at(point, s, t, step=1e-4):
    """The unit normal of a surface point(s, t), by differences."""
    def along(ds, dt):
        a, b = point(s - ds, t - dt), point(s + ds, t + dt)
        return [q - p for p, q in zip(a, b)]
    (ax, ay, az), (bx, by, bz) = along(step, 0), along(0, step)
    n = (ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx)
    length = math.hypot(*n)
    return tuple(c / length for c in n)


def grid(cells, point):
    """A grid of cells x cells quads over point(s, t), s and t in 0..1: points, normals, counts, indices, st."""
    row = cells + 1
    parameters = [(i / cells, j / cells) for i in range(row) for j in range(row)]
    indices = []
    for i in range(cells):
        for j in range(cells):
            a = i * row + j
            indices += [a, a + row, a + row + 1, a + 1]
    # Normals a little inside: a sphere's poles have none.
    normals = [normal_at(point, min(max(s, 1e-3), 1 - 1e-3), t) for s, t in parameters]
    return [point(s, t) for s, t in parameters], normals, [4] * (cells * cells), indices, parameters


def ball(cells, centre, radius):
    def point(s, t):
        theta, phi = math.pi * s, 2 * math.pi * t
        r = radius * (1 + 0.06 * math.sin(theta) * math.sin(14 * theta) * math.sin(13 * phi))
        return (centre[0] + r * math.sin(theta) * math.cos(phi), centre[1] + r * math.sin(theta) * math.sin(phi),
                centre[2] + r * math.cos(theta))
    return grid(cells, point)


def wall(axis, side, half):
    def point(s, t):
        p = [0, 0, 0]
        p[axis] = side * half
        p[(axis + 1) % 3] = half * (2 * s - 1)
        p[(axis + 2) % 3] = side * half * (1 - 2 * t)  # faces inwards
        return tuple(p)
    return grid(2, point)


def write_checker(path, size=512, squares=16):
    """An 8-bit RGB PNG."""
    cell = size // squares
    rows = bytearray()
    for y in range(size):
        rows.append(0)
        for x in range(size):
            rows += bytes((200, 190, 170) if (x // cell + y // cell) % 2 else (70, 80, 90))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(bytes(rows))) + chunk(b"IEND", b""))


def mesh_text(name, shape, material):
    points, normals, counts, indices, st = shape
    return f"""    def Mesh "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{
        uniform token subdivisionScheme = "none"
        bool doubleSided = 1
        point3f[] points = [{", ".join("(%.6g, %.6g, %.6g)" % p for p in points)}]
        normal3f[] normals = [{", ".join("(%.6g, %.6g, %.6g)" % n for n in normals)}] (interpolation = "vertex")
        int[] faceVertexCounts = {counts}
        int[] faceVertexIndices = {indices}
        texCoord2f[] primvars:st = [{", ".join("(%.6g, %.6g)" % p for p in st)}] (interpolation = "vertex")
        rel material:binding = </World/Looks/{material}>
    }}
"""


def material_text(name, diffuse, roughness, metallic):
    return f"""        def Material "{name}"
        {{
            token outputs:surface.connect = </World/Looks/{name}/Surface.outputs:surface>
            def Shader "Surface"
            {{
                uniform token info:id = "UsdPreviewSurface"
                {diffuse}
                float inputs:roughness = {roughness}
                float inputs:metallic = {metallic}
                token outputs:surface
            }}
        }}
"""


CHECKER_NODES = """        def Shader "Reader"
        {
            uniform token info:id = "UsdPrimvarReader_float2"
            string inputs:varname = "st"
            float2 outputs:result
        }
        def Shader "Checker"
        {
            uniform token info:id = "UsdUVTexture"
            asset inputs:file = @./checker.png@
            token inputs:sourceColorSpace = "sRGB"
            token inputs:wrapS = "repeat"
            token inputs:wrapT = "repeat"
            float2 inputs:st.connect = </World/Looks/floor/Reader.outputs:result>
            float3 outputs:rgb
        }
"""


def looks_text():
    parts = [material_text(name, f"color3f inputs:diffuseColor = {color}", roughness, metallic)
             for name, (color, roughness, metallic) in MATERIALS.items()]
    textured = material_text("floor", "color3f inputs:diffuseColor.connect = </World/Looks/floor/Checker.outputs:rgb>",
                             0.9, 0.0)
    end = textured.rindex("        }")
    return "".join(parts) + textured[:end] + CHECKER_NODES + textured[end:]


def write_scene(folder, cells=80):
    """Writes room.usda and its texture into `folder`; about 12 * cells**2 triangles. Returns the path."""
    half = 4.0
    meshes = []
    for axis in range(3):
        for side in (-1, 1):
            material = "floor" if (axis, side) == (2, -1) else "red" if (axis, side) == (0, -1) else "wall"
            meshes.append(mesh_text(f"Wall{axis}{'m' if side < 0 else 'p'}", wall(axis, side, half), material))
    for i in range(6):
        angle = 2 * math.pi * i / 6
        centre = (2.2 * math.cos(angle), 2.2 * math.sin(angle), -2.8 + 0.5 * (i % 3))
        meshes.append(mesh_text(f"Ball{i}", ball(cells, centre, 1.0), ("plastic", "gold", "red")[i % 3]))
    write_checker(folder / "checker.png")
    path = folder / "room.usda"
    path.write_text(f"""#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{{
    def Scope "Looks"
    {{
{looks_text()}    }}
{"".join(meshes)}    def DiskLight "Light"
    {{
        float inputs:intensity = 15
        float inputs:radius = 1
        float intensity = 15
        float radius = 1
        double3 xformOp:translate = (0, 0, 3.9)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }}
    def Camera "Camera"
    {{
        float focalLength = 15
        float horizontalAperture = 24
        float verticalAperture = 13.5
        float2 clippingRange = (0.01, 100)
        double3 xformOp:translate = (0, -3.9, 0)
        float3 xformOp:rotateXYZ = (76, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
    }}
}}
""")
    return Path(path)
