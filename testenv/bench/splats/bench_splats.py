#!/usr/bin/env python3
"""Measures how Gaussian splats are drawn: our modes among each other, then against splat-transform.

  modes   hipr-bench-splats: pairs, bytes sorted, milliseconds of every stage, frame times of every mode in turns, on a
          capture at three sizes and on scenes of up to 6 million splats; and a prim that moves
  peer    splat-transform from npm (PlayCanvas; a WebGPU compute renderer) on the same capture with the same camera, in turns
          with all our modes: frame times, ratios, and how alike the pictures are

Figures by the clock want an idle machine; processor time holds on a busy one, too. All of it takes about seven minutes of
processor time, under four on two idle cores. What follows `--` goes to hipr-bench-splats (`-- --help` lists its options):

  ./hipr bench splats                                   everything
  ./hipr bench splats --only peer --pictures out        the comparison, and pictures to look at
  ./hipr bench splats --only modes -- --synthetic 0     the capture alone
  ./hipr bench splats --only modes -- --synthetic-sizes 1280x720,1920x1080,3840x2160     also what takes long

splat-transform and Node are installed with npm, numpy and Pillow with pip, once, into --environment.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from environment import enter_environment

PACKAGES = ("numpy", "Pillow")
BASELINE = "flat16-aabb"


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bench", default="hipr-bench-splats", help="the hipr-bench-splats to measure with")
    parser.add_argument("--only", choices=("modes", "peer"), help="one part")
    parser.add_argument("--turns", type=int, default=5, help="of the comparison [%(default)s]")
    parser.add_argument("--size", default="1280x720", help="of the comparison's pictures [%(default)s]")
    assets = Path(os.environ.get("HIPR_ASSETS", HERE.parents[3] / "shared/assets"))
    parser.add_argument("--capture", type=Path, default=assets / "splats/playbot/playbot_125k_sh2.ply",
                        help="a 3DGS .ply to compare with [%(default)s]")
    parser.add_argument("--pictures", type=Path, help="keep the comparison's pictures in this folder: ours, theirs, side by side")
    parser.add_argument("--json", type=Path, help="also write the comparison's figures here")
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    parser.add_argument("--environment", type=Path, default=cache / "hipr" / "bench-splats",
                        help="where packages are installed [%(default)s]")
    parser.add_argument("arguments", nargs="*", metavar="-- ARGUMENT", help="for hipr-bench-splats, in part modes")
    return parser.parse_args()


def measure_modes(options):
    """The long table, as hipr-bench-splats prints it."""
    captures = [options.capture] if options.capture.exists() else ["--no-captures"]
    subprocess.run([options.bench, *captures, "--move", *options.arguments], check=True)


class Ours:
    """All modes of one hipr-bench-splats process a turn."""

    def __init__(self, options, folder):
        self.command = [options.bench, options.capture, "--synthetic", "0", "--sizes", options.size]
        self.folder = folder

    def frames(self):
        """{mode: (seconds, processor seconds)}, each the median of three."""
        file = self.folder / "ours.json"
        subprocess.run([*self.command, "--repetitions", "3", "--json", file, "--pictures", self.folder], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        rows = json.loads(file.read_text())["scenes"][0]["rows"]
        return {row["mode"]: (row["frameMs"]["median"] / 1e3, row["processorMs"]["median"] / 1e3) for row in rows}

    def picture(self, mode):
        return next(self.folder.glob(f"*_{mode}_*.ppm"))


def psnr(a, b):
    import numpy as np

    square = np.mean((np.asarray(a, float) - np.asarray(b, float)) ** 2)
    return 10 * np.log10(255**2 / max(square, 1e-9))


def compare_pictures(ours, theirs, keep):
    """PSNR of 8-bit pictures over black, of the whole frame and of what is not black in either."""
    import numpy as np
    from PIL import Image

    a, b = Image.open(ours).convert("RGB"), Image.open(theirs).convert("RGB")
    if keep:
        keep.mkdir(parents=True, exist_ok=True)
        a.save(keep / "hipr.png")
        b.save(keep / "splat-transform.png")
        both = Image.new("RGB", (a.width * 2, a.height))
        both.paste(a, (0, 0))
        both.paste(b, (a.width, 0))
        both.save(keep / "side_by_side.png")
        difference = np.abs(np.asarray(a, int) - np.asarray(b, int))
        Image.fromarray(np.clip(8 * difference, 0, 255).astype(np.uint8)).save(keep / "difference_x8.png")
    pixels, others = np.asarray(a), np.asarray(b)
    shown = (pixels.max(axis=2) > 2) | (others.max(axis=2) > 2)
    return psnr(pixels, others), psnr(pixels[shown], others[shown])


def spread(values, factor=1e3, digits=1):
    low, middle, high = [f"{factor * v:.{digits}f}" for v in (min(values), statistics.median(values), max(values))]
    return f"{middle} ({low}-{high})"


def print_comparison(times, device, options):
    """`times`: {name: [(seconds, processor seconds)] by turn}. Ratios are taken turn by turn."""
    print(f"\n{options.capture.stem}, {options.size}, {options.turns} turns; median (least-most). splat-transform on {device}\n")
    print("| | frame ms | processor ms | splat-transform / this | by processor time | flat16-aabb / this | by processor time |")
    print("|---|---|---|---|---|---|---|")
    for name, rows in times.items():
        cells = [spread([row[kind] for row in rows]) for kind in (0, 1)]
        for other in ("splat-transform", BASELINE):
            cells += [spread([o[kind] / row[kind] for o, row in zip(times[other], rows)], 1, 2) for kind in (0, 1)]
        print("| " + " | ".join([name, *cells]) + " |")


def compare_with_peer(options):
    from splat_transform import SplatTransform

    if not options.capture.exists():
        raise SystemExit(f"{options.capture} is not there; name another capture with --capture")
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        ours, picture = Ours(options, folder), folder / "theirs.webp"
        theirs = SplatTransform(options.environment / "npm", options.capture, options.size.split("x"), folder / "log.txt")
        device = theirs.devices()
        theirs.run(1, picture)  # shaders are compiled once and kept by the driver
        ours.frames()
        times = {"splat-transform": []}
        for turn in range(options.turns):
            print(f"turn {turn + 1} of {options.turns}", file=sys.stderr)
            for mode, row in ours.frames().items():
                times.setdefault(mode, []).append(row)
            times["splat-transform"].append(theirs.frame(picture))
        print(f"load {os.getloadavg()[0]:.1f}", end="")
        print_comparison(times, device, options)
        whole, shown = compare_pictures(ours.picture(list(times)[-1]), picture, options.pictures)
        print(f"\nPSNR of {list(times)[-1]} against splat-transform: {whole:.1f} dB, {shown:.1f} dB where something is seen")
        if options.json:
            options.json.write_text(json.dumps({"times": times, "psnr": whole, "psnrShown": shown}, indent=1))


def main():
    options = parse()
    if options.only != "modes":
        enter_environment(options.environment / "python", PACKAGES)
    if options.only != "peer":
        measure_modes(options)
    if options.only != "modes":
        compare_with_peer(options)


main()
