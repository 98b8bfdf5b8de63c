# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""python-fcl's names, over k-IOS.

    import fcl_kios.fcl as fcl              # instead of: import fcl

and for libraries that import fcl themselves, such as trimesh, before they are imported:

    import sys, fcl_kios.fcl
    sys.modules["fcl"] = fcl_kios.fcl

It is a package with python-fcl's modules fcl, collision_data and version. Docs: docs/python.md.
"""
import copyreg as _copyreg
import sys as _sys

import numpy as _np

from .. import _core
from .._core import (
    Box,
    BVHModel,
    Capsule,
    CollisionGeometry,
    CollisionObject,
    Cone,
    Convex,
    Cylinder,
    DynamicAABBTreeCollisionManager,
    Ellipsoid,
    Halfspace,
    OcTree,
    Plane,
    Sphere,
    Transform,
    TriangleP,
    collide,
    continuousCollide,
    defaultCollisionCallback,
    defaultDistanceCallback,
    distance,
)

__version__ = _core.__version__

__all__ = [
    "CollisionObject", "CollisionGeometry", "Transform", "TriangleP", "Box", "Sphere", "Ellipsoid",
    "Capsule", "Cone", "Convex", "Cylinder", "Halfspace", "Plane", "BVHModel", "OcTree",
    "DynamicAABBTreeCollisionManager", "collide", "continuousCollide", "distance",
    "defaultCollisionCallback", "defaultDistanceCallback", "OBJECT_TYPE", "NODE_TYPE",
    "CCDMotionType", "CCDSolverType", "GJKSolverType", "Contact", "CostSource",
    "CollisionRequest", "CollisionResult", "ContinuousCollisionRequest",
    "ContinuousCollisionResult", "DistanceRequest", "DistanceResult", "CollisionData",
    "DistanceData", "__version__",
]


def _numbered(name, members):
    """A class whose attributes are FCL's numbers, plain ints as in python-fcl."""
    return type(name, (), {"__module__": __name__, **{m: i for i, m in enumerate(members.split())}})


OBJECT_TYPE = _numbered("OBJECT_TYPE", "OT_UNKNOWN OT_BVH OT_GEOM OT_OCTREE OT_COUNT")
NODE_TYPE = _numbered(
    "NODE_TYPE",
    "BV_UNKNOWN BV_AABB BV_OBB BV_RSS BV_kIOS BV_OBBRSS BV_KDOP16 BV_KDOP18 BV_KDOP24 GEOM_BOX "
    "GEOM_SPHERE GEOM_ELLIPSOID GEOM_CAPSULE GEOM_CONE GEOM_CYLINDER GEOM_CONVEX GEOM_PLANE "
    "GEOM_HALFSPACE GEOM_TRIANGLE GEOM_OCTREE NODE_COUNT",
)
CCDMotionType = _numbered("CCDMotionType", "CCDM_TRANS CCDM_LINEAR CCDM_SCREW CCDM_SPLINE")
CCDSolverType = _numbered(
    "CCDSolverType",
    "CCDC_NAIVE CCDC_CONSERVATIVE_ADVANCEMENT CCDC_RAY_SHOOTING CCDC_POLYNOMIAL_SOLVER",
)
GJKSolverType = _numbered("GJKSolverType", "GST_LIBCCD GST_INDEP")


class _Record:
    """What has attributes alone."""

    def __repr__(self):
        inside = ", ".join(f"{name}={value!r}" for name, value in vars(self).items())
        return f"fcl_kios.fcl.{type(self).__name__}({inside})"


class Contact(_Record):
    """A contact of two objects: geometries o1 and o2 (the very ones that were passed in), triangles
    b1 and b2 (-1 for shapes), normal from o1 to o2, pos in the world, penetration_depth."""

    def __init__(self):
        self.o1 = self.o2 = None
        self.b1 = self.b2 = 0
        self.normal = _np.zeros(3)
        self.pos = _np.zeros(3)
        self.penetration_depth = 0.0


class CostSource(_Record):
    """An overlap of two volumes and its cost."""

    def __init__(self):
        self.aabb_min = _np.zeros(3)
        self.aabb_max = _np.zeros(3)
        self.cost_density = self.total_cost = 0.0


class CollisionRequest(_Record):
    """What collide() is asked for."""

    def __init__(self, num_max_contacts=1, enable_contact=False, num_max_cost_sources=1,
                 enable_cost=False, use_approximate_cost=True,
                 gjk_solver_type=GJKSolverType.GST_LIBCCD):
        self.num_max_contacts = num_max_contacts
        self.enable_contact = enable_contact
        self.num_max_cost_sources = num_max_cost_sources
        self.enable_cost = enable_cost
        self.use_approximate_cost = use_approximate_cost
        self.gjk_solver_type = gjk_solver_type


class CollisionResult(_Record):
    """Collects what calls of collide() find: is_collision, contacts and cost_sources."""

    def __init__(self, is_collision=False):
        self.is_collision = is_collision
        self.contacts = []
        self.cost_sources = []


