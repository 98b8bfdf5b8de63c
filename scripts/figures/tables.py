# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""The blocks of README.md and docs/*.md by name, as functions of the measured rows.

A block `<!-- report:NAME -->` is the table NAME(rows) below; of several words, as
`<!-- report:run falling -->`, its function gets the others."""
from figures.builds import building, memory, refits  # noqa: F401
from figures.motions import mbm, mbm_contact, mbm_cores, mbm_questions, missed, motions  # noqa: F401
from figures.names import default, names  # noqa: F401
from figures.paper import fits, table_i  # noqa: F401
from figures.robots import links  # noqa: F401
from figures.rows import OBBRSS, OURS, grid, number, spec, table, time
from figures.stability import stability, stress, worst_triangles, wrong_zeros  # noqa: F401
from figures.world import coal, crowd_of_small, world, world_shapes  # noqa: F401


# Phrases.

def run(rows, scenario):
    """Machine and its load, date and commit of a run."""
    of = rows.runs[scenario]
    return f"{of['machine']}, load {of['load']}, {of['date']}, commit {of['commit']}"


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


# docs/settings.md

PAIRS = ("falling", "spinning", "generated", "generated_spinning", "robots")


def of_pairs(rows, query, columns):
    lines = spec("\n".join(f"{pair.replace('_', ', ')} | error/{pair} {query}" for pair in PAIRS))
    return grid("us: k-IOS / OBBRSS", lines, spec("\n".join(columns)), lambda line, _, settings: (
        " / ".join(number(rows.us(*line, bv, **settings)) for bv in (OURS, OBBRSS))))


def errors(rows):
    return of_pairs(rows, "distance", [
        "exact | rel_err=0 abs_err=0",
        *(f"rel_err {e} | rel_err={e} abs_err=0" for e in (0.01, 0.03, 0.1, 0.3, 0.5)),
        *(f"abs_err {e} | rel_err=0 abs_err={e}" for e in (0.01, 0.1))])


def thresholds(rows):
    return of_pairs(rows, "threshold", [f"{t} | threshold={t}"
                                        for t in (0.1, 0.5, 0.9, 0.99, 1.01, 1.1, 2, 10)])


# docs/how-it-works.md

def scaling(rows):
    lines = spec("""
gap 0.1, distance   | gap_0.1 distance
gap 0.1, contact    | gap_0.1 collide
gap 0.001, distance | gap_1e-3 distance
gap 0.001, contact  | gap_1e-3 collide
touching, distance  | touching distance
touching, contact   | touching collide
""")
    columns = spec("1k triangles | 1000\n5k | 5000\n20k | 20000\n80k | 80000")

    return grid("us (OBBRSS / k-IOS)", lines, columns, lambda line, column, _: rows.with_ratio(
        f"scaling/{column[0]}/{line[0]}", line[1]))


# docs/scene.md

SCENES = [(f"{name}: {label}", ([f"robots/{robot}", query], {}))
          for name, robot in (("two UR5s", "ur5"), ("two humanoids", "humanoids"))
          for label, query in (("closest pair", "closest"), ("within 0.1, exact", "within"),
                               ("within 0.1, which", "verdicts"),
                               ("every clearance", "clearances"))]


def scenes(rows):
    """Smooth motion / random poses."""
    columns = spec("""
