#!/usr/bin/env python3
"""Measures how soon edits show: HiPR's modes against uniform restarts, over scripted edits of several scenes.

Every edit is made on a converged picture and rendered to convergence, in every mode, in turns. D is the difference of the
converged pictures before and after (same seed: what an edit does not touch is equal to the last bit). T50, T90, T99 are
the work (paths, scouts included) and the time until that share of D lies in refreshed tiles: those that show new samples, or keep
an old picture that is no worse. The error on display is that of the picture a viewer sees, against the converged one. The
last table says which goals are met; figures by the clock want an idle machine. numpy, OpenEXR, matplotlib and
flip-evaluator come from PyPI into a virtual environment of their own, once.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from environment import enter_environment

PACKAGES = ("numpy", "matplotlib", "OpenEXR", "flip-evaluator")


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--record", default="hiprrecord", help="the hiprrecord to measure")
    parser.add_argument("--modes", default="uniform,delta",
                        help="uniform first: the yardstick; MODE@SIZE sets hipr:tileSize, as in delta@16 [%(default)s]")
    parser.add_argument("--samples", type=int, default=4, help="[%(default)s]")
    parser.add_argument("--width", type=int, default=640, help="of the pictures, pixels [%(default)s]")
    parser.add_argument("--turns", type=int, default=1, help="more of them give more times [%(default)s]")
    parser.add_argument("--only", default="", metavar="REGEX", help="only scenes whose name matches")
    parser.add_argument("--flip", default="", metavar="EDIT,...", help="edits whose FLIP error is followed batch by batch, such as "
                        "'only in mirror,roughness of brass'")
    parser.add_argument("--assets", type=Path, default=Path(os.environ.get("HIPR_ASSETS", HERE.parents[3] / "shared/assets")),
                        help="folder of the real scenes; skipped when missing [%(default)s]")
    parser.add_argument("--csv", type=Path, help="also write every figure here")
    parser.add_argument("--plot", type=Path, help="also draw the figures against work here (PNG)")
    parser.add_argument("--keep", type=Path, help="keep scripts, logs and pictures in this folder")
    parser.add_argument("--set", action="append", default=[], help="a setting of every recording")
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    parser.add_argument("--environment", type=Path, default=cache / "hipr" / "bench-edits",
                        help="where the Python packages are installed [%(default)s]")
    return parser.parse_args()


class Recorder:
    """Plays a scene's edits with hiprrecord."""

    def __init__(self, program, width, settings, folder):
        self.program, self.width, self.settings, self.folder = program, width, settings, folder

    def play(self, scene, mode, samples, turn, frames=False):
        """The runs, one a picture, and where the pictures are. `frames`: also the picture after every batch."""
        from schedule_log import read_log

        folder = self.folder / scene.name / f"{mode}.{turn}"
        folder.mkdir(parents=True, exist_ok=True)
        script, log = folder / "edits.json", folder / "log.jsonl"
        script.write_text(json.dumps({"edits": scene.edits}, indent=1))
        name, _, tile = mode.partition("@")
        chosen = [f"hipr:mode={name}"] + [f"hipr:tileSize={tile}"] * bool(tile)
        settings = [word for text in (*chosen, *self.settings) for word in ("--set", text)]
        if frames:
            settings += ["--edit-frames", folder / "frames"]
        size = f"{self.width}x{round(self.width * scene.aspect)}"
        subprocess.run([self.program, scene.stage, "-q", "--edits", script, "-o", folder / "picture.exr", "--size", size,
                        "-n", str(samples), *settings],
                       check=True, env={**os.environ, "HIPR_SCHEDULE_LOG": str(log)})
        return read_log(log, samples, len(scene.edits) + 1), folder


def main():
    options = parse()
    enter_environment(options.environment, PACKAGES)
    import edit_flip
    from edit_report import Report
    from edit_runs import measure
    from edit_scenes import all_scenes

    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        recorder = Recorder(options.record, options.width, options.set, folder)
        report = Report(options.modes.split(","))
        scenes = [scene for scene in all_scenes(folder, options.assets) if re.search(options.only, scene.name)]
        for scene in scenes:
            print(f"{scene.name}: {len(scene.edits)} edits", file=sys.stderr)
            report.rows += measure(recorder, scene, options, report.processor)
            report.flip += edit_flip.measure(recorder, scene, options.flip.split(","), report.modes, options.samples)
        report.print(options)
        if options.csv:
            report.write_csv(options.csv)
        if options.plot:
            report.draw(options.plot)


main()
