# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of robots."""
from figures.rows import OBBRSS, OURS, grid, number, spec, time


def arms(rows):
    lines = spec("""
`SceneDistance`, closest pair | closest kios
FCL's `DynamicAABBTreeCollisionManager`, OBBRSS, closest pair | closest fcl_manager
`SceneDistance`, all within 0.1, with distances | within kios
the same with `exact = false`: only which | verdicts kios
FCL's manager, all within 0.1 | within fcl_manager
`SceneDistance`, every clearance | clearances kios
`fcl::distance` of each pair over k-IOS | clearances kios_pairs
""")
    return grid("us a frame", lines, spec("smooth motion | smooth\nrandom poses | random"),
                lambda line, column, _: number(
                    rows.us(f"robots/ur5/{column[0]}/{line[0]}", "scene", line[1])))


def links(rows):
    """What a pair costs by how near it is: ours, and how many times that OBBRSS takes."""
    lines = spec("""
distance                                       | - distance
the same, after other work                     | /cold distance
collide                                        | - collide
the same, after other work                     | /cold collide
of these, apart by their root volumes          | /root_reject collide
farther apart than 2 % of their extent         | /apart collide
nearer                                         | /near collide
in contact                                     | /hit collide
""")
    columns = spec("""
UR5 | ur5
generated arm | generated
machine parts | parts
""")

    def cell(line, column, _):
        place, query = line
        key = f"robots/{column[0]}{place.strip('-')}", query
        return f"{time(rows.us(*key, OURS))} ({number(rows.us(*key, OBBRSS) / rows.us(*key, OURS))})"
    return grid("a pair of links (OBBRSS by ours)", lines, columns, cell)