class ContinuousCollisionRequest(_Record):
    """What continuousCollide() is asked for. For meshes toc_err and ccd_motion_type count."""

    def __init__(self, num_max_iterations=10, toc_err=0.0001,
                 ccd_motion_type=CCDMotionType.CCDM_TRANS,
                 gjk_solver_type=GJKSolverType.GST_LIBCCD,
                 ccd_solver_type=CCDSolverType.CCDC_CONSERVATIVE_ADVANCEMENT):
        self.num_max_iterations = num_max_iterations
        self.toc_err = toc_err
        self.ccd_motion_type = ccd_motion_type
        self.gjk_solver_type = gjk_solver_type
        self.ccd_solver_type = ccd_solver_type


class ContinuousCollisionResult(_Record):
    """Whether there is a contact, and when: 0 to 1, 1 if there is none."""

    def __init__(self, is_collide=False, time_of_contact=1.0):
        self.is_collide = is_collide
        self.time_of_contact = time_of_contact


class DistanceRequest(_Record):
    """What distance() is asked for. The solver isn't looked at: python-fcl hands it to FCL as
    rel_err, so that it has never had an effect but that."""

    def __init__(self, enable_nearest_points=False, enable_signed_distance=False,
                 gjk_solver_type=GJKSolverType.GST_LIBCCD):
        self.enable_nearest_points = enable_nearest_points
        self.enable_signed_distance = enable_signed_distance
        self.gjk_solver_type = gjk_solver_type


class DistanceResult(_Record):
    """Keeps the least distance that calls of distance() find: geometries o1 and o2, triangles b1
    and b2, and nearest_points in the world; NaN where those weren't asked for."""

    def __init__(self, min_distance_=_sys.float_info.max):
        self.min_distance = min_distance_
        self.nearest_points = [None, None]
        self.o1 = self.o2 = None
        self.b1 = self.b2 = -1


class CollisionData(_Record):
    """What defaultCollisionCallback wants."""

    def __init__(self, request=None, result=None):
        self.request = CollisionRequest() if request is None else request
        self.result = CollisionResult() if result is None else result
        self.done = False


class DistanceData(_Record):
    """What defaultDistanceCallback wants."""

    def __init__(self, request=None, result=None):
        self.request = DistanceRequest() if request is None else request
        self.result = DistanceResult() if result is None else result
        self.done = False


def mark_watertight(on=True):
    """Whether meshes that are finished from now on become solids (BVHModel.markSolid()) where they
    are closed, normals outwards. Then what lies in one is in contact with it, and a distance with
    enable_signed_distance, as trimesh's min_distance_* ask for, is minus a depth where two overlap.
    Off as long as nobody calls this. An O(n log n) look at each mesh."""
    _core._mark_watertight(on)


def _load_model(stored, solid=False):
    return BVHModel._load(stored, solid)


def _reduced(names):
    return lambda g: (type(g), tuple(getattr(g, name) for name in names))


def _described(names):
    def described(self):
        values = [getattr(self, name) for name in names]
        values = [x.tolist() if isinstance(x, _np.ndarray) else x for x in values]
        inside = ", ".join(f"{name.strip('_')}={x!r}" for name, x in zip(names, values))
        return f"fcl_kios.fcl.{type(self).__name__}({inside})"

    return described


# Unlike python-fcl's, all but octrees and managers can be pickled and copied; meshes keep their
# trees and marks. By class: what it is described by, and how it is made again where not by that.
for _class, (_names, _again) in {
    TriangleP: (("a", "b", "c"), None),
    Box: (("side",), lambda g: (Box, tuple(g.side.tolist()))),
    Sphere: (("radius",), None),
    Ellipsoid: (("radii",), lambda g: (Ellipsoid, tuple(g.radii.tolist()))),
    Capsule: (("radius", "lz"), None),
    Cone: (("radius", "lz"), None),
    Cylinder: (("radius", "lz"), None),
    Halfspace: (("n", "d"), None),
    Plane: (("n", "d"), None),
    Convex: (("num_faces",), lambda g: (Convex, (g._vertices, g.num_faces, g._faces))),
    BVHModel: ((), lambda g: (_load_model, (g._save(), g._is_solid()))),
    Transform: ((), lambda t: (Transform, (t.getRotation(), t.getTranslation()))),
    CollisionObject: (("_geometry",), lambda o: (CollisionObject, (o._geometry, o.getTransform()))),
}.items():
    _copyreg.pickle(_class, _again or _reduced(_names))
    setattr(_class, "__repr__", _described(_names))
for _class, _text in {
    BVHModel: lambda g: f"<fcl_kios.fcl.BVHModel, {g.num_tries_()} triangles>",
    Transform: lambda t: "fcl_kios.fcl.Transform"
                         f"({t.getQuatRotation().tolist()}, {t.getTranslation().tolist()})",
    DynamicAABBTreeCollisionManager:
        lambda m: f"<fcl_kios.fcl.DynamicAABBTreeCollisionManager, {m.size()} objects>",
}.items():
    setattr(_class, "__repr__", _text)
for _name in __all__:
    if isinstance(globals()[_name], type):
        globals()[_name].__module__ = __name__
del _class, _names, _again, _name, _text
