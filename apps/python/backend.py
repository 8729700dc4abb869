"""Builds the wheel of the Python module by CMake, for pip. Needs nothing but Python and CMake, so
that an installation downloads nothing; Debian 12 has no scikit-build-core."""

import base64
import csv
import hashlib
import io
import pathlib
import re
import subprocess
import sys
import sysconfig
import tarfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "python-wheel"
# Wheels hold times: the oldest that zip knows, so that the same sources give the same bytes.
LONG_AGO = (1980, 1, 1, 0, 0, 0)


def version():
    text = (ROOT / "CMakeLists.txt").read_text()
    return re.search(r"project\(marrow VERSION ([0-9.]+)", text).group(1)


def metadata():
    readme = (ROOT / "README.md").read_text()
    return (
        "Metadata-Version: 2.1\nName: marrow\nVersion: %s\n"
        "Summary: Curve-skeletons of 3D shapes from their silhouettes\n"
        "License: Apache-2.0\nRequires-Python: >=3.9\nRequires-Dist: numpy\n"
        "Provides-Extra: graph\nRequires-Dist: networkx; extra == 'graph'\n"
        "Description-Content-Type: text/markdown\n\n%s" % (version(), readme)
    )


def tag():
    python = "cp%d%d" % sys.version_info[:2]
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    return "%s-%s-%s" % (python, python, platform)


def wheel_words():
    return "Wheel-Version: 1.0\nGenerator: marrow\nRoot-Is-Purelib: false\nTag: %s\n" % tag()


def run(*words):
    done = subprocess.run(words, cwd=ROOT)
    if done.returncode != 0:
        sys.exit("marrow: '%s' failed; scripts/setup.sh --all installs what it needs" % " ".join(words))


def build():
    """Compiles the module; the folder that holds the package."""
    run("cmake", "-S", str(ROOT), "-B", str(BUILD), "-DCMAKE_BUILD_TYPE=Release",
        "-DMARROW_BUILD_PYTHON=ON", "-DMARROW_BUILD_APPS=OFF", "-DMARROW_BUILD_TESTS=OFF",
        "-DMARROW_BUILD_BENCH=OFF", "-DPython3_EXECUTABLE=" + sys.executable)
    targets = subprocess.run(["cmake", "--build", str(BUILD), "--target", "help"], cwd=ROOT,
                             capture_output=True, text=True).stdout
    if "marrow_python" not in targets:
        sys.exit("marrow: pybind11 or the headers of Python are missing; "
                 "scripts/setup.sh --all installs them")
    run("cmake", "--build", str(BUILD), "--target", "marrow_python", "--parallel")
    return BUILD / "python" / "marrow"


def digest(data):
    return "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def record_of(files, record):
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    for name, data in files:
        rows.writerow([name, digest(data), len(data)])
    rows.writerow([record, "", ""])
    return text.getvalue().encode()


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    package = build()
    info = "marrow-%s.dist-info" % version()
    kept = [p for p in sorted(package.iterdir()) if p.suffix in {".py", ".pyi", ".typed", ".so"}
            or p.name == "py.typed"]
    files = [("marrow/" + p.name, p.read_bytes()) for p in kept]
    files += [
        (info + "/METADATA", metadata().encode()),
        (info + "/WHEEL", wheel_words().encode()),
        (info + "/LICENSE", (ROOT / "LICENSE").read_bytes()),
    ]
    files.append((info + "/RECORD", record_of(files, info + "/RECORD")))
    name = "marrow-%s-%s.whl" % (version(), tag())
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files:
            entry = zipfile.ZipInfo(path, LONG_AGO)
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)
    return name


def build_sdist(sdist_directory, config_settings=None):
    base = "marrow-" + version()
    name = base + ".tar.gz"
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True)
    if listed.returncode != 0:
        sys.exit("marrow: a source archive is made of a checkout, by git")
    with tarfile.open(pathlib.Path(sdist_directory) / name, "w:gz") as archive:
        for path in listed.stdout.splitlines():
            archive.add(ROOT / path, base + "/" + path)
        info = tarfile.TarInfo(base + "/PKG-INFO")
        data = metadata().encode()
        info.size = len(data)
        archive.addfile(info, io.BytesIO(data))
    return name
