"""Curves as CSV and, where matplotlib is, as SVG."""

import csv
import statistics

# What the curves of one thread sum up.
GROUPS = {
    "images": ("normalise", "first-look", "frames", "silhouettes", "distances", "medial-axes",
               "distances-to-axes"),
    "votes": ("matching", "cleaning"),
    "graph": ("region-growing", "perceptual-core", "hull-solid", "hull-thinning",
              "branch-collapse", "cycle-check", "sheets", "smoothing", "refinement"),
}


def grouped(stages):
    """Milliseconds by group from milliseconds by stage."""
    return {group: sum(stages[name] for name in names) for group, names in GROUPS.items()}


def write_csv(path, rows):
    """Rows are dicts with the same keys."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({key: round(value, 3) if isinstance(value, float) else value
                             for key, value in row.items()})


def exponent(xs, ys):
    """The power of x that y grows with, by least squares of the logarithms."""
    if len(set(xs)) < 2:
        return None
    from math import log
    x, y = [log(v) for v in xs], [log(v) for v in ys]
    mx, my = statistics.fmean(x), statistics.fmean(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def draw_svg(path, title, label, lines, unit="ms", log=True):
    """`lines`: {name: [(x, y), ...]}. False when there is nothing to draw with."""
    try:
        import matplotlib
    except ImportError:
        return False
    matplotlib.use("svg")
    # The same bytes for the same figures, and text as text.
    matplotlib.rcParams.update({"svg.hashsalt": "marrow", "svg.fonttype": "none"})
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(6, 4))
    for name, points in lines.items():
        axes.plot(*zip(*points), marker="o", markersize=4, label=name)
    if log:
        axes.set_xscale("log", base=2)
        axes.set_yscale("log")
        ticks = sorted({x for points in lines.values() for x, _ in points})
        axes.set_xticks(ticks[::max(1, len(ticks) // 8)])
        axes.xaxis.set_major_formatter(lambda x, _: f"{x:g}" if x < 1e4 else f"{x / 1e3:.0f}k")
        axes.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
    axes.set(title=title, xlabel=label, ylabel=unit)
    axes.grid(True, alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    pyplot.close(figure)
    return True
