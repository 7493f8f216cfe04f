#!/usr/bin/env python3
"""Counts which tiles of a picture the splats of a 3DGS .ply meet, with none of the renderer's code or formulas.

Everything is in double precision: full covariance matrices, and for every tile in the box around a splat the least value
that its quadratic form takes in that rectangle. What is counted, for a splat of opacity o whose centre lies beyond the near
plane and whose ellipse meets the picture:
  exact   tiles in which (x - mean)^T (covariance + 0.3)^-1 (x - mean) <= min(3.33^2, 2 ln(255 o)) somewhere
  aabb    tiles that meet a square of 3 standard deviations along the ellipse's longer axis, rounded up to pixels (3DGS)
Tiles are counted from the lower left corner of the picture. numpy is all it needs.
"""

import argparse
import json

import numpy as np

EXACT_TILES = {"flat16-exact": (16, 16), "flat8-exact": (8, 8), "higs8": (64, 32), "higs8-carry": (64, 32)}
MODES = ("flat16-aabb", *EXACT_TILES)
TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4", "double": "f8"}
CHUNK = 1 << 20  # (splat, tile) candidates at once


def read_ply(path):
    """The vertices of a binary little-endian .ply, as a structured array."""
    with open(path, "rb") as file:
        fields, count = [], None
        for line in iter(file.readline, b"end_header\n"):
            words = line.decode().split()
            if words[0] == "element":
                if words[1] != "vertex":
                    raise SystemExit(f"{path}: only vertices are understood, not {words[1]}")
                count = int(words[2])
            elif words[0] == "property":
                fields.append((words[2], "<" + TYPES[words[1]]))
            elif words[0] == "format" and words[1] != "binary_little_endian":
                raise SystemExit(f"{path}: only binary_little_endian is understood")
        return np.fromfile(file, np.dtype(fields), count)


def columns(vertices, *names):
    return np.stack([vertices[name].astype(np.float64) for name in names], axis=1)


def rotations(q):
    """Matrices of the quaternions w x y z."""
    w, x, y, z = (q / np.linalg.norm(q, axis=1, keepdims=True)).T
    return np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                     2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                     2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=1).reshape(-1, 3, 3)


class Camera:
    """At `eye`, looking at `target`, Y up."""

    def __init__(self, eye, target, vertical_fov, near, size):
        eye, target = np.array(eye, float), np.array(target, float)
        back = (eye - target) / np.linalg.norm(eye - target)
        right = np.cross((0, 1, 0), back)
        right /= np.linalg.norm(right)
        self.eye, self.view = eye, np.stack([right, np.cross(back, right), back])
        self.size, self.near = np.array(size, float), near
        self.focal = 0.5 * size[1] / np.tan(0.5 * np.radians(vertical_fov))


def project(vertices, turned, camera):
    """mean, covariance and reach (the largest value of the quadratic form) of the splats that are seen."""
    turn = np.diag((-1.0, -1.0, 1.0)) if turned else np.eye(3)
    opacity = 1 / (1 + np.exp(-vertices["opacity"].astype(np.float64)))
    to_view = camera.view @ turn
    v = columns(vertices, "x", "y", "z") @ to_view.T - camera.view @ camera.eye
    depth = -v[:, 2]
    kept = (depth >= camera.near) & (opacity >= 1 / 255)
    vertices, v, depth, opacity = vertices[kept], v[kept], depth[kept], opacity[kept]

    axes = to_view @ rotations(columns(vertices, "rot_0", "rot_1", "rot_2", "rot_3"))
    axes = axes * np.exp(columns(vertices, "scale_0", "scale_1", "scale_2"))[:, None, :]
    half = 0.5 * camera.size / camera.focal
    slope = v[:, :2] / depth[:, None]
    held = np.clip(slope, -1.3 * half, 1.3 * half)  # as 3DGS: the shape of what is far outside is that of the edge
    jacobian = np.zeros((len(v), 2, 3))
    jacobian[:, 0, 0] = jacobian[:, 1, 1] = camera.focal / depth
    jacobian[:, :, 2] = camera.focal * held / depth[:, None]
    flat = jacobian @ axes
    covariance = flat @ flat.transpose(0, 2, 1) + 0.3 * np.eye(2)
    mean = camera.focal * slope + 0.5 * camera.size
    reach = np.minimum(3.33**2, 2 * np.log(255 * opacity))
    extent = np.sqrt(reach[:, None] * np.stack([covariance[:, 0, 0], covariance[:, 1, 1]], axis=1))
    seen = np.all((mean + extent > 0) & (mean - extent < camera.size), axis=1)
    return mean[seen], covariance[seen], reach[seen], extent[seen]


