#!/usr/bin/env python3
"""Renders the stages of the USD Working Group's assets and lays each beside a picture that came with it: docs/gallery.md.

Usage: make_gallery.py --record HIPRRECORD --assets FOLDER [--only NAME] [--out FOLDER]

FOLDER is a checkout of https://github.com/usd-wg/assets. Pillow comes from PyPI into a virtual environment of its own.
"""

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parent.parent / "bench"))
from environment import enter_environment  # noqa: E402

PACKAGES = ["pillow"]
CELL, MARGIN, LABEL = 200, 6, 16


LIGHT = """
def DomeLight "Sky" {
    float inputs:intensity = 0.5
    float intensity = 0.5
    color3f inputs:color = (0.7, 0.8, 1)
    color3f color = (0.7, 0.8, 1)
}
def DistantLight "Sun" {
    float inputs:intensity = 400
    float intensity = 400
    float inputs:angle = 4
    float angle = 4
    float3 xformOp:rotateXYZ = (-50, 35, 0)
    uniform token[] xformOpOrder = ["xformOp:rotateXYZ"]
}
"""


class Pair:
    """A stage and the picture that came with it, if any did."""

    def __init__(self, name, stage, reference=None, camera=None, size=CELL, samples=64, settings=()):
        self.name, self.stage, self.reference = name, stage, reference
        self.options = ["--size", str(size), "-n", str(samples), *(word for s in settings for word in ("--set", s))]
        if camera:
            self.options += ["--camera", camera]


def schema_tests(assets):
    """Every stage with a picture by usdrecord, that is by Storm, which lights from the camera."""
    root = assets / "test_assets"
    for shot in sorted(root.glob("**/screenshots/*_usdrecord_22.08.png")):
        folder, name = shot.parent.parent, shot.name.replace("_usdrecord_22.08.png", "")
        named = [folder / (name + ending) for ending in (".usda", ".usd", ".usdc")]
        stages = [stage for stage in named if stage.exists()] or sorted(folder.glob("*.usd*"))
        if len(stages) == 1:
            yield Pair(name, stages[0], shot, samples=16)


def test_assets(assets):
    root = assets / "test_assets"
    for name, stage, shot in (
            ("AlphaBlendSortTest", "AlphaBlendSortTest.usda", "usdview.png"),
            ("NormalsTextureBiasAndScale", "NormalsTextureBiasAndScale.usda", "crn_usdview.png"),
            ("RoughnessTest", "RoughnessTest.usdz", "usdview-20.08.png"),
            ("TextureTransformTest", "TextureTransformTest.usd", "20220603-usdview.png")):
        yield Pair(name, root / name / stage, root / name / "screenshots" / shot, size=2 * CELL)


def lit(folder, name, *stages):
    """A stage over others, with lights."""
    path = folder / (name + ".usda")
    layers = ", ".join(f"@{stage}@" for stage in stages)
    path.write_text(f'#usda 1.0\n(\n    upAxis = "Y"\n    subLayers = [{layers}]\n)\n{LIGHT}')
    return path


def full_assets(assets, folder):
    full = assets / "full_assets"
    car = next(full.glob("Vehicles/**/vehicleVariants.usda"))
    scenes = assets / "intent-vfx" / "scenes"
    field = lit(folder, "field", *(scenes / f"teapotScene_{name}.usd" for name in ("camera", "layoutOverrides", "layout")))
    yield Pair("Teapot", lit(folder, "teapot", full / "Teapot" / "Teapot.usd"), size=2 * CELL)
    yield Pair("DrawModes", lit(folder, "modes", full / "Teapot" / "DrawModes.usd"), size=2 * CELL)
    yield Pair("vehicleVariants", lit(folder, "car", car), size=2 * CELL)
    yield Pair("chess_set", lit(folder, "chess", full / "OpenChessSet" / "chess_set.usda"), size=2 * CELL)
    yield Pair("teapot field", field, assets / "intent-vfx" / "images" / "render_karma.png", size=2 * CELL)


def render(pair, options, folder):
    picture = folder / (pair.name.replace(" ", "_") + ".png")
    command = [options.record, pair.stage, "-q", "-o", picture, *pair.options]
    done = subprocess.run(command, capture_output=True, text=True)
    said = (done.stdout + done.stderr).strip()
    print(f"{pair.name}: {said or 'nothing to say'}", flush=True)
    return picture if picture.exists() else None


def fitted(path, cell):
    picture = Image.open(path).convert("RGB")
    picture.thumbnail((cell, cell))
    square = Image.new("RGB", (cell, cell), (40, 40, 40))
    square.paste(picture, ((cell - picture.width) // 2, (cell - picture.height) // 2))
    return square


def sheet(pairs, options, folder, path, cell, columns):
    """Each pair: the picture that came with the stage to the left, ours to the right."""
    cells = []
    for pair in pairs:
        if options.only and options.only not in pair.name:
            continue
        ours = render(pair, options, folder)
        pictures = [p for p in (pair.reference, ours) if p]
        strip = Image.new("RGB", (cell * len(pictures) + MARGIN, cell + LABEL), (20, 20, 20))
        for i, picture in enumerate(pictures):
            strip.paste(fitted(picture, cell), (i * cell, LABEL))
        ImageDraw.Draw(strip).text((3, 2), pair.name, fill=(230, 230, 230))
        cells.append(strip)
    if not cells:
        return
    rows, row = [], []
    for strip in cells:
        row.append(strip)
        if sum(s.width for s in row) >= columns * (2 * cell + MARGIN) - MARGIN:
            rows.append(row)
            row = []
    rows += [row] if row else []
    whole = Image.new("RGB", (max(sum(s.width for s in r) for r in rows), len(rows) * (cell + LABEL)), (20, 20, 20))
    for y, strips in enumerate(rows):
        x = 0
        for strip in strips:
            whole.paste(strip, (x, y * (cell + LABEL)))
            x += strip.width
    whole.save(path, quality=85)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--record", default="hiprrecord", help="the hiprrecord that renders")
    parser.add_argument("--assets", type=Path, required=True)
    parser.add_argument("--only", help="stages whose name has this in it")
    parser.add_argument("--out", type=Path, default=Path("docs/images"))
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    parser.add_argument("--environment", type=Path, default=cache / "hipr" / "gallery")
    options = parser.parse_args()
    enter_environment(options.environment, PACKAGES)
    global Image, ImageDraw
    from PIL import Image, ImageDraw
    assets = options.assets.resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        sheet(schema_tests(assets), options, folder, options.out / "gallery_schemas.jpg", 120, 5)
        sheet(test_assets(assets), options, folder, options.out / "gallery_tests.jpg", 2 * CELL, 1)
        sheet(full_assets(assets, folder), options, folder, options.out / "gallery_assets.jpg", 2 * CELL, 1)


main()
