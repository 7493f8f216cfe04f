#!/usr/bin/env python3
"""Compares the light of every kind of light with Mitsuba 3's: the same stage in both, as means of blocks of pixels.

A cube on a floor, both matte, under one light at a time, with bounces between them. Mitsuba comes from PyPI into a virtual
environment of its own, once (60 MB). What is told for each light is the ratio of the pictures' means, and how far from 1
the ratios of blocks of 8 x 8 pixels are, at the median and at 95 of 100 blocks: units, falloff, direction and shadows.
Fails if a mean is off by more than --tolerance.
"""

import argparse
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from environment import enter_environment

PACKAGES = ["mitsuba==3.9.1", "numpy"]
BLOCK = 8
EYE, TARGET, FOV = (3.5, 3.0, 6.0), (0.0, 0.4, 0.0), 40.0
FLOOR, CUBE = (0.5, 0.5, 0.5), (0.7, 0.4, 0.3)
COLOR = (1.0, 0.8, 0.6)
ANGLE = 0.53  # degrees, of the distant light; Mitsuba has points alone


def rotation(axis, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    m = np.eye(4)
    m[i, i] = m[j, j] = c
    m[i, j], m[j, i] = -s, s
    return m


def translation(x, y, z):
    m = np.eye(4)
    m[:3, 3] = x, y, z
    return m


def scaling(x, y, z):
    return np.diag([x, y, z, 1.0])


def look_at(eye, target):
    """Camera to world: looks along -z."""
    back = np.subtract(eye, target) / np.linalg.norm(np.subtract(eye, target))
    right = np.cross((0, 1, 0), back)
    right /= np.linalg.norm(right)
    m = np.eye(4)
    m[:3, 0], m[:3, 1], m[:3, 2], m[:3, 3] = right, np.cross(back, right), back, eye
    return m


def usd_matrix(m):
    return "( " + ", ".join("(" + ", ".join(f"{v:.9g}" for v in row) + ")" for row in m.T) + " )"


def usd_xform(m):
    return (f"    matrix4d xformOp:transform = {usd_matrix(m)}\n"
            '    uniform token[] xformOpOrder = ["xformOp:transform"]\n')


def usd_material(name, **inputs):
    """Lambert's law and emission alone: a UsdPreviewSurface always shines at grazing angles."""
    lines = "".join(f"        {'color3f' if isinstance(v, tuple) else 'float'} inputs:{k} = {v}\n" for k, v in inputs.items())
    return f"""def Material "{name}" {{
    token outputs:surface.connect = </{name}/Surface.outputs:surface>
    def Shader "Surface" {{
        uniform token info:id = "ND_open_pbr_surface_surfaceshader"
{lines}        float inputs:specular_weight = 0
        token outputs:surface
    }}
}}
"""


def usd_mesh(name, points, faces, material, m):
    return f"""def Mesh "{name}" {{
    uniform token subdivisionScheme = "none"
    point3f[] points = {[tuple(p) for p in points]}
    int[] faceVertexCounts = {[len(f) for f in faces]}
    int[] faceVertexIndices = {[i for f in faces for i in f]}
    rel material:binding = </{material}>
{usd_xform(m)}}}
"""


QUAD = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(0, 1, 2, 3)]
BOX = ([(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)],
       [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)])


def stage_text(light):
    camera = (f'def Camera "Camera" {{\n    float focalLength = 50\n    float horizontalAperture = '
              f'{100 * math.tan(math.radians(FOV / 2))}\n    float verticalAperture = '
              f'{75 * math.tan(math.radians(FOV / 2))}\n{usd_xform(look_at(EYE, TARGET))}}}\n')
    return "".join(['#usda 1.0\n(\n    upAxis = "Y"\n)\n', camera,
                    usd_material("Grey", base_color=FLOOR, base_weight=1.0),
                    usd_material("Red", base_color=CUBE, base_weight=1.0),
                    usd_mesh("Floor", *QUAD, "Grey", FLOOR_PLACE), usd_mesh("Cube", *BOX, "Red", CUBE_PLACE), light])


