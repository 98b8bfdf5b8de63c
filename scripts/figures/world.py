# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of docs/world.md."""
from figures.rows import OBBRSS, OURS, grid, number, spec, time

FCL = (OBBRSS, "fcl_rss")
QUERIES = """
distance           | distance
first contact      | collide
all contacts       | contacts
nearer than 0?     | closer_than threshold=0
than 1 mm?         | closer_than threshold=0.001
than 2 cm?         | closer_than threshold=0.02
"""


def fastest(rows, scenario, query, **settings):
    """The time of FCL's fastest volume."""
    found = [row["median_us"] for row in rows.rows
             if (row["scenario"], row["query"]) == (scenario, query) and row["bv"] in FCL
             and all(row.get(key) == value for key, value in settings.items())]
    if not found:
        raise LookupError(f"no row of FCL's of {scenario}, {query}")
    return min(found)


def cell(rows, scenario, query, **settings):
    ours = rows.find(scenario, query, **settings)["median_us"]
    try:
        return f"{number(ours)} ({number(fastest(rows, scenario, query, **settings) / ours)})"
    except LookupError:
        return number(ours)


def places(rows, query, links="*"):
    """Scenarios of world with rows of the query, as lines of a table."""
    found = dict.fromkeys(row["scenario"] for row in rows.rows
                          if row["scenario"].startswith("world/") and row["query"] == query)
    return [(", ".join(scenario.split("/")[1:]).replace("_", " "), ([scenario], {}))
            for scenario in found if not scenario.endswith("/cold")]


def world(rows):
    columns = spec(QUERIES + "cold distance | distance cold\ncold contact | collide cold")

    def entry(line, column, settings):
        scenario, (query, *cold) = line[0], column
        if cold:
            scenario += "/cold"
            if scenario not in rows.scenarios(scenario):
                return ""  # one set of links alone is asked cold
        return cell(rows, scenario, query, **settings)
    return grid("us (FCL / k-IOS)", places(rows, "closer_than"), columns, entry)


def world_shapes(rows):
    meshes = dict(places(rows, "closer_than"))
    lines = [line for line in places(rows, "distance") if line[0] not in meshes]
    columns = spec("""
distance           | distance
first contact      | collide
at most 100        | contacts
""")
    return grid("us (FCL / k-IOS)", lines, columns,
                lambda line, column, settings: cell(rows, line[0], column[0], **settings))


def crowd_of_small(rows):
    lines = spec("""
all pairs, 12 triangles, cold    | crowds/12/cold collide
again                            | crowds/12/again collide
third                            | crowds/12/third collide
all pairs, 100 triangles, cold   | crowds/100/cold collide
again                            | crowds/100/again collide
third                            | crowds/100/third collide
all pairs, 900 triangles, cold   | crowds/900/cold collide
again                            | crowds/900/again collide
third                            | crowds/900/third collide
least distance, 900, cold        | crowds/900/cold distance
again                            | crowds/900/again distance
one triangle and one, distance   | crowds/one_triangle distance
the same, contact                | crowds/one_triangle collide
""")
    columns = spec("""
k-IOS          | us kios
FCL's OBBRSS   | us fcl_obbrss
OBBRSS / k-IOS | ratio
""")

    def entry(line, column, _):
        ours, theirs = (rows.find(*line, bv)["median_us"] for bv in (OURS, OBBRSS))
        if column[0] == "ratio":
            return number(theirs / ours)
        return time(ours if column[1] == OURS else theirs)
    return grid("2,000 bodies", lines, columns, entry)


def coal(rows):
    lines = spec("""
UR5's links and a table, distance   | world/table/ur5 distance
the same, first contact             | world/table/ur5 collide
the same, nearer than 2 cm?         | world/table/ur5 closer_than threshold=0.02
a shelf, distance                   | world/shelf/ur5 distance
the same, first contact             | world/shelf/ur5 collide
the same, nearer than 2 cm?         | world/shelf/ur5 closer_than threshold=0.02
terrain, distance                   | world/terrain_1m/ur5 distance
the same, first contact             | world/terrain_1m/ur5 collide
a building, distance                | world/building/ur5 distance
the same, first contact             | world/building/ur5 collide
""")
    columns = spec("""
k-IOS        | us kios
Coal         | us coal_obbrss
FCL's OBBRSS | us fcl_obbrss
Coal's error, m | error coal_obbrss
wrong        | wrong coal_obbrss
""")

    def entry(line, column, settings):
        row = rows.find(*line, column[1], **settings)
        if column[0] == "us":
            return time(row["median_us"])
        if column[0] == "error":
            return f"{row['max_abs_error']:.0e}" if "max_abs_error" in row else ""
        return f"{row['wrong_verdicts']}"
    return grid("a query", lines, columns, entry)
