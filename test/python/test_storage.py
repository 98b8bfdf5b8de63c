# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Pickles and files."""
import copy
import io
import multiprocessing
import os
import pickle

import numpy as np
import pytest

import fcl_kios
import shapes
from fcl_kios import fcl
from fcl_kios._mesh import _loaded as loaded


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_pickled_meshes_answer_alike(torus, ball, poses, protocol):
    want = torus.distance(ball, poses)
    a, b = pickle.loads(pickle.dumps((torus, ball), protocol))
    assert np.array_equal(a.distance(b, poses), want)
    assert np.array_equal(a.vertices, torus.vertices) and np.array_equal(a.faces, torus.faces)
    assert b.is_solid and not a.is_solid and b.contains([0, 0, 0]) is True


def test_buffers_travel_out_of_band(torus):
    buffers = []
    data = pickle.dumps(torus, protocol=5, buffer_callback=buffers.append)
    assert len(data) < 500 and len(buffers) == 1
    raw = buffers[0].raw()
    again = pickle.loads(data, buffers=[bytes(raw)])
    assert again._stored().tobytes() == raw.tobytes()
    assert copy.deepcopy(torus) is torus


def distances(mesh, other, poses, connection):
    connection.send(mesh.distance(other, poses))


def test_workers_get_meshes(torus, ball, poses):
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=distances, args=(torus, ball, poses, theirs))
    process.start()
    assert ours.poll(60) and np.array_equal(ours.recv(), torus.distance(ball, poses))
    process.join(60)


def test_unpickled_meshes_are_prepared():
    v, f = shapes.torus(60, 24)
    stored = pickle.dumps(fcl_kios.Mesh(v, f))  # which is gone, and shares nothing
    again, built = pickle.loads(stored), fcl_kios.Mesh(v * 1.5, f)
    assert again.nbytes == built.nbytes


