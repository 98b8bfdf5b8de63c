#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: traps.sh INTERPOSER PROGRAM
# A program that traps invalid operations lives on with the library preloaded, in each mode and with
# each instruction set.
set -euo pipefail

interposer=$1 program=$2
if ! expected=$("$program"); then
  echo "FCL itself is trapped on this machine"
  exit 77
fi
answered=0
for mode in on trust verify stats; do
  for target in '' AVX2 SSE4 SCALAR; do
    status=0
    said=$(FCL_KIOS_SIMD=$target FCL_KIOS_PRELOAD=$mode LD_PRELOAD=$interposer "$program" 2>&1) ||
      status=$?
    if [[ $said == *"is not available"* ]]; then continue; fi
    if ((status != 0)) || ! grep -qxF "$expected" <<<"$said"; then
      echo "mode $mode, instruction set '$target': status $status: $said, not $expected"
      exit 1
    fi
    if grep -qE '[1-9][0-9]* by k-IOS' <<<"$said"; then answered=1; fi
  done
done
((answered == 1)) || { echo "no copy answered: nothing was tested"; exit 1; }
