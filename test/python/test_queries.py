# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""python-fcl's queries, managers and callbacks: what they return, and whose objects."""
import numpy as np
import pytest

import shapes
from fcl_kios import fcl


@pytest.fixture(scope="module")
def mesh():
    return shapes.bvh(*shapes.torus())


@pytest.fixture(scope="module")
def cube():
    return shapes.bvh(*shapes.box())


def test_contacts_name_the_callers_geometries(mesh, cube):
    a, b = shapes.placed(mesh), shapes.placed(cube, shapes.translation(1))
    for o1, o2 in [(a, b), (b, a), (a, shapes.placed(fcl.Box(1, 1, 1), shapes.translation(1))),
                   (shapes.placed(fcl.Sphere(0.6), shapes.translation(1)), b)]:
        result = fcl.CollisionResult()
        n = fcl.collide(o1=o1, o2=o2, request=fcl.CollisionRequest(num_max_contacts=5,
                                                                   enable_contact=True),
                        result=result)
        assert 0 < n == len(result.contacts) <= 5 and result.is_collision is True
        for c in result.contacts:
            assert {id(c.o1), id(c.o2)} == {id(o1._geometry), id(o2._geometry)}
            assert c.normal.shape == c.pos.shape == (3,)
            assert abs(np.linalg.norm(c.normal) - 1) < 1e-6 and np.isfinite(c.penetration_depth)
            assert type(c.b1) is int and type(c.b2) is int
        fcl.collide(o1, o2, None, result)  # adds to it
        assert len(result.contacts) == n + 1
    far = shapes.placed(cube, shapes.translation(9))
    result = fcl.CollisionResult()
    assert fcl.collide(a, far, result=result) == 0 and not result.is_collision
    assert fcl.collide(a, b) == 1


def test_costs(mesh, cube):
    result = fcl.CollisionResult()
    fcl.collide(shapes.placed(mesh), shapes.placed(cube, shapes.translation(1)),
                fcl.CollisionRequest(num_max_cost_sources=3, enable_cost=True), result)
    assert 0 < len(result.cost_sources) <= 3
    assert (result.cost_sources[0].aabb_min <= result.cost_sources[0].aabb_max).all()


def test_distances(mesh, cube):
    a, b = shapes.placed(mesh), shapes.placed(cube, shapes.translation(3))
    result = fcl.DistanceResult()
    assert result.nearest_points == [None, None]
    d = fcl.distance(a, b, fcl.DistanceRequest(enable_nearest_points=True), result)
    assert d == result.min_distance and 1 < d < 1.2
    assert result.o1 is mesh and result.o2 is cube
    p, q = result.nearest_points
    assert abs(np.linalg.norm(p - q) - d) < 1e-12
    # A result keeps the nearest; the call returns its own.
    far = shapes.placed(cube, shapes.translation(9))
    assert fcl.distance(a, far, None, result) > 6 and result.min_distance == d
    # Points that weren't asked for aren't whatever the memory held.
    plain = fcl.DistanceResult()
    fcl.distance(a, b, fcl.DistanceRequest(), plain)
    assert np.isnan(plain.nearest_points).all()
    # The solver, which python-fcl hands on as rel_err, changes nothing.
    loose = fcl.DistanceRequest(gjk_solver_type=fcl.GJKSolverType.GST_INDEP)
    assert fcl.distance(a, b, loose) == d


def test_continuous(mesh, cube):
    a, b = shapes.placed(mesh), shapes.placed(cube, shapes.translation(3))
    result = fcl.ContinuousCollisionResult()
    end = fcl.Transform(np.array([-3.0, 0, 0]))
    t = fcl.continuousCollide(a, fcl.Transform(), b, end, fcl.ContinuousCollisionRequest(), result)
    assert result.is_collide is True and t == result.time_of_contact and 0.1 < t < 0.25
    assert fcl.continuousCollide(a, fcl.Transform(), b, fcl.Transform(np.array([3.0, 1, 0]))) == 1


