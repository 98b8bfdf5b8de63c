# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""The stubs say what the compiled module has, no more and no less, and everything is documented."""
import ast
import inspect
import pathlib
import re

import fcl_kios
from fcl_kios import _core, fcl

STUBS = ast.parse((pathlib.Path(fcl_kios.__file__).parent / "_core.pyi").read_text())


def names_of(function):
    a = function.args
    names = [x.arg for x in a.args] + (["*" + a.vararg.arg] if a.vararg else [])
    names += (["*"] if a.kwonlyargs else []) + [x.arg for x in a.kwonlyargs]
    decorators = {getattr(d, "id", "") for d in function.decorator_list}
    return names[1:] if "classmethod" in decorators else names


def names_at_run_time(function):
    """pybind11's docstrings begin with the signature."""
    try:
        parameters = list(inspect.signature(function).parameters.values())
        names = []
        for p in parameters:
            if p.kind is p.KEYWORD_ONLY and "*" not in names:
                names.append("*")
            names.append(p.name)
        return names
    except ValueError:
        inside = re.search(r"\((.*)\) ->", function.__doc__.splitlines()[0])[1]
        return [re.split(r"[:=]", part)[0].strip()
                for part in re.split(r", (?=[*\w]+(?::|$|,|=))", inside) if part]


def check(stub, scope, where):
    found = {n: getattr(scope, n) for n in dir(scope) if not n.startswith("_")}
    described = {}
    for node in stub.body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            described[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            described[node.target.id] = node
    described = {n: node for n, node in described.items() if not n.startswith("__")}
    if inspect.isclass(scope):
        bases = {n for b in scope.__bases__ for n in dir(b)}
        found = {n: x for n, x in found.items() if n not in bases}
    aliases = {"Floats", "Progress"}
    assert set(found) == set(described) - aliases, where
    for name, node in described.items():
        if isinstance(node, ast.ClassDef):
            check(node, found[name], f"{where}.{name}")
        elif isinstance(node, ast.FunctionDef) and callable(found.get(name)):
            assert names_of(node) == names_at_run_time(found[name]), f"{where}.{name}"


def test_stubs():
    check(STUBS, _core, "_core")


def test_documented():
    for name in fcl_kios.__all__:
        assert name == "__version__" or getattr(fcl_kios, name).__doc__, name
    for cls in (fcl_kios.Mesh, fcl_kios.Scene):
        for name in dir(cls):
            if name.startswith("_"):
                continue
            text = getattr(cls, name).__doc__ or ""
            assert len(re.sub(r"^\w+\(.*\) -> .*", "", text).strip()) > 10, (cls, name)
    assert fcl.__doc__


def test_the_page_names_the_defaults():
    page = pathlib.Path(__file__).resolve().parents[3] / "docs/python.md"
    named = 0
    for method, arguments in re.findall(r"^\| `mesh\.(\w+)\((.*?)\)`", page.read_text(), re.M):
        signature = getattr(_core.Mesh, method).__doc__.splitlines()[0]
        for name, value in re.findall(r"(\w+)=([^,)]+)", arguments):
            found = re.search(rf"\b{name}: [^=]*= ([^,)]+)", signature)
            assert found and eval(found[1], {"inf": float("inf")}) == eval(
                value, {"inf": float("inf")}), f"{method}: {name}={value}; {signature}"
            named += 1
    assert named >= 5
