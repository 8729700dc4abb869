"""Skeletons against exact centre lines: articulated poses of Fig. 6, resolutions of Fig. 10, truth."""

import numpy as np

from harness import machine, tables
from harness.trials import counts_words

from .section import Section, mean, percent

CENTRE_LINES = ("capsule", "tapered-capsule", "beads", "s-tube", "helix", "snake", "torus", "trefoil",
                "rings", "y", "star", "figure-eight", "double-torus", "cube-frame", "buckyball",
                "vessel-tree", "stick-figure", "quadruped", "octopus")


def nodes(path):
    """x y z radius of every node of an OBJ."""
    with open(path, encoding="ascii") as file:
        rows = [line.split()[1:5] for line in file if line.startswith("v ")]
    return np.array([row + ["nan"] * (4 - len(row)) for row in rows], dtype=float)


def radius_error(path, truth):
    """Mean error of the radius in % of the true one, taken at the nearest node of the truth."""
    ours, exact = nodes(path), nodes(truth)
    nearest = [np.argmin(np.sum((exact[:, :3] - p) ** 2, axis=1)) for p in ours[:, :3]]
    error = np.abs(ours[:, 3] - exact[nearest, 3]) / exact[nearest, 3]
    return None if np.isnan(error).any() else 100 * error.mean()


def measured(ask, method, subject, truth):
    made = ask.skeleton(method, subject)
    row = {"shape": subject.name, "method": method.title, "found": counts_words(made),
           "right": made.get("right", False), "mean": None, "hausdorff": None, "radius": None,
           "ms": made.get("ms")}
    if "failed" not in made:
        diagonal = ask.diagonal(subject)
        row["mean"], row["hausdorff"] = ask.apart(made["path"], truth, diagonal)
        row["radius"] = radius_error(made["path"], truth)
    return row


def summary(rows, methods):
    lines = [["method", "right", "distance, % of the diagonal", "worst shape's", "greatest Hausdorff",
              "radius, % of it"]]
    for method in methods:
        of = [row for row in rows if row["method"] == method.title]
        known = [row for row in of if row["mean"] is not None]
        lines.append([method.title, f"{sum(row['right'] for row in of)} of {len(of)}",
                      percent(mean(row["mean"] for row in of)),
                      percent(max((row["mean"] for row in known), default=None)),
                      percent(max((row["hausdorff"] for row in known), default=None)),
                      percent(mean(row["radius"] for row in of))])
    return lines


def table(rows):
    lines = [["shape", "method", "components/cycles/tips", "distance, %", "Hausdorff, %", "radius, %"]]
    lines += [[row["shape"], row["method"], row["found"], percent(row["mean"]),
               percent(row["hausdorff"]), percent(row["radius"])] for row in rows]
    return lines


def truth_section(ask, methods, subjects):
    """`subjects` are pairs of a shape and the path of its truth."""
    rows = [measured(ask, method, subject, truth)
            for subject, truth in subjects for method in methods]
    words = ("Distances between the skeleton and the exact centre lines, both ways, in % of the "
             "diagonal; the error of the radius in % of the true radius.")
    return Section("truth", "Exact centre lines", words, [summary(rows, methods), table(rows)], rows)


def poses_section(ask, methods, poses, few, figures):
    """`figures` gives (subject, truth) of a pose; peers, which are slow, take `few` of the poses."""
    rows = [measured(ask, method, *figures(pose)) for method in methods
            for pose in range(1, 1 + (few if method.peer else poses))]
    words = (f"The stick figure of `marrow make` in {poses} poses, bent by its own bones "
             f"(`marrow make stick-figure --pose N`); peers take the first {few}. Right is the "
             "topology of the bones: one part, no cycle, five tips.")
    return Section("poses", "Fig. 6: articulated poses", words, [summary(rows, methods)], rows)


def resolutions_section(ask, method, images, grids, subjects):
    rows = []
    for image in images:
        for grid in grids:
            tried = method.with_options("--image", str(image), "--grid", str(grid))
            of = [measured(ask, tried, subject, truth) for subject, truth in subjects]
            rows.append({"image": image, "grid": grid, "right": sum(row["right"] for row in of),
                         "shapes": len(of), "mean": mean(row["mean"] for row in of),
                         "hausdorff": mean(row["hausdorff"] for row in of),
                         "ms": tables.geometric_mean(row["ms"] for row in of if row["ms"])})
    lines = [["image", "grid", "right", "distance, %", "Hausdorff, mean %", "ms, geometric mean"]]
    lines += [[str(row["image"]), str(row["grid"]), f"{row['right']} of {row['shapes']}",
               percent(row["mean"]), percent(row["hausdorff"]), tables.number(row["ms"])]
              for row in rows]
    words = (f"{len(subjects)} shapes with exact centre lines, every size of the images with every "
             "size of the grid. Times are user CPU of the whole command on one thread.")
    return Section("resolutions", "Fig. 10: resolution of images and grid", words, [lines], rows)


def truth_path(name):
    return str(machine.work("shapes", f"{name}.truth.obj"))
