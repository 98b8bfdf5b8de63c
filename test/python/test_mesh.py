# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Batches: they equal single calls and python-fcl's names, whatever the arrays and the threads."""
import threading
import time

import numpy as np
import pytest

import fcl_kios
import shapes
from fcl_kios import fcl


@pytest.mark.parametrize("probe", [None, fcl.Box(0.5, 0.4, 0.3)], ids=["mesh", "box"])
def test_batches_are_single_calls(torus, ball, poses, probe):
    other = probe or ball
    a = shapes.placed(shapes.bvh(torus.vertices, torus.faces))
    b = fcl.CollisionObject(probe or shapes.bvh(ball.vertices, ball.faces))
    hits, near = torus.collides(other, poses), torus.distance(other, poses, points=True)
    assert hits.dtype == bool and 20 < hits.sum() < 280
    for i, X in enumerate(poses):
        b.setRotation(X[:3, :3])
        b.setTranslation(X[:3, 3])
        result = fcl.DistanceResult()
        d = fcl.distance(a, b, fcl.DistanceRequest(True), result)
        assert near.distance[i] == d == torus.distance(other, X)
        assert hits[i] == (fcl.collide(a, b) > 0) == torus.collides(other, X) == (d == 0)
        if d > 0:
            assert np.array_equal(near.point_a[i], result.nearest_points[0])
            assert near.triangle_a[i] == result.b1
            assert near.triangle_b[i] == (-1 if probe else result.b2)


def test_bounds_and_threads(torus, ball, poses):
    d, hits = torus.distance(ball, poses), torus.collides(ball, poses)
    low, high = torus.bracket(ball, poses)
    assert (low <= d * (1 + 1e-15)).all() and (d <= high * (1 + 1e-15)).all()
    assert (high - low <= 0.1 * d + 1e-12).all()
    assert np.array_equal(torus.closer_than(ball, 0.3, poses), d <= 0.3)
    for threads in (1, np.int64(2), 5):
        assert np.array_equal(torus.distance(ball, poses, threads=threads), d)
        assert np.array_equal(torus.collides(ball, poses, threads=threads), hits)
    assert np.array_equal(torus.distance(ball, poses, within=0.3), np.where(d <= 0.3, d, np.inf))
    loose = torus.distance(ball, poses, rel_err=0.2)
    assert (loose <= d * 1.2 + 1e-12).all() and (loose >= d - 1e-12).all()


def test_one_pose_none_and_no_pose(torus, ball):
    X = shapes.translation(3)
    assert type(torus.collides(ball, X)) is bool and type(torus.distance(ball, X)) is float
    assert torus.distance(ball, X[None]).shape == (1,)
    assert torus.distance(ball) == torus.distance(ball, np.eye(4))
    empty = np.empty((0, 4, 4))
    assert torus.collides(ball, empty).shape == (0,)
    near = torus.distance(ball, empty, points=True)
    assert near.point_a.shape == (0, 3) and near.triangle_b.shape == (0,)
    assert [len(x) for x in torus.bracket(ball, empty)] == [0, 0]
    assert len(ball.contains(np.empty((0, 3)))) == 0
    assert len(torus.rays(np.empty((0, 3)), np.empty((0, 3))).distance) == 0
    single = torus.distance(ball, X, points=True)
    assert single.point_a.shape == (3,) and type(single.triangle_a) is int
    assert type(torus.bracket(ball, X).lower) is float


def test_a_pair_beyond_has_no_points(torus, ball):
    near = torus.distance(ball, shapes.translation(9)[None], within=1, points=True)
    assert near.distance[0] == np.inf and near.triangle_a[0] == -1 and np.isnan(near.point_b).all()


def test_what_meshes_are_asked_about(torus):
    model = shapes.bvh(*shapes.box())
    assert torus.collides(model, shapes.translation(1)) is True
    assert torus.bracket(model, shapes.translation(3)).upper > 1
    with pytest.raises(TypeError, match="must be a mesh"):
        torus.bracket(fcl.Box(0.5, 0.4, 0.3))
    with pytest.raises(TypeError, match="must be a Mesh or a geometry"):
        torus.collides("mesh")
    octree = fcl.OcTree(0.1, bytes([0xFF, 0xFF] + [0xAA, 0xAA] * 8))
    assert torus.distance(octree, points=True).distance >= 0


