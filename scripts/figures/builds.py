# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of building and refitting models."""
from figures.rows import OBBRSS, grid, number, spec, time


BUILDERS = spec("""
k-IOS: `endModel`            | build kios
the same again               | again kios
OBBRSS: `endModel`           | build fcl_obbrss
""")
BUILT = spec("""
1k triangles          | welded/1000
20k                   | welded/20000
80k                   | welded/80000
80k, no shared vertex | soup/80000
UR5, 7 links          | ur5
""")


def building(rows):
    def cell(line, column, _):
        us = rows.us(f"build/{column[0]}", *line)
        return f"{time(us)} ({number(us / rows.us(f'build/{column[0]}', 'build', OBBRSS))})"
    return grid("time (by OBBRSS's `endModel`)", BUILDERS, BUILT, cell)


def memory(rows):
    lines = spec("""
k-IOS                         | build kios
OBBRSS                        | build fcl_obbrss
""")
    columns = spec("""
80k triangles         | welded/80000
80k, no shared vertex | soup/80000
UR5, 7 links          | ur5
""")

    def cell(line, column, _):
        row = rows.find(f"build/{column[0]}", *line)
        return f"{number(row['bytes_per_triangle'])} ({number(row['peak_bytes_per_triangle'])})"
    return grid("bytes a triangle (peak)", lines, columns, cell)


def refits(rows):
    lines = spec("""
`endReplaceModel(false)`: rebuild | refit/5000/rebuild kios
`endReplaceModel(true, false)`: refit top-down | refit/5000/top_down kios
`endReplaceModel(true, true)`: refit bottom-up | refit/5000/bottom_up kios
OBBRSS: rebuild | refit/5000/rebuild fcl_obbrss
OBBRSS: refit bottom-up | refit/5000/bottom_up fcl_obbrss
""")
    columns = spec("""
change and first query | refit median_us
distance after it | distance median_us
volume tests | distance bv_tests
worst error | distance max_abs_error
""")

    def cell(line, column, _):
        value = rows.find(line[0], column[0], line[1])[column[1]]
        if column[1] == "max_abs_error":
            return f"{value:.0e}"
        return time(value) if column[1] == "median_us" else number(value)
    return grid("two tori of 5,000 triangles", lines, columns, cell)
