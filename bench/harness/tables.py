"""Tables as text and as Markdown, and their place in a document."""

import math
import re
from pathlib import Path

from . import machine


def number(value):
    """Three digits are enough for a time."""
    if value is None:
        return ""
    if value >= 100:
        return f"{value:.0f}"
    return f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def geometric_mean(values):
    values = list(values)
    return math.exp(sum(map(math.log, values)) / len(values)) if values else None


def text(rows):
    """Rows of words in columns; the first row is the heading; None is a line."""
    widths = [max(map(len, column)) for column in zip(*filter(None, rows))]
    lines = []
    for row in [rows[0], None, *rows[1:]]:
        if row is None:
            lines.append("-" * (sum(widths) + 2 * len(widths) - 2))
            continue
        first, *rest = (cell.ljust(width) if i == 0 else cell.rjust(width)
                        for i, (cell, width) in enumerate(zip(row, widths)))
        lines.append("  ".join([first, *rest]).rstrip())
    return "\n".join(lines) + "\n"


def markdown(rows):
    head, *body = filter(None, rows)
    lines = ["| " + " | ".join(head) + " |", "|---|" + "--:|" * (len(head) - 1)]
    lines += ["| " + " | ".join(row) + " |" for row in body]
    return "\n".join(lines) + "\n"


def write(stem, rows, notes, data):
    """STEM.txt, STEM.md and STEM.json beside the build; the text is printed too."""
    said = text(rows) + "\n" + "".join(f"{note}\n" for note in notes)
    page = markdown(rows) + "\n" + " ".join(notes) + "\n"
    for suffix, content in ((".txt", said), (".md", page), (".json", data)):
        machine.work(stem + suffix).write_text(content, encoding="utf-8")
    print(said, end="")
    return page


def put(place, page):
    """Replaces what stands between <!-- KEY --> and <!-- end of KEY -->; place is FILE#KEY."""
    path, _, key = place.partition("#")
    begin, end = f"<!-- {re.escape(key)} -->\n", f"<!-- end of {re.escape(key)} -->"
    pattern = re.compile(f"({begin}).*?({end})", re.S)
    before = Path(path).read_text(encoding="utf-8")
    after, count = pattern.subn(lambda m: f"{m.group(1)}\n{page}\n{m.group(2)}", before)
    if not key or count != 1:
        machine.die(f"{path} has no place <!-- {key} --> ... <!-- end of {key} -->")
    Path(path).write_text(after, encoding="utf-8")