def test_solids(ball, block):
    inside = shapes.translation(0.1)
    small = fcl_kios.Mesh(*shapes.ball(12, 0.1), solid=True)
    assert block.collides(small, inside) and block.distance(small, inside) == 0
    assert block.bracket(small, inside) == (0, 0) and block.closer_than(small, 0.1, inside)
    assert block.distance(small, inside, points=True).triangle_a == -1
    points = np.random.default_rng(5).uniform(-0.7, 0.7, (2000, 3))
    assert np.array_equal(block.contains(points), (abs(points) <= 0.5).all(1))
    assert block.contains([0.5, 0.5, 0.5]) is True and block.contains([0.5, 0.5, 0.6]) is False
    assert block.contains([[2, 0, 0]], shapes.translation(2))[0]
    poses = np.stack([shapes.translation(0.9), shapes.translation(3), np.eye(4)])
    found = block.penetration(block, poses)
    assert found.lower[0] <= 0.1 + 1e-9 and 0.1 - 1e-9 <= found.upper[0] < 0.105
    assert found.lower[1] == found.upper[1] == 0 and not found.translation[1].any()
    assert type(block.penetration(block, poses[1]).upper) is float
    deep = block.local_depth(block, poses)
    assert np.allclose(deep.lower, [0.1, 0, 0.5], atol=1e-9) and deep.complete.all()
    assert deep.surface_of[0] in (1, 2) and deep.surface_of[2] == 0
    assert abs(np.linalg.norm(deep.point[0] - deep.nearest[0]) - 0.1) < 1e-9
    assert list(block.deeper_than(block, 0.2, poses)) == [False, False, True]
    with pytest.raises(RuntimeError, match="not decided"):
        block.deeper_than(block, 0.5)
    told = block.local_depth(block, poses, threshold=0.5)
    assert (told.upper[:2] <= 0.5).all() and told.lower[2] <= 0.5 < told.upper[2]
    with pytest.raises(ValueError, match="threshold"):
        block.local_depth(block, threshold=-1)
    soup = fcl_kios.Mesh(small.vertices, small.faces)
    for call in (soup.contains, lambda p: soup.penetration(block), lambda p: soup.local_depth(block)):
        with pytest.raises(ValueError, match="no solid"):
            call(points)
    with pytest.raises(ValueError, match="bounds no solid: .*edge"):
        fcl_kios.Mesh(ball.vertices, ball.faces[1:], solid=True)


def test_rays(ball):
    directions = np.random.default_rng(6).normal(size=(500, 3))
    unit = directions / np.linalg.norm(directions, axis=1)[:, None]
    hits = ball.rays([0, 0, 0], directions)
    assert (hits.triangle >= 0).all() and np.allclose(hits.point, unit * hits.distance[:, None])
    out = ball.rays(unit * 2, directions)
    assert (out.triangle == -1).all() and np.isinf(out.distance).all() and np.isnan(out.point).all()
    assert not ball.rays_blocked(unit * 2, -directions, t_max=1.4).any()
    assert ball.rays_blocked(unit * 2, -directions, t_max=1.6).all()
    assert (ball.rays(unit * 2, -directions, t_min=1.6).distance > 2).all()
    assert np.allclose(ball.rays([5, 0, 0], directions, shapes.translation(5)).distance, hits.distance)
    one = ball.rays([0, 0, 0], [0, 0, 3])
    assert type(one.distance) is float and abs(one.distance - 0.5) < 1e-12
    with pytest.raises(ValueError, match="2 origins, but 3 directions"):
        ball.rays(np.zeros((2, 3)), np.ones((3, 3)))
    with pytest.raises(ValueError, match=r"directions\[1\]"):
        ball.rays(np.zeros((2, 3)), [[0, 0, 1.0], [0, 0, 0]])


def test_arrays_of_any_layout(torus, ball, poses):
    want = torus.distance(ball, poses)
    wide = np.zeros((len(poses), 4, 8))
    wide[:, :, ::2] = poses
    swapped = poses.astype(">f8")
    read_only = poses.copy()
    read_only.setflags(write=False)
    for same in (np.asfortranarray(poses), wide[:, :, ::2], swapped, read_only, poses.tolist(),
                 [p for p in poses]):
        assert np.array_equal(torus.distance(ball, same), want)
    single = poses.astype(np.float32)
    assert np.array_equal(torus.distance(ball, single), torus.distance(ball, single.astype(float)))
    whole = np.eye(4, dtype=np.int32)
    whole[0, 3] = 3
    assert torus.distance(ball, whole) == torus.distance(ball, shapes.translation(3))
    doubled, f = (2 * shapes.box()[0]).astype(np.uint8), shapes.box()[1]
    assert np.array_equal(fcl_kios.Mesh(doubled, f).vertices, doubled)
    v, f = shapes.torus(60, 40)
    for vertices, faces in [(np.asfortranarray(v), f.astype(np.uint16)), (v.tolist(), f.tolist()),
                            (v[::-1][::-1], f.astype(np.uint64))]:
        mesh = fcl_kios.Mesh(vertices, faces)
        assert np.array_equal(mesh.vertices, v) and np.array_equal(mesh.faces, f)


