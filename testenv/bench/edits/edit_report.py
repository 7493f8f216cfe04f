"""Tables, CSV and plots of the rows of edit_runs."""

import csv
import os
from statistics import median

from edit_goals import print_goals
from schedule_log import CAMERA

HEAD = ("| edit | shows in | T50 | T90 | T99 | T90 / uniform | new only | on the clock | quality | strict | recall | followed | found | waste | "
        "scouts | survey | reveal |")


DISPLAY_HEAD = ("| edit | region 25 % | region 10 % | region, sum | frame 25 % | frame 10 % | frame, sum |")


class Report:
    def __init__(self, modes):
        self.modes, self.rows, self.flip = modes, [], []
        self.processor = dict.fromkeys(modes, 0.0)  # seconds

    def _base(self, row):
        return next(r for r in self.rows if (r["scene"], r["edit"], r["mode"]) == (row["scene"], row["edit"], self.modes[0]))

    def ratio(self, row, share=1):
        return row["paths"][share] / self._base(row)["paths"][share]

    def clock(self, row, share=1):
        """Ratios of time, turn by turn."""
        return sorted(a[share] / b[share] for a, b in zip(row["seconds"], self._base(row)["seconds"]))

    def area(self, row, where, unit=0):
        """Error on display, summed up over work (or seconds: unit 1), against uniform rendering."""
        return row["shown"][where]["area"][unit] / self._base(row)["shown"][where]["area"][unit]

    def _line(self, row):
        clock = self.clock(row)
        frames = [paths / row["pixels"] for paths in row["paths"]]
        cells = [f"{row['scene']}: {row['edit']}", f"{100 * row['region']:.1f} %", *(f"{f:.2f}" for f in frames),
                 f"{self.ratio(row):.2f}", f"{row['new'][1] / self._base(row)['new'][1]:.2f}", f"{median(clock):.2f} ({clock[0]:.2f}-{clock[-1]:.2f})",
                 f"{row['quality']:.2f}", f"{row['strict']:.2f}", f"{100 * row['recall']:.1f} %",
                 f"{100 * row['followed']:.1f} %",
                 f"{row['found']} of {row['tiles']}", f"{100 * row['waste']:.0f} %",
                 f"{100 * row['scouts'] / row['pixels']:.1f} %",
                 f"{100 * row['surveyed'] / self._base(row)['frame']:.1f} %",
                 f"{1000 * row['reveal']:.0f} ms"]
        return "| " + " | ".join(cells) + " |"

    def _summary(self, mode, rows, kind):
        if not rows:
            return
        t90 = [self.ratio(row) for row in rows]
        new = [row["new"][1] / self._base(row)["new"][1] for row in rows]
        clock = [median(self.clock(row)) for row in rows]
        print(f"{mode}, {len(rows)} {kind} edits: T90 / uniform median {median(t90):.2f}, worst {max(t90):.2f}; new samples only "
              f"median {median(new):.2f}, worst {max(new):.2f}; on the clock "
              f"median {median(clock):.2f}, worst {max(clock):.2f}; quality median {median(r['quality'] for r in rows):.2f}, "
              f"strict {median(r['strict'] for r in rows):.2f}; recall least {100 * min(r['recall'] for r in rows):.1f} %, "
              f"median {100 * median(r['recall'] for r in rows):.1f} %; followed least "
              f"{100 * min(r['followed'] for r in rows):.1f} %, median {100 * median(r['followed'] for r in rows):.1f} %; scouts most "
              f"{100 * max(r['scouts'] / r['pixels'] for r in rows):.1f} % of a frame")

    def print(self, options):
        print(f"{options.samples} samples, {options.turns} turns, load {os.getloadavg()[0]:.1f}. T: frames of one sample.\n")
        for mode in self.modes:
            rows = [row for row in self.rows if row["mode"] == mode]
            for local in (True, False):
                some = [row for row in rows if row["local"] == local]
                if not some:
                    continue
                print(f"{mode}, {'local' if local else 'global'} edits\n\n{HEAD}\n{'|---' * (HEAD.count('|') - 1)}|")
                for row in some:
                    print(self._line(row))
                print()
        for mode in self.modes[1:]:
            rows = [row for row in self.rows if row["mode"] == mode and row["kind"] != CAMERA]
            self._summary(mode, [row for row in rows if row["local"]], "local")
            self._summary(mode, [row for row in rows if not row["local"]], "global")

        print("\nProcessor seconds of whole recordings: " +
              ", ".join(f"{mode} {seconds:.1f}" for mode, seconds in self.processor.items()))
        for mode in self.modes[1:]:
            self._print_display(mode)
        self._print_flip()
        print_goals(self)

    def _print_display(self, mode):
        """What the viewer sees: error of the picture on display."""
        print(f"\nThe picture on display, {mode} and uniform: frames and seconds until its error is 25 % and 10 % of that at the "
              "edit\n(changed region, then whole frame), and its sum over work and time against uniform\n")
        print(DISPLAY_HEAD + "\n" + "|---" * (DISPLAY_HEAD.count("|") - 1) + "|")
        rows = [row for row in self.rows if row["mode"] == mode and row["shown"]]
        for row in rows:
            base, cells = self._base(row)["shown"], [f"{row['scene']}: {row['edit']}"]
            for where, mine in row["shown"].items():
                for (paths, seconds), (paths0, seconds0) in zip(mine["until"], base[where]["until"]):
                    cells.append(f"{paths / row['pixels']:.2f}, {seconds:.2f} s / {paths0 / row['pixels']:.2f}, {seconds0:.2f} s")
                cells.append(f"{self.area(row, where):.2f}, {self.area(row, where, 1):.2f}")
            print("| " + " | ".join(cells) + " |")
        for kind, some in (("local", [r for r in rows if r["local"]]), ("global", [r for r in rows if not r["local"]])):
            if not some:
                continue
            for where in ("region", "frame"):
                ratios = [[r["shown"][where]["until"][i][0] / self._base(r)["shown"][where]["until"][i][0] for r in some]
                          for i in range(2)]
                areas = [self.area(r, where) for r in some]
                times = [self.area(r, where, 1) for r in some]
                print(f"\n{mode}, {len(some)} {kind} edits, {where}, against uniform: to 25 % median {median(ratios[0]):.2f}, worst "
                      f"{max(ratios[0]):.2f}; to 10 % median {median(ratios[1]):.2f}, worst {max(ratios[1]):.2f}; sum over work median "
                      f"{median(areas):.2f}, worst {max(areas):.2f}; over time median {median(times):.2f}, worst {max(times):.2f}", end="")
        print()

    def _print_flip(self):
        if not self.flip:
            return
        print(f"\nFrames of one sample until the FLIP error of the changed region is 10 % of what it was\n\n| edit | "
              f"{' | '.join(self.modes)} | {' | '.join(f'{mode} / uniform' for mode in self.modes[1:])} |\n"
              f"{'|---' * (2 * len(self.modes))}|")
        for row in self.flip:
            base = row["done"][self.modes[0]]
            cells = [f"{row['done'][mode]:.2f}" for mode in self.modes] + \
                    [f"{row['done'][mode] / base:.2f}" for mode in self.modes[1:]]
            print(f"| {row['scene']}: {row['edit']} | {' | '.join(cells)} |")

    def write_csv(self, path):
        names = ["scene", "edit", "mode", "kind", "region", "local", "tiles", "pixels", "energy", "quality", "strict", "recall",
                 "followed", "waste", "found", "scouts", "surveyed", "reveal", "frame", "restarts"]
        with open(path, "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(names + ["t50_paths", "t90_paths", "t99_paths", "new50_paths",
                                     "new90_paths", "new99_paths", "t50_seconds", "t90_seconds", "t99_seconds"] +
                            [f"{where}_{figure}_{unit}" for where in ("region", "frame") for figure in ("e25", "e10", "sum")
                             for unit in ("paths", "seconds")])
            for row in self.rows:
                seconds = [median(turn[i] for turn in row["seconds"]) for i in range(3)]
                shown = [value for where in (row["shown"] or {}).values() for pair in (*where["until"], where["area"]) for value in pair]
                writer.writerow([row[name] for name in names] + row["paths"] + row["new"] + seconds + shown)

    def draw(self, path):
        """One panel an edit: the share of the difference that is still old, against work; then the FLIP errors."""
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot

        edits = list(dict.fromkeys((row["scene"], row["edit"]) for row in self.rows))
        columns = 6
        rows = -(-(len(edits) + len(self.flip)) // columns)
        figure, axes = pyplot.subplots(rows, columns, squeeze=False, figsize=(3 * columns, 2.2 * rows))
        for axis, key in zip(axes.flat, edits):
            for row in (r for r in self.rows if (r["scene"], r["edit"]) == key):
                work = [0] + [paths / row["pixels"] for paths, _ in row["curve"]]
                lines = axis.step(work, [1] + [1 - share for _, share in row["curve"]], where="post", label=row["mode"])
                if not row["shown"]:
                    continue
                error = [1] + [error for _, _, error in row["shown"]["region"]["curve"]]
                axis.step(work, error, where="post", color=lines[0].get_color(), linestyle=":")
            axis.set_title(": ".join(key), fontsize=8)
            axis.set_xlim(0, 2.5)
        for axis in axes.flat[len(edits) + len(self.flip):]:
            axis.set_visible(False)
        for axis, row in zip(axes.flat[len(edits):], self.flip):
            for mode, points in row["curves"].items():
                axis.step(*zip(*points), where="post", label=mode)
            axis.set_title(f"FLIP, {row['scene']}: {row['edit']}", fontsize=8)
            axis.set_ylim(bottom=0)
        axes.flat[0].legend(fontsize=8)
        figure.supxlabel("work: frames of one sample")
        figure.supylabel("still to be refreshed; dotted: error on display")
        figure.tight_layout()
        figure.savefig(path, dpi=80)
