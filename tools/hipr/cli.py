"""The command line."""

import argparse
import sys
from typing import List, Optional

from . import commands
from .console import say
from .errors import HiprError

DESCRIPTION = "Sets up, builds, runs and tests hdHipr, a path tracing render delegate for OpenUSD."

EPILOGUE = """\
Every command first does whatever set-up is still missing, says so, and is quick the second time.

examples:
  ./hipr render testenv/scenes/cornell.usda -o out.png    render a scene; the first time this sets everything up
  ./hipr render shot.usdc -o shot.####.exr --frames 1:24 --samples 256 --size 1920x1080
  ./hipr render -- --help                                 all options of the recorder
  ./hipr convert --up -y capture.ply capture.usdc         a capture of Gaussian splats as USD, set upright
  ./hipr test                                             set up, build and run all tests
  ./hipr test -R sampling                                 only tests whose name matches
  ./hipr usdview scene.usda                               OpenUSD's viewer with hdHipr in its viewport
  ./hipr render scene.usda -o out.png --usd /opt/usd-24.11     with an OpenUSD of your own
  eval "$(./hipr env)"; usdview scene.usda                the same environment in your own shell

HIPR_HOME names the folder for OpenUSD and its build (default: ~/.cache/hipr), HIPR_DEVICE the Vulkan device.
"""


def parser() -> argparse.ArgumentParser:
    """The whole command line."""
    common = argparse.ArgumentParser(add_help=False)
    group = common.add_argument_group("set-up")
    group.add_argument("--usd", metavar="DIR", help="use the OpenUSD (20.08 or later) installed in DIR; "
                       "so does the environment variable pxr_ROOT")
    group.add_argument("--jobs", type=_positive, default=0, metavar="N", help="parallel jobs when something is built "
                       "[as many as processors and memory allow]")
    group.add_argument("--no-packages", action="store_true", help="install no Debian packages; say what is missing")

    top = argparse.ArgumentParser(prog="hipr", description=DESCRIPTION, epilog=EPILOGUE,
                                  formatter_class=argparse.RawDescriptionHelpFormatter)
    commands_ = top.add_subparsers(dest="command", metavar="COMMAND", required=True)

    def add(name: str, help_text: str, **keywords) -> argparse.ArgumentParser:
        sub = commands_.add_parser(name, help=help_text, description=help_text[0].upper() + help_text[1:] + ".",
                                   parents=[common], formatter_class=argparse.RawDescriptionHelpFormatter, **keywords)
        sub.set_defaults(run=getattr(commands, name))
        return sub

    sub = add("setup", "install packages and build OpenUSD, as far as missing",
              epilog="--usd is remembered for this checkout; `--usd default` goes back to the one that set-up builds.")
    sub.add_argument("--full", action="store_true", help="also Python, Storm, usdview, usdrecord (the tests need them)")
    sub.add_argument("--export", metavar="FILE", help="save the built OpenUSD as an archive, for a CI to cache")
    sub.add_argument("--import", metavar="FILE", dest="import_", help="restore such an archive instead of building")
    add("build", "build hdHipr and its tests")
    for name, text, tail in (
            ("render", "render a scene with hiprrecord; its options follow", "SCENE -o PICTURE"),
            ("convert", "convert captures of Gaussian splats (.ply, .spz) to USD, and splats to .ply", "IN OUT"),
            ("usdview", "open a scene in usdview with hdHipr selected", "SCENE"),
            ("usdrecord", "record a scene with OpenUSD's usdrecord through hdHipr", "SCENE PICTURE")):
        sub = add(name, text, usage=f"hipr {name} [--usd DIR] [--jobs N] [--no-packages] {tail} [OPTION ...]")
        sub.add_argument("arguments", nargs=argparse.REMAINDER, help=f"{tail} and what else {name} takes")
    sub = add("bench", "measure the renderer, alone, against Cycles, after edits, its lights or splats",
              usage="hipr bench [--usd DIR] [--jobs N] [--no-packages] {trace,cycles,edits,lights,splats} [OPTION ...]",
              epilog="trace: rays and samples per second against bare Embree, builds, start-up, memory.\n"
                     "cycles: samples per second against Blender's Cycles, which comes from PyPI (about 400 MB).\n"
                     "edits: how soon edits show, in HiPR's modes; analysed with packages from PyPI (about 200 MB).\n"
                     "lights: every kind of light against Mitsuba, which comes from PyPI (about 100 MB).\n"
                     "splats: frames of Gaussian splats in all modes, and against splat-transform from npm (about 350 MB).\n"
                     "`hipr bench trace --help` lists their options.")
    sub.add_argument("arguments", nargs=argparse.REMAINDER, help="trace, cycles, edits, lights or splats, and their options")
    sub = add("test", "build everything and run the tests")
    sub.add_argument("-R", dest="regex", metavar="REGEX", help="only tests whose name matches")
    sub.add_argument("-L", "--label", metavar="REGEX", help="only tests with a label that matches: "
                     "unit, render, host, real")
    add("devices", "list the Vulkan devices and what each can do")
    add("env", "print the environment in which any host finds hdHipr")
    sub = add("clean", "delete the build of this checkout")
    sub.add_argument("--all", action="store_true", help="also the OpenUSD that set-up built, and what is left of its build")
    return top


def _positive(text: str) -> int:
    try:
        number = int(text)
    except ValueError:
        number = 0
    if number < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is not a number of 1 or more")
    return number


PASS_THROUGH = ("render", "convert", "usdview", "usdrecord", "bench")


def split(argv: List[str]) -> List[str]:
    """Moves set-up's options of a pass-through command to the front, so that they may stand anywhere, and the rest
    behind `--`, so that the recorder's options are not taken for ours."""
    if not argv or argv[0] not in PASS_THROUGH or argv[1:] in (["-h"], ["--help"]):
        return argv
    ours, theirs = [], []
    rest = iter(argv[1:])
    for argument in rest:
        if argument == "--":
            theirs += list(rest)
        elif argument in ("--usd", "--jobs"):
            ours += [argument, *([value] if (value := next(rest, None)) is not None else [])]
        elif argument == "--no-packages" or argument.startswith(("--usd=", "--jobs=")):
            ours.append(argument)
        else:
            theirs.append(argument)
    return [argv[0], *ours, "--", *theirs]


def main(argv: Optional[List[str]] = None) -> int:
    """Runs one command. Returns the exit status."""
    options = parser().parse_args(split(sys.argv[1:] if argv is None else argv))
    if getattr(options, "arguments", None) and options.arguments[0] == "--":
        del options.arguments[0]
    try:
        return options.run(options) or 0
    except HiprError as error:
        print(f"hipr: {error}", file=sys.stderr)
        if error.hint:
            print(f"hipr: {error.hint}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print(file=sys.stderr)
        say("Interrupted. The same command continues where this one stopped.")
        return 130