SceneDistance | us kios
pairs         | us kios_pairs
OBBRSS        | us fcl_obbrss
bounded       | us fcl_obbrss_bounded
manager       | us fcl_manager
OBBRSS / ours | ratio
searches      | searches
""")

    def entry(scenario, column):
        if column[0] == "us":
            return rows.us(scenario, "scene", column[1])
        if column[0] == "ratio":
            return rows.ratio(scenario, "scene")
        return rows.find(scenario, "scene")["narrow_queries"]

    def cell(line, column, _):
        return " / ".join(number(entry(f"{line[0]}/{motion}/{line[1]}", column))
                          for motion in ("smooth", "random"))
    return grid("us a frame: smooth / random", SCENES, columns, cell)


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
        return rows.with_ratio(line[0], *column)
    return grid("us (OBBRSS / k-IOS)", lines, columns, cell)


def rays(rows):
    lines = [(", ".join(scenario.split("/")[1:]), ([scenario], {}))
             for scenario in rows.scenarios("rays/*")]
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
    lines = []
    for scenario in rows.scenarios("solids/contains/*"):
        row = rows.find(scenario, "contains")
        lines.append([scenario.split("/")[2], f"{row['triangles']:,}", number(row["median_us"]),
                      row["wrong_verdicts"]])
    return table(["solid", "triangles", "us a point", "wrong"], lines)


def solids(rows):
    lines = []
    for scenario in rows.scenarios("solids/*"):
        if scenario.split("/")[1] in ("contains", "depth", "points"):
            continue
        row = rows.find(scenario, "penetration")
        us, collide = row["median_us"], rows.us(scenario, "collide")
        off = rows.find(scenario, "contacts", OBBRSS)["mean_rel_error"]
        lines.append([scenario[7:].replace("_", " ").replace("/", ", link "), row["frames"],
                      number(us), f"{us / collide:.0f}", f"{row['bracket_ratio']:.3f}",
                      number(row.get("max_bracket_ratio")), row["wrong_verdicts"],
                      f"{100 * off:.0f} %"])
    return table(["scene", "frames", "us", "in collide queries", "upper / lower, median",
                  "largest", "wrong", "FCL's deepest contact off by"], lines)


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
    row, anew = rows.find("motions/moved", "moved"), rows.find("motions/moved", "moved", "kios_anew")
    return table(["spheres", "move one", "move one, and contact", "make all anew, and contact", "wrong"],
                 [[f"{row['bodies']:,}", us("move"), us("moved"), us("moved", "kios_anew"),
                   f"{row['wrong_verdicts']} of {anew['frames']}"]])


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
winding number to 0.1    | winding_0.1 kios
to 0.01                  | winding_0.01 kios
to 0.001                 | winding_0.001 kios
to 1e-4                  | winding_0.0001 kios
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
    if not callable(make) or word in ("grid", "number", "spec", "table", "time", "block"):
        raise LookupError(f"scripts/figures/tables.py has no block '{name}'")
    return make(rows, *others)


# docs/preload.md

PRELOADED = spec("""
distance, 0.02 apart, 1,000 triangles          | distance_near/1000 distance
5,000                                          | distance_near/5000 distance
100,000                                        | distance_near/100000 distance
1 apart, 100,000                               | distance_far/100000 distance
nearer than 0.01? 0.02 apart, 5,000            | distance_near_bounded/5000 distance
the same, 100,000                              | distance_near_bounded/100000 distance
distance to a box, 5,000                       | distance_box_near/5000 distance
distance to an octree, 5,000                   | distance_octree_near/5000 distance
do they touch? far apart, 5,000                | collide_reject/5000 collide
0.02 apart, 5,000                              | collide_near/5000 collide
0.02 apart, 100,000                            | collide_near/100000 collide
just touching, 5,000                           | collide_touch/5000 collide
deep in each other, 5,000                      | collide_deep/5000 collide
deep in each other, 100,000                    | collide_deep/100000 collide
100 contacts, 5,000                            | collide_deep_contacts/5000 collide
a box, 0.02 apart, 20,000                      | collide_box_near/20000 collide
a sphere, 0.02 apart, 5,000                    | collide_sphere_near/5000 collide
DART: distance of two robots of 7 links        | dart_distance distance
""")


def preload(rows):
    columns = spec("FCL | fcl_obbrss\npreloaded | kios\ntrust | kios_trust")

    def cell(line, column, _):
        key = f"preload/{line[0]}", line[1], column[0]
        us = rows.us(*key)
        return time(us) if column[0] == OBBRSS else (
            f"{time(us)} ({number(rows.us(*key[:2], OBBRSS) / us)})")
    return grid("time (FCL's / preloaded)", PRELOADED, columns, cell)


# docs/python.md

def python(rows):
    """What addons/python/bench.py measured."""
    def cells(row):
        other, ratio = row.get("other_us"), row.get("ratio")
        return [row["what"], time(row["median_us"]), time(other) if other else "",
                number(ratio) if ratio else ""]
    found = [row for row in rows.rows if row["scenario"].startswith("python/")]
    if not found:
        raise LookupError("no row of python")
    return table(["what", "fcl_kios", "beside it", "ratio"], [cells(row) for row in found])
