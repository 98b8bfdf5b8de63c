# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scene: many objects by name, and how near they come."""
from typing import Any, Hashable, NamedTuple

import numpy as np

from . import _core


class Pair(NamedTuple):
    """Two objects of a scene, a before b in the order in which they were added."""

    a: Hashable
    b: Hashable
    distance: float
    triangle_a: int  #: -1 for shapes
    triangle_b: int
    point_a: Any = None  #: (3,) in the world, if points were asked for
    point_b: Any = None


class Scene:
    """Distances of many objects over many frames.

    Queries remember what they proved: a pair that stood still, or moved less than its clearance,
    isn't searched again. Threads may share a scene, and take turns. Scenes can be pickled.
    """

    def __init__(self):
        self._scene = _core._Scene()
        self._objects = {}  # by name: id, geometry, pose, obstacle
        self._names = {}  # by id
        self._excluded = set()

    def add(self, name, geometry, X=None, *, obstacle=False):
        """Adds a Mesh, or a geometry of fcl_kios.fcl, at its pose (4, 4) in the world. Obstacles
        are never asked about each other. Raises ValueError for a name that is taken."""
        if name in self._objects:
            raise ValueError(f"fcl_kios: the scene has an object {name!r} already.")
        i = self._scene.add(geometry, X, obstacle)
        pose = np.eye(4) if X is None else np.array(X, dtype=np.float64)
        self._objects[name] = [i, geometry, pose, obstacle]
        self._names[i] = name

    def remove(self, name):
        """Takes an object out, and forgets what it was excluded from."""
        i = self._id(name)
        self._scene.remove(i)
        del self._objects[name], self._names[i]
        self._excluded = {pair for pair in self._excluded if name not in pair}

    def move(self, name, X):
        """Sets the pose (4, 4) of an object, or those (n, 4, 4) of a list of names."""
        names = name if isinstance(name, list) else [name]
        poses = np.asarray(X)
        if not isinstance(name, list):
            poses = poses[None]
        self._scene.move([self._id(n) for n in names], poses)
        for n, pose in zip(names, poses):
            self._objects[n][2] = np.array(pose, dtype=np.float64)

    def changed(self, name):
        """To be called after a geometry of fcl_kios.fcl was changed."""
        self._scene.changed(self._id(name))

    def exclude(self, a, b, excluded=True):
        """Leaves a pair out of all queries, or takes it in again."""
        self._scene.exclude(self._id(a), self._id(b), excluded)
        (self._excluded.add if excluded else self._excluded.discard)(frozenset((a, b)))

    def closest(self, *, points=False):
        """The nearest Pair; None if there is none to ask about."""
        pairs = self._pairs(self._scene.closest(points), points)
        return pairs[0] if pairs else None

    def within(self, margin, *, points=False):
        """Every Pair at most so far apart; those that touch for 0."""
        return self._pairs(self._scene.within(margin, points), points)

    def clearances(self, *, points=False):
        """Every Pair."""
        return self._pairs(self._scene.clearances(points), points)

    @property
    def counts(self):
        """How many pairs the last query had, and how many of them weren't searched."""
        return self._scene.counts()

    def __len__(self):
        return len(self._objects)

    def __contains__(self, name):
        return name in self._objects

    def __iter__(self):
        return iter(list(self._objects))

    def _id(self, name):
        try:
            return self._objects[name][0]
        except KeyError:
            raise KeyError(f"the scene has no object {name!r}") from None

    def _pairs(self, answer, points):
        ids, distances, triangles, where = answer
        names = self._names
        return [
            Pair(names[a], names[b], d, ta, tb, *(where[i] if points else (None, None)))
            for i, ((a, b), d, (ta, tb)) in enumerate(
                zip(ids.tolist(), distances.tolist(), triangles.tolist())
            )
        ]

    def __getstate__(self):
        return ([(name, *entry[1:]) for name, entry in self._objects.items()],
                [tuple(pair) for pair in self._excluded])

    def __setstate__(self, state):
        self.__init__()
        for name, geometry, X, obstacle in state[0]:
            self.add(name, geometry, X, obstacle=obstacle)
        for pair in state[1]:
            self.exclude(*pair)
