"""The environment in which OpenUSD finds hdHipr, and programs find OpenUSD."""

import os
from pathlib import Path
from typing import Dict, List, Mapping

from . import oidn, paths
from .sdk import Sdk

PLUGINS = Path("plugin") / "usd"  # holds plugInfo.json, which includes those of the plugins below


def additions(sdk: Sdk, build: Path = paths.BUILD) -> Dict[str, List[Path]]:
    """The folders that each variable must begin with."""
    added = {
        "PXR_PLUGINPATH_NAME": [build / PLUGINS],
        "LD_LIBRARY_PATH": [sdk.library_dir],
        "PATH": [build / "bin", sdk.root / "bin"],
    }
    if sdk.python_dir.is_dir():
        added["PYTHONPATH"] = [sdk.python_dir]
    return added


def settings() -> Dict[str, Path]:
    """Variables that name one thing each; a user's own choice stays."""
    library = oidn.folder() / oidn.LIBRARY
    return {oidn.VARIABLE: library} if library.exists() else {}


def extended(sdk: Sdk, base: Mapping[str, str] = os.environ, build: Path = paths.BUILD) -> Dict[str, str]:
    """`base` with the folders in front. Applying it twice changes nothing."""
    env = dict(base)
    for name, folders in additions(sdk, build).items():
        wanted = [str(folder) for folder in folders]
        rest = [part for part in env.get(name, "").split(os.pathsep) if part and part not in wanted]
        env[name] = os.pathsep.join(wanted + rest)
    for name, value in settings().items():
        env[name] = env.get(name) or str(value)
    return env
