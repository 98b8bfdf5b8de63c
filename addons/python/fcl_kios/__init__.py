# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Collision and exact distance of meshes, by arrays: a call answers a whole batch of poses, points
or rays on all cores. fcl_kios.fcl has python-fcl's names instead. Docs: docs/python.md."""
import atexit as _atexit
import os as _os
from typing import NamedTuple

import numpy as np

from . import _core
from ._core import Mesh, __version__, simd_target
from ._files import load
from ._scene import Pair, Scene

__all__ = ["Bracket", "Mesh", "Nearest", "Pair", "Penetration", "RayHits", "Scene", "load",
           "simd_target", "__version__"]


class Nearest(NamedTuple):
    """What Mesh.distance(points=True) returns. Points and triangles of a pair beyond `within`, or
    of a solid within the other, are NaN and -1; so is the triangle of a shape."""

    distance: np.ndarray  #: (n,)
    point_a: np.ndarray  #: (n, 3), in A's frame
    point_b: np.ndarray  #: (n, 3), in A's frame, too
    triangle_a: np.ndarray  #: (n,)
    triangle_b: np.ndarray  #: (n,)


class Bracket(NamedTuple):
    """Proven bounds of distances."""

    lower: np.ndarray  #: (n,)
    upper: np.ndarray  #: (n,)


class Penetration(NamedTuple):
    """How deep two solids overlap; zeros where their interiors are disjoint."""

    lower: np.ndarray  #: (n,) no shorter translation parts them
    upper: np.ndarray  #: (n,) the length of `translation`
    translation: np.ndarray  #: (n, 3) of B, in A's frame: after it they are apart
    point: np.ndarray  #: (n, 3) of A's surface, in A's frame, where they touch then


class RayHits(NamedTuple):
    """The first triangle of each ray; -1, infinity and NaN for rays that miss."""

    triangle: np.ndarray  #: (n,)
    distance: np.ndarray  #: (n,) from the origin, a length
    point: np.ndarray  #: (n, 3)


def _from_trimesh(cls, mesh, *, solid=False):
    """Makes a Mesh of a trimesh.Trimesh, or whatever has vertices and faces."""
    return cls(np.asarray(mesh.vertices), np.asarray(mesh.faces), solid=solid)


def _loaded(stored, solid):
    return Mesh._loaded(stored, solid)


def _reduce(self, protocol):
    import pickle

    stored = self._stored()
    buffer = pickle.PickleBuffer(stored) if protocol >= 5 else stored.tobytes()
    return _loaded, (buffer, self.is_solid)


def _save(self, path):
    """Writes vertices, faces and trees into a file that load() reads. The name should end in
    .kios."""
    with open(path, "wb") as file:
        file.write(b"kios-mesh-solid\n" if self.is_solid else b"kios-mesh-soup \n")
        self._stored().tofile(file)


def _repr(self):
    kind = "solid of " if self.is_solid else ""
    return f"<fcl_kios.Mesh, {kind}{len(self.faces)} triangles>"


Mesh.from_trimesh = classmethod(_from_trimesh)
Mesh.save = _save
Mesh.__reduce_ex__ = _reduce
Mesh.__repr__ = _repr
Mesh.__copy__ = Mesh.__deepcopy__ = lambda self, memo=None: self  # nobody changes it
Mesh.__module__ = __name__

_atexit.register(_core._close)
if hasattr(_os, "register_at_fork"):
    _os.register_at_fork(after_in_child=_core._forget)
