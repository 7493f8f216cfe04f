"""Reads what HIPR_SCHEDULE_LOG wrote (renderer/hipr/schedule_log.h): what was rendered when, edit by edit."""

import json
from dataclasses import dataclass, field

import numpy as np


CAMERA = "camera"  # kind of a run: the view moved


@dataclass
class Grid:
    width: int
    height: int
    tile: int

    @property
    def columns(self):
        return -(-self.width // self.tile)

    @property
    def rows(self):
        return -(-self.height // self.tile)

    @property
    def count(self):
        return self.columns * self.rows

    def at(self, x, y):
        return x // self.tile + y // self.tile * self.columns


@dataclass
class Step:
    """One batch."""
    paths: int  # traced since the edit, this batch and scouts included
    seconds: float  # since the edit
    sampled: list  # tiles that got their first sample, in order
    shows: list  # (tile, samples in the mean on display) where that is new
    keeps: list  # (tile, samples) where new samples exist, but the picture before the edit is still on display


@dataclass
class Run:
    """What followed one edit, until the picture was converged."""
    grid: Grid
    kind: str
    start: float
    scout_paths: int = 0
    surveyed: float = 0.0  # seconds since the edit until the tiles were in order for the first time
    found: dict = field(default_factory=dict)  # tile -> latest priority, as surveyed
    foreseen: set = field(default_factory=set)  # tiles that had been discovered, by whatever, when their turn came
    steps: list = field(default_factory=list)
    restarts: int = 0

    def order(self):
        """Tiles in the order of their first sample."""
        return [tile for step in self.steps for tile in step.sampled]


class _Reader:
    def __init__(self, samples):
        self.samples, self.runs, self.done, self.paths = samples, [], np.zeros(0), 0

    def restart(self, line):
        grid = Grid(line["width"], line["height"], line["tileSize"])
        if not self.runs or (self.done.size and (self.done >= self.samples).all()):
            self.runs.append(Run(grid, line["kind"], line["seconds"]))
            self.paths = 0
        else:  # not converged: the edit comes in pieces, and what was refreshed is out of date again
            run = self.runs[-1]
            run.grid, run.restarts, run.foreseen = grid, run.restarts + 1, set()
            run.steps = [Step(step.paths, step.seconds, [], [], []) for step in run.steps]
        self.done = np.zeros(grid.count, int)

    def survey(self, line):
        self.paths += line["paths"]
        self.runs[-1].scout_paths += line["paths"]

    def order(self, line):
        run = self.runs[-1]
        run.surveyed = run.surveyed or line["seconds"] - run.start
        run.found.update({run.grid.at(x, y): priority for x, y, priority in line["tiles"]})

    def batch(self, line):
        run = self.runs[-1]
        sampled, shows, keeps = [], [], []
        for x, y, _, _, first, count, shown, foreseen in line["tiles"]:
            tile = run.grid.at(x, y)
            if first != self.done[tile]:
                raise SystemExit(f"tile {tile} got sample {first} after {self.done[tile]} samples")
            if first == 0:
                sampled.append(tile)
                if foreseen:
                    run.foreseen.add(tile)
            (shows if shown else keeps).append((tile, first + count))
            self.done[tile] = first + count
        self.paths += line["paths"]
        run.steps.append(Step(self.paths, line["seconds"] - run.start, sampled, shows, keeps))


def read_log(path, samples, pictures):
    """The runs of a recording of `pictures` pictures, each converged at `samples` samples."""
    reader = _Reader(samples)
    with open(path) as file:
        for text in file:
            line = json.loads(text)
            getattr(reader, line["event"])(line)
    if len(reader.runs) != pictures or not (reader.done >= samples).all():
        raise SystemExit(f"{path}: {len(reader.runs)} runs for {pictures} pictures; an edit changed nothing, or the "
                         "recording was cut short")
    return reader.runs
