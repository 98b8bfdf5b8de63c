# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Mesh: a mesh that nobody changes, and batches of queries on it."""
from __future__ import annotations

from typing import Any, Callable, NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core

Arrays = Optional[ArrayLike]
Progress = Optional[Callable[[int], Any]]
Geometry = Union["Mesh", "_core.CollisionGeometry"]
Others = Union[Geometry, Sequence[Geometry]]
_ALL = 2**31 - 1
inf = float("inf")
_KINDS = np.array(["none", "touch", "cross", "overlap"])


class Nearest(NamedTuple):
    """What Mesh.distance(points=True) returns. Points and triangles of a pair beyond `within`, or
    of a solid within the other, are NaN and -1; so is the triangle of a shape."""

    distance: Any  #: (n,)
    point_a: Any  #: (n, 3), in A's frame
    point_b: Any  #: (n, 3), in A's frame, too
    triangle_a: Any  #: (n,)
    triangle_b: Any  #: (n,)


class NearestPoints(NamedTuple):
    """What Mesh.nearest() returns; infinity, NaN and -1 for points beyond `within`."""

    distance: Any  #: (n,)
    point: Any  #: (n, 3) of the mesh, in the points' frame
    triangle: Any  #: (n,)


class Bracket(NamedTuple):
    """Proven bounds of distances."""

    lower: Any  #: (n,)
    upper: Any  #: (n,)


class Penetration(NamedTuple):
    """How deep two solids overlap; zeros where their interiors are disjoint."""

    lower: Any  #: (n,) no shorter translation parts them
    upper: Any  #: (n,) the length of `translation`
    translation: Any  #: (n, 3) of B, in A's frame: after it they are apart
    point: Any  #: (n, 3) of A's surface, in A's frame, where they touch then


class LocalDepth(NamedTuple):
    """How deep two solids lie in each other where that is deepest, in A's frame."""

    lower: Any  #: (n,) attained at `point`
    upper: Any  #: (n,) no point is deeper
    point: Any  #: (n, 3) of a surface, in the other solid; 0 where lower is 0
    nearest: Any  #: (n, 3) of the other's surface
    surface_of: Any  #: (n,) 1: `point` is A's, 2: B's, 0: it is the centre of a ball in both
    complete: Any  #: (n,) whether the bracket is as narrow as was asked


class Contacts(NamedTuple):
    """The contacts of a batch, in A's frame, by pose."""

    pose: Any  #: (k,) whose contact it is: an index into the flattened poses
    point: Any  #: (k, 3)
    normal: Any  #: (k, 3) unit vectors from A to B
    depth: Any  #: (k,) lengths, as FCL has them; of solids proven
    triangle_a: Any  #: (k,) -1 where a solid lies in the other
    triangle_b: Any  #: (k,) -1 for shapes, too


class RayHits(NamedTuple):
    """The first triangle of each ray; -1, infinity and NaN for rays that miss."""

    triangle: Any  #: (n,)
    distance: Any  #: (n,) from the origin, a length
    point: Any  #: (n, 3)


class AllHits(NamedTuple):
    """Every triangle that rays meet, by ray, then by distance."""

    ray: Any  #: (k,)
    triangle: Any  #: (k,)
    distance: Any  #: (k,) from the origin, a length
    point: Any  #: (k, 3)
    normal: Any  #: (k, 3) the triangle's, a unit vector in the rays' frame; NaN if it has no area


class SelfIntersections(NamedTuple):
    """Pairs of triangles of one mesh that meet other than in vertices and edges that they share."""

    triangles: Any  #: (k, 2) the lesser first
    kind: Any  #: (k,) "touch", "cross" or "overlap", which is in one plane


def _asked(other, X_AB):
    """The geometry or a list of them, their poses in one array, and the shape of the answers."""
    if not isinstance(other, (list, tuple)):
        return other, X_AB, None
    X = np.eye(4) if X_AB is None else np.asarray(X_AB)
    if X.ndim == 2:
        X = np.broadcast_to(X, (len(other), *X.shape))
    if X.ndim < 3 or X.ndim > 4 or len(X) != len(other):
        raise ValueError(f"fcl_kios: X_AB has shape {X.shape}; for {len(other)} geometries (4, 4), "
                         f"({len(other)}, 4, 4) or ({len(other)}, n, 4, 4) is needed.")
    return list(other), X.reshape(-1, *X.shape[-2:]), X.shape[:-2]


