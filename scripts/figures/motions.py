# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""The blocks of docs/motions.md."""
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


def missed(rows):
    """How many contacts each way misses, of paths at random."""
    found = [f"motions/ur5_{scene}/missed/{length}" for scene in ("cell", "pair")
             for length in ("0.05", "0.2", "0.8")]

    def total(key, bv):
        return sum(rows.find(scenario, "motion", bv)[key] for scenario in found)
    return (f"the proof missed contacts on {total('wrong_verdicts', 'kios')} of "
            f"{total('frames', 'kios'):,} paths at random, samples over k-IOS on "
            f"{total('wrong_verdicts', 'sampled_kios')}, samples over OBBRSS on "
            f"{total('wrong_verdicts', OBBRSS)}")
