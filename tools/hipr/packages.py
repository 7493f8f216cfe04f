"""The Debian packages hdHipr needs, each with its reason, and how they get installed."""

import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, Iterable, List, Optional

from .console import run, say
from .errors import HiprError

RENDER = "render"  # to build OpenUSD's libraries, the delegate and hiprrecord, and to render
FULL = "full"      # further: Python, Storm, usdview, usdrecord and the tests


@dataclass(frozen=True)
class Package:
    name: str
    reason: str
    group: str = RENDER
    minimum: str = ""  # a version that bookworm itself may lack: then backports has it


PACKAGES = (
    # Tools
    Package("cmake", "configures all builds"),
    Package("ninja-build", "runs all builds"),
    Package("g++", "compiles hdHipr"),
    Package("clang-14", "compiles OpenUSD: a third faster than GCC, five times with its precompiled headers"),
    Package("mold", "links OpenUSD in a blink"),
    Package("ca-certificates", "lets cargo and pip trust the registries"),
    Package("cargo-web", "fetches OpenUSD's source from the crate registry (not needed if cargo is there)"),
    Package("python3-pip", "fetches TBB 2020 from the Python package index"),
    Package("glslang-tools", "compiles the shaders"),
    Package("spirv-tools", "checks and optimises the compiled shaders"),
    # OpenUSD
    Package("libboost-dev", "OpenUSD uses Boost all over"),
    Package("libboost-python-dev", "OpenUSD's Python bindings"),
    Package("libboost-program-options-dev", "OpenUSD's command line tools"),
    Package("python3-dev", "OpenUSD's Python bindings"),
    Package("libosd-dev", "OpenSubdiv: subdivision surfaces, in OpenUSD and in the delegate"),
    Package("libglew-dev", "OpenUSD's Storm is configured with the rest"),
    Package("libgl-dev", "OpenUSD's Storm is configured with the rest"),
    Package("libx11-dev", "OpenUSD's Storm is configured with the rest"),
    Package("libxt-dev", "OpenUSD's Storm is configured with the rest"),
    # hdHipr
    Package("libvulkan-dev", "Vulkan, the device interface"),
    Package("mesa-vulkan-drivers", "lavapipe: Vulkan on a plain CPU, with ray queries and float atomics", minimum="25"),
    Package("libembree-dev", "a traversal to choose and to compare with"),
    Package("libtbb-dev", "parallel loops in the renderer"),
    Package("libopenimageio-dev", "reads textures, writes EXR and PNG"),
    Package("openimageio-tools", "names the programs that OpenImageIO's CMake files refer to"),
    Package("libopencolorio-dev", "colour spaces and view transforms"),
    Package("libopenexr-dev", "headers that OpenImageIO's CMake files refer to"),
    Package("libpugixml-dev", "reads MaterialX documents"),
    Package("libopenvdb-dev", "reads volumes from .vdb files; CMake goes on without it"),
    Package("zlib1g-dev", "inflates .spz files of splats"),
    Package("libglm-dev", "vectors and matrices"),
    Package("libcli11-dev", "hiprrecord's command line"),
    Package("libspdlog-dev", "log messages"),
    Package("nlohmann-json3-dev", "JSON in metadata and test baselines"),
    # Tests, Python, usdview
    Package("libgtest-dev", "the test framework", FULL),
    Package("libgmock-dev", "the test framework's matchers", FULL),
    Package("vulkan-validationlayers", "the tests run with Vulkan's validation layers and want them silent", FULL),
    Package("qtbase5-dev-tools", "Qt's uic turns usdview's dialogs into Python", FULL),
    Package("python3-pyside2.qtwidgets", "usdview's windows", FULL),
    Package("python3-pyside2.qtopengl", "usdview's viewport", FULL),
    Package("python3-opengl", "usdview's viewport", FULL),
    Package("python3-numpy", "OpenUSD's Python arrays; comparing pictures in tests", FULL),
    # Mesa's packages must be of one version; some come with others at an older one.
    Package("libgl1-mesa-dri", "OpenGL in software, for usdview and usdrecord", FULL, minimum="25"),
    Package("libglx-mesa0", "the same, through GLX", FULL, minimum="25"),
    Package("libegl-mesa0", "the same, through EGL", FULL, minimum="25"),
    Package("libgbm1", "the same, its buffers", FULL, minimum="25"),
    Package("xvfb", "a display where there is none: usdrecord, and the tests that drive usdview", FULL),
    Package("xauth", "xvfb-run needs it", FULL),
)


