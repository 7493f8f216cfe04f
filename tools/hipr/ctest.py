"""Runs the tests and says clearly how they went."""

import subprocess
import xml.etree.ElementTree as xml
from dataclasses import dataclass, field
from pathlib import Path
from typing import List, Mapping, Sequence

from .console import Timing, duration, say


@dataclass
class Results:
    """What a JUnit file of ctest says."""
    passed: List[str] = field(default_factory=list)
    failed: List[str] = field(default_factory=list)
    skipped: List[str] = field(default_factory=list)


def read_results(path: Path) -> Results:
    """Reads ctest's JUnit file; an absent or broken one means that no test ran."""
    results = Results()
    try:
        cases = xml.parse(path).getroot().iter("testcase")
    except (OSError, xml.ParseError):
        return results
    for case in cases:
        name = case.get("name", "?")
        status = case.get("status", "")
        if case.find("skipped") is not None or status in ("notrun", "disabled", "skipped"):
            results.skipped.append(name)
        elif case.find("failure") is not None or status == "fail":
            results.failed.append(name)
        else:
            results.passed.append(name)
    return results


def summary(results: Results, seconds: float) -> List[str]:
    """The lines shown at the end."""
    lines = [f"{len(results.passed)} passed, {len(results.failed)} failed, {len(results.skipped)} skipped "
             f"in {duration(seconds)}"]
    lines += [f"  skipped: {name}" for name in results.skipped]
    lines += [f"  FAILED:  {name}" for name in results.failed]
    return lines


def run(build: Path, env: Mapping[str, str], options: Sequence[str]) -> int:
    """Runs ctest in a build folder. Returns the exit status: 0 only if tests ran and none failed."""
    junit = build / "test-results.xml"
    junit.unlink(missing_ok=True)
    timing = Timing()
    code = subprocess.run(["ctest", "--test-dir", str(build), "--output-on-failure", "--no-tests=error",
                           "--output-junit", str(junit), *options], env=dict(env), check=False).returncode
    results = read_results(junit)
    for line in summary(results, timing.wall):
        say(line)
    return 1 if code != 0 or results.failed else 0
