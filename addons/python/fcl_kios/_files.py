# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes from files: STL, OBJ, OFF and stored ones; what trimesh reads, where it is installed."""
import os

import numpy as np

from ._core import Mesh

_HEADS = {b"kios-mesh-solid\n": True, b"kios-mesh-soup \n": False}


def load(path, *, solid=False):
    """Reads a mesh. Vertices of an STL file that are equal become one. A file that Mesh.save()
    wrote needs no build, and is a solid if the mesh was. Raises ValueError for a file that can't be
    read as its name ends, and OSError."""
    path = os.fspath(path)
    kind = os.path.splitext(path)[1].lower()
    if kind == ".kios":
        data = np.fromfile(path, dtype=np.uint8)
        head = data[:16].tobytes()
        if head not in _HEADS:
            raise ValueError(f"{path}: it is no stored mesh.")
        return Mesh._loaded(data[16:], _HEADS[head] or solid)
    reader = {".stl": _stl, ".obj": _obj, ".off": _off}.get(kind)
    if reader is None:
        return Mesh.from_trimesh(_by_trimesh(path, kind), solid=solid)
    with open(path, "rb") as file:
        data = file.read()
    try:
        vertices, faces = reader(data)
    except (ValueError, IndexError) as error:
        raise ValueError(f"{path}: it can't be read as {kind}: {error}") from None
    return Mesh(vertices, faces, solid=solid)


def _by_trimesh(path, kind):
    try:
        import trimesh
    except ImportError:
        raise ValueError(
            f"{path}: files that end in {kind or 'nothing'} are read by trimesh, which isn't "
            "installed; .stl, .obj, .off and .kios need nothing."
        ) from None
    return trimesh.load(path, force="mesh")


def _merged(corners):
    """(3 m, 3) corners of triangles as vertices and faces."""
    corners = np.ascontiguousarray(corners, dtype=np.float64) + 0.0  # no -0
    rows = corners.view(np.dtype((np.void, corners.itemsize * 3))).ravel()
    _, first, inverse = np.unique(rows, return_index=True, return_inverse=True)
    return corners[first], inverse.reshape(-1, 3)


def _stl(data):
    count = int.from_bytes(data[80:84], "little")
    if len(data) == 84 + 50 * count:
        triangle = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
        return _merged(np.frombuffer(data, triangle, count, 84)["corners"].reshape(-1, 3))
    lines = [line.split() for line in data.decode("ascii", "replace").splitlines()]
    corners = [words[1:4] for words in lines if words[:1] == ["vertex"]]
    if not corners or len(corners) % 3:
        raise ValueError("it is neither binary, of the size that it gives, nor text")
    return _merged(np.array(corners, dtype=np.float64))


def _fan(polygon):
    return [(polygon[0], b, c) for b, c in zip(polygon[1:], polygon[2:])]


def _obj(data):
    vertices, faces = [], []
    for line in data.decode("utf-8", "replace").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append(words[1:4])
        elif words[:1] == ["f"]:
            indices = [int(word.split("/")[0]) for word in words[1:]]
            faces += _fan([i - 1 if i > 0 else len(vertices) + i for i in indices])
    return np.array(vertices, dtype=np.float64).reshape(-1, 3), np.array(faces, int).reshape(-1, 3)


def _off(data):
    lines = (line.split("#")[0].split() for line in data.decode("ascii", "replace").splitlines())
    words = [word for line in lines for word in line]
    if not words or words[0] != "OFF":
        raise ValueError("it doesn't begin with OFF")
    num_vertices, num_faces = int(words[1]), int(words[2])
    end = 4 + 3 * num_vertices
    vertices = np.array(words[4:end], dtype=np.float64).reshape(num_vertices, 3)
    faces = []
    for _ in range(num_faces):
        count = int(words[end])
        faces += _fan([int(word) for word in words[end + 1:end + 1 + count]])
        end += 1 + count
    return vertices, np.array(faces, int).reshape(-1, 3)
