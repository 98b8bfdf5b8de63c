# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Collision and exact distance of meshes, by arrays: a call answers a whole batch of poses, points
or rays on all cores. fcl_kios.fcl has python-fcl's names instead. Docs: docs/python.md."""
import atexit as _atexit
import os as _os

from . import _core
from ._core import __version__, simd_target
from ._files import Repaired, load, repair
from ._mesh import (AllHits, Bracket, Contacts, LocalDepth, Mesh, Nearest, NearestPoints,
                    Penetration, RayHits, SelfIntersections, WindingTree)
from ._robot import (LinkPair, Robot, RobotClearance, RobotContact, RobotGroup, RobotMotion,
                     RobotRange)
from ._scene import Clash, Pair, Scene, clashes

__all__ = ["AllHits", "Bracket", "Clash", "Contacts", "LinkPair", "LocalDepth", "Mesh", "Nearest",
           "NearestPoints", "Pair", "Penetration", "RayHits", "Repaired", "Robot", "RobotClearance",
           "RobotContact", "RobotGroup", "RobotMotion", "RobotRange", "Scene", "SelfIntersections",
           "WindingTree", "clashes", "load", "repair", "simd_target", "__version__"]

for _name in __all__:
    if isinstance(globals()[_name], type):
        globals()[_name].__module__ = __name__
del _name

_atexit.register(_core._close)
if hasattr(_os, "register_at_fork"):
    _os.register_at_fork(before=_core._before_fork,
                         after_in_parent=lambda: _core._after_fork(False),
                         after_in_child=lambda: _core._after_fork(True))
