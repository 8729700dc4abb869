"""Results that outlive an interrupted run."""

import hashlib
import json
from pathlib import Path

from . import machine


def hash_of(*paths):
    """Names the contents of files."""
    digest = hashlib.sha256()
    for path in paths:
        digest.update(Path(path).read_bytes())
    return digest.hexdigest()[:16]


class Cells:
    """Measured cells of a table, written as soon as they are known. With `resume` those that were
    measured before, under the same stamp, are not measured again."""

    def __init__(self, stem, resume):
        self.path = machine.work(f"{stem}.cells.json")
        self.known = {}
        if resume and self.path.is_file():
            self.known = json.loads(self.path.read_text(encoding="utf-8"))

    def get(self, name, stamp, measure):
        """The cell `name`; measure() gives it where it is not known."""
        cell = self.known.get(name)
        if not cell or cell["stamp"] != stamp:
            self.known[name] = {"stamp": stamp, "value": measure()}
            self.path.write_text(json.dumps(self.known, indent=1), encoding="utf-8")
        return self.known[name]["value"]
