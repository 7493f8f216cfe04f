"""The error of the picture on display, batch by batch.

What is on display is known without recording it: a tile shows the picture before the edit or the mean of its first k samples,
which is the same in every mode and to the last bit. So one recording for each k, and the log of what was rendered when, give
the picture after every batch. The error is against the picture after all samples, which is where every mode ends: it ends
at 0, and what is left of it on the way is both the old picture and the noise of few samples."""

import numpy as np

import edit_metrics as metrics

LEVELS = (0.25, 0.1)  # of the error at the edit


def error_table(grid, pictures, mask):
    """Summed |displayed - final| of each tile (column) showing pictures[k] (row), over the pixels of `mask`. pictures[0] is
    the one before the edit, the last one is final; rows top-down. `mask` is bottom-up, like the grid."""
    final = pictures[-1].astype(np.float64)
    table = []
    for picture in pictures:
        error = np.abs(picture - final).mean(axis=2)[::-1]
        table.append(metrics.tile_energy(grid, np.where(mask, error, 0)))
    return np.array(table)


def curve(run, table):
    """(paths, seconds, error) after every batch, the error as a share of what it was at the edit."""
    on_display = table[0].copy()
    whole = on_display.sum()
    points = []
    for step in run.steps:
        for tile, samples in step.shows:
            on_display[tile] = table[samples][tile]
        points.append((step.paths, step.seconds, float(on_display.sum() / whole)))
    return points


def until(points, level):
    """Paths and seconds from which on the error stays within `level`."""
    late = [i for i, (_, _, error) in enumerate(points) if error > level]
    paths, seconds, _ = points[late[-1] + 1 if late else 0]
    return paths, seconds


def area(points):
    """Error times work, and error times seconds, summed up until it is 0."""
    paths, seconds, before, sums = 0, 0.0, 1.0, [0.0, 0.0]
    for point in points:
        sums[0] += before * (point[0] - paths)
        sums[1] += before * (point[1] - seconds)
        paths, seconds, before = point
    return sums


def measure(run, pictures, d):
    """Figures of the changed region and of the whole frame."""
    result = {}
    for name, mask in (("region", d > 0), ("frame", np.ones_like(d, bool))):
        points = curve(run, error_table(run.grid, pictures, mask))
        result[name] = {"curve": points, "until": [until(points, level) for level in LEVELS], "area": area(points)}
    return result
