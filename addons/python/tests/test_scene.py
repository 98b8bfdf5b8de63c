# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes against brute force over all pairs."""
import numpy as np
import pytest

import fcl_kios
import shapes
from fcl_kios import fcl


@pytest.fixture
def parts(torus, ball, block):
    return [torus, fcl_kios.Mesh(ball.vertices, ball.faces), fcl.Box(1, 0.5, 0.3), torus,
            fcl.Sphere(0.4), fcl_kios.Mesh(block.vertices, block.faces)]


def relative(X1, X2):
    return np.linalg.inv(X1) @ X2


def test_scenes_equal_all_pairs(parts):
    random = np.random.default_rng(4)
    scene, names = fcl_kios.Scene(), [f"part {i}" for i in range(len(parts))]
    poses = shapes.random_poses(len(parts), 3, random)
    for name, part, X in zip(names, parts, poses):
        scene.add(name, part, X)
    for frame in range(12):
        poses[:, :3, 3] += random.uniform(-0.4, 0.4, (len(parts), 3))
        scene.move(names, poses)
        want = {}
        objects = [shapes.placed(p if isinstance(p, fcl.CollisionGeometry)
                                 else shapes.bvh(p.vertices, p.faces), X)
                   for p, X in zip(parts, poses)]
        for i in range(len(parts)):
            for j in range(i):
                if not (i == 4 and j == 2):
                    want[names[j], names[i]] = fcl.distance(objects[j], objects[i])
        if frame == 0:
            scene.exclude("part 2", "part 4")
        found = scene.clearances(points=True)
        assert {(p.a, p.b): p.distance for p in found} == want
        for p in found:
            assert abs(np.linalg.norm(p.point_a - p.point_b) - p.distance) < 1e-9
        closest = scene.closest()
        assert closest.distance == min(want.values()) and closest.point_a is None
        near = scene.within(0.5)
        assert {(p.a, p.b) for p in near} == {k for k, d in want.items() if d <= 0.5}
        total, skipped = scene.counts
        assert total == 15 and 0 <= skipped <= 15
    scene.exclude("part 2", "part 4", False)
    assert len(scene.clearances()) == 15


def test_names_and_refusals(torus):
    scene = fcl_kios.Scene()
    assert scene.closest() is None and scene.within(1) == [] and len(scene) == 0
    scene.add("a", torus)
    scene.add("b", torus, shapes.translation(3).astype(np.float32), obstacle=True)
    scene.add("c", fcl.Sphere(0.1), shapes.translation(6), obstacle=True)
    assert "a" in scene and list(scene) == ["a", "b", "c"] and len(scene) == 3
    assert {(p.a, p.b) for p in scene.clearances()} == {("a", "b"), ("a", "c")}
    with pytest.raises(ValueError, match="'a' already"):
        scene.add("a", torus)
    for call in (lambda: scene.remove("d"), lambda: scene.move("d", np.eye(4)),
                 lambda: scene.exclude("a", "d")):
        with pytest.raises(KeyError, match="no object 'd'"):
            call()
    for X in (np.eye(3), np.eye(4, dtype=int), np.diag([1.0, 2, 1, 1]), np.full((4, 4), np.nan)):
        with pytest.raises(ValueError):
            scene.move("a", X)
        with pytest.raises(ValueError):
            scene.add("e", torus, X)
    with pytest.raises(ValueError, match="2 names, but 1 poses"):
        scene.move(["a", "b"], np.eye(4)[None])
    with pytest.raises(TypeError):
        scene.add("e", "torus")
    with pytest.raises(ValueError):
        scene.within(float("nan"))
    assert "e" not in scene
    scene.remove("b")
    assert scene.closest().b == "c"
    scene.add("b", torus)
    assert scene.within(0)[0].distance == 0


def test_geometries_that_change():
    scene, box = fcl_kios.Scene(), fcl.Box(1, 1, 1)
    scene.add("box", box)
    scene.add("ball", fcl.Sphere(0.5), shapes.translation(3))
    assert scene.closest().distance == pytest.approx(2)
    box.side = (2, 1, 1)
    scene.changed("box")
    assert scene.closest().distance == pytest.approx(1.5)
