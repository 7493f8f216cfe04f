"""Which OpenUSD is used, and what it can do."""

import json
import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Optional

from . import openusd, packages, paths
from .errors import HiprError

OLDEST = (20, 8)


@dataclass(frozen=True)
class Sdk:
    """An OpenUSD installation."""
    root: Path
    version: str   # such as "20.08"
    ours: bool     # made by set-up, as opposed to named by the user

    @property
    def library_dir(self) -> Path:
        return self.root / "lib"

    @property
    def python_dir(self) -> Path:
        return self.root / "lib" / "python"

    def tool(self, name: str) -> Path:
        """One of OpenUSD's programs; raises HiprError if this installation lacks it."""
        path = self.root / "bin" / name
        if not path.exists():
            raise HiprError(f"The OpenUSD in {self.root} has no {name}.",
                            "Build OpenUSD with its tools, or use set-up's own: ./hipr setup --usd default --full")
        return path


def installed_version(root: Path) -> str:
    """The version of the OpenUSD in a folder. Raises HiprError if there is none, or if it is too old."""
    header = root / "include" / "pxr" / "pxr.h"
    try:
        text = header.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise HiprError(f"{root} is not an OpenUSD installation: {header} cannot be read ({error.strerror}).",
                        "--usd and pxr_ROOT name the folder that holds include/, lib/ and pxrConfig.cmake.") from error
    parts = [re.search(rf"#define PXR_{name}_VERSION (\d+)", text) for name in ("MINOR", "PATCH")]
    if not all(parts):
        raise HiprError(f"{header} names no version.")
    minor, patch = (int(part.group(1)) for part in parts)
    if (minor, patch) < OLDEST:
        raise HiprError(f"{root} holds OpenUSD {minor}.{patch:02d}; hdHipr needs {OLDEST[0]}.{OLDEST[1]:02d} or later.")
    return f"{minor}.{patch:02d}"


def named_by_user(argument: Optional[str]) -> Optional[Path]:
    """The installation that the user chose: --usd, else pxr_ROOT, else what `setup --usd` remembered."""
    choice = argument or os.environ.get("pxr_ROOT") or remembered()
    if not choice or choice == "default":
        return None
    return Path(choice).expanduser().resolve()


def remembered() -> Optional[str]:
    """What `setup --usd` stored for this checkout."""
    try:
        return json.loads(paths.SETTINGS.read_text(encoding="utf-8")).get("usd")
    except (OSError, ValueError):
        return None


def remember(choice: str) -> None:
    """Stores the choice of `setup --usd` for this checkout; 'default' forgets it."""
    if choice == "default":
        paths.SETTINGS.unlink(missing_ok=True)
    else:
        openusd.write_json(paths.SETTINGS, {"usd": str(Path(choice).expanduser().resolve())})


def find(argument: Optional[str]) -> Optional[Sdk]:
    """The OpenUSD to use if it is there already: one file is read. None if set-up must build it first."""
    chosen = named_by_user(argument)
    if chosen:
        return Sdk(chosen, installed_version(chosen), ours=False)
    root = openusd.prefix()
    return Sdk(root, openusd.recipe.VERSION, ours=True) if openusd.has(openusd.CORE, root) else None


def ensure(argument: Optional[str], stage: str, group: str, *, jobs: int = 0, install_packages: bool = True) -> Sdk:
    """The OpenUSD to use, with a group of packages installed and built up to a stage if need be."""
    packages.ensure(group, paths.log("packages"), allowed=install_packages)
    chosen = named_by_user(argument)
    if chosen:
        return Sdk(chosen, installed_version(chosen), ours=False)
    return Sdk(openusd.Builder(jobs).ensure(stage), openusd.recipe.VERSION, ours=True)
