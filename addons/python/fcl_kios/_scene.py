# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scene: many objects by name, and how near they come; which parts of an assembly clash."""
from typing import Any, Hashable, Iterable, Iterator, List, NamedTuple, Optional, Tuple, Union

from . import _core
from ._mesh import Arrays, Mesh


class Pair(NamedTuple):
    """Two objects of a scene, distances and points in its units."""

    a: Hashable
    b: Hashable
    distance: float
    triangle_a: int  #: -1 for shapes
    triangle_b: int
    point_a: Any = None  #: (3,) in the world, if points were asked for
    point_b: Any = None


class Scene:
    """Distances of many objects over many frames.

    Queries remember what they proved: a pair that stood still, or moved less than its clearance,
    isn't searched again. Threads may share a scene, and take turns. Scenes can be pickled.
    """

    def __init__(self) -> None:
        self._scene = _core._Scene()
        self._objects: dict = {}  # by name: handle, None while it is made, and geometry
        self._excluded: set = set()

    def __repr__(self) -> str:
        return f"<fcl_kios.Scene, {len(self)} objects>"

    def add(self, name: Hashable, geometry: Union[Mesh, _core.CollisionGeometry],
            X: Arrays = None, *, obstacle: bool = False) -> None:
        """Adds a Mesh, or a geometry of fcl_kios.fcl, at its pose (4, 4) in the world. Obstacles
        are never asked about each other. Raises ValueError for a name that is taken."""
        made = [None, geometry]
        if self._objects.setdefault(name, made) is not made:
            raise ValueError(f"fcl_kios: the scene has an object {name!r} already.")
        try:
            made[0] = self._scene.add(name, geometry, X, obstacle)
        except BaseException:
            del self._objects[name]
            raise

    def remove(self, name: Hashable) -> None:
        """Takes an object out, and forgets what it was excluded from."""
        self._scene.remove(self._handle(name))
        self._objects.pop(name, None)
        for pair in list(self._excluded):
            if name in pair:
                self._excluded.discard(pair)

    def move(self, name: Any, X: Arrays) -> None:
        """Sets the pose (4, 4) of an object, or those (n, 4, 4) of a list of names: all, or none
        where one is refused."""
        names = name if isinstance(name, list) else [name]
        self._scene.move([self._handle(n) for n in names], X)

    def changed(self, name: Hashable) -> None:
        """To be called after a geometry of fcl_kios.fcl was changed."""
        self._scene.changed(self._handle(name))

    def exclude(self, a: Hashable, b: Hashable, excluded: bool = True) -> None:
        """Leaves a pair out of all queries, or takes it in again."""
        self._scene.exclude(self._handle(a), self._handle(b), excluded)
        (self._excluded.add if excluded else self._excluded.discard)(frozenset((a, b)))

    def closest(self, *, points: bool = False) -> Optional[Pair]:
        """The nearest Pair; None if there is none to ask about."""
        pairs = self._scene.closest(points)
        return Pair(*pairs[0]) if pairs else None

    def within(self, margin: float, *, points: bool = False) -> List[Pair]:
        """Every Pair at most so far apart; those that touch for 0."""
        return [Pair(*pair) for pair in self._scene.within(margin, points)]

    def clearances(self, *, points: bool = False) -> List[Pair]:
        """Every Pair."""
        return [Pair(*pair) for pair in self._scene.clearances(points)]

    @property
    def counts(self) -> Tuple[int, int]:
        """How many pairs the last query had, and how many of them weren't searched."""
        return self._scene.counts()

    def __len__(self) -> int:
        return len(self._objects)

    def __contains__(self, name: Hashable) -> bool:
        return name in self._objects

    def __iter__(self) -> Iterator[Hashable]:
        return iter(list(self._objects))

    def _handle(self, name):
        handle = self._objects.get(name, (None,))[0]
        if handle is None:
            raise KeyError(f"the scene has no object {name!r}")
        return handle

    def __getstate__(self) -> Any:
        return ([(name, geometry, *self._scene.state(handle))
                 for name, (handle, geometry) in list(self._objects.items())],
                [tuple(pair) for pair in list(self._excluded)])

    def __setstate__(self, state: Any) -> None:
        Scene.__init__(self)
        for name, geometry, X, obstacle in state[0]:
            self.add(name, geometry, X, obstacle=obstacle)
        for pair in state[1]:
            self.exclude(*pair)