def wanted(group: str) -> List[Package]:
    """The packages of a group; those of FULL include those of RENDER."""
    skip = {"cargo-web"} if shutil.which("cargo") else set()
    return [package for package in PACKAGES
            if package.name not in skip and (package.group == RENDER or group == FULL)]


def installed_versions(names: Iterable[str]) -> Dict[str, str]:
    """The versions of those packages that are installed."""
    result = subprocess.run(["dpkg-query", "-W", "-f", "${Package} ${db:Status-Status} ${Version}\n", *names],
                            capture_output=True, text=True, check=False)
    versions = {}
    for line in result.stdout.splitlines():
        name, status, version = (line.split(" ", 2) + ["", ""])[:3]
        if status == "installed":
            versions[name] = version
    return versions


def new_enough(version: str, minimum: str) -> bool:
    """Whether a Debian version is at least the minimum."""
    return not minimum or subprocess.run(
        ["dpkg", "--compare-versions", version, "ge", minimum], check=False).returncode == 0


def missing(group: str) -> List[Package]:
    """The packages of a group that are not installed, or too old."""
    packages = wanted(group)
    versions = installed_versions(package.name for package in packages)
    return [package for package in packages
            if package.name not in versions or not new_enough(versions[package.name], package.minimum)]


def ensure(group: str, log: Path, *, allowed: bool = True) -> None:
    """Installs what a group lacks. Raises HiprError with the command to type where that is not possible."""
    if not shutil.which("dpkg-query"):
        say("This is not Debian: packages are not checked. docs/setup.md lists what is needed.")
        return
    lacking = missing(group)
    if not lacking:
        return
    names = [package.name for package in lacking]
    prefix = _root_prefix()
    install = ["apt-get", "install", "-y", "--no-install-recommends"]
    by_hand = f"  {'sudo ' if os.geteuid() else ''}{' '.join(install + names)}"
    if not allowed or prefix is None:
        reason = "--no-packages was given" if not allowed else "installing them takes root or sudo"
        raise HiprError(f"{len(names)} packages are missing, and {reason}. Install them with\n{by_hand}", _backports_note(lacking))
    say(f"Installing {len(names)} packages (about 2 min):")
    for package in lacking:
        print(f"    {package.name:30} {package.reason}", flush=True)
    env = dict(os.environ, DEBIAN_FRONTEND="noninteractive", LC_ALL="C.UTF-8")
    options = ["-o", "Dpkg::Use-Pty=0", "-o", "Acquire::Retries=3", "-o", "DPkg::Lock::Timeout=300"]
    release = _add_backports(prefix, log) if any(package.minimum for package in lacking) else ""
    run("Reading the package lists", [*prefix, "apt-get", *options, "update"], log, env=env)
    # One transaction, and `/release` rather than `-t`: that takes from backports only what these few packages need.
    run("Installing packages",
        [*prefix, *install, *options, *(f"{package.name}/{release}" if package.minimum and release else package.name
                                        for package in lacking)], log, env=env)
    still = missing(group)
    if still:
        raise HiprError(f"After the installation these are still missing or too old: "
                        f"{', '.join(package.name for package in still)}.", _backports_note(still))


def _root_prefix() -> Optional[List[str]]:
    """What to put before a command so that it runs as root; None if there is no way."""
    if os.geteuid() == 0:
        return []
    if not shutil.which("sudo"):
        return None
    if sys.stdin.isatty() or subprocess.run(["sudo", "-n", "true"], capture_output=True, check=False).returncode == 0:
        return ["sudo", "--preserve-env=DEBIAN_FRONTEND"]
    return None


