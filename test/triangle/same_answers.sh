#!/bin/sh
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# The triangle kernels give bitwise the same answers however they are compiled, and whatever the
# machine: a hash of the answers is written down in same_answers.txt. With --write it is written
# anew, which needs a reason in the changelog.
#   same_answers.sh [--write] <compiler> <clang++ or nothing> <source dir> <build dir>
#     <Eigen's directories> [<sysroot> <what runs programs of another machine>]
set -eu
written=$(dirname "$0")/same_answers.txt
write=
if [ "$1" = --write ]; then
  write=1
  shift
fi
compiler=$1
clang=$2
source_dir=$3
work=$4/same_answers
eigen=$5
sysroot=${6-}
shift "$(($# < 6 ? $# : 6))"
mkdir -p "$work"
flags="-std=c++17 -ffp-contract=off -I$source_dir/include -I$source_dir/src -I$source_dir/benchmarks"
for directory in $(echo "$eigen" | tr ';' ' '); do
  flags="$flags -isystem $directory"
done
if [ -n "$sysroot" ]; then flags="$flags --sysroot=$sysroot"; fi
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
if [ -z "$write" ]; then expected=$(cat "$written"); fi
emulator=$*
compare() {
  if ! "$@" $flags $sources "$source_dir"/src/triangle/*.cpp $objects -o "$work/program"; then
    echo "cannot build with: $*"
    exit 1
  fi
  answer=$($emulator "$work/program")
  echo "$answer  $*"
  if [ "${expected:=$answer}" != "$answer" ]; then
    echo "the answers differ from $expected"
    exit 1
  fi
}
compare "$compiler" -O0
compare "$compiler" -O2
compare "$compiler" -O3
if "$compiler" -dumpmachine | grep -q ^x86_64 && grep -qs avx2 /proc/cpuinfo; then
  compare "$compiler" -O2 -mavx2 -mfma
fi
if [ -n "$clang" ] && command -v "$clang" > /dev/null; then
  compare "$clang" -O2
fi
if [ -n "$write" ]; then echo "$expected" > "$written"; fi
