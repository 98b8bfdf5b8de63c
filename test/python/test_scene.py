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
    for X in (np.eye(3), np.diag([1.0, 2, 1, 1]), np.full((4, 4), np.nan)):
        with pytest.raises(ValueError):
            scene.move("a", X)
        with pytest.raises(ValueError):
            scene.add("e", torus, X)
    before = scene.clearances()
    for refused in (np.diag([1.0, 2, 1, 1]), np.full((4, 4), np.nan)):
        with pytest.raises(ValueError):
            scene.move(["b", "c", "a"], np.stack([shapes.translation(9), np.eye(4), refused]))
        assert scene.clearances() == before
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


def test_clashes_have_their_statuses(ball, block):
    def at(x):
        X = np.eye(4)
        X[0, 3] = x
        return X

    unit = fcl_kios.Mesh(*shapes.box(), solid=True)
    parts = [("a", unit), ("b", unit, at(0.75), "g"), ("c", unit, at(1.75)), ("d", unit, at(1.75)),
             ("e", fcl_kios.Mesh(*shapes.box(0.1), solid=True)), ("f", unit, at(2.8), "g")]
    found = {c.a + c.b: c for c in fcl_kios.clashes(parts, clearance=0.1)}
    assert {k: c.status for k, c in found.items()} == {
        "ab": "overlap", "ae": "inside", "bc": "touch", "bd": "touch", "cd": "duplicate",
        "cf": "clearance", "df": "clearance"}
    deep = found["ab"]
    assert deep.deep and deep.decided and deep.lower <= 0.25 <= deep.upper * (1 + 1e-12)
    np.testing.assert_allclose(np.linalg.norm(deep.way_out), 0.25, rtol=1e-6)
    assert not found["cf"].deep and found["cf"].point_a[0] == pytest.approx(2.25)
    rest = fcl_kios.clashes(iter(parts), ignored=[("b", "a")], between_groups=True, threads=1)
    assert [(c.a, c.b) for c in rest] == [("b", "c"), ("b", "d")]
    with pytest.raises(ValueError, match="'a'"):
        fcl_kios.clashes(parts + [("a", unit)])
    with pytest.raises(ValueError, match="'z'"):
        fcl_kios.clashes(parts, ignored=[("a", "z")])
    boxes = [("x", fcl.Box(1, 1, 1)), ("y", fcl.Box(1, 1, 1), at(0.75)), ("z", unit, at(1.75))]
    assert [c.status for c in fcl_kios.clashes(boxes)] == ["overlap", "touch"]
    with pytest.raises(TypeError, match="Mesh, Box or Convex, not a Sphere"):
        fcl_kios.clashes([("a", fcl.Sphere(1))])
    soup = fcl_kios.Mesh(block.vertices, block.faces[:-1])
    unknown, = fcl_kios.clashes([("a", soup), ("b", soup, at(0.1))])
    assert unknown.status == "overlap" and not unknown.decided and unknown.upper == np.inf


@pytest.mark.parametrize("arguments, error, words", [
    ({"touch": -1}, ValueError, "touch is -1"), ({"touch": np.nan}, ValueError, "touch is nan"),
    ({"clearance": np.inf}, ValueError, "clearance is inf"),
    ({"touch": 0.2, "clearance": 0.1}, ValueError, "touch is 0.2, more than the clearance, 0.1"),
    ({"touch": "a"}, TypeError, "touch must be a number, not 'a'"),
    ({"clearance": [1, 2]}, TypeError, "clearance must be a number"),
    ({"threads": 0}, ValueError, "threads"), ({"threads": 1.5}, (TypeError, ValueError), "threads"),
    ({"ignored": ["ab"]}, TypeError, "'ab', to be ignored, must be a pair"),
    ({"ignored": [("a", 1)]}, TypeError, "a name to be ignored must be a str, not 1"),
    ({"ignored": [("a", "b", "c")]}, TypeError, "pair of names"),
    ({"part": 1}, TypeError, "part 1 must be"), ({"part": ("b",)}, TypeError, "part 1 must be"),
    ({"part": ("b", None, None, None, None)}, TypeError, "part 1 must be"),
    ({"part": ("b", None)}, TypeError, "mesh of part 'b' must be a Mesh, Box or Convex, not a NoneType"),
    ({"part": (2, "mesh")}, TypeError, "name of part 1 must be a str, not 2"),
    ({"part": ("\udc80", "mesh")}, ValueError, "can't be written in UTF-8"),
    ({"part": ("b", "mesh", np.eye(3))}, ValueError, r"X of part 'b' has shape \(3, 3\)"),
    ({"part": ("b", "mesh", np.eye(4)[None])}, ValueError, "X of part 'b' must be one pose"),
    ({"part": ("b", "mesh", np.full((4, 4), np.nan))}, ValueError, "part 'b'"),
    ({"part": ("b", "mesh", np.diag([2.0, 2, 2, 1]))}, ValueError, "part 'b'"),
    ({"part": ("b", "mesh", None, [])}, TypeError, "group of part 'b' must be hashable")])
def test_clashes_refuse_in_one_sentence(arguments, error, words):
    unit = fcl_kios.Mesh(*shapes.box(), solid=True)
    arguments = dict(arguments)
    part = arguments.pop("part", ("b", unit))
    if isinstance(part, tuple):
        part = tuple(unit if isinstance(x, str) and x == "mesh" else x for x in part)
    with pytest.raises(error, match=words) as raised:
        fcl_kios.clashes([("a", unit), part], **arguments)
    assert "\n" not in str(raised.value)
