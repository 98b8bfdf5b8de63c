# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the pictures of times show: medians, a line each."""
from figures.rows import OBBRSS
from figures.tables import PRELOADED, SCENES


def medians(rows, lines, series):
    """Lines (label, key) as (label, {series: us}); series are (name, the rest of a row's key)."""
    def found(key):
        for name, of in series:
            try:
                yield name, rows.us(*key(of))
            except LookupError:
                pass
    return [(label, dict(found(key))) for label, key in lines]


def scenes(rows):
    lines = [(label, lambda of, words=words: (f"{words[0]}/smooth/{words[1]}", "scene", of))
             for label, (words, _) in SCENES]
    return medians(rows, lines, [("SceneDistance", "kios"), ("k-IOS, each pair", "kios_pairs"),
                                 ("FCL's manager, OBBRSS", "fcl_manager"),
                                 ("OBBRSS, each pair", OBBRSS)])


def preload(rows):
    lines = [(label, lambda of, words=words: (f"preload/{words[0]}", words[1], of))
             for label, (words, _) in PRELOADED]
    return medians(rows, lines, [("preloaded", "kios"), ("with trust", "kios_trust"),
                                 ("FCL", OBBRSS)])


# Name of the picture, its function, what a time is of.
PICTURES = (("scenes", scenes, "median time of a frame, smooth motion"),
            ("preload", preload, "median time of a query"))
