"""Where things are."""

import os
from pathlib import Path

CHECKOUT = Path(__file__).resolve().parents[2]
BUILD = CHECKOUT / "build" / "release"
SETTINGS = CHECKOUT / ".hipr.json"  # what `setup --usd` remembers for this checkout


def home() -> Path:
    """The folder for what outlives a checkout: OpenUSD and its build. HIPR_HOME, else the user's cache folder."""
    if os.environ.get("HIPR_HOME"):
        return Path(os.environ["HIPR_HOME"]).expanduser().resolve()
    cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(cache) / "hipr"


def log(name: str) -> Path:
    """The log file of a part of set-up."""
    return home() / "logs" / f"{name}.log"
