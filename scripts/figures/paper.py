# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of docs/paper.md."""
from figures.rows import OURS, grid, number, spec


def fits(rows):
    volumes = dict.fromkeys(row["bv"] for row in rows.rows if row["scenario"] == "fits/falling"
                            and not row["bv"].endswith(("_shared", "_k5")))
    columns = spec("""
tests, falling / spinning | distance bv_tests falling spinning
us                        | distance median_us falling spinning
contact tests             | collide bv_tests falling
us                        | collide median_us falling
build, us a triangle      | collide build_us_per_triangle falling
k                         | collide mean_spheres falling
floats                    | collide floats_per_bv falling
bytes                     | collide bytes_per_triangle falling
tightness                 | collide tightness falling
""")

    def cell(line, column, _):
        query, key, *scenes = column
        parts = 2 if key == "bytes_per_triangle" else 1  # a triangle has two volumes
        found = (rows.find(f"fits/{scene}", query, line[0])[key] for scene in scenes)
        return " / ".join(number(value / parts) for value in found)
    return grid("volume", [(f"`{bv}`", ([bv], {})) for bv in volumes], columns, cell)


PAPER = {  # its k-IOS and its PQP
    ("falling", "collide", "median_us"): ("0.135", "0.269"),
    ("falling", "collide", "bv_tests"): ("798", "568"),
    ("falling", "distance", "median_us"): ("0.494", ""),
    ("spinning", "collide", "median_us"): ("0.000419", ""),
    ("spinning", "distance", "median_us"): ("0.494", "0.495"),
    ("spinning", "distance", "bv_tests"): ("1,896", "1,194"),
}


def table_i(rows):
    lines = spec("\n".join(f"{scene}, {name}: {label} | {scene} {query} {key}"
                           for scene in ("falling", "spinning")
                           for name, query in (("collision", "collide"), ("distance", "distance"))
                           for label, key in (("ms", "median_us"), ("tests", "bv_tests"))))
    columns = spec("""
Method II       | kios_method_ii
tuned           | kios_tree
engine          | kios
SSV (FCL's RSS) | fcl_rss_tree
OBBRSS          | fcl_obbrss
paper: k-IOS    | paper 0
paper: PQP      | paper 1
""")

    def cell(line, column, _):
        scene, query, key = line
        if column[0] == "paper":
            return PAPER.get((scene, query, key), ("", ""))[int(column[1])] or "not in the paper"
        value = rows.find(scene, query, column[0])[key]
        if key == "median_us":
            return f"{value / 1000:.3g}"
        return number(value / 2 if query == "distance" and column[0] != OURS else value)
    return grid("scene, query", lines, columns, cell)
