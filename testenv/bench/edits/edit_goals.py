"""What HiPR is meant to reach, and whether it does: one line a goal."""

from statistics import median

from schedule_log import CAMERA


def goals(report, mode):
    """(goal, limit, measured, unit); a limit is an upper bound, unless it is negative: then minus a lower one. The camera's
    moves are left out: there is nothing to look for."""
    rows = [row for row in report.rows if row["mode"] == mode and row["kind"] != CAMERA]
    local, others = [row for row in rows if row["local"]], [row for row in rows if not row["local"]]

    def clock(row):
        return median(report.clock(row))

    if local:
        yield "local edits: T90 / uniform, paths, median", 0.20, median(map(report.ratio, local)), ""
        yield "local edits: T90 / uniform, paths, worst", 0.60, max(map(report.ratio, local)), ""
        yield "local edits: T90 / uniform, clock, median", 0.20, median(map(clock, local)), ""
        yield "local edits: T90 / uniform, clock, worst", 0.60, max(map(clock, local)), ""
        yield "local edits: quality, median", -0.80, median(row["quality"] for row in local), ""
        yield ("local edits: error on display / uniform, region, paths, median", 1.0,
               median(report.area(row, "region") for row in local), "")
    if others:
        yield "other edits: T90 / uniform, paths, median", 1.05, median(map(report.ratio, others)), ""
        yield "other edits: T90 / uniform, paths, worst", 1.05, max(map(report.ratio, others)), ""
        yield "other edits: T90 / uniform, clock, median", 1.05, median(map(clock, others)), ""
        yield "other edits: T90 / uniform, clock, worst", 1.05, max(map(clock, others)), ""
        yield ("other edits: error on display / uniform, region, paths, median", 1.0,
               median(report.area(row, "region") for row in others), "")
    if rows:
        yield ("error on display / uniform, whole frame, paths, worst", 1.05,
               max(report.area(row, "frame") for row in rows), "")
        yield "D in tiles discovered before their turn, least", -95, 100 * min(row["followed"] for row in rows), " %"
        yield "scouts, share of a frame, most", 5, 100 * max(row["scouts"] / row["pixels"] for row in rows), " %"


def print_goals(report):
    for mode in report.modes[1:]:
        print(f"\n{mode}\n\n| goal | wanted | measured | met |\n|---|---|---|---|")
        for text, limit, measured, unit in goals(report, mode):
            least = limit < 0
            met = measured >= -limit if least else measured <= limit
            print(f"| {text} | {'>=' if least else '<='} {abs(limit):g}{unit} | {measured:.2f}{unit} | {'yes' if met else 'no'} |")
