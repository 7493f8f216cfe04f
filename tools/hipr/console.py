"""What set-up shows and records: steps, a progress line, the log file, and the time each step takes."""

import os
import resource
import shlex
import subprocess
import sys
import time
from collections import deque
from pathlib import Path
from typing import Callable, Iterable, Optional

from .errors import HiprError, hint_for

LineReader = Callable[[str], Optional[str]]


def say(text: str) -> None:
    """One line for the user."""
    print(f"hipr: {text}", flush=True)


def duration(seconds: float) -> str:
    """Seconds as people say them: '8 s', '3 min 20 s', '1 h 05 min'."""
    seconds = int(round(seconds))
    if seconds < 60:
        return f"{seconds} s"
    if seconds < 3600:
        return f"{seconds // 60} min {seconds % 60:02d} s"
    return f"{seconds // 3600} h {seconds % 3600 // 60:02d} min"


class Timing:
    """Wall and CPU time of a step, children included; what docs/measurements.md is filled from."""

    def __init__(self) -> None:
        self._wall = time.monotonic()
        self._cpu = self._cpu_now()

    @staticmethod
    def _cpu_now() -> float:
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    @property
    def wall(self) -> float:
        """Seconds since the start."""
        return time.monotonic() - self._wall

    @property
    def cpu(self) -> float:
        """Seconds of CPU time that finished child processes have used since the start."""
        return self._cpu_now() - self._cpu


class StatusLine:
    """A line that overwrites itself on a terminal, and appears now and then elsewhere (a CI's log)."""

    QUIET_INTERVAL = 30.0  # seconds between two lines where nothing can be overwritten

    def __init__(self) -> None:
        self._tty = sys.stdout.isatty()
        self._last = 0.0

    def show(self, text: str) -> None:
        now = time.monotonic()
        if self._tty:
            print(f"\r\033[K  {text}", end="", flush=True)
        elif now - self._last >= self.QUIET_INTERVAL:
            print(f"  {text}", flush=True)
            self._last = now

    def clear(self) -> None:
        if self._tty:
            print("\r\033[K", end="", flush=True)


def run(what: str, command: Iterable[object], log: Path, *, cwd: Optional[Path] = None,
        env: Optional[dict] = None, reader: Optional[LineReader] = None) -> None:
    """Runs a command with its output in the log file, and raises HiprError with the end of it if it fails.

    `reader` sees every line and may return a text for the status line.
    """
    arguments = [str(part) for part in command]
    log.parent.mkdir(parents=True, exist_ok=True)
    tail: deque = deque(maxlen=400)
    status = StatusLine()
    try:
        with log.open("a", encoding="utf-8") as record:
            record.write(f"\n--- {time.strftime('%F %T')} {what}\n$ {shlex.join(arguments)}\n")
            record.flush()
            with subprocess.Popen(arguments, cwd=cwd, env=env, text=True, errors="replace", stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as process:
                try:
                    for line in process.stdout:
                        record.write(line)
                        tail.append(line.rstrip())
                        text = reader(line.rstrip()) if reader else None
                        if text:
                            status.show(text)
                    code = process.wait()
                except BaseException:
                    process.terminate()  # an interrupt: the tool must not go on behind our back
                    raise
    except FileNotFoundError as error:
        raise HiprError(f"{what}: `{arguments[0]}` is not installed.",
                        "`hipr setup` installs what is missing.") from error
    except OSError as error:
        raise HiprError(f"{what}: {error}", hint_for(str(error))) from error
    finally:
        status.clear()
    if code != 0:
        output = "\n".join(tail)
        raise HiprError(f"{what} failed (exit code {code}). The end of {log}:\n\n{_excerpt(tail)}\n", hint_for(output))


def _excerpt(tail: Iterable[str]) -> str:
    """The lines of a failed command that say why: from the first failure on, else the last few."""
    lines = list(tail)
    for index, line in enumerate(lines):
        if line.startswith("FAILED:") or ": error:" in line or ": fatal error:" in line:
            return "\n".join("  " + part[:300] for part in lines[index:index + 12])
    return "\n".join("  " + part[:300] for part in lines[-12:])


def processors() -> int:
    """Processors this process may use."""
    return len(os.sched_getaffinity(0))
