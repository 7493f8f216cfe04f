"""Builds OpenUSD from the registries, in two stages, resumable at any point.

The build tree is HIPR_HOME/work/openusd-20.08, the result HIPR_HOME/openusd-20.08-<digest of the recipe>.  Every
step leaves a stamp that names its inputs; a step whose stamp fits is skipped, and ninja resumes inside the long one.
"""

import contextlib
import fcntl
import hashlib
import json
import os
import platform
import shutil
import stat
import tarfile
import time
import zipfile
from pathlib import Path
from typing import Iterator, List

from . import openusd_finish, openusd_patches, openusd_recipe as recipe, paths
from .console import Timing, duration, processors, run, say
from .errors import HiprError
from .progress import NinjaProgress

CORE = "core"
FULL = "full"

# CPU minutes on one core of a 2-core cloud machine; only for what is said before a stage starts.
CPU_MINUTES = {CORE: 18.0, FULL: 18.0}
DISK_NEEDED = 3 << 30   # bytes, sources and objects of both stages and the result
JOB_MEMORY = 1_200_000  # KiB that one compilation may take


def prefix() -> Path:
    """Where this recipe's OpenUSD lies, built or not."""
    return paths.home() / f"openusd-{recipe.VERSION}-{recipe.digest()}"


def stamp(stage: str, root: Path) -> Path:
    """The file that says that a stage is complete."""
    return root / "share" / "hipr" / f"{stage}.json"


def has(stage: str, root: Path) -> bool:
    """Whether a stage is complete in a folder that set-up made."""
    return stamp(stage, root).exists()


