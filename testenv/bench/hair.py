#!/usr/bin/env python3
"""Time and memory of a ball with hair.

Usage: hair.py HIPRRECORD [--curves N] [--bald] [--scene FILE] [-o PICTURE] [-n SAMPLES] [--size W]

A ball of radius 1 with N hairs (cubic B-splines of 6 control points, 0.35 long, 1.6 thousandths wide at the root and
pointed), one prim, in three colours, under a dome and a sun. What a sample takes is the difference between pictures of
SAMPLES and of 5 * SAMPLES samples, so that start-up and set-up do not count; --bald leaves the hair away.
"""
import argparse
import math
import os
import random
import resource
import subprocess
import sys
import tempfile

POINTS = 6
LENGTH = 0.35
WIDTH = 0.0016
COLORS = ["(0.62, 0.36, 0.14)", "(0.72, 0.46, 0.2)", "(0.5, 0.26, 0.1)"]


def direction(i, count):
    """Evenly spread over the sphere."""
    z = 1 - 2 * (i + 0.5) / count
    angle = math.pi * (3 - math.sqrt(5)) * i
    r = math.sqrt(1 - z * z)
    return r * math.cos(angle), r * math.sin(angle), z


def lock(way):
    """The middle of the lock of hair that grows at a place."""
    x, y, z = way  # turned, so that cells do not line up with the ball
    cell = [math.floor(11 * c) + 0.5 for c in (0.8 * x - 0.6 * y, 0.36 * x + 0.48 * y - 0.8 * z, 0.48 * x + 0.64 * y + 0.6 * z)]
    x, y, z = cell
    cell = (0.8 * x + 0.36 * y + 0.48 * z, -0.6 * x + 0.48 * y + 0.64 * z, -0.8 * y + 0.6 * z)
    length = math.hypot(*cell)
    return [c / length for c in cell]


def hair(i, count, numbers):
    """Control points of one hair: out of the ball, together with its lock, then down, with a wave of its own."""
    way = direction(i, count)
    middle = lock(way)
    wave, phase = 0.01 + 0.01 * numbers.random(), 6.28 * numbers.random()
    length = LENGTH * (0.8 + 0.4 * numbers.random())
    for k in range(POINTS):
        t = k / (POINTS - 1)
        x, y, z = (a + 0.75 * t * (b - a) for a, b in zip(way, middle))
        out = 1 + length * t * (1 - 0.35 * t)
        bend = wave * math.sin(phase + 5 * t) * t
        yield (x * out + bend * y, y * out - bend * x, z * out - 0.6 * length * t * t)


def curves(count, numbers):
    points = ", ".join("(%.5f, %.5f, %.5f)" % p for i in range(count) for p in hair(i, count, numbers))
    widths = ", ".join(f"{WIDTH:g}" if k < POINTS - 1 else "0" for k in range(POINTS))
    return f"""    def BasisCurves "Hair" {{
        uniform token type = "cubic"
        uniform token basis = "bspline"
        uniform token wrap = "pinned"
        int[] curveVertexCounts = [{", ".join([str(POINTS)] * count)}]
        point3f[] points = [{points}]
        float[] widths = [{", ".join([widths] * count)}] (
            interpolation = "vertex"
        )
        color3f[] primvars:displayColor = [{", ".join(numbers.choice(COLORS) for _ in range(count))}] (
            interpolation = "uniform"
        )
    }}
"""


def write_scene(path, count):
    numbers = random.Random(1)
    with open(path, "w") as out:
        out.write("""#usda 1.0
(
    upAxis = "Z"
    defaultPrim = "World"
)
def Xform "World"
{
    def Camera "Camera" {
        float focalLength = 38
        float horizontalAperture = 24
        float verticalAperture = 24
        double3 xformOp:translate = (0, -5.6, 0)
        float xformOp:rotateX = 87
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
    }
    def DomeLight "Sky" {
        color3f inputs:color = (0.75, 0.85, 1)
        color3f color = (0.75, 0.85, 1)
        float inputs:intensity = 0.25
        float intensity = 0.25
    }
    def DistantLight "Sun" {
        float inputs:intensity = 2
        float intensity = 2
        bool inputs:normalize = 1
        bool normalize = 1
        float inputs:angle = 2
        float angle = 2
        float3 xformOp:rotateXYZ = (50, 0, -35)
        uniform token[] xformOpOrder = ["xformOp:rotateXYZ"]
    }
    def Sphere "Ball" {
        double radius = 1
        color3f[] primvars:displayColor = [(0.4, 0.22, 0.1)]
    }
""")
        if count:
            out.write(curves(count, numbers))
        out.write("}\n")


def record(recorder, scene, picture, samples, size):
    """Seconds of processor time, and megabytes at the most."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = ["/usr/bin/env", "time", "-f", "%M", recorder, scene, "-o", picture, "-n", str(samples), "--size",
               f"{size}x{size}", "--camera", "/World/Camera"]
    done = subprocess.run(command, check=True, stderr=subprocess.PIPE, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, int(done.stderr.split()[-1]) / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recorder")
    parser.add_argument("--curves", type=int, default=1000000)
    parser.add_argument("--bald", action="store_true")
    parser.add_argument("--scene", help="where the scene goes, or is already")
    parser.add_argument("-o", "--output", default="hair.exr")
    parser.add_argument("-n", "--samples", type=int, default=4)
    parser.add_argument("--size", type=int, default=256)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scene = options.scene or os.path.join(folder, "hair.usda")
        if not os.path.exists(scene):
            write_scene(scene, 0 if options.bald else options.curves)
        few, _ = record(options.recorder, scene, options.output, options.samples, options.size)
        many, megabytes = record(options.recorder, scene, options.output, 5 * options.samples, options.size)
    sample = (many - few) / (4 * options.samples)
    print(f"{options.curves} curves: {sample:.3f} s a sample, {few - options.samples * sample:.1f} s to begin with, "
          f"{megabytes:.0f} MB")


if __name__ == "__main__":
    sys.exit(main())