class Clash(NamedTuple):
    """Two parts that clash, points and vectors (3,) in the world."""

    a: str
    b: str
    status: str  #: "overlap", "inside", "duplicate", "touch" or "clearance"
    decided: bool  #: the status is proven; else the bracket allows it
    deep: bool  #: lower and upper bracket a depth, else a distance
    lower: float
    upper: float  #: inf where a mesh that is no solid meets another
    point_a: Any
    point_b: Any
    way_out: Any  #: moves b out of a; zero unless two solids overlap or one is in the other


_STATUSES = ("overlap", "inside", "duplicate", "touch", "clearance")


def _length(value, name):
    try:
        length = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"fcl_kios: {name} must be a number, not {value!r}.") from None
    if not 0 <= length < float("inf"):
        raise ValueError(f"fcl_kios: {name} is {length}, but must be finite and >= 0.")
    return length


def _name(name, what):
    if not isinstance(name, str):
        raise TypeError(f"fcl_kios: {what} must be a str, not {name!r}.")
    try:
        name.encode()
    except UnicodeError:
        raise ValueError(f"fcl_kios: {what}, {name!r}, can't be written in UTF-8.") from None
    return name


def _part(part, place, groups):
    if not isinstance(part, (tuple, list)) or not 2 <= len(part) <= 4:
        raise TypeError(f"fcl_kios: part {place} must be (name, mesh), (name, mesh, X) or "
                        "(name, mesh, X, group).")
    name, mesh, X, group = (*part, None, None)[:4]
    _name(name, f"the name of part {place}")
    if not isinstance(mesh, (Mesh, _core.Box, _core.Convex)):
        raise TypeError(f"fcl_kios: the mesh of part {name!r} must be a Mesh, Box or Convex, not a "
                        f"{type(mesh).__name__}.")
    try:
        return name, mesh, X, groups.setdefault(group, len(groups))
    except TypeError:
        raise TypeError(f"fcl_kios: the group of part {name!r} must be hashable.") from None


def _ignored(pair):
    if not isinstance(pair, (tuple, list)) or len(pair) != 2:
        raise TypeError(f"fcl_kios: {pair!r}, to be ignored, must be a pair of names.")
    return tuple(_name(name, "a name to be ignored") for name in pair)


def clashes(parts: Iterable[tuple], *, touch: float = 1e-6, clearance: float = 0.0,
            ignored: Iterable[Tuple[str, str]] = (), between_groups: bool = False,
            threads: Optional[int] = None) -> List[Clash]:
    """Finds every Clash of parts, which are tuples (name, mesh), (name, mesh, X) or (name, mesh, X,
    group), X their pose (4, 4) in the world; a Box or Convex of fcl_kios.fcl is a mesh, too. What is
    at most `touch` apart or deep touches, what is nearer than the clearance lacks it. Pairs of names
    in `ignored`, and with between_groups those of one group, are left out. Raises ValueError, which
    names the part. Docs: docs/clash.md."""
    touch, clearance = _length(touch, "touch"), _length(clearance, "clearance")
    if 0 < clearance < touch:
        raise ValueError(f"fcl_kios: touch is {touch}, more than the clearance, {clearance}.")
    groups: dict = {}
    placed = [_part(part, place, groups) for place, part in enumerate(parts)]
    found = _core._clashes(placed, touch, clearance, [_ignored(pair) for pair in ignored],
                           bool(between_groups), threads)
    return [Clash(placed[a][0], placed[b][0], _STATUSES[status], *rest)
            for a, b, status, *rest in found]
