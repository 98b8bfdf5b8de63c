#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: dart.sh INTERPOSER WORK_FILE SOURCE_DIR PROGRAM
# Debian's libdart, which was never compiled against us: robots' verdicts, contacts and distances
# with the library preloaded, in three threads, are those without it. The UR5's links, too, if the
# benchmark data is found ($KIOS_DATA, or shared/data beside the sources).
set -euo pipefail

interposer=$1 work=$2 source_dir=$3 program=$4
if [[ -z $program ]]; then
  echo "skipped: the test was configured without DART (libdart-dev)"
  exit 77
fi
fail() {
  echo "$*"
  exit 1
}

# ask MESH...
ask() {
  "$program" write "$work.answers" "$@" 2>"$work.log" || fail "DART without the library"
  local mode
  for mode in on trust stats verify; do
    echo "== $mode"
    FCL_KIOS_PRELOAD=$mode LD_PRELOAD=$interposer "$program" check "$work.answers" "$@" 2>"$work.log" ||
      fail "other answers in mode $mode"
    cat "$work.log"
    if grep -q differs "$work.log"; then fail "differences"; fi
  done
  grep -qE 'distance: [0-9]{4,} by k-IOS' "$work.log" || fail "k-IOS was hardly asked"
  rm -f "$work.answers" "$work.log"
}

ask
for data in "${KIOS_DATA:-}" "$source_dir/../shared/data" "$source_dir/shared/data"; do
  if [[ -n $data && -e $data/ur5/base.stl ]]; then
    echo "== UR5"
    links=()
    for link in base shoulder upperarm forearm wrist1 wrist2 wrist3; do
      links+=("$data/ur5/$link.stl")
    done
    ask "${links[@]}"
    exit 0
  fi
done
echo "no UR5 was found"