class Builder:
    """Brings the OpenUSD of this recipe to a stage."""

    def __init__(self, jobs: int = 0):
        self.work = paths.home() / "work" / f"openusd-{recipe.VERSION}"
        self.log = paths.log("openusd")
        self.jobs = jobs or default_jobs()

    def ensure(self, stage: str) -> Path:
        """Does what is missing. Returns the prefix."""
        target = prefix()
        if has(stage, target):
            return target
        with locked(self.work.parent / "lock", "Another set-up is running; waiting for it"):
            if not has(CORE, target):
                self._stage(CORE)
            if stage == FULL and not has(FULL, target):
                self._stage(FULL)
        return target

    def _stage(self, stage: str) -> None:
        check_platform()
        self.work.mkdir(parents=True, exist_ok=True)
        check_disk(self.work)
        what = {CORE: "the libraries that rendering needs", FULL: "Python, Storm, usdview and usdrecord"}[stage]
        minutes = CPU_MINUTES[stage] / min(self.jobs, processors())
        say(f"Building OpenUSD {recipe.VERSION} with {self.jobs} jobs: {what}. This takes about "
            f"{duration(60 * minutes)}; Ctrl-C is safe, the same command continues. Log: {self.log}")
        timing = Timing()
        self._fetch_source()
        self._fetch_tbb()
        self._configure()
        self._ninja(list(recipe.CORE_LIBRARIES) if stage == CORE else ["all"])
        self._install(stage)
        record = {"stage": stage, "recipe": recipe.digest(), "jobs": self.jobs, "finished": time.strftime("%F %T"),
                  "wall_seconds": round(timing.wall), "cpu_seconds": round(timing.cpu)}
        write_json(stamp(stage, prefix()), record)
        say(f"OpenUSD {recipe.VERSION} ({stage}) is ready after {duration(timing.wall)} "
            f"({duration(timing.cpu)} of CPU time): {prefix()}")
        if stage == FULL:
            shutil.rmtree(self.work, ignore_errors=True)  # 2 GB that nothing needs any more

    # --- sources ----------------------------------------------------------------------------------------------------

    def _fetch_source(self) -> None:
        """Fetches the crate with cargo, checks it, unpacks and patches it."""
        source = self.work / "source"
        inputs = {"crate": recipe.CRATE_SHA256,
                  "patches": [[patch.file, patch.old, patch.new] for patch in openusd_patches.PATCHES]}
        if read_json(self.work / "source.json") == inputs:
            return
        crate = self._fetch_crate()
        say("Unpacking and patching OpenUSD's source")
        draft = self.work / "source.draft"
        shutil.rmtree(draft, ignore_errors=True)
        unpack_crate(crate, draft)
        try:
            openusd_patches.apply_all(draft)
        except openusd_patches.PatchError as error:
            raise HiprError(f"Patching OpenUSD's source failed: {error}") from error
        update_tree(draft, source)
        shutil.rmtree(draft)
        # The crate's authors removed usdview's icons; the folder is installed all the same.
        (source / "pxr/usdImaging/usdviewq/icons").mkdir(exist_ok=True)
        write_json(self.work / "source.json", inputs)

    def _fetch_crate(self) -> Path:
        name, version = recipe.CRATE
        found = find_crate(name, version)
        if found is None:
            say(f"Fetching {name} {version} (6 MB) with cargo")
            manifest = self.work / "crate"
            (manifest / "src").mkdir(parents=True, exist_ok=True)
            (manifest / "src" / "lib.rs").write_text("")
            (manifest / "Cargo.toml").write_text(
                '[package]\nname = "fetch"\nversion = "0.0.0"\nedition = "2018"\n'
                f'[dependencies]\n{name} = "={version}"\n')
            run("Fetching OpenUSD's source", ["cargo", "fetch"], self.log, cwd=manifest)
            found = find_crate(name, version)
        if found is None:
            raise HiprError(f"cargo fetched {name} {version}, but it is not below {cargo_home()}.")
        check_sha256(found, recipe.CRATE_SHA256)
        return found

    def _fetch_tbb(self) -> None:
        """Fetches TBB's libraries and headers with pip and unpacks them."""
        inputs = {"tbb": recipe.TBB_VERSION, **recipe.TBB_SHA256}
        if read_json(self.work / "tbb.json") == inputs:
            return
        say(f"Fetching TBB {recipe.TBB_VERSION} (4 MB) with pip")
        wheels = self.work / "wheels"
        shutil.rmtree(wheels, ignore_errors=True)
        wheels.mkdir()
        requirements = wheels / "requirements.txt"
        requirements.write_text("".join(f"{name}=={recipe.TBB_VERSION} --hash=sha256:{digest}\n"
                                        for name, digest in recipe.TBB_SHA256.items()))
        run("Fetching TBB", ["/usr/bin/python3", "-m", "pip", "download", "--quiet", "--no-deps", "--require-hashes",
                             "--only-binary=:all:", "--dest", wheels, "-r", requirements], self.log)
        shutil.rmtree(self.work / "tbb", ignore_errors=True)
        for wheel in sorted(wheels.glob("*.whl")):
            unpack_tbb(wheel, self.work / "tbb")
        write_json(self.work / "tbb.json", inputs)

    # --- build ------------------------------------------------------------------------------------------------------

    def _configure(self) -> None:
        hooks = self.work / "recipe"
        update_tree(recipe.FOLDER, hooks)  # a copy: the build must not depend on where this checkout lies
        build = self.work / "build"
        options = dict(recipe.CMAKE_OPTIONS, CMAKE_PROJECT_INCLUDE=hooks / "hook.cmake", CMAKE_INSTALL_PREFIX=prefix(),
                       TBB_ROOT_DIR=self.work / "tbb", PYSIDEUICBINARY=hooks / "pyside2-uic")
        if (build / "CMakeCache.txt").exists() and not (build / "build.ninja").exists():
            shutil.rmtree(build)  # a first configuration that failed would be remembered
        say("Configuring OpenUSD")
        environment = {key: value for key, value in os.environ.items() if key not in ("CXXFLAGS", "CFLAGS", "LDFLAGS")}
        run("Configuring OpenUSD",
            ["cmake", "-G", "Ninja", "-S", self.work / "source", "-B", build,
             *(f"-D{key}={value}" for key, value in options.items())], self.log, env=environment)

    def _ninja(self, targets: List[str]) -> None:
        build = self.work / "build"
        progress = NinjaProgress.of("ninja", build, targets)
        run("Building OpenUSD", ["ninja", "-C", build, "-j", self.jobs, *targets], self.log, reader=progress.read)

    def _install(self, stage: str) -> None:
        say(f"Installing OpenUSD ({stage})")
        target = prefix()
        run("Installing OpenUSD", ["cmake", "--install", self.work / "build", "--component", stage], self.log)
        for part in ("include", "lib"):
            shutil.copytree(self.work / "tbb" / part, target / part, dirs_exist_ok=True)
        if stage == FULL:
            openusd_finish.finish(target, self.work / "tbb", self.log)


# --- pieces -----------------------------------------------------------------------------------------------------------

