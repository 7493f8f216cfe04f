#!/usr/bin/env python3
"""Processor time of a sample of a picture with few and with many lights.

Usage: many_lights.py HIPRRECORD [COUNT ...]

A floor with balls under COUNT small spheres of light, spread over it, whose power adds up to the same. What a sample takes
is the difference between pictures of 4 and of 36 samples, so that start-up and set-up do not count.
"""
import os
import random
import resource
import subprocess
import sys
import tempfile

SAMPLES = (4, 36)
WIDTH = 160


def scene(count):
    numbers = random.Random(1)
    lines = ["#usda 1.0", '(upAxis = "Z")', 'def Xform "World" {', """
def Camera "Camera" {
    float focalLength = 28
    double3 xformOp:translate = (0, -14, 7)
    float xformOp:rotateX = 62
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
}
def Mesh "Floor" {
    uniform token subdivisionScheme = "none"
    point3f[] points = [(-20, -20, 0), (20, -20, 0), (20, 20, 0), (-20, 20, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
}"""]
    for i in range(9):
        x, y = 4.0 * (i % 3 - 1), 4.0 * (i // 3 - 1)
        lines.append(f"""def Mesh "Block{i}" {{
    uniform token subdivisionScheme = "catmullClark"
    point3f[] points = [{', '.join(str((x + a, y + b, c)) for c in (0, 2) for b in (-1, 1) for a in (-1, 1))}]
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5]
}}""")
    for i in range(count):
        place = (numbers.uniform(-16, 16), numbers.uniform(-16, 16), numbers.uniform(2.5, 4))
        lines.append(f"""def SphereLight "Light{i}" {{
    bool inputs:normalize = 1
    float inputs:intensity = {4000 / count}
    float inputs:radius = 0.02
    double3 xformOp:translate = {place}
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}""")
    return "\n".join(lines + ["}"])


def processor_seconds(recorder, stage, samples, picture):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([recorder, stage, "--camera", "/World/Camera", "--size", str(WIDTH), "--samples", str(samples),
                    "-o", picture], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    recorder, counts = sys.argv[1], [int(n) for n in sys.argv[2:]] or [10, 1000, 10000]
    print(f"{'lights':>8}{'s a sample':>12}")
    with tempfile.TemporaryDirectory() as folder:
        for count in counts:
            stage = os.path.join(folder, f"{count}.usda")
            with open(stage, "w") as file:
                file.write(scene(count))
            few, many = (processor_seconds(recorder, stage, n, os.path.join(folder, "picture.exr")) for n in SAMPLES)
            print(f"{count:8}{(many - few) / (SAMPLES[1] - SAMPLES[0]):12.3f}", flush=True)


if __name__ == "__main__":
    main()
