# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Robot: a robot from its URDF among obstacles, and batches of queries on it."""
from __future__ import annotations

import copy
import os
from typing import Any, Iterable, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._mesh import Arrays, Geometry, Mesh, Progress, inf

_AMONG = ("all", "itself", "obstacles")
_VERDICTS = np.array(["clear", "contact", "unresolved", "budget spent"])
_PAIRS = ("always", "never", "sometimes", "open")


class RobotContact(NamedTuple):
    """Two that are in contact: links, obstacles or attached objects."""

    a: str
    b: str
    point: Any  #: (3,) in the world
    element_a: int  #: which of a link's or an object's shapes
    element_b: int
    id_a: int  #: triangle of a mesh, point of a cloud; -1 for shapes
    id_b: int


class RobotClearance(NamedTuple):
    """The least clearance, a distance less the paddings; of n configurations, arrays of it. Names
    are empty, lengths infinite and points NaN where no pair is checked, or within far_enough."""

    a: Any  #: a name, or a list of n
    b: Any
    clearance: Any  #: (n,)
    lower_bound: Any  #: (n,) proven
    point_a: Any  #: (n, 3) nearest points in the world
    point_b: Any
    element_a: Any  #: (n,) which of a link's or an object's shapes
    element_b: Any
    id_a: Any  #: (n,) triangle of a mesh, point of a cloud; -1 for shapes
    id_b: Any
    gradient: Any  #: (n, k) by coordinate; NaN if it wasn't asked for


class RobotMotion(NamedTuple):
    """What Robot.check_motion() found; of n motions, arrays of it. A contact lies in the interval
    from `start` to `end` of the way, 0 to 1; `end` is one."""

    verdict: Any  #: (n,) "clear", "contact", "unresolved" or "budget spent"
    start: Any  #: (n,)
    end: Any  #: (n,)
    a: Any  #: the pair in contact, or undecided: names, or lists of n
    b: Any
    queries: Any  #: (n,) that it took


class RobotRange(NamedTuple):
    """A bracket of the least clearance over a range."""

    lower: float  #: nowhere in the range is a pair nearer: proven
    upper: float  #: the least that was seen
    at: Any  #: (k,) the configuration where that was; None if nothing was seen
    a: str
    b: str
    point_a: Any  #: (3,) in the world, NaN at contact
    point_b: Any
    complete: bool  #: whether the bracket is as narrow as was asked
    queries: int


class RobotGroup(NamedTuple):
    """A planning group of the SRDF: q[..., coordinates] is its part of q."""

    joints: List[str]
    coordinates: Any
    links: List[str]
    end_effectors: List[str]  #: groups


class LinkPair(NamedTuple):
    """What two links can do within the joints' limits."""

    a: str
    b: str
    verdict: str  #: "always", "never", which is proven, "sometimes" or "open"
    adjacent: bool  #: a joint joins them
    q: Any  #: (k,) a configuration in contact, or None


