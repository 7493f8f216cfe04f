#!/usr/bin/env python3
"""Compares HiPR with Blender's Cycles: samples per second of the same USD scene at the same size, depth and samples.

Cycles comes from PyPI (bpy) into a virtual environment of its own, once: about 400 MB. Both renderers take turns. Only
samples are timed: from each renderer's time for N samples its time for a few is taken off, so that start-up, scene import
and acceleration structures do not count on either side. Samples per second of processor time are told as well: they hold on a
machine that is busy with other work, too.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from bench_scene import write_scene
from environment import python_with

BPY = "bpy==5.0.1"  # needs Python 3.11, Debian 12's
KINDS = {"msamplesPerSecond": "Msamples/s", "msamplesPerCpuSecond": "Msamples/s of one processor"}
HERE = Path(__file__).resolve().parent


def plain_environment():
    """Blender brings its own libraries, OpenUSD among them."""
    ours = ("LD_LIBRARY_PATH", "PYTHONPATH", "PXR_PLUGINPATH_NAME")
    return {name: value for name, value in os.environ.items() if name not in ours}


class Cycles:
    name = "Cycles"

    def __init__(self, python, scene, size, depth, log):
        command = [python, HERE / "cycles_worker.py", scene, *map(str, size), str(depth)]
        self.log = log
        with open(log, "w") as stderr:
            self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=stderr,
                                            text=True, env=plain_environment())

    def _ask(self, line):
        if self.process.poll() is None:
            self.process.stdin.write(line + "\n")
            self.process.stdin.flush()
        for answer in self.process.stdout:
            if answer.startswith("RESULT "):
                return [float(word) for word in answer.split()[1:]]
        raise SystemExit("Cycles ended without a result:\n" + self.log.read_text()[-2000:])

    def time(self, samples, seed):
        """Seconds on the clock, and of all processors together."""
        return self._ask(f"{samples} {seed}")

    def mean(self, samples, folder):
        return self._ask(f"{samples} 1 {folder / 'cycles.exr'}")[2]

    def close(self):
        self.process.stdin.close()
        self.process.wait()


class Hipr:
    name = "HiPR"

    def __init__(self, record, scene, size, depth):
        self.command = [record, scene, "-q", "--camera", "Camera", "--size", f"{size[0]}x{size[1]}",
                        "--set", f"hipr:maxDepth={depth}"]

    def _render(self, samples, seed, picture):
        with tempfile.TemporaryDirectory() as folder:
            stats, picture = Path(folder, "stats.json"), picture or Path(folder, "hipr.exr")
            subprocess.run([*self.command, "-n", str(samples), "--set", f"hipr:seed={seed}", "--stats", stats,
                            "-o", picture], check=True)
            return json.loads(stats.read_text())["frames"][0]

    def time(self, samples, seed):
        before = os.times()
        clock = self._render(samples, seed, None)["seconds"]
        after = os.times()
        return clock, sum(after[2:4]) - sum(before[2:4])  # of children that have ended

    def picture(self, samples, path):
        self._render(samples, 1, path)

    def close(self):
        pass


def mean_of_picture(python, path):
    """Mean luminance of an EXR, read by bpy."""
    code = ("import sys, bpy; i = bpy.data.images.load(sys.argv[1]); i.colorspace_settings.name = 'Non-Color'; "
            "p = i.pixels[:]; n = len(p) // 4; "
            "print('RESULT', sum(.2126 * p[4*k] + .7152 * p[4*k+1] + .0722 * p[4*k+2] for k in range(n)) / n)")
    output = subprocess.run([python, "-c", code, path], check=True, capture_output=True, text=True,
                            env=plain_environment()).stdout
    return float(next(line for line in output.splitlines() if line.startswith("RESULT ")).split()[1])


def spread(values):
    return {"median": statistics.median(values), "min": min(values), "max": max(values)}


def text(s):
    return f"{s['median']:.3f} ({s['min']:.3f}-{s['max']:.3f})"


def measure(options, folder):
    scene = options.scene or write_scene(folder)
    size = tuple(map(int, options.size.split("x")))
    python = python_with(options.environment, [BPY], plain_environment())
    renderers = [Hipr(options.record, scene, size, options.depth),
                 Cycles(python, scene, size, options.depth, folder / "cycles.log")]
    msamples = size[0] * size[1] * options.samples / 1e6
    rates = {kind: {r.name: [] for r in renderers} for kind in KINDS}
    for r in renderers:  # compile, import, build
        r.time(1, 0)
    few = options.samples // 8 or 1
    for repetition in range(options.repetitions):
        for r in renderers:
            times = zip(r.time(options.samples + few, repetition + 1), r.time(few, repetition + 1))
            for kind, (long, short) in zip(KINDS, times):
                rates[kind][r.name].append(msamples / (long - short))
    hipr, cycles = renderers
    hipr.picture(options.samples, folder / "hipr.exr")
    means = {"HiPR": mean_of_picture(python, folder / "hipr.exr"), "Cycles": cycles.mean(options.samples, folder)}
    for r in renderers:
        r.close()
    return {"scene": Path(scene).name, "size": options.size, "samples": options.samples, "depth": options.depth,
            "rates": {kind: {name: spread(values) for name, values in rates[kind].items()} for kind in KINDS},
            "ratios": {kind: spread([a / b for a, b in zip(*rates[kind].values())]) for kind in KINDS},
            "meanLuminance": means}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--record", default="hiprrecord", help="the hiprrecord to measure")
    parser.add_argument("--scene", help="a USD scene with a camera; default: a room made for this purpose")
    parser.add_argument("--size", default="480x270")
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--depth", type=int, default=8, help="surface bounces; 1 is direct light only")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--json", help="also write the results here")
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    parser.add_argument("--environment", type=Path, default=cache / "hipr" / "bpy",
                        help="where Cycles is installed [%(default)s]")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        result = measure(options, Path(folder))
    print(f"{result['scene']}, {result['size']}, {result['samples']} samples, depth {result['depth']}; "
          f"load {os.getloadavg()[0]:.2f}")
    print("| | HiPR | Cycles | HiPR / Cycles |\n|---|---|---|---|")
    for kind, label in KINDS.items():
        row = [*result["rates"][kind].values(), result["ratios"][kind]]
        print(f"| {label} | {' | '.join(map(text, row))} |")
    print(f"| mean luminance | {' | '.join(f'{mean:.4f}' for mean in result['meanLuminance'].values())} | |")
    if options.json:
        Path(options.json).write_text(json.dumps(result, indent=2) + "\n")


main()
