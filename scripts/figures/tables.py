# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""The blocks of README.md and docs/*.md by name, as functions of the measured rows.

A block `<!-- report:NAME -->` is the table NAME(rows) below; of several words, as
`<!-- report:run falling -->`, its function gets the others."""
from figures.builds import building, memory, refits  # noqa: F401
from figures.motions import mbm, motions  # noqa: F401
from figures.names import default, names  # noqa: F401
from figures.paper import fits, table_i  # noqa: F401
from figures.rows import OBBRSS, OURS, grid, number, span, spec, table, time
from figures.stability import stability, stress, worst_triangles, wrong_zeros  # noqa: F401
from figures.world import coal, world, world_shapes  # noqa: F401


# Phrases.

def run(rows, scenario):
    """Machine and its load, date and commit of a run."""
    of = rows.runs[scenario]
    return f"{of['machine']}, load {of['load']}, {of['date']}, commit {of['commit']}"


def ratio(rows, *key):
    return number(rows.ratio(*key))


def ratios(rows, query, *scenarios):
    """The least and the largest ratio to OBBRSS."""
    found = sorted(rows.ratio(scenario, query) for scenario in scenarios)
    return f"{number(found[0])} to {number(found[-1])}"


# README.md

README = spec("""
distance, UR5's links and a room                 | world/room/ur5 distance fcl_obbrss
first contact, UR5's links and a shelf           | world/shelf/ur5 collide fcl_obbrss
distance, falling tori                           | falling distance fcl_obbrss
distance, spinning bunny and torus               | spinning distance fcl_obbrss
distance, two UR5 arms, a pair of links          | robots/ur5 distance fcl_obbrss
distance, tori of 80,000 triangles, gap 0.001    | scaling/80000/gap_1e-3 distance fcl_obbrss
first contact, falling tori                      | falling collide fcl_obbrss
first contact, two UR5 arms, a pair of links     | robots/ur5 collide fcl_obbrss
distance, UR5's links and a building             | coal/building/ur5 distance coal_obbrss
first contact, links off a floor                 | world/floor/ur5/apart collide fcl_obbrss
nearer than 1.1 times the distance? falling tori | error/falling threshold fcl_obbrss threshold=1.1
closest of all pairs, two humanoids              | robots/humanoids/smooth/closest scene fcl_manager
all contacts of a mesh and a convex shape        | shapes/convex contacts fcl_obbrss
moving tori, linear motion                       | continuous/linear continuous fcl_obbrss_sampling
a path of 0.2 rad is free, UR5 in a cell         | motions/ur5_cell/valid/0.2 motion fcl_obbrss
the least clearance over a path, to 1 mm, UR5    | motions/range/ur5/path range fcl_obbrss_samples
first hit of a random ray, 80,000 triangles      | rays/80000/random first embree
build a torus of 80,000 triangles                | build/welded/80000 build fcl_obbrss
build an equal one                               | build/welded/80000 again fcl_obbrss build
distance of a point, ours signed, 84,000 triangles | points/torus signed fcl_obbrss ball
contacts of a building's 10,000 parts            | clashes/10000 contact fcl_manager
""")
OTHERS = {OBBRSS: "FCL OBBRSS", "fcl_manager": "FCL's manager, OBBRSS", "embree":
          "Embree, single precision", "coal_obbrss": "Coal OBBRSS",
          "fcl_obbrss_sampling": "FCL OBBRSS, 1,000 samples",
          "fcl_obbrss_samples": "FCL OBBRSS, a sample each 2 mm",
          "fcl_obbrss_advancement": "FCL OBBRSS, advancement"}


def against(rows):
    """The questions of the README as (label, our time, the other's, its name); a fourth word is the
    query that the other has instead."""
    for label, ((scenario, query, bv, *theirs), settings) in README:
        yield (label, rows.us(scenario, query, **settings),
               rows.us(scenario, *(theirs or [query]), bv, **settings), OTHERS[bv])


def readme(rows, count=None):
    """All questions, or the first ones."""
    out = [[label, time(ours), time(other), name, number(other / ours)]
           for label, ours, other, name in list(against(rows))[:count and int(count)]]
    return table(["question", "k-IOS", "the other", "", "other / k-IOS"], out)


# docs/scene.md

def crowds(rows):
    lines = spec("""
crowd: closest pair   | scene/crowd/closest
crowd: within 0.1     | scene/crowd/within
roadmap: closest pair | scene/roadmap/closest
roadmap: within 0.1   | scene/roadmap/within
""")
    columns = spec("""
SceneDistance      | median_us kios
FCL's manager      | median_us fcl_manager
manager / ours     | ratio
searches           | narrow_queries kios
manager's searches | narrow_queries fcl_manager
""")
    return grid("us a frame", lines, columns, lambda line, column, _: number(
        rows.ratio(line[0], "scene", "fcl_manager") if column == ["ratio"]
        else rows.find(line[0], "scene", column[1])[column[0]]))


# docs/settings.md

def calls(rows):
    lines = spec("""
do they touch? `fcl::collide`, one contact | collide kios
nearer than ten times the distance? `kios::closerThan` | threshold kios threshold=10
nearer than 1.1 times | threshold kios threshold=1.1
how far, exactly? `fcl::distance`, `kios::distanceBracket` | distance kios rel_err=0 abs_err=0
how far, within a tenth? `rel_err = 0.1` | distance kios rel_err=0.1 abs_err=0
how far, within 0.1? `abs_err = 0.1` | distance kios rel_err=0 abs_err=0.1
a bracket after 32 expansions: `max_expansions = 32` | budget kios budget=32
FCL's OBBRSS: do they touch? | collide fcl_obbrss
FCL's OBBRSS: how far? | distance fcl_obbrss rel_err=0 abs_err=0
""")
    columns = spec("falling | falling\nspinning | spinning\ngenerated | generated")

    def cell(line, column, settings):
        scenario = f"error/{column[0]}"
        if line[0] == "collide":
            scenario = column[0].replace("generated", "generated/falling")
        return number(rows.us(scenario, *line, **settings))
    return grid("us", lines, columns, cell)


# docs/continuous.md, docs/shapes.md, docs/rays.md

def continuous(rows):
    columns = spec("""
volume tests       | bv_tests kios
triangle tests     | leaf_tests kios
k-IOS              | median_us kios
wrong              | wrong kios
FCL, 1,000 samples | median_us fcl_obbrss_sampling
wrong              | wrong fcl_obbrss_sampling
FCL, advancement   | median_us fcl_obbrss_advancement
wrong              | wrong fcl_obbrss_advancement
""")

    def cell(line, column, _):
        row = rows.find(f"continuous/{line[0]}", "continuous", column[1])
        if column[0] == "wrong":
            return f"{row['wrong_verdicts']} of {row['frames']}"
        return time(row[column[0]]) if column[0] == "median_us" else number(row[column[0]])
    motions = spec("\n".join(f"{motion} | {motion}"
                             for motion in ("translation", "linear", "screw", "spline")))
    return grid("motion", motions, columns, cell)


def shapes(rows):
    lines = [(scenario.split("/")[1].replace("shell", "octree"), ([scenario], {}))
             for scenario in rows.scenarios("shapes/*") + rows.scenarios("octrees/*")]
    columns = spec("""
distance          | distance
FCL's worst error | distance error
first contact     | collide
all contacts      | contacts
""")

    def cell(line, column, _):
        if column[1:]:
            return f"{rows.find(line[0], 'distance', OBBRSS)['max_abs_error']:.0e}"
        return f"{number(rows.us(line[0], *column))} ({number(rows.ratio(line[0], *column))})"
    return grid("us (OBBRSS / k-IOS)", lines, columns, cell)


def rays(rows):
    lines = [(", ".join(scenario.split("/")[1:]), ([scenario], {}))
             for kind in ("80000", "strips") for scenario in rows.scenarios(f"rays/{kind}/*")]
    columns = spec("""
k-IOS          | us kios
Embree         | us embree
volume tests   | bv_tests
triangle tests | leaf_tests
Embree differs | wrong embree
""")

    def cell(line, column, _):
        if len(column) == 1:
            return number(rows.find(line[0], "first")[column[0]])
        asked = [(line[0], query, column[1]) for query in ("first", "any", "all")]
        return " / ".join(number(rows.us(*key)) if column[0] == "us"
                          else str(rows.find(*key)["wrong_verdicts"]) for key in asked)
    return grid("us: first / any / all hits", lines, columns, cell)


# docs/solids.md

def containment(rows):
    """Time of a point, and the points that were judged wrongly."""
    found = [rows.find(scenario, "contains") for scenario in rows.scenarios("solids/contains/*")]
    return (f"{span(row['median_us'] for row in found)} us a point, and is wrong for "
            f"{sum(row['wrong_verdicts'] for row in found)}")


def solids(rows):
    scenes = {}
    for scenario in rows.scenarios("solids/*"):
        scene = scenario.split("/")[1]
        if scene not in ("contains", "depth", "points"):
            scenes.setdefault(scene.replace("_", " "), []).append(scenario)

    def line(name, of):
        found = [rows.find(scenario, "penetration") for scenario in of]
        ratios = [row["median_us"] / rows.us(scenario, "collide")
                  for row, scenario in zip(found, of)]
        off = [rows.find(scenario, "contacts", OBBRSS)["mean_rel_error"] for scenario in of]
        return [name + (f", {len(of)} links" if len(of) > 1 else ""),
                sum(row["frames"] for row in found), span(row["median_us"] for row in found),
                span(map(round, ratios)), span(row["bracket_ratio"] for row in found),
                number(max(row.get("max_bracket_ratio", 0) for row in found)),
                sum(row["wrong_verdicts"] for row in found),
                span(round(100 * error) for error in off) + " %"]
    return table(["scene", "frames", "us", "in collide queries", "upper / lower, median",
                  "largest", "wrong", "FCL's deepest contact off by"],
                 [line(*scene) for scene in scenes.items()])


def depths(rows):
    lines = []
    for scenario in rows.scenarios("solids/depth/*"):
        of = [rows.find(scenario, "depth", rel_err=e) for e in (0.3, 0.1, 0.03, 0.01, 0.001)]
        deeper = [rows.find(scenario, "deeper", threshold=t) for t in (0.5, 1.5)]
        lines.append([scenario[13:].replace("/", ", "), f"{of[0]['triangles']:,}",
                      number(rows.us(scenario, "collide")),
                      *(number(row["median_us"]) for row in of + deeper),
                      sum(row["wrong_verdicts"] for row in of + deeper)])
    return table(["scene", "triangles", "collide", "rel_err 0.3", "0.1", "0.03", "0.01", "0.001",
                  "deeper than half?", "than 1.5 times?", "wrong"], lines)


# docs/robot.md, docs/points.md, docs/clash.md

def moved(rows):
    def us(query, bv=OURS):
        return time(rows.us("motions/moved", query, bv))
    return (f"{us('move')}, and the next question whether the arm touches anything comes after "
            f"{us('moved')} in all, where making all anew takes {us('moved', 'kios_anew')}")


def points(rows):
    columns = spec("""
torus of 84,000 triangles | points/torus
scan of 500,000           | points/scan
""")
    lines = spec("""
signed distance          | signed kios
nearest point            | nearest kios
a ball, `fcl::distance`  | ball kios
a ball, FCL's OBBRSS     | ball fcl_obbrss
winding number to 0.01   | winding_0.01 kios
to 0.001                 | winding_0.001 kios
to 1e-6                  | winding_1e-06 kios
""")

    def cell(line, column, _):
        row = rows.find(*column, line[0].replace("_", " "), line[1])
        error = row.get("max_abs_error")
        return number(row["median_us"]) + (f" (off by {error:.0e})" if error else "")
    return grid("us a point", lines, columns, cell)


def clashes(rows):
    columns = spec("""
parts                      | bodies clashes kios
pairs with a status        | total_pairs clashes kios
`findClashes`              | median_us clashes kios
wrong                      | wrong_verdicts clashes kios
contacts, k-IOS            | median_us contact kios
contacts, OBBRSS           | median_us contact fcl_manager
clashes that these miss    | wrong_verdicts contact fcl_manager
""")
    lines = [(f"{int(scenario.split('/')[1]):,}", ([scenario], {}))
             for scenario in rows.scenarios("clashes/*0")]

    def cell(line, column, _):
        value = rows.find(line[0], *column[1:])[column[0]]
        return time(value) if column[0] == "median_us" else f"{value:,}"
    return grid("building", lines, columns, cell)


def block(rows, name):
    """The text of a block; LookupError if there is no such block, or no row for it."""
    word, *others = name.split()
    make = globals().get(word)
    if not callable(make) or word in ("grid", "number", "span", "spec", "table", "time",
                                         "block"):
        raise LookupError(f"scripts/figures/tables.py has no block '{name}'")
    return make(rows, *others)


# docs/python.md

def python(rows):
    """What addons/python/bench.py measured."""
    def cells(row):
        other, ratio = row.get("other_us"), row.get("ratio")
        return [row["what"], time(row["median_us"]), time(other) if other else "",
                number(ratio) if ratio else ""]
    found = [row for row in rows.rows if row["scenario"].startswith("python/")
             and not row["what"].startswith("the same of")]
    if not found:
        raise LookupError("no row of python")
    return table(["what", "fcl_kios", "beside it", "ratio"], [cells(row) for row in found])