def _backports_note(lacking: Iterable[Package]) -> str:
    needy = [f"{package.name} {package.minimum} or later" for package in lacking if package.minimum]
    return f"{', '.join(needy)} comes from bookworm-backports on Debian 12." if needy else ""


# --- bookworm-backports ---------------------------------------------------------------------------------------------

BACKPORTS_FILE = Path("/etc/apt/sources.list.d/hipr-backports.sources")


def os_codename(path: Path = Path("/etc/os-release")) -> str:
    """The release's name, such as 'bookworm'; empty if it has none."""
    match = re.search(r"^VERSION_CODENAME=\"?(\w+)", path.read_text(encoding="utf-8"), re.M) if path.exists() else None
    return match.group(1) if match else ""


@dataclass(frozen=True)
class Source:
    uri: str
    suites: tuple
    signed_by: str = ""


def read_sources(root: Path = Path("/etc/apt")) -> List[Source]:
    """Every package source that apt is told about, in both formats."""
    found = []
    for path in [root / "sources.list", *sorted(root.glob("sources.list.d/*"))]:
        if path.suffix == ".sources":
            found += _read_deb822(path.read_text(encoding="utf-8", errors="replace"))
        elif path.suffix == ".list" and path.exists():
            found += _read_one_line(path.read_text(encoding="utf-8", errors="replace"))
    return found


def _read_deb822(text: str) -> List[Source]:
    found = []
    text = re.sub(r"^#.*\n?", "", text, flags=re.M)
    for stanza in re.split(r"\n\s*\n", text):
        fields = {key.lower(): " ".join(value.split())
                  for key, value in re.findall(r"^([\w-]+):[ \t]*(.*(?:\n[ \t]+.*)*)", stanza, re.M)}
        if "deb" in fields.get("types", "").split() and fields.get("enabled", "yes") != "no":
            found += [Source(uri, tuple(fields.get("suites", "").split()), fields.get("signed-by", ""))
                      for uri in fields.get("uris", "").split()]
    return found


def _read_one_line(text: str) -> List[Source]:
    found = []
    for options, uri, suite in re.findall(r"^\s*deb\s+(?:\[([^\]]*)\]\s+)?(\S+)\s+(\S+)", text, re.M):
        signed = re.search(r"signed-by=(\S+)", options)
        found.append(Source(uri, (suite,), signed.group(1) if signed else ""))
    return found


def backports_source(sources: Iterable[Source], codename: str) -> Optional[str]:
    """The text of a source for backports at the mirror that the release itself comes from; None if there already
    is one. Raises HiprError if that mirror is not found."""
    sources = list(sources)
    suite = f"{codename}-backports"
    if any(suite in source.suites for source in sources):
        return None
    for source in sources:
        if codename in source.suites:
            signed = f"Signed-By: {source.signed_by}\n" if source.signed_by else ""
            return f"Types: deb\nURIs: {source.uri}\nSuites: {suite}\nComponents: main\n{signed}"
    raise HiprError(f"No package source for '{codename}' was found, so {suite} cannot be added.",
                    f"Add {suite} to apt's sources yourself: lavapipe 25 comes from there.")


def _add_backports(prefix: List[str], log: Path) -> str:
    """Makes sure that apt knows backports on Debian 12. Returns the release to install from, empty for the usual."""
    codename = os_codename()
    if codename != "bookworm":
        return ""
    text = backports_source(read_sources(), codename)
    if text:
        say(f"Adding {codename}-backports to the package sources ({BACKPORTS_FILE}): lavapipe 25 comes from there.")
        run("Adding backports", [*prefix, "sh", "-c", f"printf '%s' \"$1\" > {BACKPORTS_FILE}", "sh", text], log)
    return f"{codename}-backports"
