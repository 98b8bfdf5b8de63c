# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of docs/world.md."""
from figures.rows import OBBRSS, OURS, grid, number, spec, table

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


def places(rows, query):
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
    def kinds(query):
        return [label.rpartition(", ")[0] for label, _ in places(rows, query)]
    names = dict.fromkeys(kind for kind in kinds("distance") if kind not in kinds("closer_than"))
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


def coal(rows):
    """Ours / Coal's / FCL's OBBRSS, and how Coal's answers stand against the oracle."""
    lines = spec("""
UR5's links and a table | coal/table/ur5
a shelf                 | coal/shelf/ur5
terrain                 | coal/terrain_1m/ur5
a building              | coal/building/ur5
""")
    columns = spec("""
distance            | distance
first contact       | collide
nearer than 2 cm?   | closer_than threshold=0.02
Coal's error, m     | error
Coal's wrong        | wrong
""")

    def entry(line, column, settings):
        if column[0] == "error":
            return f"{rows.find(line[0], 'distance', 'coal_obbrss')['max_abs_error']:.0e}"
        if column[0] == "wrong":
            return str(sum(rows.find(line[0], query, "coal_obbrss")["wrong_verdicts"]
                           for query in ("distance", "collide")))
        return " / ".join(number(rows.us(line[0], column[0], bv, **settings))
                          for bv in (OURS, "coal_obbrss", OBBRSS))
    return table(["us: k-IOS / Coal / FCL's OBBRSS", *(label for label, _ in columns)],
                 [[label, *(entry(line[0], column[0], column[1]) for _, column in columns)]
                  for label, line in lines])
