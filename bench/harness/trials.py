"""One skeleton of one shape by one program, and what it is worth."""

import json
from dataclasses import dataclass, field
from pathlib import Path

from . import cells, child, machine, peers, skeletons

SECONDS = 120  # for one skeleton


@dataclass
class Method:
    """A program that makes skeletons; `options` are those of `marrow extract`, `peer` is another's."""
    name: str
    title: str
    options: list = field(default_factory=list)
    peer: peers.Peer = None

    def command(self, subject, out):
        if self.peer:
            return [*self.peer.command, subject.off(), out]
        return [machine.program("marrow"), "extract", subject.path, "-o", out, "--threads", "1",
                "--quiet", *self.options]

    def with_options(self, *options):
        return Method(f"{self.name}{''.join(options)}", self.title, [*self.options, *options])


OURS = Method("marrow", "Marrow")
PAPER = Method("paper", "the paper's rules", ["--rules", "paper"])


def peers_here():
    """The methods of others that this machine has, and words about those that it has not."""
    found, missing = peers.available()
    return [Method(p.name, p.title, peer=p) for p in found], missing


class Trials:
    """Makes skeletons and compares them; what is known from an earlier run is not made again."""

    def __init__(self, resume, progress):
        self.store = cells.Cells("experiments", resume)
        self.progress = progress

    def skeleton(self, method, subject):
        """{"path", "counts", "right", "ms"} or {"failed": words}."""
        self.progress.note(f"{subject.name}: {method.title}")
        out = str(machine.work("skeletons", f"{subject.name}.{method.name}.obj"))
        command = method.command(subject, out)
        stamp = [cells.hash_of(subject.path, command[-3] if method.peer else command[0])]
        if not Path(out).exists():
            stamp.append("no skeleton")
        return self.store.get(f"{subject.name}/{method.name}", stamp,
                              lambda: self._make(method, subject, command, out))

    def _make(self, method, subject, command, out):
        done = child.run(command, SECONDS)
        if done.timed_out:
            return {"failed": f"over {SECONDS} s"}
        if method.peer and done.status == peers.CANNOT_TAKE:
            return {"failed": "cannot take it"}
        if done.status:
            return {"failed": f"status {done.status}"}
        seconds = sum(json.loads(done.output)["seconds"].values()) if method.peer else done.user
        counted = skeletons.counts(out)
        return {"path": out, "counts": counted, "ms": 1e3 * seconds,
                "right": skeletons.is_expected(counted, subject.expected)}

    def _asked(self, *words):
        done = child.run([machine.program("marrow"), *words, "--json"], SECONDS)
        if done.status:
            machine.die(f"marrow {' '.join(words)} failed: {done.errors.strip()}")
        return json.loads(done.output)

    def diagonal(self, subject):
        return self._asked("info", subject.path)["diagonal"]

    def apart(self, first, second, diagonal):
        """(mean, Hausdorff) both ways in % of `diagonal`."""
        told = self._asked("compare", first, second)["both_ways"]
        return tuple(100 * told[key]["distance"] / diagonal for key in ("mean", "hausdorff"))

    def quality(self, method, subject, skeleton):
        """The figures of `marrow check`; a peer's nodes have the radii of the inscribed balls."""
        if not method.peer:
            return self._asked("check", subject.path, skeleton)
        out = str(Path(skeleton).with_suffix(".skel"))
        done = child.run([machine.program("marrow"), "convert", skeleton, out, "--radius", "1e-6"],
                         SECONDS)
        if done.status:
            machine.die(f"marrow convert {skeleton}: {done.errors.strip()}")
        told = self._asked("check", subject.path, out)
        return {**told, "reconstruction_percent": told["inscribed_reconstruction_percent"]}

    def picture(self, name, subject, skeleton, folder):
        """A PNG of a shape and its skeleton; its file name."""
        out = Path(folder) / f"{name}.png"
        done = child.run([machine.program("marrow"), "render", subject.path, skeleton, "-o",
                          str(out), "--size", "800x600"], SECONDS)
        if done.status:
            machine.die(f"picture {name}: {done.errors.strip()}")
        return out.name


def counts_words(result):
    """components/cycles/tips, and whether they are right."""
    if "failed" in result:
        return result["failed"]
    found = result["counts"]
    return (f"{found['components']}/{found['cycles']}/{found['tips']}"
            f"{'' if result['right'] else ' wrong'}")
