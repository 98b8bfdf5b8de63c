# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""What Python's users expect of any package: signatures, docstrings, stubs, reprs, names."""
import importlib
import inspect
import os
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

import fcl_kios
import shapes
from fcl_kios import _core, fcl


def documented():
    """Every public class and function, and every method and property of them."""
    for module in (fcl_kios, fcl, _core):
        for name, x in vars(module).items():
            if not name.startswith("_") and (inspect.isclass(x) or callable(x)):
                yield f"{module.__name__}.{name}", x
                for method in vars(x) if inspect.isclass(x) else ():
                    if not method.startswith("_"):
                        yield f"{module.__name__}.{name}.{method}", getattr(x, method)


def test_signatures_and_docstrings():
    methods = [(name, x) for name, x in documented() if inspect.isroutine(x)]
    assert len(methods) > 100
    for name, x in methods:
        signature = inspect.signature(x)
        assert "self" not in list(signature.parameters)[1:], name
    for name, x in documented():
        if callable(x) and not re.search(r"\.[A-Z_]+\.|(NODE|OBJECT)_TYPE|CCD|GJK", name):
            text = x.__doc__ or ""
            assert len(text) > 2 and "--" not in text, name
    for bound in (fcl_kios.Mesh(*shapes.box()).distance, fcl.Transform().setRotation,
                  fcl.DynamicAABBTreeCollisionManager().update):
        assert "self" not in inspect.signature(bound).parameters and bound.__doc__
    assert str(inspect.signature(fcl.Box)) == "(x, y, z)"
    assert str(inspect.signature(fcl.collide)) == "(o1, o2, request=None, result=None)"


def test_the_page_names_the_defaults():
    page = pathlib.Path(__file__).resolve().parents[2] / "docs/python.md"
    named = 0
    for method, arguments in re.findall(r"^\| `mesh\.(\w+)\((.*?)\)`", page.read_text(), re.M):
        signature = inspect.signature(getattr(fcl_kios.Mesh, method))
        for name, value in re.findall(r"(\w+)=([^,)]+)", arguments):
            assert signature.parameters[name].default == eval(value, {"inf": np.inf}), (method, name)
            named += 1
    assert named >= 5


def test_stubs(tmp_path):
    """By mypy's stubtest, which imports what it checks. That classes have pybind11's metaclass is
    nothing for stubs to say, and private bases are looked into by nobody."""
    pytest.importorskip("mypy")
    allowed = [r"fcl_kios\.(\w+\.)*_?[A-Z]\w*", r".*\.__getattr__"]
    (tmp_path / "allowed").write_text("\n".join(allowed) + "\n")
    root = pathlib.Path(fcl_kios.__file__).parents[1]
    done = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "fcl_kios", "--ignore-missing-stub",
         "--ignore-unused-allowlist", "--allowlist", str(tmp_path / "allowed")], cwd=root,
        env={**os.environ, "MYPYPATH": str(root), "PYTHONPATH": str(root)}, capture_output=True,
        text=True)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("made, text", [
    (lambda: fcl.Box(1, 2, 3), "fcl_kios.fcl.Box(side=[1.0, 2.0, 3.0])"),
    (lambda: fcl.Plane([0, 0, 1], 2), "fcl_kios.fcl.Plane(n=[0.0, 0.0, 1.0], d=2.0)"),
    (lambda: shapes.bvh(*shapes.box()), "<fcl_kios.fcl.BVHModel, 12 triangles>"),
    (lambda: shapes.placed(fcl.Sphere(2)),
     "fcl_kios.fcl.CollisionObject(geometry=fcl_kios.fcl.Sphere(radius=2.0))"),
    (lambda: fcl.Transform([1, 2, 3]), "fcl_kios.fcl.Transform([1.0, 0.0, 0.0, 0.0], [1.0, 2.0, 3.0])"),
    (fcl.DynamicAABBTreeCollisionManager, "<fcl_kios.fcl.DynamicAABBTreeCollisionManager, 0 objects>"),
    (fcl.CollisionResult, "fcl_kios.fcl.CollisionResult(is_collision=False, contacts=[], cost_sources=[])"),
    (fcl_kios.Scene, "<fcl_kios.Scene, 0 objects>"),
    (lambda: fcl_kios.Mesh(*shapes.box(), solid=True), "<fcl_kios.Mesh, solid of 12 triangles>"),
])
def test_reprs(made, text):
    assert repr(made()) == text


def test_modules_of_python_fcl():
    code = """
import sys, fcl_kios.fcl
sys.modules["fcl"] = fcl_kios.fcl
import fcl, fcl.fcl, fcl.collision_data, fcl.version
from fcl.collision_data import CollisionRequest
assert CollisionRequest is fcl.CollisionRequest is fcl_kios.fcl.CollisionRequest
assert fcl.fcl.Box is fcl_kios.fcl.Box and fcl.version.__version__ == fcl.__version__
"""
    subprocess.run([sys.executable, "-c", code], check=True, cwd="/",
                   env={**os.environ, "PYTHONPATH": os.path.dirname(os.path.dirname(fcl_kios.__file__))})
    for name in ("fcl", "collision_data", "version"):
        assert importlib.import_module(f"fcl_kios.fcl.{name}").__doc__
    with pytest.raises(ImportError):
        importlib.import_module("fcl")


def test_rotations_of_few_decimals():
    """Are made orthonormal, as the docstring says; floats are taken as they are."""
    a, b = shapes.bvh(*shapes.torus()), shapes.bvh(*shapes.box())
    for R in shapes.random_rotations(50, np.random.default_rng(4)):
        rounded = fcl.Transform(np.round(R, 4), np.array([2.0, 0.1, 0.2])).getRotation()
        assert np.abs(rounded.T @ rounded - np.eye(3)).max() < 1e-14
        assert np.abs(rounded - R).max() < 2e-4
        assert np.array_equal(fcl.Transform(R.astype("f")).getRotation(), R.astype("f"))
        o = fcl.CollisionObject(b, fcl.Transform([2.0, 0.1, 0.2]))
        o.setRotation(np.round(R, 4))
        near = fcl.distance(fcl.CollisionObject(a), o)
        o.setQuatRotation(np.round(fcl.Transform(R).getQuatRotation(), 4))
        assert abs(near - fcl.distance(fcl.CollisionObject(a), o)) < 1e-3


def test_a_manager_updates_what_it_is_told():
    """One object's move looks at that object alone: another that isn't finite is no matter."""
    objects = [fcl.CollisionObject(fcl.Box(1, 1, 1), fcl.Transform([3.0 * i, 0, 0])) for i in range(9)]
    manager = fcl.DynamicAABBTreeCollisionManager()
    manager.registerObjects(iter(objects))
    objects[8].setTranslation([0, 0, np.nan])
    objects[1].setTranslation([0.5, 0, 0])
    for moved in (objects[1], [objects[1]], iter(objects[1:2])):
        manager.update(moved)
    data = fcl.CollisionData()
    manager.collide(data, fcl.defaultCollisionCallback)
    assert data.result.is_collision
    with pytest.raises(ValueError, match="not finite"):
        manager.update()
    for o in objects[::2]:
        manager.unregisterObject(o)
    assert manager.getObjects() == objects[1::2]