class Robot(_core._Robot):
    """A robot from its URDF, among obstacles and with what it holds. Threads may share it; a change
    waits for queries. copy.copy() gives one that changes by itself. Docs: docs/robot.md.

    urdf, srdf: paths. Without an SRDF, links that a joint joins may touch. packages: the folder of
    each package that meshes are named by (package://name/...), else looked for as ROS does. padding:
    of all links. Meshes are read as load() reads them, but by no trimesh. Raises ValueError that
    names file, line and what to do.

    Lengths are in metres, angles in radians. q is a configuration of k coordinates, (k,); where it
    says so, q may be n of them, (n, k), and answers are arrays. threads, progress: as of Mesh. No
    query holds the GIL. Names are those of links, obstacles and attached objects. Raises ValueError
    for names that aren't there, shapes that don't fit, and poses that aren't rigid."""

    def __init__(self, urdf: Any, srdf: Any = "", *, packages: Mapping[str, Any] = {},
                 padding: float = 0.0) -> None:
        super().__init__(os.fsencode(urdf), os.fsencode(srdf or ""),
                         {name: os.fsencode(path) for name, path in packages.items()}, padding)

    def state(self, name: str) -> NDArray[np.float64]:
        """A group state, (k,); coordinates that it doesn't name are 0, or the limit next to it."""
        return self._state(name)

    def group(self, name: str) -> RobotGroup:
        """A planning group."""
        return RobotGroup(*self._group(name))

    def within_limits(self, q: ArrayLike, slack: float = 0.0) -> Any:
        """Whether all coordinates are within the limits, or `slack` beyond: a bool, or n."""
        return self._within_limits(q, slack)

    def pose(self, name: str, q: ArrayLike) -> NDArray[np.float64]:
        """The frame of a link, an obstacle or an attached object in the world, (4, 4) or
        (n, 4, 4)."""
        return self._pose(name, q)

    def add(self, name: str, geometry: Geometry, X_W: Arrays = None) -> None:
        """Adds an obstacle at its pose (4, 4) in the world: a Mesh, or a geometry of fcl_kios.fcl,
        which is copied."""
        self._add(name, _kept(geometry), X_W)

    def add_box(self, name: str, size: ArrayLike, X_W: Arrays = None) -> None:
        """Adds a box of these three lengths about its origin."""
        size = np.asarray(size, float)
        if size.shape != (3,):
            raise ValueError(f"fcl_kios: size has shape {size.shape}; (3,) is needed.")
        self._add(name, _core.Box(*size), X_W)

    def add_points(self, name: str, points: ArrayLike, radius: float = 0.0) -> None:
        """Adds points (n, 3) in the world, such as a scan's, as balls of that radius."""
        self._add_points(name, points, radius)

    def add_octomap(self, name: str, path: Any, X_W: Arrays = None) -> None:
        """Adds octomap's octree, a file .bt or .ot."""
        self._add_octomap(name, os.fsencode(path), X_W)

    def add_scene(self, path: Any) -> None:
        """Reads MoveIt's planning scene in YAML: obstacles, attached objects, allowed pairs."""
        self._add_scene(os.fsencode(path))

    def move(self, name: str, X_W: ArrayLike) -> None:
        """Moves an obstacle to a pose (4, 4): in microseconds, whatever else is there."""
        self._move(name, X_W)

    def attach(self, name: str, link: str, geometry: Geometry, X_LB: Arrays = None, *,
               touch_links: Union[str, Iterable[str]] = ()) -> None:
        """Adds an object that a link carries at X_LB (4, 4) in the link's frame. It may touch that
        link and what `touch_links` names: one, or a list."""
        self._attach(name, link, _kept(geometry), X_LB, _names(touch_links))

    def attach_obstacle(self, name: str, link: str, q: ArrayLike, *,
                        touch_links: Union[str, Iterable[str]] = ()) -> None:
        """Attaches an obstacle where it is when the robot stands at q (k,)."""
        self._attach_obstacle(name, link, q, _names(touch_links))

    def detach(self, name: str, q: ArrayLike) -> None:
        """Makes what is attached an obstacle, where it is when the robot stands at q (k,)."""
        self._detach(name, q)

    def remove(self, name: str) -> None:
        """Removes an obstacle, or what is attached."""
        self._remove(name)

    def ignore_pair(self, a: str, b: str, ignored: bool = True) -> None:
        """Allows two to touch, or checks them again."""
        self._ignore_pair(a, b, ignored)

    def ignore(self, pairs: Iterable[LinkPair]) -> None:
        """Ignores the pairs of link_pairs() that are "always" or "never" in contact."""
        self._ignore([(pair.a, pair.b) for pair in pairs if pair.verdict in ("always", "never")])

    def is_ignored(self, a: str, b: str) -> bool:
        """Whether two may touch."""
        return self._allowed(a, b)

    def set_padding(self, name: str, padding: float) -> None:
        """Sets a padding: what is nearer than both paddings is in contact."""
        self._set_padding(name, padding)

    def contact(self, q: ArrayLike) -> Optional[RobotContact]:
        """A pair in contact at q (k,), or None."""
        found = self._contact(q)
        return RobotContact(*found) if found else None

    def contacts(self, q: ArrayLike, *, threads: Optional[int] = None,
                 progress: Progress = None) -> Any:
        """Whether any pair is in contact: n bools, or one."""
        return self._contacts(q, (threads, progress))

    def clearance(self, q: ArrayLike, *, among: str = "all", rel_err: float = 0.0,
                  abs_err: float = 0.0, far_enough: float = inf, gradient: bool = True,
                  threads: Optional[int] = None, progress: Progress = None) -> RobotClearance:
        """The least clearance at q (k,) or (n, k), a RobotClearance. among: "all" pairs, those of
        the robot with "itself", or with "obstacles". The distance is at most max(rel_err d, abs_err)
        too large; the search ends once it knows that all are `far_enough`. Where the nearest points
        are unique, the gradient is the derivative."""
        if among not in _AMONG:
            raise ValueError(f"fcl_kios: among must be one of {_AMONG}, but is {among!r}.")
        return RobotClearance(*self._clearances(q, _AMONG.index(among), rel_err, abs_err,
                                                far_enough, gradient, (threads, progress)))

    def within(self, q: ArrayLike, margin: float) -> RobotClearance:
        """All pairs that are at most `margin` apart at q (k,), the nearest first, as arrays."""
        return RobotClearance(*self._within(q, margin))

    def check_motion(self, q0: ArrayLike, q1: ArrayLike, *, min_separation: float = 0.0,
                     first_contact: bool = False, within_limits: bool = False,
                     resolution: float = 2**-20, max_queries: int = 1000000,
                     threads: Optional[int] = None, progress: Progress = None) -> RobotMotion:
        """Decides whether straight paths from q0 to q1 are clear, (k,) or (n, k) each: a
        RobotMotion. "clear" is proven for the whole way: farther apart than min_separation.
        first_contact: asks for the earliest. within_limits: ends beyond the limits raise ValueError.
        What an interval of `resolution` of the way doesn't decide is "unresolved". Docs:
        docs/motions.md."""
        verdict, *rest = self._check_motions(q0, q1, min_separation, first_contact, resolution,
                                             max_queries, within_limits, (threads, progress))
        named = _VERDICTS[verdict]
        return RobotMotion(str(named) if np.ndim(verdict) == 0 else named, *rest)

    def least_clearance(self, path: Arrays = None, *,
                        box: Optional[Tuple[ArrayLike, ArrayLike]] = None, abs_err: float = 1e-4,
                        rel_err: float = 0.01, ceiling: float = inf, max_queries: int = 100000,
                        within_limits: Optional[bool] = None) -> RobotRange:
        """Brackets the least clearance on a path (m, k), straight in between, or in a box: lower and
        upper ends, (k,) each. Beyond the limits a box is refused unless within_limits is False, a
        path if it is True. The search ends at a bracket of abs_err or rel_err of the clearance,
        beyond the ceiling, or after so many queries. Docs: docs/range.md."""
        return self._ranges(path, box, False, abs_err, rel_err, ceiling, max_queries,
                            within_limits=within_limits)[0]

    def least_clearances(self, path: Arrays = None, *,
                         box: Optional[Tuple[ArrayLike, ArrayLike]] = None, abs_err: float = 1e-4,
                         rel_err: float = 0.01, ceiling: float = inf, max_queries: int = 100000,
                         within_limits: Optional[bool] = None) -> List[RobotRange]:
        """Brackets the least clearance of each pair, the nearest first; a path has two ends here."""
        return self._ranges(path, box, True, abs_err, rel_err, ceiling, max_queries,
                            within_limits=within_limits)

    def _ranges(self, path, box, *how, within_limits):
        if (path is None) == (box is None):
            raise ValueError("fcl_kios: either a path or a box is needed.")
        ends = np.atleast_2d(np.asarray(path if box is None else box))
        if box is None and within_limits and not all(within := self.within_limits(ends)):
            raise ValueError(f"fcl_kios: path[{np.argmin(within)}] is beyond the joints' limits.")
        return [RobotRange(*found) for found in self._least_clearances(
            ends, box is not None, *how, within_limits is not False)]

    def link_pairs(self, *, max_boxes: int = 4000000, max_seconds: float = 10.0,
                   threads: Optional[int] = None) -> List[LinkPair]:
        """What each pair of links can do within the limits, by proof. Obstacles, paddings and what
        is ignored don't count."""
        return [LinkPair(a, b, _PAIRS[verdict], adjacent, q) for a, b, verdict, adjacent, q in
                self._link_pairs(max_boxes, max_seconds, threads)]

    def __repr__(self) -> str:
        return f"<fcl_kios.Robot {self.name!r}, {len(self.joints)} coordinates>"

    def __copy__(self) -> Robot:
        made = type(self).__new__(type(self))
        _core._Robot.__init__(made, self)
        return made

    def __deepcopy__(self, memo: Any) -> Robot:
        return copy.copy(self)  # nobody changes what both share


def _names(names):
    return [names] if isinstance(names, str) else list(names)


def _kept(geometry):
    """What nobody else can change."""
    return geometry if isinstance(geometry, (Mesh, _core.OcTree)) else copy.copy(geometry)
