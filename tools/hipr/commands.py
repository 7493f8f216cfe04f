"""What each command does. Every function takes the parsed options and returns an exit status (None is 0)."""

import os
import shlex
import shutil
import sys
from pathlib import Path
from typing import Iterator, List, Tuple

from . import ctest, environment, oidn, openusd, packages, paths, sdk as sdks
from .console import Timing, duration, say
from .errors import HiprError
from .project import Project
from .sdk import Sdk

RENDERER = "HiPR"  # the name in the plugin's plugInfo.json


def setup(options) -> None:
    if options.usd:
        if options.usd != "default":
            sdks.installed_version(Path(options.usd).expanduser())
        sdks.remember(options.usd)
    if options.import_:
        openusd.import_archive(Path(options.import_).expanduser())
    stage = openusd.FULL if options.full else openusd.CORE
    timing = Timing()
    group = packages.FULL if options.full else packages.RENDER
    sdk = sdks.ensure(options.usd, stage, group, jobs=options.jobs, install_packages=not options.no_packages)
    if options.full:
        oidn.ensure()
    say(f"Ready in {duration(timing.wall)}: OpenUSD {sdk.version} in {sdk.root}")
    if options.export:
        if not sdk.ours:
            raise HiprError("--export saves the OpenUSD that set-up built, and this is your own.")
        openusd.export_archive(Path(options.export).expanduser())


def build(options) -> None:
    _built(options, openusd.CORE, tests=True)
    say(f"hdHipr is in {paths.BUILD}.")


def render(options) -> int:
    sdk, project = _built(options, openusd.CORE)
    if "--denoise" in options.arguments:
        oidn.ensure()
    return _replace(project.program("hiprrecord"), options.arguments, sdk)


def convert(options) -> int:
    sdk, project = _built(options, openusd.CORE)
    return _replace(project.program("hiprconvert"), options.arguments, sdk)


def usdview(options) -> int:
    sdk, _ = _built(options, openusd.FULL)
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise HiprError("usdview needs a display, and neither DISPLAY nor WAYLAND_DISPLAY is set.",
                        "To render without one: ./hipr render SCENE -o PICTURE")
    return _replace(sdk.tool("usdview"), _with_renderer(options.arguments), sdk, python=sdk.ours)


def usdrecord(options) -> int:
    sdk, _ = _built(options, openusd.FULL)
    return _replace(sdk.tool("usdrecord"), _with_renderer(options.arguments), sdk, python=sdk.ours,
                    display=not os.environ.get("DISPLAY"))


def test(options) -> int:
    timing = Timing()
    sdk, project = _built(options, openusd.FULL, tests=True)
    oidn.ensure()
    say(f"Set-up and build took {duration(timing.wall)}. Running the tests")
    selection: List[str] = []
    if options.regex:
        selection += ["-R", options.regex]
    if options.label:
        selection += ["-L", options.label]
    return ctest.run(project.build, environment.extended(sdk), selection)


def bench(options) -> int:
    what, *arguments = options.arguments or [""]
    scripts = {"cycles": ("compare_cycles.py", "--record", "hiprrecord"),
               "edits": ("edits/bench_edits.py", "--record", "hiprrecord"),
               "lights": ("compare_lights.py", "--record", "hiprrecord"),
               "splats": ("splats/bench_splats.py", "--bench", "hipr-bench-splats")}
    if what != "trace" and what not in scripts:
        raise HiprError(f"there is no benchmark '{what}'." if what else "which benchmark?",
                        "Say trace, cycles, edits, lights or splats.")
    sdk, project = _built(options, openusd.CORE, tests=what not in ("edits", "lights"))
    if what == "trace":
        return _replace(project.program("hipr-bench"), ["trace", *arguments], sdk)
    script, option, program = scripts[what]
    return _replace(paths.CHECKOUT / "testenv/bench" / script, [option, str(project.program(program)), *arguments], sdk,
                    python=True)


def devices(options) -> int:
    sdk, project = _built(options, openusd.CORE)
    return _replace(project.program("hiprdevices"), [], sdk)


def env(options) -> None:
    sdk = sdks.find(options.usd)
    if sdk is None:
        raise HiprError("OpenUSD is not built yet, so there is no environment to print.", "Run ./hipr setup first.")
    for name, value in _environment_lines(sdk):
        print(f"export {name}={value}")


def clean(options) -> None:
    targets = [paths.BUILD]
    if options.all:
        home = paths.home()
        targets += [home / "work", *home.glob(f"openusd-{openusd.recipe.VERSION}-*")]
    for target in targets:
        if target.exists():
            say(f"Deleting {target}")
            shutil.rmtree(target)


# --- shared -----------------------------------------------------------------------------------------------------------

def _built(options, stage: str, *, tests: bool = False) -> Tuple[Sdk, Project]:
    """The OpenUSD and the build, brought up to date. The quick way, when all is there, reads a few stamps."""
    group = packages.FULL if tests or stage == openusd.FULL else packages.RENDER
    sdk = sdks.find(options.usd)
    if sdk is None or (sdk.ours and not openusd.has(stage, sdk.root)) or not _packages_known(group):
        sdk = sdks.ensure(options.usd, stage, group, jobs=options.jobs, install_packages=not options.no_packages)
        _remember_packages(group)
    project = Project(sdk, options.jobs)
    project.ensure(tests=tests)
    return sdk, project


def _packages_stamp() -> dict:
    """What the answer of dpkg depends on."""
    try:
        changed = Path("/var/lib/dpkg/status").stat().st_mtime_ns
    except OSError:
        changed = 0
    return {"dpkg": changed, "wanted": [f"{package.name} {package.minimum}" for package in packages.PACKAGES]}


def _packages_known(group: str) -> bool:
    return openusd.read_json(paths.home() / f"packages-{group}.json") == _packages_stamp()


def _remember_packages(group: str) -> None:
    openusd.write_json(paths.home() / f"packages-{group}.json", _packages_stamp())


def _with_renderer(arguments: List[str]) -> List[str]:
    """usdview's and usdrecord's arguments with HiPR as the renderer, unless they name one."""
    named = any(argument in ("--renderer", "-r") or argument.startswith("--renderer=") for argument in arguments)
    return arguments if named else ["--renderer", RENDERER, *arguments]


def _environment_lines(sdk: Sdk) -> Iterator[Tuple[str, str]]:
    for name, folders in environment.additions(sdk).items():
        value = os.pathsep.join(shlex.quote(str(folder)) for folder in folders)
        yield name, f"{value}${{{name}:+:${name}}}"
    for name, value in environment.settings().items():
        yield name, f"${{{name}:-{shlex.quote(str(value))}}}"


def _replace(program: Path, arguments: List[str], sdk: Sdk, *, python: bool = False, display: bool = False) -> int:
    """Becomes the program, in the environment in which it finds everything."""
    command = [str(program), *arguments]
    if python:  # not whatever `python3` comes first on PATH: OpenUSD's modules are built for Debian's
        command.insert(0, "/usr/bin/python3")
    if display:
        command = ["xvfb-run", "-a", *command]
    sys.stdout.flush()
    try:
        os.execvpe(command[0], command, environment.extended(sdk))
    except OSError as error:
        raise HiprError(f"{command[0]} cannot be run: {error.strerror}.") from error