def _shaped(answer, shape):
    return answer if shape is None else answer.reshape(shape + answer.shape[1:])


class Mesh(_core._Mesh):
    """A mesh that nobody changes, and batches of queries on it. Threads may share it, and it can be
    pickled with its trees.

    vertices: (n, 3) floats or integers; faces: (m, 3) integers below n. Where `solid` is true the
    mesh must be closed, normals outwards: then solids and shapes of fcl_kios.fcl that lie in it are
    in contact with it, and points are contained. Of a Mesh that is no solid only the surface
    counts, wherever it lies. Raises ValueError that says what is wrong.

    All queries: lengths are in the mesh's units. One pose, point or ray gives one answer, n of them
    give n. `other` may be a list of k geometries: X_AB is (k, 4, 4) or (k, n, 4, 4) then, or (4, 4)
    for all, and answers are (k,) or (k, n). threads: at most so many; None: all cores. progress:
    called, about every 20 ms, with how many more are done, as tqdm's update(). No batch holds the
    GIL, and answers don't depend on threads. ValueError is raised for arrays of other shapes and
    dtypes, and for poses that aren't rigid or finite."""

    def __init__(self, vertices: ArrayLike, faces: ArrayLike, *, solid: bool = False) -> None:
        super().__init__(vertices, faces, solid)

    @classmethod
    def from_trimesh(cls, mesh: Any, *, solid: bool = False) -> Mesh:
        """Makes a Mesh of a trimesh.Trimesh, or whatever has vertices and faces."""
        return cls(np.asarray(mesh.vertices), np.asarray(mesh.faces), solid=solid)

    def to_trimesh(self) -> Any:
        """A trimesh.Trimesh of the same vertices and faces. Needs trimesh."""
        import trimesh  # type: ignore

        return trimesh.Trimesh(self.vertices, self.faces, process=False)

    def save(self, path: Any) -> None:
        """Writes vertices, faces and trees into a file that load() reads. The name should end in
        .kios."""
        with open(path, "wb") as file:
            file.write(b"kios-mesh-solid\n" if self.is_solid else b"kios-mesh-soup \n")
            self._stored().tofile(file)

    def collides(self, other: Others, X_AB: Arrays = None, *, threads: Optional[int] = None,
                 progress: Progress = None) -> Any:
        """Whether the geometries touch: exact, touching counts. other: a Mesh, a geometry of
        fcl_kios.fcl, or a list of them; X_AB: (4, 4) or (n, 4, 4), its pose in this mesh's frame;
        None: the identity. A bool, or n of them."""
        other, X_AB, shape = _asked(other, X_AB)
        return _shaped(self._collides(other, X_AB, (threads, progress)), shape)

    def distance(self, other: Others, X_AB: Arrays = None, *, rel_err: float = 0.0,
                 abs_err: float = 0.0, within: float = inf, points: bool = False,
                 threads: Optional[int] = None, progress: Progress = None) -> Any:
        """Distances, 0 at contact: exact to 16 eps of the nearest triangles' extent, or at most
        max(rel_err d, abs_err) too large. Pairs farther apart than `within` are infinity, which is
        faster to find. A float, or n of them; with points=True a Nearest, whose points are in this
        mesh's frame."""
        other, X_AB, shape = _asked(other, X_AB)
        found = self._distance(other, X_AB, rel_err, abs_err, within, points, (threads, progress))
        return Nearest(*(_shaped(x, shape) for x in found)) if points else _shaped(found, shape)

    def bracket(self, other: Others, X_AB: Arrays = None, *, rel_err: float = 0.1,
                abs_err: float = 0.0, threads: Optional[int] = None,
                progress: Progress = None) -> Bracket:
        """Proven lower and upper bounds of the distances, a Bracket: at most max(rel_err d,
        abs_err) apart, to rounding. Of meshes only."""
        other, X_AB, shape = _asked(other, X_AB)
        found = self._bracket(other, X_AB, rel_err, abs_err, (threads, progress))
        return Bracket(*(_shaped(x, shape) for x in found))

    def closer_than(self, other: Others, t: float, X_AB: Arrays = None, *,
                    threads: Optional[int] = None, progress: Progress = None) -> Any:
        """Whether they are at most t apart, as distance() <= t, but faster. Of meshes only."""
        other, X_AB, shape = _asked(other, X_AB)
        return _shaped(self._closer_than(other, t, X_AB, (threads, progress)), shape)

    def contacts(self, other: Others, X_AB: Arrays = None, *, max_contacts: Optional[int] = None,
                 threads: Optional[int] = None, progress: Progress = None) -> Contacts:
        """Points, normals and depths of contacts, in this mesh's frame, as fcl.collide() lists
        them: at most max_contacts a pose."""
        other, X_AB, _ = _asked(other, X_AB)
        most = _ALL if max_contacts is None else max_contacts
        return Contacts(*self._contacts(other, X_AB, most, (threads, progress)))

    def penetration(self, other: Others, X_AB: Arrays = None, *, rel_gap: float = 0.04,
                    max_tests: int = 48, threads: Optional[int] = None,
                    progress: Progress = None) -> Penetration:
        """How deep two solids overlap: a Penetration, whose translation moves `other` out of this
        one. The search ends once upper <= (1 + rel_gap) lower, or after so many tests; bounds are
        proven anyway."""
        other, X_AB, shape = _asked(other, X_AB)
        found = self._penetration(other, X_AB, rel_gap, max_tests, (threads, progress))
        return Penetration(*(_shaped(x, shape) for x in found))

    def local_depth(self, other: Others, X_AB: Arrays = None, *, tolerance: float = 0.0,
                    rel_err: float = 0.01, threshold: Optional[float] = None,
                    max_pieces: int = 100000,
                    threads: Optional[int] = None, progress: Progress = None) -> LocalDepth:
        """How far one solid's surface has come into the other where that is deepest, or the radius
        of a ball in both: a LocalDepth. The search ends once upper - lower is at most the
        tolerance or rel_err * upper, or after so many pieces; bounds are proven anyway. With a
        threshold >= 0 it ends, too, once lower > threshold or upper <= threshold; a pose where
        neither holds is undecided."""
        other, X_AB, shape = _asked(other, X_AB)
        if threshold is not None and not threshold >= 0:
            raise ValueError("threshold must be at least 0.")
        found = self._local_depth(other, X_AB, tolerance, rel_err,
                                  -1.0 if threshold is None else threshold, max_pieces,
                                  (threads, progress))
        return LocalDepth(*(_shaped(x, shape) for x in found))

    def deeper_than(self, other: Others, t: float, X_AB: Arrays = None, *,
                    max_pieces: int = 100000, threads: Optional[int] = None,
                    progress: Progress = None) -> Any:
        """Whether the local depth of two solids exceeds t, as local_depth() finds it, but faster.
        Raises RuntimeError if that can't be decided for a pose; local_depth(threshold=t) doesn't."""
        other, X_AB, shape = _asked(other, X_AB)
        return _shaped(self._deeper_than(other, t, X_AB, max_pieces, (threads, progress)), shape)

    def contains(self, points: ArrayLike, X_WM: Arrays = None, *, threads: Optional[int] = None,
                 progress: Progress = None) -> Any:
        """Whether points (n, 3), or (3,), lie in the solid or on its surface: exact. X_WM: the
        mesh's pose in the points' frame, (4, 4), or (n, 4, 4) for one a point. n bools, or one.
        Raises ValueError if the mesh is no solid."""
        return self._contains(points, X_WM, (threads, progress))

    def nearest(self, points: ArrayLike, X_WM: Optional[ArrayLike] = None, *, within: float = inf,
                threads: Optional[int] = None, progress: Progress = None) -> NearestPoints:
        """The points of the mesh that are nearest to points (n, 3), or (3,): NearestPoints, right
        to 16 eps. X_WM: the mesh's pose in the points' frame, (4, 4). Of equally near triangles the
        first. Points that are farther than `within` take little time."""
        return NearestPoints(*self._nearest(points, X_WM, within, (threads, progress)))

    def signed_distance(self, points: ArrayLike, X_WM: Optional[ArrayLike] = None, *,
                        within: float = inf, winding: Optional[WindingTree] = None,
                        threads: Optional[int] = None, progress: Progress = None) -> Any:
        """Distances of points (n, 3), or (3,), from the nearest triangle of a solid: negative
        inside, where trimesh has them positive, and 0 on every triangle; signs are exact. Where
        components overlap, it is a lower bound of the depth in their union. Infinities, with signs,
        beyond `within`. X_WM: the mesh's pose in the points' frame, (4, 4). A mesh that isn't closed
        takes the WindingTree of it: inside is where the number exceeds 0.5. n floats, or one. Raises
        ValueError if the mesh is no solid and `winding` is None."""
        return self._signed_distance(points, X_WM, within, winding, (threads, progress))

    def rays(self, origins: ArrayLike, directions: ArrayLike, X_WM: Arrays = None, *,
             t_min: float = 0.0, t_max: float = inf, threads: Optional[int] = None,
             progress: Progress = None) -> RayHits:
        """The first triangles that rays meet, RayHits. origins: (n, 3), or (3,) for all;
        directions: (n, 3) of any length but 0; X_WM: the mesh's pose in the rays' frame, (4, 4) or
        one a ray; t_min, t_max: lengths along the rays between which hits count."""
        return RayHits(*self._rays(origins, directions, X_WM, t_min, t_max, (threads, progress)))

    def rays_all(self, origins: ArrayLike, directions: ArrayLike, X_WM: Arrays = None, *,
                 t_min: float = 0.0, t_max: float = inf, max_hits: Optional[int] = None,
                 threads: Optional[int] = None, progress: Progress = None) -> AllHits:
        """Every triangle that rays meet, AllHits, with normals: the first max_hits of each ray.
        Else as rays()."""
        most = _ALL if max_hits is None else max_hits
        return AllHits(*self._rays_all(origins, directions, X_WM, t_min, t_max, most,
                                       (threads, progress)))

    def rays_blocked(self, origins: ArrayLike, directions: ArrayLike, X_WM: Arrays = None, *,
                     t_min: float = 0.0, t_max: float = inf,
                     threads: Optional[int] = None, progress: Progress = None) -> Any:
        """Whether the rays meet any triangle: faster than rays()."""
        return self._rays_blocked(origins, directions, X_WM, t_min, t_max, (threads, progress))

    def self_intersections(self, limit: Optional[int] = None) -> SelfIntersections:
        """The first `limit` pairs of triangles that meet other than in shared vertices and edges,
        SelfIntersections: exact. Triangles without area are left out."""
        triangles, kinds = self._self_intersections(_ALL if limit is None else limit)
        return SelfIntersections(triangles, _KINDS[kinds])

    def prepare(self) -> None:
        """Does nothing, as a mesh is prepared when it is made. Gone in the next version."""

    @property
    def is_solid(self) -> bool:
        """Whether it has an inside."""
        return self._is_solid()

    @property
    def nbytes(self) -> int:
        """Bytes of memory, trees included."""
        return self._nbytes()

    @property
    def vertices(self) -> NDArray[np.float64]:
        """(n, 3) float64, read only, not copied."""
        return self._vertices()

    @property
    def faces(self) -> NDArray[np.int64]:
        """(m, 3) int64, read only, not copied."""
        return self._faces()

    @property
    def bounds(self) -> NDArray[np.float64]:
        """(2, 3) the least and the largest coordinates of vertices that triangles use."""
        used = self.vertices[np.unique(self.faces)]
        return np.stack([used.min(0), used.max(0)])

    @property
    def volume(self) -> float:
        """The volume of a closed mesh, by how often it winds round each point; to rounding."""
        corners = self.vertices[self.faces] - self.bounds.mean(0)
        return float(np.linalg.det(corners).sum() / 6)

    def __repr__(self) -> str:
        kind = "solid of " if self.is_solid else ""
        return f"<fcl_kios.Mesh, {kind}{len(self.faces)} triangles>"

    def __copy__(self) -> Mesh:
        return self  # nobody changes it

    def __deepcopy__(self, memo: Any) -> Mesh:
        return self

    def __reduce_ex__(self, protocol: Any) -> Any:
        import pickle

        stored = self._stored()
        buffer = pickle.PickleBuffer(stored) if protocol >= 5 else stored.tobytes()
        return _loaded, (buffer, self.is_solid)


class WindingTree(_core._WindingTree):
    """The generalized winding number of a mesh, closed or not: how often it winds round points, 1
    in a closed mesh and 0 outside, a fraction near holes. Made once for any number of points."""

    def __init__(self, mesh: Mesh) -> None:
        super().__init__(mesh)

    def at(self, points: ArrayLike, *, error: float = 1e-3, threads: Optional[int] = None,
           progress: Progress = None) -> Any:
        """The numbers at points (n, 3), or (3,), in the mesh's frame: off by at most `error`; 0 sums
        all triangles. n floats, or one."""
        return self._at(points, error, (threads, progress))

    @property
    def nbytes(self) -> int:
        """Bytes of memory."""
        return self._nbytes()


def _loaded(stored, solid):
    mesh = Mesh.__new__(Mesh)
    _core._Mesh.__init__(mesh, stored, solid)
    return mesh
