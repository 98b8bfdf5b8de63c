# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Nothing leaks, and objects outlive what they were made from, in any order of deletion."""
import gc
import itertools
import os
import pickle
import sys
import weakref

import numpy as np
import pytest

import fcl_kios
import shapes
from fcl_kios import fcl


def resident():
    """Bytes of this process in memory."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * 4096


def everything():
    """Creates, asks, is refused and calls back."""
    mesh = shapes.bvh(*shapes.torus(8, 6))
    geometries = [mesh, fcl.Box(1, 1, 1), fcl.Convex(*convex()), fcl.Sphere(1),
                  fcl.OcTree(0.1, bytes([0xFF, 0xFF] + [0xAA, 0xAA] * 8))]
    objects = [shapes.placed(g, shapes.translation(0.3 * i)) for i, g in enumerate(geometries)]
    manager = fcl.DynamicAABBTreeCollisionManager()
    manager.registerObjects(objects)
    manager.setup()
    for callback in (fcl.defaultCollisionCallback, lambda *_: False):
        manager.collide(fcl.CollisionData(fcl.CollisionRequest(100, True, 2, True)), callback)
    manager.distance(objects[0], fcl.DistanceData(), lambda a, b, _: (False, fcl.distance(a, b)))
    manager.unregisterObject(objects[1])
    for wrong in (lambda: manager.collide(None, lambda *_: 1 / 0), lambda: fcl.Transform("abc"),
                  lambda: fcl.CollisionObject(None), lambda: mesh.addSubModel(np.eye(3), [[0, 1, 9]]),
                  lambda: fcl.collide(objects[0], objects[1], object())):
        try:
            wrong()
        except Exception:
            pass
    fcl.continuousCollide(objects[0], fcl.Transform(), objects[1], fcl.Transform([1, 0, 0]))
    a, b = fcl_kios.Mesh(*shapes.torus(8, 6)), fcl_kios.Mesh(*shapes.ball(4), solid=True)
    poses = np.tile(np.eye(4), (5, 1, 1))
    a.collides(b, poses), a.distance(b, poses, points=True), a.bracket(b, poses)
    b.contains(poses[0, :3, :3]), b.penetration(b), a.rays(poses[0, :3, :3], poses[0, :3, :3])
    for wrong in (lambda: a.collides(b, poses * 2), lambda: a.distance(b, poses, progress=lambda n: 1 / 0)):
        try:
            wrong()
        except Exception:
            pass
    scene = fcl_kios.Scene()
    scene.add("a", a)
    scene.add("b", geometries[1], shapes.translation(3))
    scene.closest(points=True), scene.within(1), scene.clearances()
    pickle.loads(pickle.dumps((a, b, mesh, objects[0], scene), protocol=5))


def convex():
    v, f = shapes.box()
    return v, len(f), np.insert(f, 0, 3, axis=1).ravel()


def small():
    """What programs do a million times: creations, queries, callbacks and exceptions."""
    still = shapes.placed(CUBE)
    other = fcl.CollisionObject(fcl.Box(1, 2, 3), fcl.Transform([3, 0, 0]))
    fcl.distance(still, other, fcl.DistanceRequest(True), fcl.DistanceResult())
    fcl.collide(still, other, fcl.CollisionRequest(), fcl.CollisionResult())
    for wrong in (lambda: MESH.collides(MESH, 2 * np.eye(4)), lambda: fcl.Transform("no"),
                  lambda: PAIR.collide(other, lambda *_: 1 / 0)):
        with pytest.raises((ValueError, TypeError, ZeroDivisionError)):
            wrong()
    PAIR.collide({}, lambda *_: True)
    MESH.distance(MESH, shapes.translation(3))


CUBE, MESH = shapes.bvh(*shapes.box()), fcl_kios.Mesh(*shapes.box())
PAIR = fcl.DynamicAABBTreeCollisionManager()
PAIR.registerObjects([fcl.CollisionObject(CUBE), fcl.CollisionObject(fcl.Sphere(1))])
PAIR.setup()


@pytest.mark.parametrize("work, rounds, bytes", [
    (everything, 400, 8000),
    (small, 2 * int(os.environ.get("KIOS_LOOPS", 10_000)), 75)])  # 500000 make it a million
def test_memory_is_flat(work, rounds, bytes):
    for _ in range(60 + rounds // 10):
        work()
    gc.collect()
    before, objects = resident(), len(gc.get_objects())
    for _ in range(rounds):
        work()
    gc.collect()
    assert len(gc.get_objects()) < objects + 200
    assert resident() - before < max(1.5e6, rounds * bytes)


def test_reference_counts():
    mesh, other = shapes.bvh(*shapes.torus(8, 6)), fcl.Box(1, 1, 1)
    data = fcl.CollisionData()

    def callback(a, b, cdata):
        return False

    def round_trip():
        objects = [fcl.CollisionObject(mesh), fcl.CollisionObject(other)]
        manager = fcl.DynamicAABBTreeCollisionManager()
        manager.registerObjects(objects)
        manager.collide(data, callback)
        manager.collide(fcl.CollisionData(), fcl.defaultCollisionCallback)
        fcl.distance(*objects, fcl.DistanceRequest(), fcl.DistanceResult())

    round_trip()
    watched = [mesh, other, data, callback, fcl.defaultCollisionCallback, fcl.Contact, None]
    counts = [sys.getrefcount(x) for x in watched]
    for _ in range(50):
        round_trip()
    after = [sys.getrefcount(x) for x in watched]
    assert after[:-1] == counts[:-1] and after[-1] < counts[-1] + 25


def test_objects_live_as_long_as_they_are_needed():
    """The result of a query names its parts, which live by that."""
    for order in itertools.permutations(range(4)):
        g1, g2 = shapes.bvh(*shapes.torus(8, 6)), fcl.Box(1, 1, 1)
        o1, o2 = fcl.CollisionObject(g1), fcl.CollisionObject(g2, fcl.Transform([1, 0, 0]))
        manager = fcl.DynamicAABBTreeCollisionManager()
        manager.registerObjects([o1, o2])
        alive = {0: g1, 1: g2, 2: o1, 3: o2}
        ids, watch = (id(g1), id(g2)), weakref.ref(o1)
        del g1, g2, o1, o2
        for i in order:
            del alive[i]
            gc.collect()
            data = fcl.CollisionData()
            manager.collide(data, fcl.defaultCollisionCallback)
            contact = data.result.contacts[0]
            assert (id(contact.o1), id(contact.o2)) in (ids, ids[::-1])
        assert watch() is not None
        del manager, data, contact
        gc.collect()
        assert watch() is None


def test_cycles_are_collected():
    class Part(fcl.CollisionObject):
        pass

    class Shape(fcl.Box):
        pass

    class Manager(fcl.DynamicAABBTreeCollisionManager):
        pass

    shape = Shape(1, 1, 1)
    part, manager = Part(shape), Manager()
    shape.part, part.manager = part, manager
    manager.registerObject(part)
    watch = [weakref.ref(x) for x in (shape, part, manager)]
    del shape, part, manager
    gc.collect()
    assert [w() for w in watch] == [None] * 3


def test_half_made_objects():
    """Python subclasses that don't call __init__, or raise in it, are refused, not crashed on."""

    class Lazy(fcl.CollisionObject):
        def __init__(self):
            pass

    class Failing(fcl.CollisionObject):
        def __init__(self):
            gc.collect()
            raise KeyError

    with pytest.raises(TypeError):
        Lazy()
    with pytest.raises(KeyError):
        Failing()
    gc.collect()
    for cls in (fcl.OcTree, fcl.DynamicAABBTreeCollisionManager):
        with pytest.raises(TypeError, match="pickle"):
            pickle.dumps(cls.__new__(cls))
