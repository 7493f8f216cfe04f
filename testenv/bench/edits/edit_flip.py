"""FLIP error after every batch, for a few edits: pictures as `hiprrecord --edit-frames` writes them, with the view transform,
against the converged picture of the same run.

FLIP: P. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", 2020; PyPI flip-evaluator."""

import json
from dataclasses import replace

import flip_evaluator
import numpy as np
import OpenEXR  # noqa: F401  (before PIL: both bring a zlib)
from PIL import Image

import edit_metrics as metrics

REMAINING = 0.1  # share of the error at the edit that counts as done


def load(path):
    return np.asarray(Image.open(path).convert("RGB"), dtype=np.float32) / 255


def error(reference, picture, mask):
    pixels, _, _ = flip_evaluator.evaluate(reference, picture, "LDR", applyMagma=False, computeMeanError=False)
    return float(pixels[..., 0][mask].mean())


def frames_of(folder):
    """For every edit the list of (paths, file), in order."""
    frames = {}
    for text in (folder / "frames.jsonl").read_text().splitlines():
        line = json.loads(text)
        frames.setdefault(line["edit"], []).append((line["paths"], folder / line["file"]))
    return frames


def curve(run, frames, before, mask):
    """(paths, error) from the edit on; paths with scouts."""
    reference = load(frames[-1][1])
    points = [(0, error(reference, load(before), mask))]
    for paths, file in frames:
        points.append((paths + run.scout_paths, error(reference, load(file), mask)))
    return points


def done(points):
    """Work from which on the error stays within REMAINING of what it was at the edit."""
    late = [i for i, (_, value) in enumerate(points) if value > REMAINING * points[0][1]]
    return points[late[-1] + 1][0]


def measure(recorder, scene, names, modes, samples):
    """One row an edit: the curves of all modes and when they are done."""
    from edit_runs import read_pictures

    scene = replace(scene, edits=[edit for edit in scene.edits if edit["name"] in names])
    if not scene.edits:
        return []
    rows = {edit["name"]: {"scene": scene.name, "edit": edit["name"], "curves": {}, "done": {}} for edit in scene.edits}
    for mode in modes:
        runs, folder = recorder.play(scene, mode, samples, "flip", frames=True)
        shown = read_pictures(folder, len(scene.edits) + 1)
        frames = frames_of(folder / "frames")
        for number, edit in enumerate(scene.edits, 1):
            d = metrics.difference(shown[number - 1], shown[number])[::-1]  # as files have it: rows top-down
            points = curve(runs[number], frames[number], frames[number - 1][-1][1], d > 0)
            row = rows[edit["name"]]
            row["curves"][mode] = [(paths / d.size, value) for paths, value in points]
            row["done"][mode] = done(points) / d.size
    return list(rows.values())
