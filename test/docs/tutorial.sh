#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: tutorial.sh PROGRAM WORK_DIR CUBE
# Runs the tutorial's program on the cube that is shipped, on a file that is cut off and on none.
set -euo pipefail

program=$(realpath "$1")
mkdir -p "$2"
cp "$3" "$2/cube.stl"
cd "$2"

expected='12 triangles
distance 2, at x = 1 and 3
within 0.5: 0
at least 1.8: 1
frame 0: 1 and 2 are 5.5 apart
  0 to the wall: 7
  1 to the wall: 5.5
frame 1: 1 and 2 are 4.5 apart
  0 to the wall: 7
  1 to the wall: 4.5
frame 2: 1 and 2 are 3.5 apart
  0 to the wall: 7
  1 to the wall: 3.5'
output=$("$program")
echo "$output"
# How many pairs a scene searches is its own business.
if [[ $(grep -v searched <<<"$output") != "$expected" ]]; then
  echo "FAILED: expected"$'\n'"$expected"
  exit 1
fi
head -c 200 cube.stl >cut.stl
refused() { # FILE MESSAGE
  local status=0 message
  message=$("$program" "$1" 2>&1) || status=$?
  if ((status != 1)) || [[ $message != "$1 $2" ]]; then
    echo "FAILED: $1: status $status, $message"
    exit 1
  fi
}
refused cut.stl 'is no binary STL file'
refused missing.stl "can't be opened"
