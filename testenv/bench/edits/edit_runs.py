"""Runs a scene in all modes, in turns, and makes one row of figures an edit and mode."""

import re
import resource
from statistics import median

import numpy as np
import OpenEXR

import edit_display
import edit_metrics as metrics
from schedule_log import CAMERA


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


def row_of(scene, edit, mode, d, runs, pictures):
    """The figures of one edit in one mode. `runs`: of all turns; figures that are no times are of the first. `pictures`: before
    the edit, then after 1, 2... all samples."""
    run = runs[0]
    energy = metrics.tile_energy(run.grid, d)
    region = float((d > 0).mean())
    row = {"scene": scene.name, "edit": edit, "mode": mode, "kind": run.kind, "region": region,
           "local": region < metrics.LOCAL, "restarts": run.restarts, "tiles": run.grid.count,
           "pixels": d.size, "energy": float(d.mean())}
    table = edit_display.error_table(run.grid, pictures, np.ones_like(d, bool))
    shares = [metrics.refreshed(r, energy, lambda tile, samples: table[0][tile] <= table[samples][tile]) for r in runs]
    row["seconds"] = [[seconds for _, seconds in metrics.times(r, share)] for r, share in zip(runs, shares)]
    row["paths"] = [paths for paths, _ in metrics.times(run, shares[0])]
    row["new"] = [paths for paths, _ in metrics.times(run, metrics.refreshed(run, energy, lambda *_: False))]
    row["quality"], row["strict"] = metrics.quality(run, energy)
    row["recall"], row["waste"] = metrics.recall(run.found, energy), metrics.waste(run.found, energy)
    row["followed"] = metrics.recall(run.foreseen, energy)
    row["found"], row["scouts"] = len(run.found), run.scout_paths
    row["surveyed"] = median(r.surveyed for r in runs)
    row["reveal"] = median(r.steps[0].seconds for r in runs)
    row["frame"] = median(metrics.frame(r)[1] for r in runs)
    row["curve"] = [(step.paths, float(share)) for step, share in zip(run.steps, shares[0])]
    # After a move of the camera the old picture is carried along: what is on display does not follow from these pictures.
    row["shown"] = None if run.kind == CAMERA else edit_display.measure(run, pictures, d)
    return row


def record_steps(recorder, scene, mode, samples):
    """The pictures after fewer than all samples: of each number of samples the list that read_pictures() gives."""
    steps = []
    for count in range(1, samples):
        _, folder = recorder.play(scene, mode, count, f"{count}-samples")
        steps.append(read_pictures(folder, len(scene.edits) + 1))
    return steps


def processor_seconds():
    """Of the recordings so far."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def measure(recorder, scene, options, processor):
    """The rows of a scene. Adds to `processor` what the complete recordings cost, mode by mode."""
    modes = options.modes.split(",")
    runs, pictures = {mode: [] for mode in modes}, {}
    for turn in range(options.turns):
        for mode in modes:
            before = processor_seconds()
            played, folder = recorder.play(scene, mode, options.samples, turn)
            runs[mode].append(played)
            if turn == 0:
                processor[mode] += processor_seconds() - before
                pictures[mode] = read_pictures(folder, len(scene.edits) + 1)
    require_equal(scene, pictures)
    shown = pictures[modes[0]]
    steps = record_steps(recorder, scene, modes[0], options.samples)
    rows = []
    for number, edit in enumerate(scene.edits, 1):
        d = metrics.difference(shown[number - 1], shown[number])
        if not d.any():
            raise SystemExit(f"{scene.name}, {edit['name']}: the edit does not show")
        seen = [shown[number - 1], *(pictures[number] for pictures in steps), shown[number]]
        rows += [row_of(scene, edit["name"], mode, d, [turn[number] for turn in runs[mode]], seen) for mode in modes]
    return rows
