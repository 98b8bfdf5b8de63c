# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of robots."""
from figures.rows import grid, spec, time


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

    return grid("a pair of links (OBBRSS by ours)", lines, columns, lambda line, column, _: (
        rows.with_ratio(f"robots/{column[0]}{line[0].strip('-')}", line[1], show=time)))
