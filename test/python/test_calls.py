# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Calls beyond pairs of poses: several geometries, contacts, all hits, and what mends a mesh."""
import numpy as np
import pytest

import fcl_kios
import shapes
from fcl_kios import fcl


def test_several_geometries_in_one_call(torus, ball, block, poses):
    several = [ball, block, torus]
    stacked = np.stack([poses, poses[::-1], poses])
    for ask in (torus.collides, torus.distance, lambda o, X: torus.bracket(o, X).lower,
                lambda o, X: torus.closer_than(o, 0.3, X),
                lambda o, X: torus.distance(o, X, points=True).point_b):
        one_by_one = np.stack([ask(o, X) for o, X in zip(several, stacked)])
        assert np.array_equal(ask(several, stacked), one_by_one, equal_nan=True)
        assert np.array_equal(ask(several, stacked[:, 7]), one_by_one[:, 7], equal_nan=True)
    X = shapes.translation(2)
    assert torus.distance((ball, fcl.Sphere(0.5)), X).tolist() == [
        torus.distance(ball, X), torus.distance(fcl.Sphere(0.5), X)]
    assert torus.collides([ball, torus]).tolist() == [torus.collides(ball), True]
    assert torus.collides([], np.empty((0, 4, 4))).shape == (0,)
    inside = block.penetration([block, ball], shapes.translation(0.9))
    assert inside.translation.shape == (2, 3) and inside.upper.shape == (2,)
    for wrong in (stacked[:2], poses, np.zeros((3, 4))):
        with pytest.raises(ValueError, match="shape"):
            torus.collides(several, wrong)
    with pytest.raises(TypeError, match="must be a mesh"):
        torus.bracket([ball, fcl.Sphere(1)], stacked[:2])


def test_a_pose_for_each_query(ball):
    random = np.random.default_rng(8)
    X = shapes.random_poses(200, 0.4, random)
    points = random.uniform(-0.4, 0.4, (200, 3))
    want = [ball.contains(p, x) for p, x in zip(points, X)]
    assert np.array_equal(ball.contains(points, X), want) and 20 < sum(want) < 180
    directions = random.normal(size=(200, 3))
    for ask in (lambda d, x: ball.rays([0, 0, 0], d, x).distance,
                lambda d, x: ball.rays_blocked([0, 0, 0], d, x)):
        assert np.array_equal(ask(directions, X), [ask(d, x) for d, x in zip(directions, X)])
    with pytest.raises(ValueError, match="3 poses X_WM for 200"):
        ball.rays([0, 0, 0], directions, X[:3])


@pytest.mark.parametrize("probe", [fcl.Box(0.5, 0.4, 0.3), None], ids=["box", "mesh"])
def test_contacts_are_those_of_collide(torus, ball, poses, probe):
    other = probe or ball
    found = torus.contacts(other, poses, max_contacts=50)
    a = shapes.placed(shapes.bvh(torus.vertices, torus.faces))
    b = fcl.CollisionObject(probe or shapes.bvh(ball.vertices, ball.faces))
    assert 0 < len(found.pose) and (np.diff(found.pose) >= 0).all()
    for i in np.unique(found.pose)[:20]:
        b.setTransform(fcl.Transform(poses[i, :3, :3], poses[i, :3, 3]))
        result = fcl.CollisionResult()
        fcl.collide(a, b, fcl.CollisionRequest(50, True), result)
        mine = [(c.pos, c.normal, c.penetration_depth, c.b1) for c in result.contacts]
        for k, (pos, normal, depth, triangle) in zip(np.flatnonzero(found.pose == i), mine):
            assert np.array_equal(found.point[k], pos) and np.array_equal(found.normal[k], normal)
            assert found.depth[k] == depth and found.triangle_a[k] == triangle
        assert (found.pose == i).sum() == len(mine)
    assert np.array_equal(np.unique(found.pose), np.flatnonzero(torus.collides(other, poses)))
    assert (found.triangle_b >= 0).all() == (probe is None)
    assert torus.contacts(other, shapes.translation(9)).point.shape == (0, 3)
    assert len(torus.contacts([other, other], np.stack([poses, poses])).pose) == 2 * len(
        torus.contacts(other, poses).pose)


def test_all_hits_of_rays(torus):
    random = np.random.default_rng(9)
    origins, directions = random.normal(size=(200, 3)), random.normal(size=(200, 3))
    X = shapes.random_poses(1, 0.5, random)[0]
    found, first = torus.rays_all(origins, directions, X), torus.rays(origins, directions, X)
    begins = np.flatnonzero(np.diff(found.ray, prepend=-1))
    hit = found.ray[begins]
    assert np.array_equal(hit, np.flatnonzero(first.triangle >= 0)) and len(found.ray) > len(hit) > 30
    for mine, want in zip(found[1:4], first):
        assert np.array_equal(mine[begins], want[hit])
    corners = torus.vertices[torus.faces[found.triangle]] @ X[:3, :3].T
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert np.allclose(found.normal, normals / np.linalg.norm(normals, axis=1)[:, None])
    assert np.array_equal(torus.rays_all(origins, directions, X, max_hits=1).ray, hit)
    flat = fcl_kios.Mesh([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]])
    assert np.isnan(flat.rays_all([0.5, 0, 1], [0, 0, -1]).normal).all()


