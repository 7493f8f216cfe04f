"""Open Image Denoise for the AOV `denoised`. Debian 12 has no package of it; PyPI has a wheel with its libraries."""

import ctypes.util
import os
import shutil
import tempfile
import zipfile
from pathlib import Path

from . import paths
from .console import run, say
from .errors import HiprError

VARIABLE = "HIPR_OIDN_LIBRARY"  # where hdHipr looks for the library
WHEEL = ("pyoidn", "2.5.1.0")
WHEEL_SHA256 = "32ad13368f8de1ef63001942ad05b02a00cd732d1206d97f352d3a3f606d823e"
LIBRARY = "libOpenImageDenoise.so.2"
# What denoising on the processor needs, of 170 MB.
WANTED = (LIBRARY, "libOpenImageDenoise_core.so.", "libOpenImageDenoise_device_cpu.so.", "libtbb.so.12")


def folder() -> Path:
    """Where set-up puts it. The libraries look for each other in a `lib` beside themselves."""
    return paths.home() / f"oidn-{WHEEL[1]}" / "lib"


def present() -> bool:
    """Whether hdHipr can find it: set-up's own, one that the user names, or one of the system."""
    return (folder() / LIBRARY).exists() or bool(os.environ.get(VARIABLE)) or system_has_it()


def system_has_it() -> bool:
    """Whether the loader knows version 2."""
    return ctypes.util.find_library("OpenImageDenoise") == LIBRARY


def ensure() -> None:
    """Fetches what is missing. Without the network there is one message, and the rest goes on."""
    if present():
        return
    say("Fetching Open Image Denoise (87 MB) with pip")
    try:
        _fetch()
    except HiprError:
        say(f"Open Image Denoise could not be fetched; its tests are skipped. Log: {paths.log('oidn')}")


def _fetch() -> None:
    paths.home().mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="oidn-", dir=paths.home()) as scratch:
        work = Path(scratch)
        requirements = work / "requirements.txt"
        requirements.write_text(f"{WHEEL[0]}=={WHEEL[1]} --hash=sha256:{WHEEL_SHA256}\n")
        run("Fetching Open Image Denoise",
            ["/usr/bin/python3", "-m", "pip", "download", "--quiet", "--no-deps", "--require-hashes", "--retries", "1",
             "--only-binary=:all:", "--dest", work, "-r", requirements], paths.log("oidn"))
        unpack(next(work.glob("*.whl")), work / "oidn" / "lib")
        shutil.rmtree(folder().parent, ignore_errors=True)
        (work / "oidn").rename(folder().parent)


def unpack(wheel: Path, target: Path) -> None:
    """Unpacks the wanted libraries of the wheel into a folder."""
    target.mkdir(parents=True)
    with zipfile.ZipFile(wheel) as archive:
        for name in archive.namelist():
            file = name.rpartition("/")[2]
            exact = file in WANTED
            versioned = any(part.endswith("so.") and file.startswith(part) for part in WANTED)
            if "/lib/" in name and (exact or versioned):
                (target / file).write_bytes(archive.read(name))
