# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the triangle kernels get wrong: docs/stability.md, and phrases of README.md."""
from figures.rows import OURS, grid, spec


def worst_triangles(rows):
    """What FCL's triangle kernels get wrong."""
    def of(query, bv):
        return [row for row in rows.rows if row["scenario"].startswith("stability/")
                and (row["query"], row["bv"]) == (query, bv)]

    def wrong(query, bv):
        return sum(row["wrong_verdicts"] for row in of(query, bv))
    assert wrong("distance", OURS) == wrong("collide", OURS) == 0
    distances = of("distance", "fcl")
    worst = max(row.get("max_abs_error", 0) for row in distances)
    return (f"of {sum(row['frames'] for row in distances):,} hard pairs of triangles, FCL's "
            f"distance is 0 for pairs that are apart, or not 0 for pairs that meet, in "
            f"{wrong('distance', 'fcl'):,}, and off by up to {worst:.2g} of the pair's size or not "
            f"finite; its intersection test is wrong for {wrong('collide', 'fcl'):,}; ours are "
            f"wrong for none")


def wrong_zeros(rows):
    """How often FCL's triangle distance says contact for none, or none for contact."""
    found = [rows.find(scenario, "distance", "fcl") for scenario in rows.scenarios("stability/*")]
    return (f"{sum(row['wrong_verdicts'] for row in found):,} of "
            f"{sum(row['frames'] for row in found):,}")


FAMILIES = ["random", "interpenetrating", "small near large", "edges at", "parallel edges", "faces at",
            "needles", "cap", "over a sliver", "beyond a sliver", "gap", "penetration", "lattice",
            "vertex on", "edge", "one ulp from contact", "shared", "identical", "nearly identical",
            "signed zeros", "coplanar", "segment", "point", "same point", "collinear",
            "repeated vertices", "offset", "scale", "size ratio", "exponents", "denormal",
            "around the least normal"]


def stability(rows):
    """The worst of each family of classes, a family by how the names of its classes begin."""
    classes = rows.scenarios("stability/*")
    family = {name: next(f for f in FAMILIES if name[10:].startswith(f)) for name in classes}
    columns = spec("""
error: k-IOS         | distance max_abs_error kios
FCL                  | distance max_abs_error fcl
wrong 0: k-IOS       | distance wrong_verdicts kios
FCL                  | distance wrong_verdicts fcl
wrong verdict: k-IOS | collide wrong_verdicts kios
FCL                  | collide wrong_verdicts fcl
""")

    def label(names):
        return names[0][10:] if len(names) == 1 else f"{family[names[0]]} ..., {len(names)} classes"

    def cell(line, column, _):
        query, key, bv = column
        values = [rows.find(name, query, bv).get(key) for name in line]
        if None in values:
            return "not finite"
        return f"{max(values):.1e}" if key == "max_abs_error" else str(sum(values))
    groups = [[name for name in classes if family[name] == f] for f in FAMILIES]
    # Those in which FCL's error, too, is below the bound of ours are one row.
    small = [names for names in groups if all(
        rows.find(name, "distance", "fcl").get("max_abs_error", 1) <= 16 * 2**-52 for name in names)]
    lines = [(label(names), (names, {})) for names in groups if names and names not in small]
    small = sum(small, [])
    return grid("class", [*lines, (f"the other {len(small)} classes", (small, {}))], columns, cell)


STRESS = spec("""
nearest point        | nearest
signed distance      | signed
winding number       | winding
local depth          | depth
deeper than?         | deeper
clashes              | clashes
""")


def stress(rows):
    """Answers that are wrong, and left open, by class of solids; those without any are one row."""
    def cell(line, column, _):
        found = [rows.find(name, column[0]) for name in line]
        wrong, frames, left = (sum(row[key] for row in found)
                               for key in ("wrong_verdicts", "frames", "undecided"))
        return f"{wrong} of {frames:,}" + (f", {left} open" if left else "")
    def clean(name):
        found = [rows.find(name, *query) for _, (query, _) in STRESS]
        return not any(row["wrong_verdicts"] + row["undecided"] for row in found)

    def label(names):
        return ", ".join(name.split("/", 1)[1] for name in names)
    names = rows.scenarios("stress/*")
    groups = [list(filter(clean, names)), *([name] for name in names if not clean(name))]
    return grid("wrong", [(label(group), (group, {})) for group in groups if group], STRESS, cell)
