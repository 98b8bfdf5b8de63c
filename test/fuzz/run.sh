#!/bin/sh
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Builds the fuzz target with clang++ and runs it. The corpus stays in the build directory, so that
# every run goes on where the last one ended. Exit code 77: clang++ has no libFuzzer here.
#   run.sh <clang++> <source dir> <build dir> <seconds> <Eigen's include directories>
set -eu
clang=$1
source_dir=$2
work=$3/fuzz
seconds=$4
eigen=$5
flags="-std=c++17 -O2 -g -ffp-contract=off"
checks="-fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined"
ignored=$source_dir/test/fuzz/uninstrumented.txt
checks="$checks -fsanitize-ignorelist=$ignored -fsanitize-coverage-ignorelist=$ignored"
mkdir -p "$work/corpus"

echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' \
  > "$work/probe.cpp"
if ! "$clang" $flags $checks "$work/probe.cpp" -o "$work/probe" 2> "$work/probe.log"; then
  echo "skipped: '$clang' cannot link -fsanitize=fuzzer (install libFuzzer, in compiler-rt)"
  exit 77
fi

for directory in $(echo "$eigen" | tr ';' ' '); do
  flags="$flags -isystem $directory"
done
flags="$flags -I$source_dir/include -I$source_dir/src -I$source_dir/test -I$source_dir/benchmarks"

# The oracle is not what is tested: without checks it is ten times as fast.
for file in rational_oracle triangle_pair; do
  "$clang" $flags -c "$source_dir/benchmarks/scenes/$file.cpp" -o "$work/$file.o"
done
"$clang" $flags $checks "$source_dir"/src/triangle/*.cpp "$source_dir/test/fuzz/triangle_fuzz.cpp" \
  "$work/rational_oracle.o" "$work/triangle_pair.o" -o "$work/triangle_fuzz"

# Any bytes are two triangles; the first inputs only need the length.
if [ -z "$(ls "$work/corpus")" ]; then
  split -b 96 "$source_dir/test/fuzz/triangle_fuzz.cpp" "$work/corpus/seed"
fi
export ASAN_OPTIONS=malloc_context_size=0:quarantine_size_mb=1
exec "$work/triangle_fuzz" -max_total_time="$seconds" -max_len=192 -len_control=0 -verbosity=0 \
  -print_final_stats=1 -error_exitcode=1 -timeout_exitcode=1 -artifact_prefix="$work/" "$work/corpus"
