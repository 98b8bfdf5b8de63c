#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: build.sh SOURCE_DIR BUILD_DIR CMAKE CXX CXXFLAGS CONFIG LAUNCHER JOBS
# Installs the build and builds the examples against it, in BUILD_DIR/examples.
set -euo pipefail

source_dir=$1 build_dir=$2 cmake=$3 cxx=$4 flags=$5 config=$6 launcher=$7 jobs=$8
work=$build_dir/examples

rm -rf "$work/prefix"
"$cmake" --install "$build_dir" --config "$config" --prefix "$work/prefix" >/dev/null
"$cmake" -S "$source_dir/examples" -B "$work" -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" \
  -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_BUILD_TYPE=Release
"$cmake" --build "$work" -j "$jobs"