def usd_light(kind, place, **inputs):
    lines = ""
    for name, value in inputs.items():
        usd_type = {tuple: "color3f", bool: "bool", float: "float"}.get(type(value), "asset")
        text = f"@{value}@" if usd_type == "asset" else int(value) if usd_type == "bool" else value
        lines += f"    {usd_type} {name.replace('__', ':')} = {text}\n    {usd_type} inputs:{name.replace('__', ':')} = {text}\n"
    return f'def {kind} "Light" {{\n{lines}{usd_xform(place)}}}\n'


def rgb(values):
    return {"type": "rgb", "value": [float(v) for v in values]}


def area(radiance):
    return {"type": "area", "radiance": radiance}


def shape(kind, m, emitter, **more):
    return {"type": kind, "to_world": mi.ScalarTransform4f(m), "emitter": emitter, **more}


def write_picture(path, width, height, seed):
    """A picture without symmetries, in linear light."""
    x, y = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    values = np.stack([0.2 + x, 0.3 + y * y, 0.6 + 0.5 * np.sin(9 * x + 4 * y + seed)], -1) + 3 * (
        np.hypot(x - 0.3, y - 0.35) < 0.15)[..., None]
    mi.Bitmap(values.astype(np.float32)).write(str(path))


def lights(folder):
    """Name: USD text and Mitsuba's emitters."""
    aim = translation(0.8, 3.2, 1.0) @ rotation(2, 12) @ rotation(0, -80)  # -z goes down
    turned = rotation(1, 180)                                              # Mitsuba's shapes face +z
    radiance = rgb(12 * c for c in COLOR)
    sky, slide = folder / "sky.exr", folder / "slide.exr"
    write_picture(sky, 256, 128, 0)
    write_picture(slide, 64, 48, 1)
    solid = math.pi * math.sin(math.radians(ANGLE / 2)) ** 2
    common = {"intensity": 12.0, "color": COLOR}
    rect = scaling(0.75, 0.4, 1)
    glow = usd_material("Glow", base_weight=0.0, emission_color=COLOR, emission_luminance=12.0)
    yield "rect", usd_light("RectLight", aim, width=1.5, height=0.8, **common), shape(
        "rectangle", aim @ turned @ rect, area(radiance))
    yield "rect, normalized", usd_light("RectLight", aim, width=1.5, height=0.8, normalize=True, **common), shape(
        "rectangle", aim @ turned @ rect, area(rgb(12 * c / 1.2 for c in COLOR)))
    yield "rect with a texture", usd_light("RectLight", aim, width=1.5, height=0.8, texture__file=slide, **common), shape(
        "rectangle", aim @ turned @ rect,
        area({"type": "bitmap", "bitmap": mi.Bitmap(
            np.asarray(mi.Bitmap(str(slide)))[::-1] * np.float32(12) * np.float32(COLOR)), "raw": True}))
    yield "disk", usd_light("DiskLight", aim, radius=0.6, **common), shape(
        "disk", aim @ turned @ scaling(0.6, 0.6, 1), area(radiance))
    yield "sphere", usd_light("SphereLight", aim, radius=0.35, **common), shape(
        "sphere", aim @ scaling(0.35, 0.35, 0.35), area(radiance))
    yield "cylinder", usd_light("CylinderLight", aim, radius=0.15, length=1.6, **common), shape(
        "cylinder", aim, area(radiance), p0=[-0.8, 0, 0], p1=[0.8, 0, 0], radius=0.15)
    yield "distant", usd_light("DistantLight", aim, angle=ANGLE, intensity=5e4, color=COLOR), {
        "type": "directional", "direction": [float(v) for v in -aim[:3, 2]], "irradiance": rgb(5e4 * solid * c for c in COLOR)}
    yield "dome with a texture", usd_light("DomeLight", rotation(1, 25), texture__file=sky, **common), {
        "type": "envmap", "scale": 12.0, "to_world": mi.ScalarTransform4f(rotation(1, 25) @ SKY_TURN),
        "bitmap": mi.Bitmap(np.asarray(mi.Bitmap(str(sky))) * np.float32(COLOR))}
    off = 'def SphereLight "Off" {\n    token visibility = "invisible"\n}\n'  # keeps the camera's light away
    yield "emissive mesh", off + glow + usd_mesh("Lamp", *QUAD, "Glow", aim @ turned @ rect), shape(
        "rectangle", aim @ turned @ rect, area(radiance), bsdf={"type": "diffuse", "reflectance": rgb((0, 0, 0))})


def matte(color):
    return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(color)}}


