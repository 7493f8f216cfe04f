"""Runs the tools of an OpenUSD install on a machine without a display."""

import os
import shutil
import subprocess
import sys
import tempfile

SKIP = 77  # ctest's SKIP_RETURN_CODE of these tests
HERE = os.path.dirname(os.path.abspath(__file__))
SCENE = os.path.join(HERE, "scenes", "squares.usda")
RENDERER = os.environ.get("HIPR_TEST_RENDERER", "HiPR")


def skip(reason):
    print("skipped: " + reason)
    sys.exit(SKIP)


def require(tool):
    """Path of a tool of the install; ends the test as skipped when it cannot run here."""
    prefix = os.environ.get("HIPR_USD_PREFIX", "")
    path = os.path.join(prefix, "bin", tool)
    if not os.path.exists(path):
        skip("%s has no %s" % (prefix or "HIPR_USD_PREFIX", tool))
    if not os.path.isdir(os.path.join(prefix, "lib", "python", "pxr")):
        skip("%s was built without Python" % prefix)
    if not shutil.which("xvfb-run"):
        skip("xvfb-run is not installed")
    try:
        import OpenGL  # noqa: F401
        import PySide2.QtOpenGL  # noqa: F401
    except ImportError as error:
        skip("Python lacks a module: %s" % error)
    return path


def run(arguments, timeout=850):
    """Runs a Python tool below a virtual display; returns its exit code and everything it printed."""
    prefix = os.environ["HIPR_USD_PREFIX"]
    environment = dict(os.environ)
    environment["PYTHONPATH"] = os.pathsep.join([os.path.join(prefix, "lib", "python"), HERE])
    environment["LIBGL_ALWAYS_SOFTWARE"] = "1"
    environment["PXR_USDVIEW_SUPPRESS_STATE_SAVING"] = "1"
    environment["QT_QPA_PLATFORM"] = "xcb"
    command = ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24", sys.executable] + arguments
    with tempfile.TemporaryFile("w+") as output:
        process = subprocess.run(command, env=environment, stdout=output, stderr=subprocess.STDOUT,
                                 stdin=subprocess.DEVNULL, timeout=timeout)
        output.seek(0)
        return process.returncode, output.read()


def colour_name(r, g, b):
    """'red', 'green' or 'blue' for saturated 8-bit colours, 'grey' for equal parts, else 'mixed'."""
    strongest = max(r, g, b)
    if strongest - min(r, g, b) < 12:
        return "grey"
    if strongest < 150 or sorted((r, g, b))[1] > 80:
        return "mixed"
    return {r: "red", g: "green", b: "blue"}[strongest]