def tile_box(mean, extent, tile, size):
    """First tile and number of tiles along both axes that meet a box."""
    tiles = np.ceil(size / tile)
    first = np.clip(np.floor((mean - extent) / tile), 0, tiles)
    end = np.clip(np.floor((mean + extent) / tile) + 1, 0, tiles)
    return first.astype(np.int64), np.maximum(end - first, 0).astype(np.int64)


def count_squares(mean, covariance, tile, size):
    longest = np.linalg.eigvalsh(covariance)[:, 1]
    radius = np.ceil(3 * np.sqrt(longest))[:, None]
    return int(np.prod(tile_box(mean, radius, tile, size)[1], axis=1).sum())


def least_on_edges(a, b, c, x, y):
    """The least a x^2 + 2 b x y + c y^2 on the edges of rectangles, x and y being their pairs of sides."""
    least = np.full(len(a), np.inf)
    for side in range(2):
        other = np.clip(-b * x[side] / c, y[0], y[1])
        least = np.minimum(least, a * x[side] ** 2 + 2 * b * x[side] * other + c * other**2)
        other = np.clip(-b * y[side] / a, x[0], x[1])
        least = np.minimum(least, a * other**2 + 2 * b * other * y[side] + c * y[side] ** 2)
    return least


def count_exact(mean, covariance, reach, extent, tile, size):
    inverse = np.linalg.inv(covariance)
    first, number = tile_box(mean, extent, tile, size)
    candidates = np.prod(number, axis=1)
    ends = np.cumsum(candidates)
    pairs, begin = 0, 0
    while begin < len(mean):
        end = max(begin + 1, int(np.searchsorted(ends, ends[begin] - candidates[begin] + CHUNK, side="right")))
        splat = np.repeat(np.arange(begin, end), candidates[begin:end])
        which = np.arange(len(splat)) - np.repeat(ends[begin:end] - candidates[begin:end] - (ends[begin] - candidates[begin]),
                                                  candidates[begin:end])
        columns_ = number[splat, 0]
        corner = (first[splat] + np.stack([which % columns_, which // columns_], axis=1)) * tile - mean[splat]
        x, y = [(corner[:, k], corner[:, k] + tile[k]) for k in range(2)]
        least = least_on_edges(inverse[splat, 0, 0], inverse[splat, 0, 1], inverse[splat, 1, 1], x, y)
        inside = (x[0] <= 0) & (x[1] >= 0) & (y[0] <= 0) & (y[1] >= 0)
        pairs += int(np.count_nonzero(inside | (least <= reach[splat])))
        begin = end
    return pairs


def count(path, turned, camera, modes=MODES):
    """Pairs by mode, and how many splats are seen."""
    mean, covariance, reach, extent = project(read_ply(path), turned, camera)
    result, by_tile = {"visible": len(mean)}, {}
    for mode in modes:
        if mode == "flat16-aabb":
            result[mode] = count_squares(mean, covariance, np.array([16.0, 16.0]), camera.size)
            continue
        tile = EXACT_TILES[mode]
        if tile not in by_tile:
            by_tile[tile] = count_exact(mean, covariance, reach, extent, np.array(tile, float), camera.size)
        result[mode] = by_tile[tile]
    return result


def bench_camera(size):
    """The camera of hipr-bench-splats."""
    return Camera((0, 1.1, 2.6), (0, 0.5, 0), 60, 0.2, size)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ply", help="a capture, binary little-endian")
    parser.add_argument("--size", default="1920x1080", help="of the picture [%(default)s]")
    parser.add_argument("--upright", action="store_true", help="Y is up already; else the capture is turned half around z")
    options = parser.parse_args()
    size = tuple(map(int, options.size.split("x")))
    print(json.dumps(count(options.ply, not options.upright, bench_camera(size))))


if __name__ == "__main__":
    main()
