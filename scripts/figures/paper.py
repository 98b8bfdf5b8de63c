# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of docs/paper.md and docs/exact-distance.md."""
from figures.rows import OURS, grid, number, spec


def fits(rows):
    volumes = dict.fromkeys(row["bv"] for row in rows.rows if row["scenario"] == "fits/falling")
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


def packing(rows):
    lines = spec("""
scalar, one pair after the other       | scalar
the paper's: four at a time, 128 bits  | packed_by_four
`kios::separation`, with all pads      | kios_separation
eight volumes at a time, SSE4          | kios_eight_nodes SSE4
eight volumes at a time, AVX2          | kios_eight_nodes AVX2
eight volumes at a time, AVX-512       | kios_eight_nodes AVX3
""")
    columns = spec("""
Method II: distance, ns | packing/method_ii distance median_us
overlap, ns             | packing/method_ii collide median_us
tests                   | packing/method_ii distance bv_tests
tuned: distance, ns     | packing/tuned distance median_us
overlap, ns             | packing/tuned collide median_us
tests                   | packing/tuned distance bv_tests
""")

    def cell(line, column, _):
        bv, *target = line
        settings = {"simd_target": target[0]} if target else {}
        value = rows.find(*column[:2], bv, **settings)[column[2]]
        return number(1000 * value if column[2] == "median_us" else value)
    return grid("test of two volumes", lines, columns, cell)


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


def figure_6(rows):
    lines = spec("""
two UR5 arms            | paper/arms_ur5
two generated arms      | paper/arms
two humanoids, 19 links | paper/humanoids
the same, links as ellipsoids of well-shaped triangles | paper/humanoids_rounded
""")
    columns = spec("""
Method II       | kios_method_ii
tuned           | kios_tree
engine          | kios
SSV (FCL's RSS) | fcl_rss_tree
""")

    def cell(line, column, _):
        row = rows.find(line[0], "distance", column[0])
        ms = f"{row['median_us'] / 1000:.3g}"
        if column[0] == "fcl_rss_tree":
            return ms
        return f"{ms} ({number(row['ratio_to_ssv'])}, {number(row['max_ratio_to_ssv'])})"
    return grid("ms a frame (times faster than RSS: mean, best frame)", lines, columns, cell)


def exact(rows):
    lines = spec("\n".join(f"{n} | exact/{n}" for n in (1, 2, 4, 16, 64)))
    columns = spec("""
`separation()`, us            | kios_separation median_us
FCL's RSS, us                 | fcl_rss median_us
exact, us                     | kios_exact median_us
exact, bodies made before, us | kios_exact_prepared median_us
tightness: `separation()`     | kios_separation tightness
FCL's RSS                     | fcl_rss tightness
exact                         | kios_exact tightness
""")
    return grid("triangles", lines, columns, lambda line, column, _: number(
        rows.find(line[0], "distance", column[0])[column[1]]))
