#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: tutorial.sh PROGRAM WORK_DIR
# Runs the tutorial's program on a cube in a binary STL file, on a file that is cut off and on none.
set -euo pipefail

program=$(realpath "$1")
mkdir -p "$2"
cd "$2"

# A digit 0 or 1 as a float, a corner "xyz" of such digits, a triangle of three corners.
float() { if (($1)); then printf '\0\0\200\077'; else printf '\0\0\0\0'; fi; }
corner() { float "${1:0:1}" && float "${1:1:1}" && float "${1:2:1}"; }
triangle() { corner 000 && corner "$1" && corner "$2" && corner "$3" && printf '\0\0'; }
{
  printf '%-80s' 'a cube'
  printf '\014\0\0\0'
  for face in '000 010 110 100' '001 101 111 011' '000 100 101 001' '010 011 111 110' \
    '000 001 011 010' '100 110 111 101'; do
    read -r a b c d <<<"$face"
    triangle "$a" "$b" "$c"
    triangle "$a" "$c" "$d"
  done
} >part.stl

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
head -c 200 part.stl >cut.stl
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
