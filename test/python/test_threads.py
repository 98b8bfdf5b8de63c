# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Threads, forks, signals and the end of the interpreter."""
import multiprocessing
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import fcl_kios
import shapes
from fcl_kios import fcl


def test_threads_share_objects(torus, ball, poses):
    want = torus.distance(ball, poses)
    mesh = shapes.bvh(torus.vertices, torus.faces)
    other = shapes.bvh(ball.vertices, ball.faces)
    fixed = fcl.CollisionObject(mesh)

    def ask(k):
        if k % 2:
            return torus.distance(ball, poses, threads=1 + k % 3)
        return np.array([fcl.distance(fixed, shapes.placed(other, X)) for X in poses])

    with ThreadPoolExecutor(6) as pool:
        for found in pool.map(ask, range(24)):
            assert np.array_equal(found, want)


def together(*works):
    """Runs them in threads, and raises what any raises."""
    with ThreadPoolExecutor(len(works)) as pool:
        for done in [pool.submit(work) for work in works]:
            done.result(60)


def test_changes_and_queries_take_turns(torus, ball):
    """A change waits for the queries of other threads, and is never refused."""
    mesh, stop, changed = shapes.bvh(torus.vertices, torus.faces), threading.Event(), []
    a, b = fcl.CollisionObject(mesh), shapes.placed(shapes.bvh(ball.vertices, ball.faces))
    want = fcl.distance(a, b)
    manager = fcl.DynamicAABBTreeCollisionManager()
    manager.registerObjects([a, b])

    def disturb():
        while not stop.is_set():
            for change in (lambda: a.setTranslation([0.0, 0, 0]), mesh.computeLocalAABB,
                           lambda: (manager.unregisterObject(b), manager.registerObject(b)),
                           manager.update, lambda: fcl.Box(1, 1, 1).computeLocalAABB()):
                change()
                changed.append(1)

    def ask():
        try:
            for _ in range(300):
                assert fcl.distance(a, b) == want
                data = fcl.DistanceData()
                manager.distance(data, fcl.defaultDistanceCallback)
                assert data.result.min_distance in (want, sys.float_info.max)
        finally:
            stop.set()

    together(disturb, disturb, ask)
    assert len(changed) > 20


def test_a_change_waits_for_a_query_of_its_object(torus):
    """And for no other query: the box that is being asked about is free once the batch has ended."""
    box, other, seen = fcl.Box(0.5, 0.5, 0.5), fcl.Box(1, 1, 1), []
    poses = np.tile(shapes.random_poses(300, 1.7, np.random.default_rng(7)), (150, 1, 1))
    began = threading.Event()

    def batch():
        torus.distance(box, poses, threads=1, progress=lambda n: began.set())
        seen.append("batch")

    def change():
        assert began.wait(30)
        other.side = (2, 2, 2)
        seen.append("other")
        box.side = (1, 1, 1)
        seen.append("box")

    together(batch, change)
    assert seen == ["other", "batch", "box"]


def test_scenes_in_threads(torus, ball):
    scene = fcl_kios.Scene()
    for i in range(6):
        scene.add(("fixed", i), ball, shapes.translation(2.0 * i))

    def come_and_go(k):
        def work():
            for i in range(100):
                scene.add((k, i), torus, shapes.translation(0, 3 + k))
                assert any((k, i) in (p.a, p.b) for p in scene.clearances())
                scene.remove((k, i))
                scene.move(("fixed", k), shapes.translation(2.0 * k, 0.01 * i))
        return work

    def ask():
        for _ in range(150):
            for pair in scene.clearances():
                assert pair.a != pair.b and pair.distance >= 0

    together(come_and_go(0), come_and_go(1), ask, ask)
    assert len(scene) == 6 and len(scene.clearances()) == 15


def test_changes_during_a_batch_are_refused(torus, poses):
    box, many, seen = fcl.Box(0.5, 0.5, 0.5), np.tile(poses, (100, 1, 1)), []

    def progress(n):
        with pytest.raises(RuntimeError, match="while a query reads it"):
            box.side = (1, 1, 1)
        seen.append(n)

    torus.distance(box, many, progress=progress)
    box.side = (1, 1, 1)
    assert seen


def child_uses(scene, manager, box, batch, connection):
    box.side = (1, 1, 1)
    data = fcl.DistanceData()
    manager.distance(data, fcl.defaultDistanceCallback)
    scene.add("new", fcl_kios.Mesh(*shapes.ball(6)))
    connection.send((data.result.min_distance, len(scene.clearances()), batch(2)))


