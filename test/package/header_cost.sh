#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: header_cost.sh CXX SOURCE_DIR BUILD_DIR EIGEN_DIRS
# A file that includes fcl_kios/fcl_kios.h compiles in at most 1.3 times the processor time of one
# that includes fcl/fcl.h, and so does one that uses either: medians of three, interleaved.
set -euo pipefail

cxx=$1 source_dir=$2 build_dir=$3
limit=1.3
flags=(-std=c++17 -O2 "-I$source_dir/include" "-I$build_dir/include")
IFS=';' read -ra eigen <<<"$4"
for directory in "${eigen[@]}"; do flags+=(-isystem "$directory"); done

seconds() { # of processor time
  local TIMEFORMAT=%U
  { time "$cxx" "${flags[@]}" "$@" -c "$source_dir/test/package/header_cost.cpp" -o /dev/null; } \
    2>&1
}
median() { printf '%s\n' "$@" | sort -g | sed -n 2p; }

status=0
seconds -DKIOS -DUSE >/dev/null # reads the headers from the disk
for what in "" -DUSE; do
  fcl=() kios=()
  for _ in 1 2 3; do
    time=$(seconds $what)
    fcl+=("$time")
    time=$(seconds $what -DKIOS)
    kios+=("$time")
  done
  awk -v what="${what:-the header alone}" -v fcl="$(median "${fcl[@]}")" \
    -v kios="$(median "${kios[@]}")" -v limit="$limit" 'BEGIN {
      ratio = kios / fcl
      printf "%s: fcl/fcl.h %.2f s, fcl_kios.h %.2f s: %.2f times\n", what, fcl, kios, ratio
      exit ratio > limit
    }' || status=1
done
exit "$status"
