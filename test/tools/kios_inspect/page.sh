#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: page.sh KIOS_INSPECT DIR
# Pages of a generated mesh, and of two, one with a path that is markup, in headless Chromium:
# see page.py. Leaves their pictures in DIR; docs/images/inspect.png is DIR/knot.png. Skipped
# without Chromium or Python.
set -euo pipefail

inspect=$1 dir=$2
here=$(cd "$(dirname "$0")" && pwd)
source "$here/../browser.sh"
mkdir -p "$dir"
cd "$dir"

# A torus knot, of 96 x 14 squares.
awk 'BEGIN {
  n = 96; m = 14; turn = 8 * atan2(1, 1)
  for (i = 0; i < n; ++i) {
    t = turn * i / n
    x = (2 + cos(3 * t)) * cos(2 * t); y = (2 + cos(3 * t)) * sin(2 * t); z = sin(3 * t)
    dx = -3 * sin(3 * t) * cos(2 * t) - 2 * y; dy = -3 * sin(3 * t) * sin(2 * t) + 2 * x
    dz = 3 * cos(3 * t)
    # Across the tangent d: out = d x (x, y, 0), and d x out.
    ax = -dz * y; ay = dz * x; az = dx * y - dy * x
    bx = dy * az - dz * ay; by = dz * ax - dx * az; bz = dx * ay - dy * ax
    a = sqrt(ax * ax + ay * ay + az * az); b = sqrt(bx * bx + by * by + bz * bz)
    for (j = 0; j < m; ++j) {
      c = 0.42 * cos(turn * j / m); s = 0.42 * sin(turn * j / m)
      u = c / a; v = s / b
      print "v", x + u * ax + v * bx, y + u * ay + v * by, z + u * az + v * bz
    }
  }
  for (i = 0; i < n; ++i) for (j = 0; j < m; ++j) {
    p = i * m + j + 1; q = i * m + (j + 1) % m + 1
    r = (i + 1) % n * m + j + 1; s = (i + 1) % n * m + (j + 1) % m + 1
    print "f", p, r, s, q
  }
}' >knot.obj
mkdir -p '<'
cp knot.obj '</script><b>knot.obj'

browse() { "$python" "$here/page.py" "$chromium" "$@"; }
echo "== one mesh"
"$inspect" knot.obj --html knot.html
browse knot.html knot.png --size 1100x640
echo "== two meshes, dark"
"$inspect" '</script><b>knot.obj' knot.obj --pose-b=6.2,0.5,0.5,0.70710678,0.70710678,0,0 \
  --html pair.html
browse pair.html pair.png --size 1100x640 --dark