def test_forks_beside_queries_and_builds(torus, ball, poses):
    """The child finds no lock, scene or geometry in use, and threads of its own."""
    many = np.tile(poses, (10, 1, 1))

    def batch(threads):
        return torus.distance(ball, many, threads=threads).tolist()
    want = batch(2)  # in threads, which the child hasn't
    scene, box = fcl_kios.Scene(), fcl.Box(1, 1, 1)
    manager = fcl.DynamicAABBTreeCollisionManager()
    manager.registerObjects([fcl.CollisionObject(box), shapes.placed(box, shapes.translation(3))])
    for i in range(12):
        scene.add(i, torus, shapes.translation(0.2 * i, 0.1, 0.3))
    context, stop = multiprocessing.get_context("fork"), threading.Event()

    def busy(what):
        def work():
            while not stop.is_set():
                what()
        return threading.Thread(target=work)

    threads = [busy(what) for what in (
        lambda: (scene.move(3, shapes.translation(0.01)), scene.clearances()),
        lambda: manager.distance(fcl.DistanceData(), fcl.defaultDistanceCallback),
        lambda: torus.distance(box, np.tile(np.eye(4), (500, 1, 1))),
        lambda: fcl_kios.Mesh(*shapes.torus(100, 60)))]
    for t in threads:
        t.start()
    try:
        for _ in range(3):
            ours, theirs = context.Pipe()
            process = context.Process(target=child_uses, args=(scene, manager, box, batch, theirs))
            process.start()
            assert ours.poll(30) and ours.recv() == (2.0, 78, want)
            process.join(30)
            assert process.exitcode == 0
    finally:
        stop.set()
        for t in threads:
            t.join()


def run(code, **options):
    paths = [os.path.dirname(os.path.dirname(fcl_kios.__file__)), os.path.dirname(__file__)]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}
    head = "import numpy as np, fcl_kios, shapes, threading, time\nfrom fcl_kios import fcl\n"
    return subprocess.Popen([sys.executable, "-c", head + textwrap.dedent(code)], env=environment,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)


LONG = """
    a, b = fcl_kios.Mesh(*shapes.torus(60, 40)), fcl_kios.Mesh(*shapes.ball(24))
    poses = np.tile(shapes.random_poses(1000, 1.5, np.random.default_rng(1)), (300, 1, 1))
    oa, ob = fcl.CollisionObject(shapes.bvh(*shapes.torus())), shapes.placed(shapes.bvh(*shapes.ball()))
"""


LARGE = """
    v, f = shapes.torus(1000, 500)
    oa, ob = [shapes.placed(shapes.bvh(v, f), X) for X in (np.eye(4), shapes.translation(1e-5))]
    many = fcl.CollisionRequest(10**7, True)
"""


@pytest.mark.parametrize("work", [
    "a.distance(b, poses, threads=1)", "a.distance(b, poses, threads=2)", "fcl_kios.Mesh(2 * v, f)",
    "shapes.bvh(2 * v, f)", "fcl.collide(oa, ob, many, fcl.CollisionResult())"])
def test_ctrl_c(work):
    process = run(LONG + ("" if "poses" in work else LARGE) + f"""
    print("go", flush=True)
    try:
        {work}
    except KeyboardInterrupt:
        print(time.time(), flush=True)
    """)
    assert process.stdout.readline() == "go\n"
    time.sleep(0.3)
    sent = time.time()
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=30)
    assert out, err
    assert float(out) - sent < 0.8  # 0.1 s and what a busy machine takes


@pytest.mark.parametrize("work", ["a.distance(b, poses)", "fcl.distance(oa, ob)",
                                  "fcl_kios.Mesh(*shapes.torus(30, 20))"])
def test_the_interpreter_may_end_meanwhile(work):
    process = run(LONG + f"""
    def forever():
        while True:
            {work}
    for _ in range(3):
        threading.Thread(target=forever, daemon=True).start()
    time.sleep(0.3)
    """)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 0, err
    assert "terminate" not in err and "Fatal" not in err


def test_globals_may_live_to_the_end():
    process = run(LONG + """
    import sys
    manager = fcl.DynamicAABBTreeCollisionManager()
    manager.registerObjects([oa, ob])
    scene = fcl_kios.Scene()
    scene.add("a", a); scene.add("b", b); scene.closest()
    sys.keep = manager, scene, a, oa
    class Late:
        def __del__(self):
            manager.distance(fcl.DistanceData(), fcl.defaultDistanceCallback)
            a.distance(b, poses[:100])
    sys.late = Late()
    """)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 0 and "Fatal" not in err, err
