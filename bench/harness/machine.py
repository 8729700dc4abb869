"""The folders, the build, and the words that say where figures come from."""

import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
_folders = {"build": ROOT / "build" / "release", "work": ROOT / "build" / "bench"}


def die(words):
    sys.exit(f"{Path(sys.argv[0]).name}: {words}")


def work(*parts):
    """A path in the folder of results, which is made."""
    path = _folders["work"].joinpath(*parts)
    path.parent.mkdir(parents=True, exist_ok=True)
    return path


def use(folder):
    """Takes the programs in FOLDER/bin as they are, instead of build()."""
    _folders["build"] = Path(folder).resolve()
    _folders["work"] = Path(folder).resolve() / "bench-work"


def build(*targets):
    """Builds the release preset as scripts/lib.sh does; its words are shown if it fails."""
    script = 'source scripts/lib.sh; build release "$@"'
    done = subprocess.run(["bash", "-c", script, "bench", *targets], cwd=ROOT, check=False,
                          stdout=subprocess.DEVNULL)
    if done.returncode:
        die("the build failed; scripts/setup.sh --bench installs what it needs")


def run(command):
    """Runs a program that must not fail."""
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    if done.returncode:
        die(f"{' '.join(command)} failed: {done.stderr.strip()}")


def program(name):
    return str(_folders["build"] / "bin" / name)


def _first_line(*command):
    try:
        return subprocess.run(command, capture_output=True, text=True,
                              check=True).stdout.splitlines()[0].strip()
    except (OSError, subprocess.CalledProcessError, IndexError):
        return "unknown"


def _compiler():
    cache = (_folders["build"] / "CMakeCache.txt").read_text(encoding="utf-8")
    path = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", cache, re.M)
    kind = re.search(r"^CMAKE_BUILD_TYPE:\w+=(.+)$", cache, re.M)
    kind = kind.group(1).upper() if kind else "RELEASE"  # what CMakeLists.txt takes then
    flags = re.search(rf"^CMAKE_CXX_FLAGS_{kind}:\w+=(.*)$", cache, re.M)
    return f"{_first_line(path.group(1), '--version')}, {flags.group(1)}"


def _busy():
    """Other work disturbs the clock, and caches too."""
    load, cores = os.getloadavg()[0], os.cpu_count()
    return f"busy with other work, load {load:.1f} on {cores} cores" if load > cores else ""


_busy_at_start = _busy()  # later the measured programs are part of the load


def describe():
    """Where the figures come from."""
    cpus = re.findall(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(encoding="utf-8"),
                      re.M)
    system = re.search(r'^PRETTY_NAME="(.*)"$', Path("/etc/os-release").read_text(encoding="utf-8"),
                       re.M)
    return {
        "machine": f"{cpus[0] if cpus else 'unknown'}, {os.cpu_count()} cores",
        "system": system.group(1) if system else "unknown",
        "compiler": _compiler(),
        "commit": _first_line("git", "-C", str(ROOT), "describe", "--always", "--dirty"),
        "state": _busy_at_start,
    }


def describe_text():
    told = describe()
    words = f"{told['machine']}; {told['system']}; {told['compiler']}; commit {told['commit']}"
    return f"{words}; {told['state']}" if told["state"] else words
