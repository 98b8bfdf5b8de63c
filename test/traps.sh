#!/bin/sh
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: traps.sh PROGRAM... MESH_FUZZ
# Runs the programs' traps_test.cpp, and the fuzzer, which traps, with each instruction set of this
# machine and build but the best, with which their own tests run.
set -eu

failed=0
ran=0
for target in AVX2 SSE4 NEON EMU128 SCALAR; do
  for program in "$@"; do
    case $program in
      */mesh_fuzz) options="--seed 3 --seconds 6 --least 200 --shrink 1 --slow 10" ;;
      *) options="--only traps" ;;
    esac
    # shellcheck disable=SC2086 # several options
    if said=$(FCL_KIOS_SIMD=$target "$program" $options 2>&1); then
      ran=$((ran + 1))
    elif echo "$said" | grep -q "FCL_KIOS_SIMD=$target is not available"; then
      echo "$target: skipped, this machine or build lacks it"
      break
    else
      echo "$target, $program:"
      echo "$said" | grep -A 3 -E 'Failure|exception|FAILED|signal' | head -n 40
      failed=1
    fi
  done
done
if [ "$ran" -eq 0 ]; then
  echo "no other instruction set was tried"
  failed=1
fi
exit $failed
