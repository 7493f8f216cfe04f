"""Time left of a ninja build, from its output."""

import re
import subprocess
import time
from collections import deque
from pathlib import Path
from typing import Iterable, Optional

from .console import duration

_STEP = re.compile(r"^\[(\d+)/(\d+)\] (.*)")


def weight(description: str) -> float:
    """How long a build step takes, in units of an average compilation."""
    if description.startswith("Building"):
        return 8.0 if "cmake_pch" in description else 1.0
    if description.startswith("Linking"):
        return 0.5
    return 0.01  # copying a header, compiling Python


class NinjaProgress:
    """Reads ninja's lines and tells how far it is. Steps count by weight, or a thousand copied headers would
    make the rest look short."""

    WINDOW = 60  # steps; the speed is that of the recent ones

    def __init__(self, pending: Iterable[str]):
        pending = list(pending)
        self._steps = len(pending)
        self._total = sum(weight(step) for step in pending) or 1.0
        self._done = 0.0
        self._recent: deque = deque(maxlen=self.WINDOW)

    @classmethod
    def of(cls, ninja: str, build: Path, targets: Iterable[str]) -> "NinjaProgress":
        """Asks ninja what is pending."""
        result = subprocess.run([ninja, "-C", str(build), "-n", *targets], capture_output=True, text=True, check=False)
        matches = (_STEP.match(line) for line in result.stdout.splitlines())
        return cls([match.group(3) for match in matches if match])

    @property
    def remaining(self) -> float:
        """Weight of the steps still to do."""
        return max(self._total - self._done, 0.0)

    def seconds_left(self) -> Optional[float]:
        """Estimated from the recent steps; None before there are enough of them."""
        if len(self._recent) < 10:
            return None
        (start, done_then), (end, done_now) = self._recent[0], self._recent[-1]
        if end - start < 2.0 or done_now - done_then < 1.0:
            return None
        return self.remaining * (end - start) / (done_now - done_then)

    def read(self, line: str) -> Optional[str]:
        """Takes in one line; returns the text of the status line, or None if the line is not about a step."""
        match = _STEP.match(line)
        if not match:
            return None
        self._done += weight(match.group(3))
        step, steps = int(match.group(1)), int(match.group(2))
        if steps != self._steps:  # CMake ran again first: the plan that was asked for is not the one that runs
            self._steps = steps
            self._total = self._done + (steps - step)
        self._recent.append((time.monotonic(), self._done))
        left = self.seconds_left()
        percent = min(99, int(100 * self._done / self._total))
        return (f"{percent:2d} %  step {step} of {steps}"
                + (f", about {duration(left)} left" if left is not None else ""))
