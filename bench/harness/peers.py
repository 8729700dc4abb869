"""The peers that this machine has, measured."""

import json
import statistics
import subprocess
import sys
from dataclasses import dataclass

from . import child, machine, skeletons

SOURCES = machine.ROOT / "bench" / "peers"
CANNOT_TAKE = 3  # exit status of a peer that does not take such a shape


@dataclass
class Peer:
    """A program PROGRAM SHAPE.off OUT.obj that prints its seconds as JSON."""
    name: str
    title: str
    command: list


def _built(source, build):
    """Whether the project of the peers could be built; its words are in BUILD.log."""
    log = build.with_suffix(".log")
    log.parent.mkdir(parents=True, exist_ok=True)
    with open(log, "w", encoding="utf-8") as words:
        for command in (["cmake", "-S", source, "-B", build, "-G", "Ninja",
                         "-DCMAKE_BUILD_TYPE=Release"], ["cmake", "--build", build]):
            if subprocess.run(command, stdout=words, stderr=words, check=False).returncode:
                return False
    return True


def _has_scikit_image(python):
    probe = [python, "-c", "from skimage.morphology import skeletonize_3d"]
    return subprocess.run(probe, capture_output=True, check=False).returncode == 0


def available():
    """Those that can run here, and words about the others."""
    found, missing = [], []
    build = machine.ROOT / "build" / "peers"
    sys.stderr.write("== building the peers (a minute the first time)\n")
    if _built(SOURCES, build):
        found.append(Peer("cgal", "CGAL mean curvature flow", [str(build / "cgal_skeleton")]))
    else:
        missing.append(f"CGAL could not be built (libcgal-dev, libeigen3-dev; {build}.log)")
    python = next((p for p in ("/usr/bin/python3", sys.executable) if _has_scikit_image(p)), None)
    if python:
        found.append(Peer("lee", "voxelise and thin, 128³",
                          [python, str(SOURCES / "lee_thinning.py")]))
    else:
        missing.append("no scikit-image that has skeletonize_3d (python3-skimage)")
    return found, missing


def measure(peer, subject, runs, budget):
    """Medians over `runs` runs, fewer once they have taken `budget` seconds."""
    out = machine.work("skeletons", f"{subject.name}.{peer.name}.obj")
    command = [*peer.command, subject.off(), str(out)]
    parts, totals, peak = [], [], 0.0
    while len(totals) < runs and (not totals or sum(totals) < 1e3 * budget):
        done = child.run(command)
        if done.timed_out:
            return {"failed": "takes over 600 s"}
        if done.status == CANNOT_TAKE:
            return {"failed": "cannot take it"}
        if done.status:
            return {"failed": f"ended with status {done.status}"}
        told = json.loads(done.output)
        parts.append({part: 1e3 * seconds for part, seconds in told["seconds"].items()})
        totals.append(sum(parts[-1].values()))
        peak = max(peak, done.peak_mb)
    counted = skeletons.counts(out)
    return {
        "milliseconds": statistics.median(totals),
        "parts": {part: statistics.median(p[part] for p in parts) for part in parts[0]},
        "runs": len(totals),
        "peak_mb": peak,
        "counts": counted,
        "right": skeletons.is_expected(counted, subject.expected),
        "version": told["version"],
    }
