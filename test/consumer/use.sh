#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: use.sh SOURCE_DIR PREFIX WORK_DIR CMAKE CXX CXXFLAGS
# Builds and runs the consumer against the package installed in PREFIX, shared or static: by
# find_package, with assertions, and by pkg-config with a plain compiler call, without them and with
# multiplications fused where the machine can.
set -euo pipefail

source_dir=$1 prefix=$2 work=$3 cmake=$4 cxx=$5
read -ra flags <<<"$6"
here=$source_dir/test/consumer
version=$(<"$source_dir/VERSION")
fail() {
  echo "$*"
  exit 1
}

library=$(find "$prefix" \( -name libfcl_kios.so -o -name libfcl_kios.a \) -print -quit)
pc_file=$(find "$prefix" -name fcl_kios.pc -print -quit)
[[ -n $library && -n $pc_file ]] || fail "no library or no fcl_kios.pc in $prefix"
if [[ $prefix != /usr ]]; then
  export LD_LIBRARY_PATH=${library%/*}${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
  export PKG_CONFIG_PATH=${pc_file%/*}${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}
fi
[[ -f $prefix/share/ament_index/resource_index/packages/fcl_kios ]] || fail "no ament marker"
[[ -f $prefix/share/fcl_kios/package.xml ]] || fail "no package.xml"
mkdir -p "$work/plain"

echo "== find_package, ${library##*/}"
"$cmake" -S "$here" -B "$work/cmake" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_CXX_FLAGS="${flags[*]}" -DCMAKE_BUILD_TYPE=Debug -DEXPECTED_VERSION="$version" >/dev/null
found=$(sed -n 's/^fcl_kios_DIR:PATH=//p' "$work/cmake/CMakeCache.txt")
[[ $found == "$prefix"/* ]] || fail "find_package found $found, not $prefix"
"$cmake" --build "$work/cmake"
"$work/cmake/consumer"
"$work/cmake/clearance_consumer"
"$work/cmake/paper_consumer"

# without COMPONENT WORDS: asked for by find_package, it is refused with these words. The view of
# the package lacks the addon robot.
if [[ $prefix != /usr ]]; then
  echo "== components that aren't there"
  cp -rs "$prefix" "$work/less"
  find "$work/less" -name 'fcl_kiosRobotTargets*' -delete
  mkdir "$work/component"
  cat >"$work/component/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.22...3.31)
project(component LANGUAGES CXX)
find_package(fcl_kios REQUIRED COMPONENTS ${COMPONENT})
END
  without() {
    local said
    said=$("$cmake" -S "$work/component" -B "$work/component/$1" -DCOMPONENT="$1" \
      -DCMAKE_PREFIX_PATH="$work/less" -DCMAKE_CXX_COMPILER="$cxx" 2>&1) && fail "$1 was found"
    [[ $(tr -s '\n ' '  ' <<<"$said") == *"$2"* ]] || fail "$1: $said"
  }
  without robot 'cmake --preset full'
  without robots 'there are clearance, paper and robot'
fi

echo "== pkg-config"
static=()
if [[ $library == *.a ]]; then static=(--static); fi
[[ $(pkg-config --modversion fcl_kios) == "$version" ]] || fail "fcl_kios.pc has another version"
package=(-std=c++17 -O1 -DNDEBUG -ffp-contract=fast "${flags[@]}")
read -ra package_cflags <<<"$(pkg-config --cflags fcl_kios)"
read -ra package_libs <<<"$(pkg-config "${static[@]}" --libs fcl_kios)"
read -ra force_include <<<"$(pkg-config --variable=force_include fcl_kios)"
if [[ " ${package_cflags[*]}" == *" -std="* ]]; then
  fail "fcl_kios.pc sets the language standard: ${package_cflags[*]}"
fi
"$cxx" "${package[@]}" "${package_cflags[@]}" "${force_include[@]}" -c "$here/generic.cpp" \
  -o "$work/plain/generic.o"
"$cxx" "${package[@]}" "$here/main.cpp" "$work/plain/generic.o" "${package_cflags[@]}" \
  "${package_libs[@]}" -o "$work/plain/consumer"
"$work/plain/consumer"
if [[ " ${package_libs[*]} " == *" -lfcl_kios_"* ]]; then
  fail "fcl_kios.pc links an addon: ${package_libs[*]}"
fi
for addon in clearance paper; do
  read -ra addon_libs <<<"$(pkg-config "${static[@]}" --libs "fcl_kios_$addon")"
  "$cxx" "${package[@]}" "$here/$addon.cpp" "${package_cflags[@]}" "${addon_libs[@]}" \
    -o "$work/plain/${addon}_consumer"
  "$work/plain/${addon}_consumer"
done

if [[ $library == *.so && ! ${flags[*]} =~ -fsanitize|-march|-mavx ]]; then
  "$here/flags.sh" "$source_dir" "$prefix" "$work/plain" "$cxx" "${flags[*]}"
fi
