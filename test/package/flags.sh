#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: flags.sh SOURCE_DIR BUILD_DIR CMAKE CXX
# Whatever flags a packager sets, our files are compiled without fused multiplications, which would
# break the error-free sums and products behind bounds and predicates; flags that give up IEEE
# arithmetic are refused.
set -euo pipefail

source_dir=$1 work=$2/flags_check cmake=$3 cxx=$4
configure() {
  rm -rf "$work"
  "$cmake" -S "$source_dir" -B "$work" -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_BUILD_TYPE=Release \
    -DFCL_KIOS_BUILD_TESTS=OFF -DFCL_KIOS_BUILD_BENCHMARKS=OFF -DFCL_KIOS_BUILD_EXAMPLES=OFF \
    "$@" >"$work.log" 2>&1
}

configure -DCMAKE_CXX_FLAGS=-ffp-contract=fast
total=$(grep -c '"command":' "$work/compile_commands.json")
off=$(grep '"command":' "$work/compile_commands.json" |
  grep -c -- '-ffp-contract=fast.* -ffp-contract=off ' || true)
echo "-ffp-contract=off comes last for $off of $total files"
((total > 50 && off == total)) || exit 1

for flag in -Ofast -ffast-math -funsafe-math-optimizations; do
  for variable in CMAKE_CXX_FLAGS CMAKE_CXX_FLAGS_RELEASE; do
    if configure "-D$variable=$flag" || ! grep -q "IEEE" "$work.log"; then
      echo "$flag in $variable is not refused"
      exit 1
    fi
  done
done
rm -rf "$work"
