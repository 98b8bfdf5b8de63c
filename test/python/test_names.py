# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every name of python-fcl, its keywords and what it returns."""
import copy
import inspect
import pickle

import numpy as np
import pytest

import fcl_kios
import shapes
from fcl_kios import fcl

NAMES = """CollisionObject CollisionGeometry Transform TriangleP Box Sphere Ellipsoid Capsule Cone
Convex Cylinder Halfspace Plane BVHModel OcTree DynamicAABBTreeCollisionManager collide
continuousCollide distance defaultCollisionCallback defaultDistanceCallback OBJECT_TYPE NODE_TYPE
CCDMotionType CCDSolverType GJKSolverType Contact CostSource CollisionRequest CollisionResult
ContinuousCollisionRequest ContinuousCollisionResult DistanceRequest DistanceResult CollisionData
DistanceData __version__""".split()

N = np.array([0.0, 0, 1])
TETRAHEDRON = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
TRIANGLES = np.array([[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]])
FACES = np.insert(TRIANGLES, 0, 3, axis=1).ravel()
OCTREE = bytes([0xFF, 0xFF] + [0xAA, 0xAA] * 8)


def make(name):
    return {
        "TriangleP": lambda: fcl.TriangleP(a=TETRAHEDRON[0], b=TETRAHEDRON[1], c=TETRAHEDRON[2]),
        "Box": lambda: fcl.Box(x=1, y=2, z=3),
        "Sphere": lambda: fcl.Sphere(radius=0.5),
        "Ellipsoid": lambda: fcl.Ellipsoid(a=1, b=2, c=3),
        "Capsule": lambda: fcl.Capsule(radius=0.5, lz=2),
        "Cone": lambda: fcl.Cone(radius=0.5, lz=2),
        "Cylinder": lambda: fcl.Cylinder(radius=0.5, lz=2),
        "Convex": lambda: fcl.Convex(vertices=TETRAHEDRON, num_faces=4, faces=FACES),
        "Halfspace": lambda: fcl.Halfspace(n=N, d=0.5),
        "Plane": lambda: fcl.Plane(n=N, d=0.5),
        "BVHModel": lambda: shapes.bvh(TETRAHEDRON, TRIANGLES),
        "OcTree": lambda: fcl.OcTree(r=0.1, data=OCTREE),
    }[name]()


GEOMETRIES = NAMES[3:15]
NODES = dict(TriangleP="GEOM_TRIANGLE", BVHModel="BV_OBBRSS", OcTree="GEOM_OCTREE")


def test_all_37():
    assert len(NAMES) == 37 and sorted(fcl.__all__) == sorted(NAMES)
    assert all(hasattr(fcl, name) for name in NAMES)
    assert isinstance(fcl.__version__, str)


def test_numbers():
    for cls, members in dict(OBJECT_TYPE=5, NODE_TYPE=21, CCDMotionType=4, CCDSolverType=4,
                             GJKSolverType=2).items():
        values = [v for k, v in vars(getattr(fcl, cls)).items() if not k.startswith("_")]
        assert sorted(values) == list(range(members)) and all(type(v) is int for v in values)
    assert fcl.NODE_TYPE.GEOM_OCTREE == 19 and fcl.CCDMotionType.CCDM_SCREW == 2


@pytest.mark.parametrize("name", GEOMETRIES)
def test_geometries(name):
    g = make(name)
    assert isinstance(g, fcl.CollisionGeometry) and type(g).__module__ == "fcl_kios.fcl"
    node = NODES.get(name, "GEOM_" + name.upper())
    assert g.getNodeType() == getattr(fcl.NODE_TYPE, node)
    g.computeLocalAABB()
    assert g.aabb_center.shape == (3,)
    g.aabb_center = [1, 2, 3]
    assert g.aabb_center.tolist() == [1, 2, 3]
    with pytest.raises(ValueError, match="not finite"):
        g.aabb_center = [1, np.nan, 3]
    o = fcl.CollisionObject(geom=g, tf=fcl.Transform(np.array([1.0, 2, 3])))
    assert o.getNodeType() == getattr(fcl.NODE_TYPE, node)
    kinds = dict(BVHModel=fcl.OBJECT_TYPE.OT_BVH, OcTree=fcl.OBJECT_TYPE.OT_OCTREE)
    assert o.getObjectType() == kinds.get(name, fcl.OBJECT_TYPE.OT_GEOM)
    assert o.isOccupied() is True and o.isFree() is False and o.isUncertain() is False


def test_members():
    for name, member, value in [("Box", "side", (4, 5, 6)), ("Ellipsoid", "radii", (4, 5, 6)),
                                ("TriangleP", "b", (4, 5, 6)), ("Plane", "n", (0, 1, 0))]:
        g = make(name)
        setattr(g, member, value)
        assert getattr(g, member).tolist() == list(value)
        with pytest.raises(ValueError, match="3 numbers"):
            setattr(g, member, [1, 2])
        with pytest.raises((TypeError, ValueError)):
            setattr(g, member, "abc")
    for name, member in [("Sphere", "radius"), ("Capsule", "radius"), ("Capsule", "lz"),
                         ("Cone", "lz"), ("Cylinder", "radius"), ("Plane", "d"),
                         ("Halfspace", "d")]:
        g = make(name)
        setattr(g, member, 0.25)
        assert getattr(g, member) == 0.25
        with pytest.raises(TypeError):
            setattr(g, member, "abc")
    assert make("Convex").num_faces == 4


