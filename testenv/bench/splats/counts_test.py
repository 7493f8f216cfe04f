#!/usr/bin/env python3
"""The pass's own counts of (splat, tile) pairs against those of splat_counts.py, which shares nothing with it.

counts_test.py HIPR_BENCH_SPLATS ASSETS: on a scene made by that program, always, and on playbot where the shared assets are. Every
mode must agree within 0.1 %, at 1920 x 1080 and at 3840 x 2160.
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from splat_counts import MODES, bench_camera, count

SIZES = ((1920, 1080), (3840, 2160))
PERCENT = 0.1


class Counts(unittest.TestCase):
    def counted(self, *arguments):
        """What hipr-bench-splats counts: {(size, mode): row}."""
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "counts.json"
            sizes = ",".join(f"{w}x{h}" for w, h in SIZES)
            subprocess.run([PROGRAM, "--count", "--sizes", sizes, "--synthetic-sizes", sizes, "--json", file, *arguments], check=True,
                           stdout=subprocess.DEVNULL)
            scenes = json.loads(file.read_text())["scenes"]
        self.assertEqual(len(scenes), 1)
        return {(tuple(row["size"]), row["mode"]): row for row in scenes[0]["rows"]}

    def hold(self, rows, ply, turned):
        self.assertEqual(len(rows), len(SIZES) * len(MODES))
        for size in SIZES:
            expected = count(ply, turned, bench_camera(size))
            for mode in MODES:
                row = rows[size, mode]
                for what, ours, numpys in (("pairs", row["pairs"], expected[mode]),
                                           ("visible", row["visible"], expected["visible"])):
                    off = 100 * (ours / numpys - 1)
                    print(f"{ply.name} {size[0]}x{size[1]} {mode} {what}: {ours}, numpy {numpys} ({off:+.3f} %)")
                    with self.subTest(mode=mode, size=size, what=what):
                        self.assertGreater(numpys, 0)
                        self.assertLessEqual(abs(off), PERCENT)

    def test_synthetic(self):
        with tempfile.TemporaryDirectory() as folder:
            rows = self.counted("--no-captures", "--synthetic", "60000", "--save", folder)
            self.hold(rows, Path(folder) / "synthetic_60000.ply", turned=False)

    def test_playbot(self):
        ply = ASSETS / "splats/playbot/playbot_125k_sh2.ply"
        if not ply.exists():
            self.skipTest(f"{ply} is not there")
        self.hold(self.counted(ply, "--synthetic", "0"), ply, turned=True)


if __name__ == "__main__":
    ASSETS = Path(sys.argv.pop())
    PROGRAM = sys.argv.pop()
    unittest.main()
