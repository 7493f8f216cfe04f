"""Runs a scene in all modes, in turns, and makes one row of figures an edit and mode."""

import re
from statistics import median

import numpy as np
import OpenEXR

import edit_metrics as metrics


def read_pictures(folder, count):
    """The pictures of a recording, before any edit and after each: float32, rows top-down."""
    pictures = {}
    for path in folder.glob("picture.*.exr"):
        number = int(re.match(r"picture\.(\d+)", path.name).group(1))
        channels = OpenEXR.File(str(path)).channels()
        rgb = channels["RGBA"] if "RGBA" in channels else channels["RGB"]
        pictures[number] = rgb.pixels[:, :, :3]
    if sorted(pictures) != list(range(count)):
        raise SystemExit(f"{folder}: pictures {sorted(pictures)} instead of 0 to {count - 1}")
    return [pictures[number] for number in range(count)]


def require_equal(scene, pictures):
    """The converged pictures of all modes are equal to the last bit."""
    first, *others = pictures
    for mode in others:
        for number, (a, b) in enumerate(zip(pictures[first], pictures[mode])):
            if a.tobytes() != b.tobytes():
                name = scene.edits[number - 1]["name"] if number else "no edit"
                raise SystemExit(f"{scene.name}, {name}: {first} and {mode} differ in "
                                 f"{int((a != b).any(axis=2).sum())} pixels")


def row_of(scene, edit, mode, d, runs):
    """The figures of one edit in one mode. `runs`: of all turns, the complete one first."""
    run = runs[0]
    energy = metrics.tile_energy(run.grid, d)
    region = float((d > 0).mean())
    row = {"scene": scene.name, "edit": edit, "mode": mode, "kind": run.kind, "region": region,
           "local": region < metrics.LOCAL, "restarts": run.restarts, "tiles": run.grid.count,
           "pixels": d.size, "energy": float(d.mean())}
    row["seconds"] = [[seconds for _, seconds in metrics.times(r, energy)] for r in runs]
    row["paths"] = [paths for paths, _ in metrics.times(run, energy)]
    row["quality"], row["strict"] = metrics.quality(run, energy)
    row["recall"], row["waste"] = metrics.found(run, energy)
    row["found"], row["scouts"] = len(run.found), run.scout_paths
    row["surveyed"] = median(r.surveyed for r in runs)
    row["reveal"] = median(r.steps[0].seconds for r in runs)
    row["frame"] = median(metrics.frame(r)[1] for r in runs)
    order = np.cumsum([energy[step.fresh].sum() for step in run.steps]) / energy.sum()
    row["curve"] = [(step.paths, float(share)) for step, share in zip(run.steps, order)]
    return row


def measure(recorder, scene, options):
    modes = options.modes.split(",")
    runs, pictures = {mode: [] for mode in modes}, {}
    for turn in range(options.turns):
        for mode in modes:
            played, folder = recorder.play(scene, mode, options.few if turn else options.samples, turn)
            runs[mode].append(played)
            if turn == 0:
                pictures[mode] = read_pictures(folder, len(scene.edits) + 1)
    require_equal(scene, pictures)
    shown = pictures[modes[0]]
    rows = []
    for number, edit in enumerate(scene.edits, 1):
        d = metrics.difference(shown[number - 1], shown[number])
        if not d.any():
            raise SystemExit(f"{scene.name}, {edit['name']}: the edit does not show")
        rows += [row_of(scene, edit["name"], mode, d, [turn[number] for turn in runs[mode]]) for mode in modes]
    return rows
