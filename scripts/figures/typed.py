# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Finds times, ratios and shares that somebody typed into a page."""
import re

BLOCK = re.compile(r"<!-- report:(.+?) -->(.*?)<!-- /report -->", re.DOTALL)
HIDDEN = [BLOCK.pattern, r"```.*?```", r"<!--.*?-->", r"`[^`\n]*`", r"\]\([^)]*\)"]

COUNT = r"(?:\d[\d.,]*(?:e-?\d+)?|two|three|four|five|six|seven|eight|nine|ten|\w+teen|\w+ty)"
PART = r"(?:half|thirds?|quarters?|fifths?|sixths?|sevenths?|eighths?|tenths?|twice|thrice)"
FIGURE = re.compile(
    rf"\b{COUNT} ?(?:[unµm]s\b|s\b|seconds?\b|minutes?\b|hours?\b|times\b|%|per ?cent\b)"
    rf"|\b\d[\d.]*x\b|(?<![\w/^])\d+/\d+\b(?!/)"
    rf"|\b{PART} (?:as |of (?:the|its|their|our|FCL\S*) (?:time|speed)|faster|slower)"
    rf"|\b{PART} (?:less|more|longer)\b"
    rf"|\b(?:faster|slower|cheaper|dearer|longer) by (?:a |an |two |three |four )?{PART}\b")
UNIT = re.compile(r"\b([unµm]s|seconds?|times)\b")
DECIMALS = re.compile(r"[-\d.,/()e ]*\d\.\d[-\d.,/()e ]*")  # a cell of nothing but numbers


def cells_of(lines):
    """The cells of tables with a number in a column of times, or with decimals alone."""
    timed = []  # by column of the present table: whether its head names a unit of time
    for number, line in enumerate(lines, 1):
        cells = line.split("|")[1:-1] if line.startswith("|") else []
        if not cells:
            timed = []
        elif not timed:
            timed = [bool(UNIT.search(cell)) for cell in cells]
        else:
            for is_time, cell in zip(timed, cells):
                if re.search(r"\d", cell) if is_time else DECIMALS.fullmatch(cell):
                    yield number, cell.strip()


# A default and its value, in either order.
DEFAULT = re.compile(rf"\bdefaults?(?:\s+(?:is|are|of|to))?[:=]?\s+(?:a\s+)?(?:{COUNT}|million)\b"
                     rf"|\b(?:{COUNT}|million)\s+(?:by default|is the default)", re.I)

# The same after the name of what it belongs to: `name` (12.
VALUE_OF = re.compile(r"`[\w:.-]+`\s\(\d[\d.,]*\b")


def typed(text):
    """Measured figures and defaults outside of blocks, code and links, as (number of the line,
    figure, the line with its neighbours)."""
    lines = text.splitlines()
    for hidden in HIDDEN[:-2]:  # all but code spans and links
        text = re.sub(hidden, lambda match: re.sub(r"[^\n]", " ", match[0]), text, flags=re.DOTALL)
    values = [(text.count("\n", 0, match.start()) + 1, " ".join(match[0].split()))
              for match in VALUE_OF.finditer(text)]
    for hidden in HIDDEN:
        text = re.sub(hidden, lambda match: re.sub(r"[^\n]", " ", match[0]), text, flags=re.DOTALL)
    shown = text.splitlines()
    found = [(number, match[0]) for number, line in enumerate(shown, 1)
             for match in FIGURE.finditer(line)]
    joined = "\n".join(shown)
    found += [(joined.count("\n", 0, match.start()) + 1, " ".join(match[0].split()))
              for match in DEFAULT.finditer(joined)]
    for number, figure in sorted({*found, *values, *cells_of(shown)}):
        yield number, figure, " ".join(map(str.strip, lines[max(0, number - 2):number + 1]))
