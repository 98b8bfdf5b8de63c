#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: wheel.sh WHEEL PYTHON [TEST...]
# Installs a wheel of scripts/wheel, offline, into an environment of its own beside PYTHON's numpy.
# There it answers, and the process has no library of the machine that the wheel brings. pytest
# then runs these tests.
set -euo pipefail

wheel=$1 python=$2
shift 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$python" -m venv --system-site-packages "$work/venv"
"$work/venv/bin/python" -m pip install --quiet --no-index --no-deps --force-reinstall "$wheel"
cd "$work"
"$work/venv/bin/python" - <<'EOF'
import pathlib
import numpy as np
import fcl_kios

vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
mesh = fcl_kios.Mesh(vertices, np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]))
X = np.eye(4)
X[0, 3] = 2
assert mesh.distance(mesh, X) == 1
pathlib.Path("ball.urdf").write_text("<robot name='r'><link name='l'><collision><geometry>"
                                     "<sphere radius='1'/></geometry></collision></link></robot>")
robot = fcl_kios.Robot("ball.urdf")
robot.add("mesh", mesh)
assert robot.contact([]).b == "mesh"
package = pathlib.Path(fcl_kios.__file__).parent
brought = {path.name for path in (package / "libs").glob("*.so*")}
assert any(name.startswith("libfcl.so") for name in brought), brought
for line in open("/proc/self/maps"):
    path = pathlib.Path(line.split()[-1])
    assert path.name not in brought or package in path.parents, path
assert list((package / "libs").glob("*.copyright")), "no licences"
EOF
if (($#)); then "$work/venv/bin/python" -m pytest -q -p no:cacheprovider "$@"; fi
echo "wheel: installed, answers, and brings what it needs"
