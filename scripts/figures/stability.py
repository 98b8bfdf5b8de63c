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
    def is_small(name):
        return rows.find(name, "distance", "fcl").get("max_abs_error", 1) <= 16 * 2**-52
    small = [names for names in groups if all(map(is_small, names))]
    lines = [(label(names), (names, {})) for names in groups if names and names not in small]
    small = sum(small, [])
    return grid("class", [*lines, (f"the other {len(small)} classes", (small, {}))], columns, cell)


STRESS = spec("""
nearest points    | nearest
signed distances  | signed
winding numbers   | winding
local depths      | depth
`deeperThan`      | deeper
pairs of parts    | clashes
""")


def stress(rows):
    """How many answers are wrong, how many left open, and in which classes of solids."""
    names = rows.scenarios("stress/*")
    phrases = []
    for label, (query, _) in STRESS:
        found = {name: rows.find(name, *query) for name in names}
        assert not any(row["wrong_verdicts"] for row in found.values())
        frames, left = (sum(row[key] for row in found.values()) for key in ("frames", "undecided"))
        phrases.append(f"{frames:,} {label}" + (f" ({left} open)" if left else ""))
    open_for = [name.split("/", 1)[1] for name in names if rows.find(name, "depth")["undecided"]]
    return f"none is wrong of {', '.join(phrases)}; depths are open for {', '.join(open_for)}"
