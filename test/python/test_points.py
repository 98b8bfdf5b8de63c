# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Points and meshes by arrays."""
import numpy as np
import pytest

import fcl_kios as kios
from shapes import box

POINTS = np.array([[0.0, 0, 0], [0.25, 0, 0], [0.5, 0.1, 0.1], [2, 0, 0], [0, 0, -3]])
DISTANCES = [0.5, 0.25, 0, 1.5, 2.5]


def test_nearest():
    mesh = kios.Mesh(*box())
    distance, point, triangle = mesh.nearest(POINTS)
    assert np.allclose(distance, DISTANCES, rtol=1e-15)
    assert np.allclose(np.linalg.norm(point - POINTS, axis=1), distance, rtol=1e-15)
    assert ((0 <= triangle) & (triangle < len(mesh.faces))).all()
    many = np.random.default_rng(1).normal(size=(5000, 3))
    one = [mesh.nearest(p) for p in many[:20]]
    alike = mesh.nearest(many, threads=2)
    assert np.array_equal([n.distance for n in one], alike.distance[:20])
    assert np.array_equal([n.point for n in one], alike.point[:20])
    near = mesh.nearest(POINTS, within=1)
    assert np.array_equal(np.isinf(near.distance), np.array(DISTANCES) > 1)
    assert (near.triangle[3:] == -1).all() and np.isnan(near.point[3:]).all()


def test_signed_distance():
    mesh = kios.Mesh(*box(), solid=True)
    sign = np.array([-1, -1, 1, 1, 1])
    assert np.allclose(mesh.signed_distance(POINTS), sign * DISTANCES, rtol=1e-15)
    X = np.eye(4)
    X[:3, 3] = [1, 2, 3]
    assert np.allclose(mesh.signed_distance(POINTS + X[:3, 3], X), sign * DISTANCES)
    assert mesh.signed_distance(POINTS[0], within=0.1) == -np.inf
    done = []
    mesh.signed_distance(np.zeros((3000, 3)), progress=done.append)
    assert sum(done) == 3000


def test_winding_numbers():
    vertices, faces = box()
    bowl = kios.Mesh(vertices, faces[2:])  # without a face
    tree = kios.WindingTree(bowl)
    exact = tree.at(POINTS, error=0)
    assert np.abs(tree.at(POINTS, error=0.01) - exact).max() <= 0.01
    assert abs(exact[0] - 5 / 6) < 1e-12 and isinstance(tree.at(POINTS[0]), float)
    assert bowl.signed_distance(POINTS[0], winding=tree) == -0.5
    assert tree.nbytes > 0
    with pytest.raises(ValueError, match="solid"):
        bowl.signed_distance(POINTS)


def test_trees_of_other_meshes_are_refused():
    one, other = kios.Mesh(*box()), kios.Mesh(*box(2))
    with pytest.raises(ValueError, match="tree of this model"):
        one.signed_distance(POINTS, winding=kios.WindingTree(other))


def test_trees_keep_their_mesh():
    tree = kios.WindingTree(kios.Mesh(*box()))
    assert abs(tree.at(POINTS[0]) - 1) < 1e-3


@pytest.mark.parametrize("bad", [np.nan, np.inf, 1e305])
def test_bad_points(bad):
    mesh = kios.Mesh(*box(), solid=True)
    points = np.zeros((3000, 3))
    points[2500, 1] = bad
    for call in mesh.nearest, mesh.signed_distance, kios.WindingTree(mesh).at:
        with pytest.raises(ValueError, match=r"points\[2500\]") as raised:
            call(points)
        assert "column" not in str(raised.value)


@pytest.mark.parametrize("count", [0, 1, 3000])
def test_bad_requests(count):
    mesh = kios.Mesh(*box(), solid=True)
    points = np.zeros((count, 3))
    for call in mesh.nearest, mesh.signed_distance:
        for within in -1, np.nan:
            with pytest.raises(ValueError, match="within") as raised:
                call(points, within=within)
            assert "points[" not in str(raised.value)
        with pytest.raises(ValueError, match="pose|rotation|rigid"):
            call(points, 2 * np.eye(4))
    with pytest.raises(ValueError, match="error"):
        kios.WindingTree(mesh).at(points, error=-1)
    with pytest.raises(ValueError, match="solid"):
        kios.Mesh(*box()).signed_distance(points)
    with pytest.raises(ValueError):
        mesh.nearest(np.zeros((3, 2)))
