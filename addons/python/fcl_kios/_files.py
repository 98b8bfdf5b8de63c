# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes from files, and what mends them: STL, OBJ, OFF, PLY, DAE and stored ones; what trimesh
reads, where it is installed."""
import os
import stat
import warnings
from typing import Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from ._core import _read_file, _repair
from ._mesh import Mesh, _loaded

_HEADS = {b"kios-mesh-solid\n": True, b"kios-mesh-soup \n": False}
_READ = (".stl", ".obj", ".off", ".ply", ".dae")


class Repaired(NamedTuple):
    """A mesh, and what repair() did to make it of another."""

    vertices: Any  #: (n, 3) each one a vertex as it was given
    faces: Any  #: (m, 3)
    vertex_of: Any  #: (given vertices,) the one that stands for it; -1 if no triangle uses it
    triangle_of: Any  #: (m,) the given triangle; -1 for those that fill holes
    summary: str  #: what was changed and what is left
    is_solid: bool  #: whether Mesh(vertices, faces, solid=True) takes it


def repair(vertices: ArrayLike, faces: ArrayLike, *, weld: float = 1e-5, weld_length: float = 0.0,
           max_hole_edges: int = 0, max_hole_perimeter: float = float("inf")) -> Repaired:
    """Makes a mesh fit for a solid, as far as that needs no invented surface, and tells what it
    changed. Vertices at most so far apart become one: the larger of `weld`, a part of the diagonal
    of the mesh's box, and `weld_length`, in its units. Doubled triangles go, neighbours are turned
    to one side. Holes of at most max_hole_edges (256 at most) and so long around are filled. Docs:
    docs/solids.md."""
    return Repaired(*_repair(vertices, faces, weld, weld_length, max_hole_edges,
                             max_hole_perimeter))


def load(file: Any, *, kind: Optional[str] = None, solid: bool = False,
         repair: Union[bool, dict] = False) -> Mesh:
    """Reads a mesh from a path, or from what has read(), such as io.BytesIO: then `kind` says what
    it is, as "stl". Vertices of an STL file that are equal become one. repair=True, or a dict of
    repair()'s options, mends it first, and warns of what was changed. A file that Mesh.save() wrote
    needs no build, and is a solid if the mesh was. Raises ValueError for a file that can't be read
    as its name ends, with its line, and OSError. Warns of what is left out of a file, and where it
    looks cut off."""
    content = file.read() if hasattr(file, "read") else None
    if content is None:
        path = os.fsdecode(file)
        mode = os.stat(path).st_mode
        if not stat.S_ISREG(mode) and not stat.S_ISDIR(mode):
            raise ValueError(f"{path}: this is no regular file.")
        kind = kind or os.path.splitext(path)[1]
    else:
        if not kind:
            raise ValueError("fcl_kios: kind must say what is read, as \"stl\".")
        path = str(getattr(file, "name", "file"))
        content = content.encode() if isinstance(content, str) else bytes(content)
    kind = "." + kind.lower().lstrip(".")
    if kind == ".kios" and not repair:
        return _stored(path, content, solid)
    if kind in _READ:
        name = path if path.lower().endswith(kind) else path + kind
        if content is None and name != path:
            with open(path, "rb") as opened:
                content = opened.read()
        vertices, faces, said = _read_file(os.fsencode(name), kind == ".stl", content)
        for what in said:
            warnings.warn(what, stacklevel=2)
    else:
        mesh = (_stored(path, content, False) if kind == ".kios"
                else _by_trimesh(file if content is None else content, path, kind))
        vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    if repair is not False:
        mended = globals()["repair"](vertices, faces, **({} if repair is True else repair))
        vertices, faces = mended.vertices, mended.faces
        if mended.summary:
            warnings.warn(f"{path}: {mended.summary}", stacklevel=2)
    return Mesh(vertices, faces, solid=solid)


def _stored(path, content, solid):
    if content is None:
        with open(path, "rb") as file:
            head = file.read(16)  # else a large file is refused late
            data = np.fromfile(file, dtype=np.uint8) if head in _HEADS else None
    else:
        head, data = content[:16], np.frombuffer(content, np.uint8)[16:]
    if head not in _HEADS:
        raise ValueError(f"{path}: it is no stored mesh.")
    mesh = _loaded(data, _HEADS[head] or solid)
    mesh.nbytes  # is marked now, and refused if it can't be
    return mesh


def _by_trimesh(file, path, kind):
    try:
        import trimesh  # type: ignore
    except ImportError:
        raise ValueError(
            f"{path}: files that end in {kind.strip('.') and kind or 'nothing'} are read by "
            "trimesh, which isn't installed; .stl, .obj, .off, .ply, .dae and .kios need nothing."
        ) from None
    if isinstance(file, bytes):
        import io

        return trimesh.load(io.BytesIO(file), file_type=kind[1:], force="mesh")
    return trimesh.load(os.fsdecode(file), force="mesh")
