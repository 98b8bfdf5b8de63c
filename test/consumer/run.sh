#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: run.sh SOURCE_DIR BUILD_DIR CMAKE CXX CXXFLAGS CONFIG
# Installs the build, moves the installed tree and uses it as others would.
set -euo pipefail

source_dir=$1 build_dir=$2 cmake=$3 cxx=$4 flags=$5 config=$6
work=$build_dir/consumer
prefix=$work/prefix

rm -rf "$work"
mkdir -p "$work"
"$cmake" --install "$build_dir" --config "$config" --prefix "$work/first" >/dev/null
mv "$work/first" "$prefix"
if grep -rIlF -e "$source_dir" -e "$build_dir" "$prefix"; then
  echo "these installed files name the source or build directory"
  exit 1
fi
"$source_dir/test/consumer/use.sh" "$source_dir" "$prefix" "$work" "$cmake" "$cxx" "$flags"
