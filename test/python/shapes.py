# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes, poses and python-fcl's objects of them, for tests and bench.py."""
import numpy as np

from fcl_kios import fcl


def grid_faces(nu, nv):
    """Triangles of a grid that is closed both ways, outwards where u x v is."""
    i, j = np.meshgrid(np.arange(nu), np.arange(nv), indexing="ij")
    a, b = i * nv + j, (i + 1) % nu * nv + j
    c, d = (i + 1) % nu * nv + (j + 1) % nv, i * nv + (j + 1) % nv
    return np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], 2).reshape(-1, 3)


def torus(nu=30, nv=20, bumps=0.05):
    u, v = np.meshgrid(np.arange(nu) * 2 * np.pi / nu, np.arange(nv) * 2 * np.pi / nv,
                       indexing="ij")
    r = 0.4 + bumps * np.sin(7 * u + 5 * v)
    points = [(1 + r * np.cos(v)) * np.cos(u), (1 + r * np.cos(v)) * np.sin(u), r * np.sin(v)]
    return np.stack(points, -1).reshape(-1, 3), grid_faces(nu, nv)


def ball(n=16, radius=0.5):
    """A sphere of 2 n rings of 2 n points, its poles two vertices."""
    t = np.arange(1, n) * np.pi / n
    p = np.arange(2 * n) * np.pi / n
    rings = np.stack([np.outer(np.sin(t), np.cos(p)), np.outer(np.sin(t), np.sin(p)),
                      np.outer(np.cos(t), np.ones(2 * n))], -1).reshape(-1, 3)
    vertices = radius * np.vstack([rings, [[0, 0, 1], [0, 0, -1]]])
    m, top, bottom, faces = 2 * n, len(vertices) - 2, len(vertices) - 1, []
    for k in range(m):
        l = (k + 1) % m
        faces.append((top, k, l))
        faces.append((bottom, (n - 2) * m + l, (n - 2) * m + k))
        for ring in range(n - 2):
            a, b = ring * m + k, ring * m + l
            faces += [(a, a + m, b + m), (a, b + m, b)]
    return vertices, np.array(faces)


def box(size=1.0):
    x = np.array([(i & 1, i >> 1 & 1, i >> 2 & 1) for i in range(8)], float)
    faces = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3),
             (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)]
    return size * (x - 0.5), np.array(faces)


def random_rotations(n, random):
    q = random.normal(size=(n, 4))
    w, x, y, z = (q / np.linalg.norm(q, axis=1)[:, None]).T
    return np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                     2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                     2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
                    -1).reshape(-1, 3, 3)


def random_poses(n, spread, random):
    poses = np.tile(np.eye(4), (n, 1, 1))
    poses[:, :3, :3] = random_rotations(n, random)
    poses[:, :3, 3] = random.uniform(-spread, spread, (n, 3))
    return poses


def translation(x, y=0.0, z=0.0):
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def bvh(vertices, faces, module=fcl):
    model = module.BVHModel()
    model.beginModel(num_tris_=len(faces), num_vertices_=len(vertices))
    model.addSubModel(verts=vertices, triangles=faces)
    model.endModel()
    return model


def placed(geometry, pose=None, module=fcl):
    if pose is None:
        return module.CollisionObject(geometry)
    return module.CollisionObject(geometry, module.Transform(pose[:3, :3], pose[:3, 3]))