@contextlib.contextmanager
def locked(file: Path, waiting: str) -> Iterator[None]:
    """Holds a lock that other processes wait for; it ends with the process, however that ends."""
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            say(waiting)
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def default_jobs() -> int:
    """As many jobs as there are processors, unless memory is short."""
    with open("/proc/meminfo", encoding="ascii") as info:
        available = next((int(line.split()[1]) for line in info if line.startswith("MemAvailable")), JOB_MEMORY)
    return max(1, min(processors(), available // JOB_MEMORY))


def check_platform() -> None:
    """Only x86-64 Linux: TBB 2020 comes as a binary for it."""
    if platform.system() != "Linux" or platform.machine() != "x86_64":
        raise HiprError(f"Set-up builds OpenUSD on x86-64 Linux only, and this is {platform.system()} on "
                        f"{platform.machine()}.", "Name an installation of OpenUSD 20.08 or later with --usd DIR.")


def check_disk(folder: Path) -> None:
    """Says at the start, not after twenty minutes, that there is too little room."""
    free = shutil.disk_usage(folder).free
    if free < DISK_NEEDED:
        raise HiprError(f"Only {free / 2**30:.1f} GB are free on the disk of {folder}; the build of OpenUSD needs "
                        f"{DISK_NEEDED / 2**30:.0f} GB.", "Free some space, or choose another place with HIPR_HOME.")


def cargo_home() -> Path:
    """Where cargo keeps what it fetched."""
    return Path(os.environ.get("CARGO_HOME") or Path.home() / ".cargo")


def find_crate(name: str, version: str):
    """The crate's archive in cargo's cache, or None."""
    return next(iter(sorted(cargo_home().glob(f"registry/cache/*/{name}-{version}.crate"))), None)


def check_sha256(path: Path, expected: str) -> None:
    """Raises HiprError unless the file is what the recipe pins."""
    actual = hashlib.sha256(path.read_bytes()).hexdigest()
    if actual != expected:
        raise HiprError(f"{path} has the SHA-256 {actual}, not {expected}.", "Delete that file and try again.")


def unpack_crate(crate: Path, target: Path) -> None:
    """Unpacks the OpenUSD source inside the crate into target."""
    start = f"{'-'.join(recipe.CRATE)}/{recipe.CRATE_SOURCE}/"
    with tarfile.open(crate, "r:gz") as archive:
        for member in archive:
            if member.isfile() and member.name.startswith(start) and ".." not in member.name:
                path = target / member.name[len(start):]
                path.parent.mkdir(parents=True, exist_ok=True)
                with archive.extractfile(member) as data, path.open("wb") as out:
                    shutil.copyfileobj(data, out)


def unpack_tbb(wheel: Path, target: Path) -> None:
    """Unpacks headers and release libraries of a TBB wheel into target/include and target/lib."""
    with zipfile.ZipFile(wheel) as archive:
        for name in archive.namelist():
            inner = name.partition(".data/data/")[2]
            library = inner.startswith("lib/") and not ("debug" in inner or "preview" in inner)
            if library or inner.startswith("include/tbb/") or inner.startswith("include/serial/"):
                path = target / inner
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(archive.read(name))


def update_tree(source: Path, target: Path) -> None:
    """Makes target equal to source without touching a file that is equal already, so that only what changed is built
    again after a change of the patches."""
    wanted = {path.relative_to(source) for path in source.rglob("*") if path.is_file()}
    for path in [path for path in target.rglob("*") if path.is_file()]:
        if path.relative_to(target) not in wanted:
            path.unlink()
    for path in sorted(wanted):
        (target / path).parent.mkdir(parents=True, exist_ok=True)
        copy_if_different(source / path, target / path)


def copy_if_different(source: Path, target: Path) -> None:
    """Copies a file with its mode unless the target has the same content: a new time would rebuild everything."""
    if not target.exists() or target.read_bytes() != source.read_bytes():
        shutil.copy(source, target)
    target.chmod(stat.S_IMODE(source.stat().st_mode))


def read_json(path: Path):
    """The content of a stamp, or None."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def write_json(path: Path, content) -> None:
    """Writes a stamp: whole, or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    draft = path.with_suffix(".draft")
    draft.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
    draft.replace(path)


# --- archives ---------------------------------------------------------------------------------------------------------

def export_archive(file: Path) -> None:
    """Saves the built OpenUSD, so that another machine (a CI) can import it."""
    target = prefix()
    if not has(CORE, target):
        raise HiprError("There is no built OpenUSD to export yet.", "Run `./hipr setup --full` first.")
    say(f"Exporting {target.name} to {file}")
    draft = file.with_name(file.name + ".part")
    try:
        with tarfile.open(draft, "w:xz", preset=2) as archive:
            archive.add(target, arcname=target.name)
        draft.replace(file)
    except OSError as error:
        draft.unlink(missing_ok=True)
        raise HiprError(f"{file} could not be written: {error.strerror}.") from error


def import_archive(file: Path) -> None:
    """Restores what export_archive saved. An archive of another recipe is refused: it would not be used."""
    target = prefix()
    if has(FULL, target):
        say(f"OpenUSD {recipe.VERSION} is there already: {target}")
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    draft = target.with_name(target.name + ".part")
    shutil.rmtree(draft, ignore_errors=True)
    try:
        with tarfile.open(file, "r:*") as archive:
            names = {member.name.split("/", 1)[0] for member in archive.getmembers()}
            if names != {target.name}:
                raise HiprError(f"{file} holds {', '.join(sorted(names))}, and this checkout needs {target.name}.",
                                "Export it again from a machine that has set up this version.")
            say(f"Importing {target.name} from {file}")
            archive.extractall(draft, filter="data") if hasattr(tarfile, "data_filter") else archive.extractall(draft)
    except (OSError, EOFError, tarfile.TarError) as error:
        shutil.rmtree(draft, ignore_errors=True)
        raise HiprError(f"{file} is not an archive made by `hipr setup --export`: {error}") from error
    shutil.rmtree(target, ignore_errors=True)
    (draft / target.name).replace(target)
    draft.rmdir()