def test_what_arrays_are_refused(torus, ball, poses):
    for wrong, message in [(np.full((4, 4), 2**60), "X_AB has integers"),
                           (poses > 0, "X_AB has dtype bool"),
                           (poses.astype(complex), "complex128"), (poses.astype(object), "object"),
                           (poses.astype(np.float16), "float16"),
                           (poses.astype(np.longdouble), "longdouble|float128"),
                           (poses[:, :3], r"shape \(300, 3, 4\)"), (poses[None], "shape"),
                           (np.float64(1), "shape"), ("abc", "dtype"), ([[1], [1, 2]], "X_AB"),
                           (poses * 1.5, r"X_AB\[0\] is no pose")]:
        with pytest.raises(ValueError, match=message):
            torus.collides(ball, wrong)
    for change, at in [((slice(None, 3), slice(None, 3)), 17), ((0, 3), 250)]:
        bad = poses.copy()
        bad[(at, *change)] = np.nan
        for threads in (1, 2):
            with pytest.raises(ValueError, match=rf"X_AB\[{at}\]"):
                torus.distance(ball, bad, threads=threads)
    bad = poses.copy()
    bad[40:, :3, :3] *= 1.01
    for _ in range(5):
        with pytest.raises(ValueError, match=r"X_AB\[40\]"):
            torus.distance(ball, bad, threads=4)
    for option in (dict(rel_err=-1), dict(within=-1), dict(within=np.nan), dict(abs_err=np.nan),
                   dict(threads=0), dict(threads=1.5)):
        with pytest.raises(ValueError):
            torus.distance(ball, poses, **option)
    v, f = shapes.box()
    for vertices, faces, message in [
            ((v * 2).astype(int) * 2**60, f, "vertices has integers"),
            (v[:, :2], f, "vertices has shape"),
            (v, f.astype(float), "faces has dtype float64"), (v, f[:, :2], "faces has shape"),
            (v, f + 1, "faces.*refers to vertex 8, but there are 8"), (v, f - 1, "vertex -1"),
            (v, f[:0], "at least one triangle"), (v + np.inf, f, r"vertices\[0\] is not finite"),
            (v, f.astype(bool), "bool"), (v.astype(complex), f, "complex")]:
        with pytest.raises(ValueError, match=message):
            fcl_kios.Mesh(vertices, faces)
    with pytest.raises(ValueError, match="2 poses X_WM for 3"):
        ball.contains(np.zeros((3, 3)), poses[:2])
    for points in ([1, 2], np.zeros((3, 2)), np.zeros((2, 3, 3)), [2**60 + 1, 0, 0], [None] * 3):
        with pytest.raises(ValueError, match="points"):
            ball.contains(points)


def test_poses_are_read_where_they_lie(torus, ball):
    import tracemalloc

    poses = np.tile(shapes.translation(9), (200_000, 1, 1))  # 26 MB
    tracemalloc.start()
    torus.collides(ball, poses)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 1e6


def test_views(torus):
    vertices, faces = torus.vertices, torus.faces
    assert vertices.dtype == np.float64 and faces.dtype == np.int64
    for array in (vertices, faces):
        with pytest.raises(ValueError):
            array[0, 0] = 1
        with pytest.raises(ValueError):
            array.setflags(write=True)
    assert np.shares_memory(vertices, torus.vertices)
    mesh = fcl_kios.Mesh(*shapes.box())
    view = mesh.vertices
    del mesh
    assert view.sum() == 0
    assert torus.nbytes > 200 * len(faces) and "4800 triangles" in repr(torus)


def test_progress(torus, ball, poses):
    many, told = np.tile(poses, (40, 1, 1)), []
    torus.distance(ball, many, progress=told.append)
    assert sum(told) == len(many) and all(n > 0 for n in told)
    for threads in (1, 2):
        with pytest.raises(ZeroDivisionError):
            torus.distance(ball, many, progress=lambda n: 1 / 0, threads=threads)


def test_the_gil_is_free_meanwhile(torus, ball, poses):
    many, ticks, stop = np.tile(poses, (60, 1, 1)), [], threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    ticker = threading.Thread(target=tick)
    ticker.start()
    start = time.perf_counter()
    torus.distance(ball, many, threads=1)
    took = time.perf_counter() - start
    stop.set()
    ticker.join()
    during = [t for t in ticks if start < t < start + took]
    assert len(during) > took / 0.02
