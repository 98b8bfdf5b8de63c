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
    names = dict.fromkeys(label.rpartition(", ")[0] for label, _ in places(rows, "closer_than"))
    columns = spec(QUERIES + """cold distance      | distance /ur5/cold
cold contact       | collide /ur5/cold
parts: distance    | distance /parts
first contact      | collide /parts
all contacts       | contacts /parts
""")
    return grid("us (FCL / k-IOS)", [(name, ([name.replace(" ", "_")], {})) for name in names],
                columns, lambda line, column, settings: cell(
                    rows, f"world/{line[0]}{(*column, '/ur5')[1]}", column[0], **settings))


def world_shapes(rows):
    meshes = dict(places(rows, "closer_than"))
    names = dict.fromkeys(label.rpartition(", ")[0] for label, _ in places(rows, "distance")
                          if label not in meshes)
    columns = spec("""
distance, links      | distance ur5
parts                | distance parts
first contact, links | collide ur5
parts                | collide parts
at most 100, links   | contacts ur5
parts                | contacts parts
""")
    return grid("us (FCL / k-IOS)", [(name, ([name.replace(" ", "_")], {})) for name in names],
                columns, lambda line, column, settings: cell(
                    rows, f"world/{line[0]}/{column[1]}", column[0], **settings))


def crowd_of_small(rows):
    lines = spec("""
all pairs, 12 triangles  | crowds/12 collide
all pairs, 100 triangles | crowds/100 collide
all pairs, 900 triangles | crowds/900 collide
least distance, 900      | crowds/900 distance
two triangles, distance  | crowds/one_triangle distance
two triangles, contact   | crowds/one_triangle collide
""")
    columns = spec("cold | /cold\nagain | /again\nthird | /third")

    def entry(line, column, _):
        scenario = line[0] + column[0]
        if line[0].endswith("one_triangle"):  # is asked again and again, as one row
            if column[0] != "/again":
                return ""
            scenario = line[0]
        ours, theirs = (rows.find(scenario, line[1], bv)["median_us"] for bv in (OURS, OBBRSS))
        return f"{time(ours)} ({number(theirs / ours)})"
    return grid("2,000 bodies (OBBRSS / k-IOS)", lines, columns, entry)


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