def test_nothing_is_no_geometry():
    g = fcl.CollisionGeometry()
    assert g.getNodeType() is None and g.aabb_center is None and g.computeLocalAABB() is None
    for arguments in [(g,), (None,), ()]:
        with pytest.raises(ValueError, match="a geometry is needed"):
            fcl.CollisionObject(*arguments)
    with pytest.raises(TypeError):
        fcl.CollisionObject("box")


def test_transforms():
    R = shapes.random_rotations(1, np.random.default_rng(1))[0]
    q = fcl.Transform(R).getQuatRotation()
    for t in [fcl.Transform(R, [1, 2, 3]), fcl.Transform(q, np.array([[1.0, 2, 3]]).ravel()),
              fcl.Transform(fcl.Transform(R, (1, 2, 3)))]:
        assert np.allclose(t.getRotation(), R) and t.getTranslation().tolist() == [1, 2, 3]
        assert np.allclose(t.getQuatRotation(), q)
    assert fcl.Transform().getQuatRotation().tolist() == [1, 0, 0, 0]
    t = fcl.Transform([4, 5, 6])
    assert t.getTranslation().tolist() == [4, 5, 6] and np.array_equal(t.getRotation(), np.eye(3))
    t.setRotation(R.astype(np.float32))
    t.setTranslation([1, 2, 3])
    assert np.allclose(t.getRotation(), R, atol=1e-6)
    t.setQuatRotation(q)
    o = fcl.CollisionObject(make("Box"))
    o.setTransform(t)
    assert np.allclose(o.getTransform().getRotation(), R)
    assert o.getTranslation().tolist() == [1, 2, 3]
    o.setRotation(np.eye(3))
    o.setQuatRotation(q)
    o.setTranslation(np.array([3, 2, 1]))
    assert np.allclose(o.getRotation(), R) and np.allclose(o.getQuatRotation(), q)
    assert o.getTranslation().tolist() == [3, 2, 1]
    for wrong in [([1, 2],), (np.eye(4),), (np.eye(3), [1, 2]), (1, 2, 3), ("abc",)]:
        with pytest.raises((ValueError, TypeError)):
            fcl.Transform(*wrong)


def test_keywords():
    want = dict(
        CollisionRequest=dict(num_max_contacts=1, enable_contact=False, num_max_cost_sources=1,
                              enable_cost=False, use_approximate_cost=True, gjk_solver_type=0),
        CollisionResult=dict(is_collision=False),
        ContinuousCollisionRequest=dict(num_max_iterations=10, toc_err=0.0001, ccd_motion_type=0,
                                        gjk_solver_type=0, ccd_solver_type=1),
        ContinuousCollisionResult=dict(is_collide=False, time_of_contact=1.0),
        DistanceRequest=dict(enable_nearest_points=False, enable_signed_distance=False,
                             gjk_solver_type=0),
        DistanceResult=dict(min_distance_=np.finfo(float).max),
        CollisionData=dict(request=None, result=None),
        DistanceData=dict(request=None, result=None),
    )
    for name, defaults in want.items():
        parameters = inspect.signature(getattr(fcl, name)).parameters
        assert {k: p.default for k, p in parameters.items()} == defaults, name
    assert fcl.CollisionData().done is False and fcl.DistanceData().done is False
    contact, cost = fcl.Contact(), fcl.CostSource()
    assert vars(contact).keys() == {"o1", "o2", "b1", "b2", "normal", "pos", "penetration_depth"}
    assert vars(cost).keys() == {"aabb_min", "aabb_max", "cost_density", "total_cost"}


def test_building_a_model():
    m = fcl.BVHModel()
    assert m.num_tries_() == 0 and m.buildState() == 0
    with pytest.raises(ValueError, match="beginModel"):
        m.addVertex(0, 0, 0)
    assert m.beginModel() == 0 and m.buildState() == 1
    for corners in TETRAHEDRON[TRIANGLES]:
        assert m.addTriangle(v1=corners[0], v2=corners[1], v3=corners[2]) is True
    for _ in range(50):
        assert m.addTriangle([0, 0, 0], [1, 0, 0], [0, 1, 0]) is True
    assert m.addSubModel(TETRAHEDRON.astype(np.float32), TRIANGLES.astype(np.uint8)) is True
    assert m.endModel() == 0 and m.num_tries_() == 58 and m.buildState() == 2
    assert m.endModel() < 0
    points = fcl.BVHModel()
    points.beginModel(num_tris_=0, num_vertices_=0)
    for p in TETRAHEDRON:
        assert points.addVertex(x=p[0], y=p[1], z=p[2]) is True
    assert points.endModel() == 0


