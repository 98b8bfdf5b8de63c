# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""The rows of docs/measured, and how they are written in a table."""
import fnmatch
import json

OURS, OBBRSS = "kios", "fcl_obbrss"


class Rows:
    """The rows of docs/measured, and the lines that open a run in `runs`."""

    def __init__(self, folder):
        self.runs, self.rows = {}, []
        for file in sorted(folder.glob("*.jsonl")):
            for line in map(json.loads, file.read_text(encoding="utf-8").splitlines()):
                if "run" in line:
                    self.runs[line["run"]] = line
                else:
                    self.rows.append(line)

    def find(self, scenario, query, bv=OURS, **settings):
        for row in self.rows:
            if (row["scenario"], row["query"], row["bv"]) == (scenario, query, bv) and all(
                    row.get(key) == value for key, value in settings.items()):
                return row
        raise LookupError(f"no row of {scenario}, {query}, {bv} {settings or ''}")

    def scenarios(self, pattern):
        """In the order of the run."""
        found = dict.fromkeys(row["scenario"] for row in self.rows)
        return [scenario for scenario in found if fnmatch.fnmatchcase(scenario, pattern)]

    def us(self, *key, **settings):
        """Time of a query; of the mean pair, where a frame asks for several."""
        row = self.find(*key, **settings)
        whole = row["query"] in ("scene", "motion", "clashes", "contact")
        pairs = None if whole else row.get("total_pairs")
        return row["median_us"] / (pairs / row["frames"] if pairs else 1)

    def ratio(self, scenario, query, bv=OBBRSS, **settings):
        """How many times our time the other volume takes: above 1, ours is faster. It is the
        quotient of the medians that tables show."""
        return self.us(scenario, query, bv, **settings) / self.us(scenario, query, **settings)

    def with_ratio(self, *key, show=None):
        return f"{(show or number)(self.us(*key))} ({number(self.ratio(*key))})"


def number(value):
    if value is None:
        return ""
    if isinstance(value, int) or value >= 99.5:
        return f"{value:,.0f}"
    return f"{value:.3g}" if value >= 1 else f"{value:.2g}"


def span(values):
    """The least and the largest, or one where they are written alike."""
    texts = list(dict.fromkeys(map(number, sorted(values))))
    return f"{texts[0]} to {texts[-1]}" if len(texts) > 1 else texts[0]


def time(us):
    return number(us / 1000) + " ms" if us >= 1000 else number(us) + " us"


def spec(text):
    """Lines `label | word ... name=number ...` as (label, words and settings)."""
    out = []
    for line in text.strip().splitlines():
        label, _, words = (part.strip() for part in line.rpartition("|"))
        settings = dict(word.split("=") for word in words.split() if "=" in word)
        out.append((label, ([word for word in words.split() if "=" not in word],
                            {key: float(value) for key, value in settings.items()})))
    return out


def table(head, lines):
    align = ["---"] + ["--:"] * (len(head) - 1)
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in [head, align, *lines])


def grid(corner, lines, columns, cell):
    """A table of lines and columns by label; a cell is cell(words of its line, words of its
    column, the settings of both), and empty where a volume has no such row."""
    def text(line, column):
        try:
            return cell(line[0], column[0], {**line[1], **column[1]})
        except LookupError:
            if line[0][-1:] == [OURS] or column[0][-1:] == [OURS]:
                raise
            return ""
    return table([corner, *(label for label, _ in columns)],
                 [[label, *(text(line, column) for _, column in columns)] for label, line in lines])
