# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""The blocks of docs/motions.md, and of plans in docs/robot.md."""
from figures.rows import OBBRSS, grid, number, spec, time


def motions(rows):
    """Time by kind of path, and how many pairs are asked."""
    columns = spec("""
proven                  | us kios
queries                 | narrow_queries kios
samples, k-IOS          | us sampled_kios
samples, OBBRSS         | median_us fcl_obbrss
queries                 | narrow_queries fcl_obbrss
""")

    def cell(line, column, _):
        row = rows.find(line[0], "motion", column[1])
        if column[0] == "narrow_queries":
            return number(row["narrow_queries"])
        us = row["median_us"]
        return time(us) if column[0] == "median_us" else (
            f"{time(us)} ({number(rows.us(line[0], 'motion', OBBRSS) / us)})")
    lines = [f"{place}, {length} rad, {kind} | motions/ur5_{scene}/{of}/{length}"
             for scene, place in (("cell", "in the cell"), ("pair", "two arms"))
             for kind, of, lengths in (("free", "valid", ("0.05", "0.2", "0.8")),
                                       ("not free", "invalid", ("0.2",)))
             for length in lengths]
    return grid("path", spec("\n".join(lines)), columns, cell)


MBM = [(f"{label}, {kind.replace('_', ' ')}" if kind else label,
        [f"mbm/{kind}_{robot}" if kind else f"mbm/{robot}"])
       for robot, label in (("panda", "Panda"), ("ur5", "UR5"))
       for kind in ("bookshelf_small", "bookshelf_tall", "bookshelf_thin", "box", "cage",
                    "table_pick", "table_under_pick", "")]


def mbm(rows):
    """MotionBenchMaker's problems by kind, Panda's / UR5's."""
    columns = spec("""
problems               | frames kios
proven: solved         | solved kios
median                 | median_us kios
mean                   | mean_us kios
samples, k-IOS: median | median_us sampled_kios
OBBRSS: solved         | solved fcl_obbrss
median                 | median_us fcl_obbrss
mean                   | mean_us fcl_obbrss
contacts called free   | wrong_verdicts fcl_obbrss
""")

    def of_robot(scenario, key, bv):
        value = rows.find(scenario, "plan", bv)[key]
        if not key.endswith("_us"):
            return number(value)
        base = rows.find(scenario, "plan")[key]
        return time(value) + (f" ({number(value / base)})" if bv == OBBRSS else "")
    kinds = len(MBM) // 2  # of each robot, the last of them all problems
    lines = [(panda.partition(", ")[2] or "**all**", ([*words, *others], {}))
             for (panda, words), (_, others) in zip(MBM[:kinds], MBM[kinds:])]
    return grid("problems, Panda / UR5", lines, columns, lambda line, column, _: " / ".join(
        of_robot(scenario, *column) for scenario in line))
