# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes from files: STL, OBJ, OFF, PLY, DAE and stored ones; what trimesh reads, where it is
installed."""
import os
import stat
import warnings

import numpy as np

from ._core import Mesh, _read_file

_HEADS = {b"kios-mesh-solid\n": True, b"kios-mesh-soup \n": False}


def load(path, *, solid=False):
    """Reads a mesh. Vertices of an STL file that are equal become one. A file that Mesh.save()
    wrote needs no build, and is a solid if the mesh was. Raises ValueError for a file that can't be
    read as its name ends, with its line, and OSError. Warns of what is left out of a file, and where
    it looks cut off."""
    path = os.fsdecode(path)
    kind = os.path.splitext(path)[1].lower()
    mode = os.stat(path).st_mode
    if not stat.S_ISREG(mode) and not stat.S_ISDIR(mode):
        raise ValueError(f"{path}: this is no regular file.")
    if kind == ".kios":
        data = np.fromfile(path, dtype=np.uint8)
        head = data[:16].tobytes()
        if head not in _HEADS:
            raise ValueError(f"{path}: it is no stored mesh.")
        return Mesh._loaded(data[16:], _HEADS[head] or solid)
    if kind not in (".stl", ".obj", ".off", ".ply", ".dae"):
        return Mesh.from_trimesh(_by_trimesh(path, kind), solid=solid)
    vertices, faces, said = _read_file(os.fsencode(path), kind == ".stl")
    for what in said:
        warnings.warn(what, stacklevel=2)
    return Mesh(vertices, faces, solid=solid)


def _by_trimesh(path, kind):
    try:
        import trimesh
    except ImportError:
        raise ValueError(
            f"{path}: files that end in {kind or 'nothing'} are read by trimesh, which isn't "
            "installed; .stl, .obj, .off, .ply, .dae and .kios need nothing."
        ) from None
    return trimesh.load(path, force="mesh")
