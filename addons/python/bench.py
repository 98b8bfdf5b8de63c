#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""usage: bench.py [--cpu] [--json FILE [--run NAME]] [--repeats N] [ROW...]

Times of the package against python-fcl's way of doing the same, interleaved in one process. Needs
the package fcl_kios on PYTHONPATH; python-fcl (`fcl`), trimesh and Open3D where they are installed,
else the rows that compare with them have no ratio, which is said. Answers are compared, too.
--cpu takes the time of the process on all cores instead, for a machine that does other things."""
import argparse
import json
import os
import pathlib
import pickle
import statistics
import subprocess
import sys
import time

import numpy as np

# Instead of this folder, whose fcl_kios isn't built.
sys.path[0] = str(pathlib.Path(__file__).resolve().parents[2] / "test/python")
import fcl_kios  # noqa: E402
import shapes  # noqa: E402
from fcl_kios import fcl as ours  # noqa: E402

try:
    import fcl as theirs

    if theirs.__name__ != "fcl":
        raise ImportError("this fcl isn't python-fcl")
except ImportError as error:
    theirs, why_not = None, str(error)
try:
    import trimesh
    import trimesh.collision
except ImportError:
    trimesh = None
try:
    import open3d
except ImportError:
    open3d = None

ROWS = {}


def row(function):
    ROWS[function.__name__] = function
    return function


now = time.perf_counter


def clock(what):
    start = now()
    what()
    return now() - start


def compare(mine, other, repeats):
    """Median seconds of each and the median ratio, asked in turns; checks nothing."""
    a, b = [], []
    for _ in range(repeats):
        a.append(clock(mine))
        if other:
            b.append(clock(other))
    if not other:
        return statistics.median(a), None, None
    return statistics.median(a), statistics.median(b), statistics.median(
        y / x for x, y in zip(a, b))


def part(n=20_000):
    """A torus with bumps, of n triangles about."""
    side = int((n / 2 / 1.5) ** 0.5)
    return shapes.torus(int(1.5 * side), side)


def apart(n, random):
    """Poses at which two parts are apart, and near enough that their boxes overlap."""
    poses = shapes.random_poses(40 * n, 2.2, random)
    mesh = fcl_kios.Mesh(*part(2000))
    d = mesh.distance(mesh, poses)
    return poses[(d > 0.05) & (d < 0.6)][:n]


@row
def distance_of_two_meshes(repeats):
    """fcl.distance() of two meshes of 20,000 triangles each, 40 poses"""
    v, f = part()
    poses = apart(40, np.random.default_rng(1))

    def ask(module):
        a, b = shapes.bvh(v, f, module), shapes.bvh(v, f, module)
        o1, o2 = shapes.placed(a, module=module), shapes.placed(b, module=module)

        def run():
            d = []
            for X in poses:
                o2.setRotation(X[:3, :3])
                o2.setTranslation(X[:3, 3])
                d.append(module.distance(o1, o2, module.DistanceRequest(), module.DistanceResult()))
            return np.array(d)

        return run

    mine, other = ask(ours), ask(theirs) if theirs else None
    if other:
        assert np.allclose(mine(), other(), atol=1e-9)
    a, b, ratio = compare(mine, other, repeats)
    return a / len(poses), b and b / len(poses), ratio


@row
def trimesh_min_distance(repeats):
    """trimesh's CollisionManager.min_distance_internal(), ten parts of 20,000 triangles"""
    if not trimesh:
        return None
    v, f = part()
    mesh = trimesh.Trimesh(v, f, process=False)
    poses = [shapes.translation(3 * (i % 4), 3 * (i // 4), 0.2 * (i % 3)) for i in range(10)]
    for X, R in zip(poses, shapes.random_rotations(10, np.random.default_rng(2))):
        X[:3, :3] = R

    def ask(module):
        trimesh.collision.fcl = module
        manager = trimesh.collision.CollisionManager()
        for i, X in enumerate(poses):
            manager.add_object(str(i), mesh, X)

        def run():
            trimesh.collision.fcl = module
            return manager.min_distance_internal()

        return run

    mine, other = ask(ours), ask(theirs) if theirs else None
    if other:
        assert abs(mine() - other()) < 1e-9 and mine() > 0
    return compare(mine, other, repeats)


@row
def poses_of_a_gripper(repeats):
    """10,000 poses of a gripper (5,000 triangles) against an object (20,000): Mesh.collides() beside
    trimesh's loop of set_transform() and in_collision_internal()"""
    v, f = part(5000)
    v = v * [0.3, 0.3, 0.6]
    poses = shapes.random_poses(10_000, 1.8, np.random.default_rng(3))  # at some they touch
    hand, thing = fcl_kios.Mesh(v, f), fcl_kios.Mesh(*part())
    mine = lambda: thing.collides(hand, poses)
    hits = mine()
    assert 0.05 < hits.mean() < 0.95
    assert all(thing.collides(hand, X) == h for X, h in zip(poses[::20], hits[::20]))
    if not (trimesh and theirs):
        return compare(mine, None, repeats)
    trimesh.collision.fcl = theirs
    manager = trimesh.collision.CollisionManager()
    manager.add_object("thing", trimesh.Trimesh(*part(), process=False))
    manager.add_object("hand", trimesh.Trimesh(v, f, process=False))
    every = 10  # as each costs the same

    def loop():
        found = []
        for X in poses[::every]:
            manager.set_transform("hand", X)
            found.append(manager.in_collision_internal())
        return np.array(found)

    assert np.array_equal(loop(), hits[::every])
    a, b, ratio = compare(mine, loop, repeats)
    return a, b * every, ratio * every


@row
def a_million_poses(repeats):
    """a million poses, most of them far, in one call"""
    hand, thing = fcl_kios.Mesh(*part(5000)), fcl_kios.Mesh(*part())
    poses = shapes.random_poses(1_000_000, 20, np.random.default_rng(4))
    return compare(lambda: thing.collides(hand, poses), None, 1)


@row
def signed_distances(repeats):
    """100,000 points in and about a torus of 84,000 triangles: Mesh.signed_distance() beside Open3D's
    RaycastingScene.compute_signed_distance(), which is in floats, on one thread each"""
    vertices, faces = part(84_000)
    random = np.random.default_rng(5)
    points = random.uniform(1.2 * vertices.min(0), 1.2 * vertices.max(0), (100_000, 3))
    mesh = fcl_kios.Mesh(vertices, faces, solid=True)
    mine = lambda: mesh.signed_distance(points, threads=1)
    if not open3d:
        return compare(mine, None, repeats)
    scene = open3d.t.geometry.RaycastingScene(nthreads=1)
    scene.add_triangles(open3d.core.Tensor(vertices.astype(np.float32)),
                        open3d.core.Tensor(faces.astype(np.uint32)))
    asked = open3d.core.Tensor(points.astype(np.float32))
    theirs_of = lambda: scene.compute_signed_distance(asked, nthreads=1).numpy()
    # Not signs: the rays that tell them meet nothing in Debian's 0.16, whose signs are all positive.
    assert np.abs(np.abs(mine()) - np.abs(theirs_of())).max() < 1e-6
    return compare(mine, theirs_of, repeats)


def unpickled(n, repeats):
    """Asks a part of n triangles for its first distance, unpickled or built."""
    v, f = part(n)
    probe = fcl_kios.Mesh(*part(200))
    probe.prepare()
    pose = shapes.translation(1.2, 0.1, 0.3)
    buffers = []
    stored = pickle.dumps(fcl_kios.Mesh(v, f), protocol=5, buffer_callback=buffers.append)
    load = lambda: pickle.loads(stored, buffers=buffers).distance(probe, pose)
    build = lambda: fcl_kios.Mesh(v, f).distance(probe, pose)
    assert load() == build()
    return compare(load, build, repeats)


@row
def unpickling(repeats):
    """pickle.loads() of a mesh of 20,000 triangles and a first distance, its buffer out of band as
    joblib's and Dask's are, beside building it and the same distance"""
    return unpickled(20_000, repeats)


@row
def unpickling_a_thousand(repeats):
    """the same of 1,000 triangles"""
    return unpickled(1000, 20 * repeats)  # as each is short


@row
def unpickling_200_thousand(repeats):
    """the same of 200,000 triangles"""
    return unpickled(200_000, min(repeats, 5))


@row
def importing(repeats):
    """import fcl_kios, numpy's own time not counted"""

    def seconds(code):
        return float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                                    check=True, env=os.environ).stdout)

    code = (f"import numpy, pickle, time; now = time.{now.__name__}; t = now(); "
            "import fcl_kios.fcl; print(now() - t)")
    return statistics.median(seconds(code) for _ in range(repeats)), None, None


def text_of(seconds):
    if seconds is None:
        return "-"
    for unit, scale in (("s", 1), ("ms", 1e3)):
        if seconds * scale >= 1:
            return f"{seconds * scale:.3g} {unit}"
    return f"{seconds * 1e6:.3g} us"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("rows", nargs="*", choices=[[], *ROWS])
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--json", help="docs/measured/preload.jsonl, say: its other runs stay")
    parser.add_argument("--run", default="python", help="name of the run, beginning with python")
    parser.add_argument("--cpu", action="store_true")
    arguments = parser.parse_args()
    global now
    if arguments.cpu:
        now = time.process_time
    if theirs is None:
        print(f"python-fcl isn't there ({why_not}): no row compares with it")
    if trimesh is None:
        print("trimesh isn't there: its rows are skipped")
    if open3d is None:
        print("Open3D isn't there (Debian: python3-open3d): no row compares with it")
    print("| what | fcl_kios | beside it | ratio |\n| --- | --: | --: | --: |")
    measured = []
    for name in arguments.rows or ROWS:
        found = ROWS[name](arguments.repeats)
        if found is None:
            continue
        mine, other, ratio = found
        what = " ".join(ROWS[name].__doc__.split())
        print(f"| {what} | {text_of(mine)} | {text_of(other)} | "
              f"{'-' if ratio is None else f'{ratio:.3g}'} |", flush=True)
        measured.append(dict(scenario=f"python/{name}", query="python", bv="kios", what=what,
                             median_us=1e6 * mine, other_us=other and 1e6 * other, ratio=ratio,
                             simd_target=fcl_kios.simd_target()))
    if arguments.json:
        root = pathlib.Path(__file__).resolve().parents[2]
        sys.path.append(str(root / "scripts"))
        from figures.measure import header, replace, slim

        command = " ".join(["addons/python/bench.py"] + ["--cpu"] * arguments.cpu
                           + [f"--repeats {arguments.repeats}", *arguments.rows])
        replace(pathlib.Path(arguments.json), arguments.run,
                [header(root, arguments.run, command), *map(slim, measured)])


if __name__ == "__main__":
    main()
