"""What is built when set-up builds OpenUSD: versions, checksums, options. Data only; openusd.py acts on it."""

import hashlib
from pathlib import Path

from . import openusd_patches

VERSION = "20.08"
FOLDER = Path(__file__).resolve().parent / "openusd"

CRATE = ("usd-cpp", "0.1.1")
CRATE_SHA256 = "1f3194acfd59968ff88c03f6552196c74a7ade9e4f5582b00fae3a14e4ce4519"
CRATE_SOURCE = "thirdparty/USD"  # where OpenUSD lies inside the crate

# TBB 2020: the last release with the tbb::task interface that OpenUSD 20.08 is written against.
TBB_VERSION = "2020.0.133"
TBB_SHA256 = {
    "tbb": "0e7b232098cc9a7bf86b08beb21ecbc5be2ba21d2e6f0d1ac6d2917e614335dc",
    "tbb-devel": "1761afdd946982cfab1ca5bd3a3cb4ad4e9fbf8623aef58e108d04c55d842298",
}

# What rendering through Hydra needs; everything else is the `full` stage.
CORE_LIBRARIES = (
    "arch", "tf", "gf", "js", "trace", "work", "plug", "vt",
    "ar", "kind", "sdf", "ndr", "sdr", "pcp", "usd",
    "usdGeom", "usdVol", "usdLux", "usdMedia", "usdShade", "usdRender", "usdHydra", "usdRi", "usdSkel", "usdUI",
    "usdUtils",
    "hf", "hio", "cameraUtil", "pxOsd", "hd",
    "usdImaging", "usdSkelImaging", "usdVolImaging", "usdRiImaging",
    "usdShaders", "sdrGlslfx",
)

# Clang parses this code base a third faster than GCC, and its precompiled headers keep template instantiations.
COMPILERS = ("clang-14", "clang++-14")
LINKER_FLAG = "-fuse-ld=mold"

CMAKE_OPTIONS = {
    "CMAKE_BUILD_TYPE": "Release",
    "CMAKE_CXX_FLAGS": "-w",  # an old code base and a new compiler: hundreds of warnings nobody here can act on
    "CMAKE_CXX_FLAGS_RELEASE": "-O2 -DNDEBUG",
    "CMAKE_C_COMPILER": COMPILERS[0],
    "CMAKE_CXX_COMPILER": COMPILERS[1],
    "CMAKE_SHARED_LINKER_FLAGS": LINKER_FLAG,
    "CMAKE_MODULE_LINKER_FLAGS": LINKER_FLAG,
    "CMAKE_EXE_LINKER_FLAGS": LINKER_FLAG,
    "CMAKE_SUPPRESS_DEVELOPER_WARNINGS": "ON",
    "CMAKE_WARN_DEPRECATED": "OFF",
    "PXR_USE_PYTHON_3": "ON",
    "PYTHON_EXECUTABLE": "/usr/bin/python3",
    "PXR_BUILD_TESTS": "OFF",
    "PXR_BUILD_EXAMPLES": "OFF",
    "PXR_BUILD_TUTORIALS": "OFF",
    "PXR_ENABLE_PTEX_SUPPORT": "OFF",
    "HIPR_CORE_LIBRARIES": ";".join(CORE_LIBRARIES),
}


def _code_lines(path: Path) -> str:
    """The lines of a CMake file, header or script that are more than a comment: only those change a build."""
    lines = (line.strip() for line in path.read_text(encoding="utf-8").splitlines())
    return "\n".join(line for line in lines
                     if line and not line.startswith(("//", "# ")))


def digest() -> str:
    """A short name for exactly this recipe: two recipes with one digest build the same thing."""
    parts = [VERSION, CRATE_SHA256, repr(sorted(TBB_SHA256.items())), repr(sorted(CMAKE_OPTIONS.items()))]
    parts += [repr((patch.file, patch.old, patch.new)) for patch in openusd_patches.PATCHES]
    parts += [f"{path.name}\n{_code_lines(path)}" for path in sorted(FOLDER.iterdir())]
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:12]
