# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of robots."""
from figures.rows import OBBRSS, OURS, grid, number, spec, time


def links(rows):
    """What a pair costs: ours, and how many times that OBBRSS takes."""
    lines = spec("""
distance                                       | - distance
the same, after other work                     | /cold distance
collide                                        | - collide
the same, after other work                     | /cold collide
""")
    columns = spec("""
UR5 | ur5
generated arm | generated
machine parts | parts
""")

    def cell(line, column, _):
        place, query = line
        key = f"robots/{column[0]}{place.strip('-')}", query
        return f"{time(rows.us(*key, OURS))} ({number(rows.us(*key, OBBRSS) / rows.us(*key, OURS))})"
    return grid("a pair of links (OBBRSS by ours)", lines, columns, cell)