def test_bad_requests(mesh, cube):
    a, b = shapes.placed(mesh), shapes.placed(cube)
    with pytest.raises(TypeError, match="CollisionRequest.num_max_contacts"):
        fcl.collide(a, b, fcl.CollisionRequest(num_max_contacts="many"))
    with pytest.raises(TypeError, match="num_max_contacts"):
        fcl.collide(a, b, fcl.CollisionRequest(num_max_contacts=-1))
    with pytest.raises(AttributeError):
        fcl.collide(a, b, object())
    with pytest.raises(TypeError):
        fcl.collide(a, mesh)
    with pytest.raises(TypeError):
        fcl.collide(None, a)
    skewed = shapes.placed(cube, np.diag([1.0, 2, 1, 1]))
    with pytest.raises(ValueError, match="rigid|rotation"):
        fcl.distance(a, skewed)


def managed(*objects):
    manager = fcl.DynamicAABBTreeCollisionManager()
    manager.registerObjects(objects)
    manager.setup()
    return manager


def test_managers_and_default_callbacks(mesh, cube):
    objects = [shapes.placed(cube, shapes.translation(1.5 * i)) for i in range(8)]
    ring = shapes.placed(mesh)
    for manager in (managed(*objects), managed()):
        for o in objects:
            manager.registerObject(o)  # once is enough
        assert manager.size() == 8 and not manager.empty()
        assert all(x is y for x, y in zip(manager.getObjects(), objects))
        data = fcl.DistanceData(fcl.DistanceRequest(enable_nearest_points=True))
        manager.distance(data, fcl.defaultDistanceCallback)
        assert abs(data.result.min_distance - 0.5) < 1e-12 and data.result.o1 is cube
        data = fcl.CollisionData(fcl.CollisionRequest(num_max_contacts=100))
        manager.collide(data, fcl.defaultCollisionCallback)
        assert not data.result.is_collision and not data.done
        manager.collide(ring, data, fcl.defaultCollisionCallback)
        assert data.result.is_collision
        assert {id(c.o1) for c in data.result.contacts} | {id(c.o2) for c in data.result.contacts} \
            == {id(mesh), id(cube)}
        other = managed(ring)
        data = fcl.DistanceData()
        manager.distance(other, data, fcl.defaultDistanceCallback)
        assert data.result.min_distance == 0
    objects[3].setTranslation([0, 0, 0])
    manager.update(objects[3])
    data = fcl.CollisionData()
    manager.collide(data, fcl.defaultCollisionCallback)
    assert data.result.is_collision
    manager.update(objects)
    manager.update(ring)  # which it doesn't have
    manager.unregisterObject(ring)
    manager.unregisterObject(objects[3])
    assert manager.size() == 7 and objects[3] not in manager.getObjects()
    manager.clear()
    assert manager.empty() and manager.getObjects() == []
    manager.distance(fcl.DistanceData(), fcl.defaultDistanceCallback)


def test_the_default_callbacks_in_cpp_are_those_of_python(mesh):
    random = np.random.default_rng(3)
    objects = [shapes.placed(mesh, X) for X in shapes.random_poses(14, 2.5, random)]
    manager, half = managed(*objects), managed(*objects[7:])
    for most in (1, 4, 1000):
        answers = []
        for callback in (fcl.defaultCollisionCallback,
                         lambda a, b, data: fcl.defaultCollisionCallback(a, b, data)):
            data = fcl.CollisionData(fcl.CollisionRequest(num_max_contacts=most))
            manager.collide(data, callback)
            manager.collide(objects[0], data, callback)
            half.collide(manager, data, callback)
            answers.append((data.done, data.result.is_collision,
                            [(c.b1, c.b2) for c in data.result.contacts]))
        assert answers[0] == answers[1]
    answers = []
    for callback in (fcl.defaultDistanceCallback,
                     lambda a, b, data: fcl.defaultDistanceCallback(a, b, data)):
        for ask in (lambda d: managed(*objects[::5]).distance(d, callback),
                    lambda d: half.distance(shapes.placed(mesh, shapes.translation(9)), d, callback)):
            data = fcl.DistanceData(fcl.DistanceRequest(enable_nearest_points=True))
            ask(data)
            answers.append((data.result.min_distance, data.result.b1, data.result.b2,
                            np.ravel(data.result.nearest_points).tolist()))
    assert answers[:2] == answers[2:]


