"""Variants of shapes against the skeletons of the shapes themselves: Table 1, Fig. 6, Fig. 12."""

from harness.trials import counts_words

from .section import Section, mean, percent

TITLES = ["shape", "faces", "method", "components/cycles/tips", "as the original's",
          "mean, % of the diagonal", "Hausdorff, %"]


def compared(ask, methods, groups, turn_back=None):
    """Rows of figures: each variant against the original by the same method. `groups` are pairs of
    an original and its variants."""
    rows = []
    for base, variants in groups:
        diagonal = ask.diagonal(base)
        for method in methods:
            original = ask.skeleton(method, base)
            for variant in variants:
                if not variant.faces:
                    variant.off()
                made = ask.skeleton(method, variant)
                row = {"shape": variant.name, "faces": variant.faces, "method": method.title,
                       "found": counts_words(made), "same": "", "mean": None, "hausdorff": None}
                if "failed" not in original and "failed" not in made:
                    path = turn_back(variant, made["path"]) if turn_back else made["path"]
                    row["mean"], row["hausdorff"] = ask.apart(original["path"], path, diagonal)
                    row["same"] = original["counts"] == made["counts"]
                row["right"] = made.get("right", False)
                rows.append(row)
    return rows


def table(rows):
    lines = [TITLES]
    for row in rows:
        same = {True: "yes", False: "no", "": ""}[row["same"]]
        lines.append([row["shape"], f"{row['faces']:,}", row["method"], row["found"], same,
                      percent(row["mean"]), percent(row["hausdorff"])])
    return lines


def summary(rows, methods):
    lines = [["method", "right", "as the original's", "mean, % of the diagonal",
              "greatest Hausdorff, %"]]
    for method in methods:
        of = [row for row in rows if row["method"] == method.title]
        worst = max((row["hausdorff"] for row in of if row["hausdorff"] is not None), default=None)
        lines.append([method.title, f"{sum(row['right'] for row in of)} of {len(of)}",
                      f"{sum(row['same'] is True for row in of)} of {len(of)}",
                      percent(mean(row["mean"] for row in of)), percent(worst)])
    return lines


def section(key, title, words, ask, methods, groups, turn_back=None):
    rows = compared(ask, methods, groups, turn_back)
    return Section(key, title, words, [summary(rows, methods), table(rows)], rows)


def steps(methods, groups):
    """How many skeletons that takes."""
    return len(methods) * sum(1 + len(variants) for _, variants in groups)
