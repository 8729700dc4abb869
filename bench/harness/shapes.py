"""The shapes to measure: those that the project makes, or a set of files with a manifest."""

import json
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from . import machine

# A loop, thin limbs, curled limbs, branches, a chain of loops, many loops, a body.
MADE = ("torus", "hand", "octopus", "vessel-tree", "rings", "buckyball", "quadruped", "plant")


@dataclass
class Subject:
    """A shape on disk and what its skeleton must be like."""
    name: str
    path: str
    expected: dict = field(default_factory=dict)
    faces: int = 0  # triangles, known once off() has been called

    def off(self):
        """The triangles as an OFF file, for the peers."""
        out = machine.work("triangles", f"{self.name}.off")
        subprocess.run([machine.program("marrow_triangles"), self.path, str(out)], check=True)
        with open(out, encoding="ascii") as file:
            file.readline()
            self.faces = int(file.readline().split()[1])
        return str(out)


def make(name, resolution=1.0):
    """A shape of `marrow make` with its truth; resolution is the factor on its faces."""
    stem = name if resolution == 1 else f"{name}_{resolution:g}"
    shape = machine.work("shapes", f"{stem}.ply")
    truth = machine.work("shapes", f"{stem}.gt.json")
    subprocess.run([machine.program("marrow"), "make", name, "-o", str(shape),
                    "--truth", str(truth), "--resolution", str(resolution)], check=True)
    expected = json.loads(truth.read_text(encoding="utf-8"))["expected"]
    return Subject(stem, str(shape), expected)


def from_set(folder, only, group="real"):
    """Shapes of FOLDER/manifest.json, by name (without folder and extension), in the order of
    `only`; without it all in its folder `group`."""
    manifest = Path(folder) / "manifest.json"
    if not manifest.is_file():
        machine.die(f"{manifest} is not there; --set wants a folder with a manifest.json")
    known = {}
    for item in json.loads(manifest.read_text(encoding="utf-8"))["items"]:
        path = Path(folder) / item["file"]
        known.setdefault(path.stem, Subject(path.stem, str(path), item.get("expected", {})))
    names = only or [name for name, s in known.items() if Path(s.path).parent.name == group]
    for name in names:
        if name not in known:
            machine.die(f"{manifest} has no shape {name}")
    return [known[name] for name in names]


def chosen(folder, only):
    """What the options --set and --only ask for."""
    if folder:
        return from_set(folder, only)
    return [make(name) for name in only or MADE]