def test_callbacks_get_the_callers_objects(cube):
    class Part(fcl.CollisionObject):
        def __init__(self, geometry, name):
            super().__init__(geometry)
            self.name = name

    parts = [Part(cube, f"part {i}") for i in range(4)]
    manager, seen, data = managed(*parts), [], {"any": "object"}

    def callback(a, b, cdata):
        assert cdata is data and a in parts and b in parts
        seen.append({a.name, b.name})
        fcl.collide(a, b)
        return False

    manager.collide(data, callback)
    assert len(seen) == 6
    seen.clear()
    manager.collide(data, lambda a, b, _: bool(seen.append(a)) or len(seen) == 2)
    assert len(seen) == 2
    manager.distance(data, lambda a, b, _: (True, fcl.distance(a, b)))


def test_what_a_callback_raises_ends_the_query(cube):
    manager, calls = managed(*[shapes.placed(cube) for _ in range(6)]), []

    def callback(*_):
        calls.append(1)
        raise KeyError("mine")

    for ask in (lambda: manager.collide(None, callback), lambda: manager.distance(None, callback),
                lambda: manager.collide(managed(shapes.placed(cube)), None, callback),
                lambda: manager.distance(shapes.placed(cube), None, callback)):
        calls.clear()
        with pytest.raises(KeyError, match="mine"):
            ask()
        assert len(calls) == 1
    with pytest.raises(TypeError, match="distance callback must return"):
        manager.distance(None, lambda *_: False)
    with pytest.raises(TypeError):
        manager.distance(None, lambda *_: (False, "far"))
    for arguments in [(), (None,), (None, None), (1, None, callback), (1, 2, 3, callback)]:
        with pytest.raises((ValueError, TypeError)):
            manager.collide(*arguments)


def test_a_callback_cant_pull_the_rug(cube):
    objects = [shapes.placed(cube) for _ in range(4)]
    manager, refused = managed(*objects), []

    def callback(a, b, _):
        for change in (lambda: manager.unregisterObject(a), manager.clear, manager.update,
                       lambda: manager.registerObject(shapes.placed(cube)), manager.setup):
            with pytest.raises(RuntimeError, match="while a query reads it"):
                change()
            refused.append(change)
        return False

    manager.collide(None, callback)
    assert len(refused) == 30
    manager.clear()


def test_settings_of_the_tree():
    manager = fcl.DynamicAABBTreeCollisionManager()
    for name, kind in dict(max_tree_nonbalanced_level=int, tree_incremental_balance_pass=int,
                           tree_topdown_balance_threshold=int, tree_topdown_level=int,
                           tree_init_level=int, octree_as_geometry_collide=bool,
                           octree_as_geometry_distance=bool).items():
        value = getattr(manager, name)
        assert type(value) is kind
        setattr(manager, name, kind(1))
        assert getattr(manager, name) == 1


def test_solids_have_signed_distances(cube):
    solid = shapes.bvh(*shapes.box(4.0))
    solid.markSolid()
    inner = shapes.bvh(*shapes.box())
    inner.markSolid()
    o1, o2 = shapes.placed(solid), shapes.placed(inner, shapes.translation(1))
    assert fcl.collide(o1, o2) == 1 and fcl.collide(o1, shapes.placed(cube)) == 0
    result = fcl.DistanceResult()
    fcl.distance(o1, o2, fcl.DistanceRequest(True, True), result)
    assert -1.6 < result.min_distance < -1.49
    with pytest.raises(ValueError, match="no solid"):
        shapes.bvh(*[x[:4] if i else x for i, x in enumerate(shapes.box())]).markSolid()
