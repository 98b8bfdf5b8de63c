#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: load_mesh.sh RUN_SH PROGRAM WORK_DIR
# Good and bad files: what is printed, which status, what the message says.
set -euo pipefail

run=("$(realpath "$1")" "$2" libassimp-dev)
work=$3
mkdir -p "$work"
cd "$work"

cat >cube.obj <<'OBJ'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
OBJ
cat >plate.stl <<'STL'
solid plate
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 2 0 0
vertex 0 2 0
endloop
endfacet
facet normal 0 0 1
outer loop
vertex 1 1 0
vertex 1 1 0
vertex 1 1 0
endloop
endfacet
endsolid plate
STL
# Each facet has its own corners, and a normal that keeps readers from joining them.
{
  echo 'solid tetrahedron'
  for facet in '0 0 -1|0 0 0|0 1 0|1 0 0' '0 -1 0|0 0 0|1 0 0|0 0 1' '-1 0 0|0 0 0|0 0 1|0 1 0' \
    '1 1 1|1 0 0|0 1 0|0 0 1'; do
    IFS='|' read -r normal a b c <<<"$facet"
    printf 'facet normal %s\nouter loop\n' "$normal"
    printf 'vertex %s\n' "$a" "$b" "$c"
    printf 'endloop\nendfacet\n'
  done
  echo 'endsolid tetrahedron'
} >tetrahedron.stl
: >empty.stl
printf 'v 0 0 0\nv 1 0 0\nl 1 2\n' >lines.obj
sed 's/vertex 2 0 0/vertex nan 0 0/' plate.stl >nan.stl
head -c 60 plate.stl >cut.stl
echo 'no mesh' >text.xyzzy

failures=0
expect() { # STATUS TEXT ARGUMENT...
  local status=0 output
  output=$("${run[@]}" "${@:3}" 2>&1) || status=$?
  if ((status == 77)); then
    echo "$output"
    exit 77
  fi
  if ((status != $1)) || ! grep -qF -- "$2" <<<"$output"; then
    echo "FAILED: load_mesh ${*:3}: status $status, expected $1 and '$2':"
    failures=$((failures + 1))
  fi
  echo "$output"
}

expect 0 'cube.obj: 12 triangles, 8 vertices, 1 x 1 x 1' cube.obj
expect 0 'distance 1, ' cube.obj
expect 0 'tetrahedron.stl: 4 triangles, 4 vertices, ' tetrahedron.stl
expect 0 'plate.stl: 2 triangles, ' cube.obj plate.stl
expect 2 'usage: load_mesh FILE' # no file
expect 1 'load_mesh: missing.obj: Unable to open file' missing.obj
expect 1 'load_mesh: empty.stl: ' empty.stl
expect 1 'load_mesh: lines.obj: ' lines.obj
expect 1 'load_mesh: text.xyzzy: No suitable reader found' text.xyzzy
expect 1 'load_mesh: cut.stl: ' cut.stl
expect 1 'load_mesh: nan.stl: ' nan.stl
exit "$failures"
