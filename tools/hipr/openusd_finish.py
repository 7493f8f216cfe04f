"""What OpenUSD's own installation leaves undone: the last touches on the installed tree."""

import struct
from pathlib import Path

from .console import run


def finish(target: Path, tbb: Path, log: Path) -> None:
    """Completes the full installation in `target`, which was built with the TBB in the folder `tbb`."""
    make_relocatable(target, tbb)
    find_boost(target / "pxrConfig.cmake")
    write_sky(target / "lib/usd/hdx/resources/textures/StinsonBeach.exr")
    # Now and quietly: otherwise every first start is slow, and warns of what newer Pythons think of the old code.
    run("Compiling Python files", ["/usr/bin/python3", "-W", "ignore", "-m", "compileall", "-q",
                                   target / "lib" / "python"], log)


def make_relocatable(target: Path, tbb: Path) -> None:
    """Makes the CMake targets speak of their own prefix, not of the folders they were built in."""
    for path in (target / "cmake").glob("pxrTargets*.cmake"):
        text = path.read_text(encoding="utf-8")
        for folder in (tbb, target):
            text = text.replace(str(folder), "${_IMPORT_PREFIX}")
        path.write_text(text, encoding="utf-8")


BOOST = "find_package(Boost REQUIRED COMPONENTS python)  # the targets below link to Boost::python\n"


def find_boost(config: Path) -> None:
    """Makes OpenUSD's CMake package find the one that its targets name."""
    text = config.read_text(encoding="utf-8")
    if BOOST not in text:
        config.write_text(BOOST + text, encoding="utf-8")


def write_sky(path: Path) -> None:
    """Writes the picture of OpenUSD's default dome light. The crate carries no images, and Hydra's task controller
    reports an error where the file is absent: a white sky takes the place of the photograph."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(white_exr(16, 8))


def white_exr(width: int, height: int) -> bytes:
    """An uncompressed scanline OpenEXR file, RGB half floats, all 1.0 (OpenEXR file layout, version 2)."""
    def attribute(name: str, kind: str, value: bytes) -> bytes:
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value

    half = 1
    channels = b"".join(name + b"\0" + struct.pack("<iBxxxii", half, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = (struct.pack("<2i", 20000630, 2)
              + attribute("channels", "chlist", channels)
              + attribute("compression", "compression", b"\0")
              + attribute("dataWindow", "box2i", window)
              + attribute("displayWindow", "box2i", window)
              + attribute("lineOrder", "lineOrder", b"\0")
              + attribute("pixelAspectRatio", "float", struct.pack("<f", 1.0))
              + attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0.0, 0.0))
              + attribute("screenWindowWidth", "float", struct.pack("<f", 1.0)) + b"\0")
    row = struct.pack("<e", 1.0) * (3 * width)
    size = 8 + len(row)
    first = len(header) + 8 * height
    offsets = b"".join(struct.pack("<Q", first + y * size) for y in range(height))
    return header + offsets + b"".join(struct.pack("<2i", y, len(row)) + row for y in range(height))
