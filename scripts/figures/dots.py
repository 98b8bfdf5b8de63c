# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the pictures of times show: medians, a line each."""
from figures.builds import BUILDERS, BUILT
from figures.motions import MBM
from figures.rows import OBBRSS, spec


def medians(rows, lines, series):
    """Lines (label, key) as (label, {series: us}); series are (name, the rest of a row's key)."""
    def found(key):
        for name, of in series:
            try:
                yield name, rows.us(*key(of))
            except LookupError:
                pass
    return [(label, dict(found(key))) for label, key in lines]


def mbm(rows):
    lines = [(label, lambda of, words=words: (*words, "plan", of)) for label, words in MBM]
    return medians(rows, lines, [("k-IOS, proven", "kios"), ("k-IOS, samples", "sampled_kios"),
                                 ("OBBRSS, samples", OBBRSS)])


def building(rows):
    lines = [(label, lambda of, words=words: (f"build/{words[0]}", *of))
             for label, (words, _) in BUILT]
    series = [("k-IOS, an equal model" if words[0] == "again" else label.partition(":")[0], words)
              for label, (words, _) in BUILDERS]
    return medians(rows, lines, series)


SCENES = [(f"{name}: {label}", ([f"robots/{robot}", query], {}))
          for name, robot in (("two UR5s", "ur5"), ("two humanoids", "humanoids"))
          for label, query in (("closest pair", "closest"), ("within 0.1, exact", "within"),
                               ("within 0.1, which", "verdicts"),
                               ("every clearance", "clearances"))]


def scenes(rows):
    lines = [(label, lambda of, words=words: (f"{words[0]}/smooth/{words[1]}", "scene", of))
             for label, (words, _) in SCENES]
    return medians(rows, lines, [("SceneDistance", "kios"), ("k-IOS, each pair", "kios_pairs"),
                                 ("FCL's manager, OBBRSS", "fcl_manager"),
                                 ("OBBRSS, each pair", OBBRSS)])


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
    lines = [(label, lambda of, words=words: (f"preload/{words[0]}", words[1], of))
             for label, (words, _) in PRELOADED]
    return medians(rows, lines, [("preloaded", "kios"), ("with trust", "kios_trust"),
                                 ("FCL", OBBRSS)])


# Name of the picture, its function, what a time is of.
PICTURES = (("plans", mbm, "median time of a plan"),
            ("scenes", scenes, "median time of a frame, smooth motion"),
            ("building", building, "median time of building a model"),
            ("preload", preload, "median time of a query"))