def test_what_would_crash_fcl_is_refused():
    m = fcl.BVHModel()
    m.beginModel()
    with pytest.raises(ValueError, match=r"triangles\[1\] refers to vertex 3, but there are 3"):
        m.addSubModel(TETRAHEDRON[:3], TRIANGLES)
    with pytest.raises(ValueError, match=r"refers to vertex -1"):
        m.addSubModel(TETRAHEDRON, TRIANGLES - 1)
    with pytest.raises(ValueError, match=r"verts\[1\] is not finite"):
        m.addSubModel(np.where(TETRAHEDRON == 1, np.nan, 0), TRIANGLES)
    with pytest.raises(ValueError, match="not finite"):
        m.addVertex(0, np.inf, 0)
    empty = fcl.CollisionObject(fcl.BVHModel())
    with pytest.raises(ValueError, match="it is empty"):
        fcl.collide(empty, fcl.CollisionObject(make("Box")))
    for faces, count in [(FACES[:-1], 4), (FACES, 3), (FACES, 5), (FACES - 1, 4), ([2, 0, 1], 1),
                         ([9, 0, 1, 2], 1), ([], 0)]:
        with pytest.raises(ValueError, match="Convex"):
            fcl.Convex(TETRAHEDRON, count, faces)
    for data in [b"", b"\xff", b"\xff\xff\xff", b"\xff" * 1000]:
        with pytest.raises(ValueError, match="octree"):
            fcl.OcTree(0.1, data)
    with pytest.raises(ValueError, match="positive"):
        fcl.OcTree(0, OCTREE)
    flat, box = fcl.CollisionObject(make("Halfspace")), fcl.CollisionObject(make("Box"))
    with pytest.raises(ValueError, match="Halfspace"):
        fcl.distance(flat, box)
    with pytest.raises(ValueError, match="Convex"):
        fcl.collide(fcl.CollisionObject(make("Convex")), fcl.CollisionObject(make("Plane")))
    # Objects without a finite box are either given one or refused by managers.
    manager = fcl.DynamicAABBTreeCollisionManager()
    manager.registerObjects([flat, box, fcl.CollisionObject(make("Plane")),
                             fcl.CollisionObject(fcl.BVHModel())])
    manager.setup()
    box.setTranslation([0, 0, 5])
    manager.update()
    box.setTranslation([0, 0, np.nan])
    for call in [manager.update, lambda: manager.update(box),
                 lambda: fcl.DynamicAABBTreeCollisionManager().registerObject(box)]:
        with pytest.raises(ValueError, match="not finite"):
            call()


def test_octrees():
    tree = fcl.OcTree(0.1, OCTREE)
    for data in (bytearray(OCTREE), list(OCTREE)):
        result = fcl.CollisionResult()
        fcl.collide(fcl.CollisionObject(fcl.OcTree(0.1, data)), fcl.CollisionObject(make("Box")),
                    fcl.CollisionRequest(), result)
        assert result.is_collision
    mesh = shapes.placed(make("BVHModel"), shapes.translation(0.1, 0.1, 0.1))
    assert fcl.collide(fcl.CollisionObject(tree), mesh) == 1


@pytest.mark.parametrize("name", [n for n in GEOMETRIES if n != "OcTree"])
def test_geometries_can_be_pickled(name):
    g = make(name)
    loaded = pickle.loads(pickle.dumps(g))
    assert type(loaded) is type(g)
    probe = shapes.placed(shapes.bvh(*shapes.torus()), shapes.translation(0.3, 0.2, 0.1))
    if name == "TriangleP":  # not served against meshes
        assert loaded.b.tolist() == g.b.tolist()
        return
    o = pickle.loads(pickle.dumps(fcl.CollisionObject(g, fcl.Transform([0, 0, 0.5]))))
    d = [fcl.distance(x, probe) for x in (o, fcl.CollisionObject(loaded, fcl.Transform([0, 0, 0.5])),
                                          fcl.CollisionObject(g, fcl.Transform([0, 0, 0.5])))]
    assert d[0] == d[1] == d[2]


@pytest.mark.parametrize("copied", [lambda g: pickle.loads(pickle.dumps(g)), copy.copy,
                                    copy.deepcopy], ids=["pickle", "copy", "deepcopy"])
def test_copies_keep_the_mark(copied):
    vertices, faces = shapes.box()
    marked, small = shapes.bvh(vertices, faces), shapes.bvh(0.1 * vertices, faces)
    marked.markSolid()
    small.markSolid()
    inner = fcl_kios.Mesh(0.1 * vertices, faces, solid=True)
    for g in (marked, copied(marked), copied(fcl.CollisionObject(marked))._geometry):
        assert fcl.collide(fcl.CollisionObject(g), fcl.CollisionObject(small)) == 1
        # What lies inside is at no distance, as it collides.
        assert inner.collides(g) and inner.distance(g) == 0
        assert inner.bracket(g) == (0, 0) and inner.closer_than(g, 0.0)
