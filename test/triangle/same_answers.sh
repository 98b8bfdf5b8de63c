#!/bin/sh
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# The triangle kernels give bitwise the same answers however they are compiled.
#   same_answers.sh <compiler> <clang++ or nothing> <source dir> <build dir> <Eigen's directories>
set -eu
compiler=$1
clang=$2
source_dir=$3
work=$4/same_answers
eigen=$5
mkdir -p "$work"
flags="-std=c++17 -ffp-contract=off -I$source_dir/include -I$source_dir/src -I$source_dir/benchmarks"
for directory in $(echo "$eigen" | tr ';' ' '); do
  flags="$flags -isystem $directory"
done
sources="$source_dir/test/triangle/same_answers.cpp"
scenes="triangle_classes triangle_pair coplanar_triangles degenerate_triangles scaled_triangles
  separated_triangles touching_triangles"

# The pairs themselves come from one build: only the kernels vary.
objects=
for scene in $scenes; do
  "$compiler" $flags -O1 -c "$source_dir/benchmarks/scenes/$scene.cpp" -o "$work/$scene.o"
  objects="$objects $work/$scene.o"
done

expected=
compare() {
  if ! "$@" $flags $sources "$source_dir"/src/triangle/*.cpp $objects -o "$work/program"; then
    echo "cannot build with: $*"
    exit 1
  fi
  answer=$("$work/program")
  echo "$answer  $*"
  if [ "${expected:=$answer}" != "$answer" ]; then
    echo "the answers differ"
    exit 1
  fi
}
compare "$compiler" -O0
compare "$compiler" -O2
compare "$compiler" -O3
if [ "$(uname -m)" = x86_64 ] && grep -qs avx2 /proc/cpuinfo; then
  compare "$compiler" -O2 -mavx2 -mfma
fi
if [ -n "$clang" ] && command -v "$clang" > /dev/null; then
  compare "$clang" -O2
fi
