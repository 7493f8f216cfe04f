"""Builds hdHipr itself, and knows without asking CMake or ninja when there is nothing to build."""

import hashlib
import os
import shutil
from pathlib import Path
from typing import Iterable, List, Optional

from . import openusd, paths
from .console import Timing, duration, run, say
from .errors import HiprError
from .progress import NinjaProgress
from .sdk import Sdk

RENDER_TARGETS = ("hiprrecord", "hdHipr", "hiprdevices", "usdSplat", "hiprconvert")
SOURCE_FOLDERS = ("cmake", "plugin", "renderer", "schemas", "shaders")
TEST_FOLDERS = ("testenv",)
TOP_FILES = ("CMakeLists.txt", "CMakePresets.json")


def fingerprint(root: Path, folders: Iterable[str]) -> str:
    """A digest of the names, sizes and times of all sources; a few milliseconds."""
    digest = hashlib.sha256()
    for name in TOP_FILES:
        _add(digest, root / name)
    for folder in folders:
        for parent, names, files in os.walk(root / folder):
            names[:] = sorted(name for name in names if not name.startswith((".", "__pycache__")))
            for name in sorted(files):
                _add(digest, Path(parent, name))
    return digest.hexdigest()


def _add(digest, path: Path) -> None:
    try:
        status = path.stat()
    except OSError:
        return  # an editor's lock or a dangling link; a real source that is gone changes the digest by its absence
    digest.update(f"{path}\0{status.st_size}\0{status.st_mtime_ns}\n".encode())


class Project:
    """The release build of this checkout against one OpenUSD."""

    def __init__(self, sdk: Sdk, jobs: int = 0, root: Path = paths.CHECKOUT, build: Path = paths.BUILD):
        self.sdk = sdk
        self.root = root
        self.build = build
        self.jobs = jobs or openusd.default_jobs()
        self.log = build / "hipr.log"

    def ensure(self, *, tests: bool = False) -> None:
        """Configures and builds what changed: hiprrecord and the plugin, or everything with the tests."""
        scope = "all" if tests else "render"
        folders = SOURCE_FOLDERS + (TEST_FOLDERS if tests else ())
        state = {"sources": fingerprint(self.root, folders), "usd": str(self.sdk.root), "version": self.sdk.version,
                 "tests": tests}
        if openusd.read_json(self._stamp(scope)) == state and self._outputs_exist():
            return
        self.build.mkdir(parents=True, exist_ok=True)
        with openusd.locked(self.build / "hipr.lock", "Another build of this checkout is running; waiting for it"):
            self._build(scope, state)

    def _build(self, scope: str, state: dict) -> None:
        tests = state["tests"]
        timing = Timing()
        if self._must_configure(tests):
            self._configure(tests)
        targets: List[str] = [] if tests else list(RENDER_TARGETS)
        progress = NinjaProgress.of("ninja", self.build, targets)
        if progress.remaining > 1.0:
            say(f"Building hdHipr{' and its tests' if tests else ''} with {self.jobs} jobs. Log: {self.log}")
        run("Building hdHipr", ["ninja", "-C", self.build, "-j", self.jobs, *targets], self.log, reader=progress.read)
        openusd.write_json(self._stamp(scope), state)
        if timing.wall > 2.0:
            say(f"hdHipr is built ({duration(timing.wall)}).")

    def program(self, name: str) -> Path:
        """A program of the build; raises HiprError if it is not there."""
        path = self.build / "bin" / name
        if not path.exists():
            raise HiprError(f"{path} is not there.", "Build it with ./hipr build.")
        return path

    def _stamp(self, scope: str) -> Path:
        return self.build / f"hipr-{scope}.json"

    def _outputs_exist(self) -> bool:
        return (self.build / "bin" / "hiprrecord").exists() and (self.build / "plugin/usd/hdHipr.so").exists()

    def _configured(self) -> Optional[dict]:
        return openusd.read_json(self.build / "hipr-configured.json")

    def _must_configure(self, tests: bool) -> bool:
        done = self._configured()
        if done is None or not (self.build / "build.ninja").exists():
            return True
        return done["usd"] != str(self.sdk.root) or done["stage"] != self._stage() or (tests and not done["tests"])

    def _stage(self) -> str:
        """What the OpenUSD has to link against; more of it after the second stage."""
        return openusd.FULL if (self.sdk.root / "pxrConfig.cmake").exists() else openusd.CORE

    def _configure(self, tests: bool) -> None:
        if not shutil.which("cmake"):
            raise HiprError("cmake is not installed.", "./hipr setup installs what is missing.")
        done = self._configured() or {}
        if done and done.get("usd") != str(self.sdk.root):
            (self.build / "CMakeCache.txt").unlink(missing_ok=True)  # it remembers libraries of the other OpenUSD
        tests = tests or bool(done.get("tests"))
        say(f"Configuring hdHipr for OpenUSD {self.sdk.version} in {self.sdk.root}")
        run("Configuring hdHipr",
            ["cmake", "--preset", "release", "-B", self.build, f"-Dpxr_ROOT={self.sdk.root}", "-DHIPR_BUILD_PLUGIN=ON",
             f"-DHIPR_BUILD_TESTS={'ON' if tests else 'OFF'}"], self.log, cwd=self.root)
        openusd.write_json(self.build / "hipr-configured.json",
                           {"usd": str(self.sdk.root), "stage": self._stage(), "tests": tests})
