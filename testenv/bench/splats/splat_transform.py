"""splat-transform (PlayCanvas, MIT): draws 3DGS captures with a tiled compute renderer through WebGPU, from npm."""

import os
import platform
import shutil
import subprocess
import time
from pathlib import Path

NODE = 22  # it wants this one or newer
PACKAGES = ["@playcanvas/splat-transform@3.7.0", "playcanvas@2"]
CAMERA = ["--camera-pos", "0,1.1,2.6", "--camera-target", "0,0.5,0", "--camera-fov", "60", "--camera-near", "0.2"]


def node_package():
    """npm's package with the program node for this machine. `node` itself would fetch that by an install script."""
    machine = {"x86_64": "x64", "aarch64": "arm64"}.get(platform.machine(), platform.machine())
    return f"node-{platform.system().lower()}-{machine}@{NODE}"


def install(folder):
    """Installs it into `folder` unless it is there; no script of any package is run."""
    stamp = folder / "complete"
    wanted = "\n".join([node_package(), *PACKAGES])
    if stamp.exists() and stamp.read_text() == wanted:
        return
    if not shutil.which("npm"):
        raise SystemExit("npm is needed to get splat-transform: apt install npm. Without it: --only modes")
    print(f"Installing {', '.join(PACKAGES)} into {folder}", flush=True)
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run(["npm", "install", "--prefix", folder, "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error",
                    node_package(), *PACKAGES], check=True)
    stamp.write_text(wanted)


class SplatTransform:
    """One capture, one size. A run starts a process, so frames are timed by the difference of two runs that draw the same
    picture once and several times (as samples of a motion without movement)."""

    def __init__(self, folder, capture, size, log):
        install(folder)
        modules = folder / "node_modules"
        node = modules / node_package().split("@")[0] / "bin/node"
        self.program = [node, modules / "@playcanvas/splat-transform/bin/cli.mjs"]
        self.capture, self.size, self.log = capture, size, log
        self.environment = dict(os.environ)
        for name in ("LD_LIBRARY_PATH", "PYTHONPATH"):
            self.environment.pop(name, None)

    def devices(self):
        """What it says of the device it draws with, usually the first."""
        output = subprocess.run([*self.program, "--list-gpus"], env=self.environment, capture_output=True, text=True).stdout
        return next((line.strip() for line in output.splitlines() if line.startswith("[0]")), "no device")

    def run(self, frames, picture):
        """(seconds, processor seconds) of drawing `frames` times, start and end included."""
        command = [*self.program, "-w", "-q", "--no-tty", self.capture, *CAMERA, "--camera-pos-end", CAMERA[1],
                   "--resolution", "x".join(map(str, self.size)), "--motion-samples", str(frames), "--webp-effort", "0", picture]
        begin = time.monotonic()
        with open(self.log, "w") as log:
            child = subprocess.Popen(list(map(str, command)), env=self.environment, stdout=log, stderr=log)
            _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.monotonic() - begin
        if child.returncode or not Path(picture).exists():
            raise SystemExit(f"splat-transform failed:\n{Path(self.log).read_text()[-2000:]}")
        return seconds, usage.ru_utime + usage.ru_stime

    def frame(self, picture, frames=9):
        """(seconds, processor seconds) a frame."""
        one, many = self.run(1, picture), self.run(frames, picture)
        return tuple((m - o) / (frames - 1) for o, m in zip(one, many))
