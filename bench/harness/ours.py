"""Marrow, measured."""

import json
import statistics
from dataclasses import dataclass

from . import child, machine, skeletons


@dataclass
class Figure:
    """Medians of one benchmark, in milliseconds."""
    user: float
    wall: float
    faces: int
    inside: dict  # wall clock of the stages within, by their names


def benchmarks(shapes, flags=(), pattern="", runs=5, seconds=0.1):
    """Runs marrow_benchmarks; {stage: {shape: Figure}} in the order of the pipeline. `shapes` is
    its flag, --make=... or --shapes=..."""
    command = [machine.program("marrow_benchmarks"), shapes, *flags, "--benchmark_format=json",
               f"--benchmark_repetitions={runs}", f"--benchmark_min_time={seconds}"]
    if pattern:
        command.append(f"--benchmark_filter={pattern}")
    done = child.run(command, seconds=3600)
    if done.status:
        machine.die(f"{' '.join(command)} failed: {done.errors.strip()}")
    samples = {}
    for run in json.loads(done.output)["benchmarks"]:
        if run.get("error_occurred"):
            machine.die(f"{run['name']}: {run['error_message']}")
        if run["run_type"] == "iteration":
            stage, shape = run["name"].split("/")[:2]
            samples.setdefault(stage, {}).setdefault(shape, []).append(run)
    return {stage: {shape: _figure(found) for shape, found in by_shape.items()}
            for stage, by_shape in samples.items()}


def _figure(samples):
    def median(key):
        return statistics.median(sample[key] for sample in samples)

    inside = {key[3:]: median(key) for key in samples[0] if key.startswith("in ")}
    return Figure(median("real_time"), median("wall_ms"), int(samples[0]["faces"]), inside)


def whole(subject, runs=5, flags=(), seconds=0.1):
    """One shape: the stages and the whole in user milliseconds, counts, peak memory."""
    found = benchmarks(f"--shapes={subject.path}", ["--threads=1", *flags], runs=runs,
                       seconds=seconds)
    stages = {stage: next(iter(figures.values())).user for stage, figures in found.items()}
    out = machine.work("skeletons", f"{subject.name}.marrow.obj")
    options = [word for flag in flags for word in flag.split("=")]
    command = [machine.program("marrow"), "extract", subject.path, "-o", str(out), "--threads", "1",
               "--quiet", *options]
    done = child.run(command)
    if done.status:
        machine.die(f"{' '.join(command)} failed: {done.errors.strip()}")
    counted = skeletons.counts(out)
    return {
        "milliseconds": stages.pop("extract"),
        "parts": stages,
        "runs": runs,
        "peak_mb": done.peak_mb,
        "counts": counted,
        "right": skeletons.is_expected(counted, subject.expected),
    }
