"""Experiments that look at topology and quality: small features, clouds, few faces, hollow shapes."""

from harness import tables
from harness.trials import counts_words

from .section import Section, mean, percent


def expected_words(subject):
    """What the manifest asks for."""
    def one(value):
        return f"{value[0]}–{value[1]}" if isinstance(value, list) else str(value)
    return "/".join(one(subject.expected.get(key, "any")) for key in ("components", "cycles", "tips"))


def counted_section(key, title, words, ask, methods, subjects, folder, drawn):
    """Counts by every method; pictures of the shapes that `drawn` names, by the first method."""
    rows, lines, pictures = [], [["shape", "asked", *(m.title for m in methods)]], []
    for subject in subjects:
        made = [ask.skeleton(method, subject) for method in methods]
        rows.append({"shape": subject.name,
                     **{m.title: counts_words(result) for m, result in zip(methods, made)}})
        lines.append([subject.name, expected_words(subject), *map(counts_words, made)])
        if subject.name in drawn and "failed" not in made[0]:
            pictures.append((ask.picture(f"{key}_{subject.name}", subject, made[0]["path"], folder),
                             f"{subject.name}, {methods[0].title}"))
    right = [["", "", *(f"{sum(ask.skeleton(m, s).get('right', False) for s in subjects)} of "
                        f"{len(subjects)} right" for m in methods)]]
    return Section(key, title, words, [lines + right], rows, pictures)


def features_section(ask, method, images, subjects, folder, drawn):
    """Tips by the size of the images."""
    tried = [method, *(method.with_options("--image", str(image)) for image in images)]
    names = ["default", *(f"{image}²" for image in images)]
    rows, pictures = [], []
    lines = [["shape", "asked", *names, *(f"{name}, ms" for name in names)]]
    for subject in subjects:
        made = [ask.skeleton(m, subject) for m in tried]
        lines.append([subject.name, expected_words(subject), *map(counts_words, made),
                      *(tables.number(result.get("ms")) for result in made)])
        rows.append({"shape": subject.name, **dict(zip(names, map(counts_words, made)))})
        if subject.name in drawn:
            pictures += [(ask.picture(f"features_{subject.name}_{name.strip('²')}", subject,
                                      result["path"], folder), f"{subject.name}, {name}")
                         for name, result in zip(names, made) if "failed" not in result]
    words = ("Components/cycles/tips by the size of the images; by default Marrow looks again at "
             "512² where parts are thinner than a pixel.")
    return Section("features", "Fig. 13: small features", words, [lines], rows, pictures)


def quality_section(ask, methods, subjects):
    keys = ("centredness", "outside_percent", "reconstruction_percent")
    rows = []
    for subject in subjects:
        for method in methods:
            made = ask.skeleton(method, subject)
            told = {} if "failed" in made else ask.quality(method, subject, made["path"])
            rows.append({"shape": subject.name, "method": method.title,
                         "found": counts_words(made), **{key: told.get(key) for key in keys}})
    lines = [["method", "shapes", "centredness", "outside, %", "reconstruction, %"]]
    for method in methods:
        of = [row for row in rows if row["method"] == method.title
              and row["centredness"] is not None]
        lines.append([method.title, str(len(of)), *(percent(mean(row[key] for row in of))
                                                    for key in keys)])
    detail = [["shape", "method", "components/cycles/tips", "centredness", "outside, %",
               "reconstruction, %"]]
    detail += [[row["shape"], row["method"], row["found"], *(percent(row[key]) for key in keys)]
               for row in rows]
    words = ("By `marrow check`. Centredness: how much nearer one side of the wall is than the other, "
             "across the line, 0 is the middle; outside: share of the length; reconstruction: mean "
             "distance of the surface from the balls in % of the diagonal (peers give no radii: "
             "theirs are the inscribed balls).")
    return Section("quality", "Centred, inside, complete", words, [lines, detail], rows)