def mitsuba_picture(light, options):
    width, height = options.size
    to_world = look_at(EYE, TARGET) @ rotation(1, 180)  # looks along +z
    scene = mi.load_dict({
        "type": "scene", "light": light,
        "integrator": {"type": "path", "max_depth": options.depth + 1, "rr_depth": 1000, "hide_emitters": False},
        "sensor": {"type": "perspective", "fov": FOV, "fov_axis": "x", "to_world": mi.ScalarTransform4f(to_world),
                   "film": {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"},
                            "pixel_format": "rgb"},
                   "sampler": {"type": "independent", "sample_count": options.samples}},
        "floor": {"type": "rectangle", "to_world": mi.ScalarTransform4f(FLOOR_PLACE), "bsdf": matte(FLOOR)},
        "cube": {"type": "cube", "to_world": mi.ScalarTransform4f(CUBE_PLACE), "bsdf": matte(CUBE)}})
    return np.asarray(mi.render(scene))


def hipr_picture(light, options, folder):
    stage, picture = folder / "stage.usda", folder / "hipr.exr"
    stage.write_text(stage_text(light))
    subprocess.run([options.record, stage, "-q", "--camera", "/Camera", "--size", "x".join(map(str, options.size)),
                    "-n", str(options.samples), "--set", f"hipr:maxDepth={options.depth}",
                    "--set", "hipr:pixelFilter=box", "-o", picture], check=True)
    return np.asarray(mi.Bitmap(str(picture)))[..., :3]


def blocks(picture):
    h, w = picture.shape[0] // BLOCK, picture.shape[1] // BLOCK
    return picture[:h * BLOCK, :w * BLOCK].reshape(h, BLOCK, w, BLOCK, 3).mean((1, 3)) @ np.array([0.2126, 0.7152, 0.0722])


def compare(options, folder):
    worst = 0.0
    print(f"{options.size[0]} x {options.size[1]}, {options.samples} samples, {options.depth} bounces; HiPR / Mitsuba")
    print("| light | mean | blocks: median off by | 95 of 100 off by less than |\n|---|---|---|---|")
    for name, usd, emitter in lights(folder):
        if options.only and options.only not in name:
            continue
        ours, theirs = hipr_picture(usd, options, folder), mitsuba_picture(emitter, options)
        if options.keep:
            for who, picture in (("hipr", ours), ("mitsuba", theirs)):
                mi.Bitmap(np.ascontiguousarray(picture)).write(str(options.keep / f"{name} {who}.exr"))
        ratio = ours.mean() / theirs.mean()
        expected = blocks(theirs)
        lit = expected > 0.01 * expected.mean()
        off = np.abs(blocks(ours)[lit] / expected[lit] - 1)
        worst = max(worst, abs(ratio - 1))
        print(f"| {name} | {ratio:.4f} | {np.median(off):.2%} | {np.quantile(off, 0.95):.2%} |", flush=True)
    return worst <= options.tolerance


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--record", default="hiprrecord", help="the hiprrecord to compare")
    parser.add_argument("--size", default="160x120", type=lambda text: tuple(map(int, text.split("x"))))
    parser.add_argument("--samples", type=int, default=1024)
    parser.add_argument("--depth", type=int, default=4, help="surface bounces; 1 is direct light only")
    parser.add_argument("--tolerance", type=float, default=0.02)
    parser.add_argument("--only", help="lights whose name has this in it")
    parser.add_argument("--keep", type=Path, help="a folder for the pictures")
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    parser.add_argument("--environment", type=Path, default=cache / "hipr" / "mitsuba",
                        help="where Mitsuba is installed [%(default)s]")
    options = parser.parse_args()
    enter_environment(options.environment, PACKAGES)
    global mi, np, FLOOR_PLACE, CUBE_PLACE, SKY_TURN
    import mitsuba as mi
    import numpy as np
    mi.set_variant("scalar_rgb")
    FLOOR_PLACE = rotation(0, -90) @ scaling(5, 5, 1)
    CUBE_PLACE = translation(0, 0.6, 0) @ rotation(1, 30) @ scaling(0.6, 0.6, 0.6)
    SKY_TURN = np.eye(4)
    with tempfile.TemporaryDirectory() as folder:
        sys.exit(not compare(options, Path(folder)))


main()