def test_altered_bytes_are_refused(ball):
    stored = ball._stored().tobytes()
    altered = bytearray(stored)
    altered[len(stored) // 2] ^= 1
    for wrong in (stored[:-1], bytes(altered)):
        with pytest.raises(ValueError, match="stored model"):
            loaded(wrong, True)
    with pytest.raises(ValueError):
        loaded(np.frombuffer(stored, np.uint8)[::2], False)


def test_files(tmp_path, torus, ball, poses):
    for mesh in (torus, ball):
        mesh.save(tmp_path / "mesh.kios")
        again = fcl_kios.load(tmp_path / "mesh.kios")
        assert again.is_solid == mesh.is_solid and np.array_equal(again.faces, mesh.faces)
        assert np.array_equal(again.distance(ball, poses), mesh.distance(ball, poses))
    v, f = shapes.box()
    text = "".join("facet normal 0 0 0\nouter loop\n" + "".join(
        "vertex %g %g %g\n" % tuple(p) for p in t) + "endloop\nendfacet\n" for t in v[f])
    (tmp_path / "a.STL").write_text("solid box\n" + text + "endsolid box\n")
    mesh = fcl_kios.load(tmp_path / "a.STL", solid=True)
    assert len(mesh.vertices) == 8 and len(mesh.faces) == 12
    assert mesh.contains([[0.4, 0.4, 0.4], [0.6, 0, 0]]).tolist() == [True, False]


def test_an_altered_head_is_refused_at_once(tmp_path):
    fcl_kios.Mesh(*shapes.torus(150, 90)).save(tmp_path / "soup.kios")
    v, f = shapes.ball()
    fcl_kios.Mesh(v, f[1:]).save(tmp_path / "open.kios")
    content = (tmp_path / "open.kios").read_bytes()
    (tmp_path / "open.kios").write_bytes(b"kios-mesh-solid\n" + content[16:])
    with pytest.raises(ValueError, match="bounds no solid"):  # by load(), not by the first query
        fcl_kios.load(tmp_path / "open.kios")
    with open(tmp_path / "large.kios", "wb") as file:
        file.truncate(1 << 40)  # of which 16 bytes are read
    with pytest.raises(ValueError, match="no stored mesh"):
        fcl_kios.load(tmp_path / "large.kios")


def test_what_has_read(tmp_path, ball):
    v, f = shapes.box()
    text = "".join("v %g %g %g\n" % tuple(p) for p in v) + "".join(
        "f %d %d %d\n" % tuple(t + 1) for t in f)
    for file in (io.BytesIO(text.encode()), io.StringIO(text)):
        assert fcl_kios.load(file, kind="obj", solid=True).contains([0, 0, 0])
    ball.save(tmp_path / "ball.kios")
    with open(tmp_path / "ball.kios", "rb") as file:
        assert np.array_equal(fcl_kios.load(file, kind="kios").faces, ball.faces)
    for file, kind, message in [(io.BytesIO(b""), "stl", "neither binary STL"), (io.BytesIO(b""), None, "kind"),
                                (io.BytesIO(b"no"), ".kios", "no stored mesh"),
                                (io.BytesIO(b"v a b c\n"), "obj", "file.obj:1")]:
        with pytest.raises(ValueError, match=message):
            fcl_kios.load(file, kind=kind)


def test_files_that_are_mended(tmp_path):
    v, f = shapes.box()
    v = v[f].reshape(-1, 3) + np.random.default_rng(2).uniform(-1e-7, 1e-7, (36, 3))
    lines = "".join("v %r %r %r\n" % tuple(p) for p in v.tolist())
    lines += "".join(f"f {i + 1} {i + 2} {i + 3}\n" for i in range(0, 33, 3))  # one is missing
    (tmp_path / "loose.obj").write_text(lines)
    with pytest.raises(ValueError, match="bounds no solid"):
        fcl_kios.load(tmp_path / "loose.obj", solid=True)
    with pytest.warns(UserWarning, match="welded"):
        with pytest.raises(ValueError, match="bounds no solid"):
            fcl_kios.load(tmp_path / "loose.obj", solid=True, repair=True)
    with pytest.warns(UserWarning, match="filled"):
        mesh = fcl_kios.load(tmp_path / "loose.obj", solid=True, repair=dict(max_hole_edges=3))
    assert len(mesh.vertices) == 8 and abs(mesh.volume - 1) < 1e-5


def test_files_that_cant_be_read(tmp_path):
    for name, content, message in [
            ("a.stl", b"solid\nvertex 1 2\n", "a.stl:2: 'vertex' stands where 'facet'"),
            ("b.stl", b"", "empty"), ("e.obj", b"v a b c\n", "e.obj:1: 'a' is no"),
            ("f.dae", b"<COLLADA/>", "needs a <scene>|without which this"),
            ("i.kios", b"kios", "no stored mesh"), ("j.kios", b"kios-mesh-solid\nabc", "cut off"),
            ("k.kios", b"kios-mesh-loose\nabc", "no stored mesh")]:
        (tmp_path / name).write_bytes(content)
        with pytest.raises(ValueError, match=message):
            fcl_kios.load(tmp_path / name)
    for path, error in [(tmp_path / "none.stl", FileNotFoundError), (tmp_path, ValueError),
                        ("/dev/zero", ValueError)]:
        with pytest.raises(error):
            fcl_kios.load(path)
    (tmp_path / "d.stl").mkdir()
    with pytest.raises(IsADirectoryError):
        fcl_kios.load(tmp_path / "d.stl")
    os.mkfifo(tmp_path / "fifo.stl")
    with pytest.raises(ValueError, match="no regular file"):
        fcl_kios.load(tmp_path / "fifo.stl")


def test_what_files_lose_is_warned_of(tmp_path):
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n")
    with pytest.warns(UserWarning, match="1 point or line left out") as caught:
        fcl_kios.load(tmp_path / "a.obj")
    assert len(caught) == 1 and caught[0].filename == __file__


def test_from_trimesh():
    class Trimesh:
        vertices, faces = shapes.box()

    assert fcl_kios.Mesh.from_trimesh(Trimesh, solid=True).is_solid


def test_scenes_can_be_pickled(torus):
    scene = fcl_kios.Scene()
    scene.add("torus", torus)
    scene.add(("a", 1), fcl.Box(1, 2, 3), shapes.translation(4), obstacle=True)
    scene.add("ball", fcl.Sphere(0.5), shapes.translation(0, 4))
    scene.exclude("ball", ("a", 1))
    again = pickle.loads(pickle.dumps(scene, protocol=5))
    assert list(again) == list(scene) and again.clearances() == scene.clearances()
    assert len(again.clearances()) == 2