def test_measures(torus, ball, block):
    assert block.bounds.tolist() == [[-0.5] * 3, [0.5] * 3] and abs(block.volume - 1) < 1e-12
    far = fcl_kios.Mesh(block.vertices + 1e6, block.faces)
    assert abs(far.volume - 1) < 1e-9 and far.bounds[1, 0] == 1e6 + 0.5
    assert abs(ball.volume - np.pi / 6) < 0.01 and np.pi ** 2 * 0.32 * 0.9 < torus.volume
    extra = fcl_kios.Mesh(np.vstack([block.vertices, [[9, 9, 9]]]), block.faces)
    assert extra.bounds[1, 0] == 0.5


def test_to_trimesh(block):
    trimesh = pytest.importorskip("trimesh")
    made = block.to_trimesh()
    assert isinstance(made, trimesh.Trimesh) and np.array_equal(made.faces, block.faces)


def test_self_intersections(torus):
    v, f = shapes.box()
    two = fcl_kios.Mesh(np.vstack([v, v + [0.3, 0.2, 0.1]]), np.vstack([f, f + 8]))
    found = two.self_intersections()
    assert len(found.kind) > 4 and set(found.kind) == {"cross"}
    assert (found.triangles[:, 0] < 12).all() and (found.triangles[:, 1] >= 12).all()
    assert np.array_equal(two.self_intersections(3).triangles, found.triangles[:3])
    assert torus.self_intersections().triangles.shape == (0, 2)
    folded = fcl_kios.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.2, 0.7, 0]], [[0, 1, 2], [1, 0, 3]])
    assert folded.self_intersections().kind.tolist() == ["overlap"]


def test_repair():
    v, f = shapes.box()
    loose = v[f].reshape(-1, 3) + np.random.default_rng(3).uniform(-1e-7, 1e-7, (36, 3))
    faces = np.arange(36).reshape(-1, 3)
    mended = fcl_kios.repair(loose, faces)
    assert mended.is_solid and len(mended.vertices) == 8 and "28 vertices welded" in mended.summary
    assert np.abs(mended.vertices[mended.vertex_of] - loose).max() < 3e-7
    assert np.array_equal(mended.triangle_of, np.arange(12))
    assert not fcl_kios.repair(loose, faces, weld=0).is_solid
    assert fcl_kios.repair(loose, faces, weld=0, weld_length=1e-6).is_solid
    filled = fcl_kios.repair(v, f[1:], max_hole_edges=3)
    assert filled.is_solid and filled.triangle_of[-1] == -1
    for wrong in (dict(weld=-1), dict(max_hole_edges=1000)):
        with pytest.raises(ValueError):
            fcl_kios.repair(v, f, **wrong)


def test_a_soup_within_a_solid_is_what_the_docstring_says(block):
    v, f = shapes.ball(8, 0.1)
    soup, solid = fcl_kios.Mesh(v, f), fcl_kios.Mesh(v, f, solid=True)
    assert "Of a Mesh that is no solid only the surface counts" in " ".join(fcl_kios.Mesh.__doc__.split())
    for inner, hit in [(soup, False), (solid, True), (fcl.Sphere(0.1), True), (fcl.Box(.1, .1, .1), True)]:
        assert block.collides(inner) is hit and (block.distance(inner) == 0) is hit


def test_watertight_meshes_have_signed_distances():
    """As trimesh asks for them: DistanceRequest(enable_signed_distance=True) by a manager."""
    v, f = shapes.box(2.0)

    def least(faces):
        objects = [shapes.placed(shapes.bvh(v, faces), X) for X in
                   (np.eye(4), shapes.translation(1.5), shapes.translation(9))]
        manager = fcl.DynamicAABBTreeCollisionManager()
        manager.registerObjects(objects)
        data = fcl.DistanceData(fcl.DistanceRequest(True, True))
        manager.distance(data, fcl.defaultDistanceCallback)
        return data.result.min_distance

    assert least(f) == 0
    try:
        fcl.mark_watertight()
        assert -0.52 < least(f) <= -0.5
        assert least(f[1:]) == 0  # it has a hole
        assert least(f[:, ::-1]) == 0  # inside out
    finally:
        fcl.mark_watertight(False)
    assert least(f) == 0
