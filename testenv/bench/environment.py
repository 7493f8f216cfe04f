"""Virtual environments for what benches need from PyPI."""

import os
import subprocess
import sys
from pathlib import Path


def python_with(folder, packages, environment=None):
    """The interpreter of the virtual environment in `folder`, which is made when missing."""
    python = folder / "bin" / "python"
    if not (folder / "complete").exists():
        print(f"Installing {', '.join(packages)} into {folder}", file=sys.stderr)
        subprocess.run(["/usr/bin/python3", "-m", "venv", folder], check=True)
        subprocess.run([python, "-m", "pip", "install", "-q", *packages], check=True, env=environment)
        (folder / "complete").touch()
    return python


def enter_environment(folder, packages):
    """Goes on with this program in the virtual environment in `folder`."""
    if Path(sys.prefix).resolve() != folder.resolve():
        python = python_with(folder, packages)
        os.execv(python, [str(python), *sys.argv])
