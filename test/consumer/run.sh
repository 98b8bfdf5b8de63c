#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: run.sh SOURCE_DIR BUILD_DIR CMAKE CXX CXXFLAGS CONFIG
# Installs the build, moves the installed tree, then builds and runs the consumer against it, by
# find_package and by pkg-config with a plain compiler call.
set -euo pipefail

source_dir=$1 build_dir=$2 cmake=$3 cxx=$4 config=$6
read -ra flags <<<"$5"
here=$source_dir/test/consumer
work=$build_dir/consumer
prefix=$work/prefix

rm -rf "$work"
mkdir -p "$work/plain"
"$cmake" --install "$build_dir" --config "$config" --prefix "$work/first" >/dev/null
mv "$work/first" "$prefix"
if grep -rIlF -e "$source_dir" -e "$build_dir" "$prefix"; then
  echo "these installed files name the source or build directory"
  exit 1
fi
library=$(find "$prefix" -name 'libfcl_kios.*' -print -quit)
pc_file=$(find "$prefix" -name fcl_kios.pc -print -quit)
export LD_LIBRARY_PATH=${library%/*}${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export PKG_CONFIG_PATH=${pc_file%/*}${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}

echo "== find_package"
"$cmake" -S "$here" -B "$work/cmake" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_CXX_FLAGS="${flags[*]}" -DCMAKE_BUILD_TYPE=Debug >/dev/null
"$cmake" --build "$work/cmake"
"$work/cmake/consumer"

echo "== pkg-config"
package=(-std=c++17 "${flags[@]}")
read -ra package_cflags <<<"$(pkg-config --cflags fcl_kios)"
read -ra package_libs <<<"$(pkg-config --libs fcl_kios)"
read -ra force_include <<<"$(pkg-config --variable=force_include fcl_kios)"
if [[ " ${package_cflags[*]}" == *" -std="* ]]; then
  echo "fcl_kios.pc sets the language standard: ${package_cflags[*]}"
  exit 1
fi
"$cxx" "${package[@]}" "${package_cflags[@]}" "${force_include[@]}" -c "$here/generic.cpp" \
  -o "$work/plain/generic.o"
"$cxx" "${package[@]}" "$here/main.cpp" "$work/plain/generic.o" "${package_cflags[@]}" \
  "${package_libs[@]}" -o "$work/plain/consumer"
"$work/plain/consumer"
