"""A section of docs/results.md."""

from dataclasses import dataclass, field

from harness import curves, tables


@dataclass
class Section:
    """What one experiment says: words, tables, and figures for a CSV."""
    key: str
    title: str
    words: str
    tables: list = field(default_factory=list)  # of rows of words, the first one the heading
    rows: list = field(default_factory=list)    # of dicts
    pictures: list = field(default_factory=list)  # (file name, words)

    def page(self, folder):
        """Markdown; the CSV goes into `folder`."""
        parts = [f"## {self.title}\n", self.words + "\n"]
        parts += [tables.markdown(rows) for rows in self.tables]
        if self.rows:
            keys = list(dict.fromkeys(key for row in self.rows for key in row))
            curves.write_csv(folder / f"{self.key}.csv",
                             [{key: row.get(key, "") for key in keys} for row in self.rows])
            parts.append(f"All figures: [{self.key}.csv]({folder.name}/{self.key}.csv)\n")
        parts += [f"![{words}]({folder.name}/{name})\n" for name, words in self.pictures]
        return "\n".join(parts)


def percent(value):
    return "" if value is None else f"{value:.3f}"


def mean(values):
    values = [v for v in values if v is not None]
    return sum(values) / len(values) if values else None
