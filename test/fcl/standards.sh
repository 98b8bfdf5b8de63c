#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: standards.sh CXX SOURCE_DIR BUILD_DIR LIBRARY FCL_TABLES EIGEN_DIRS CXXFLAGS
# Queries reach kIOS, and FCL where they should, as C++17, 20 and 23, with and without the forced
# include; with it, FCL's headers are read after ours, and symbols are hidden.
# FCL's tables for float come from FCL_TABLES, but for one that compiles them itself, as users do.
set -euo pipefail

cxx=$1 source_dir=$2 build_dir=$3 library=$4 tables=$5
work=$build_dir/standards
mkdir -p "$work"
compiler=("$cxx")
if command -v ccache >/dev/null; then compiler=(ccache "$cxx"); fi
flags=(-O0 -Wall -Wextra "-I$source_dir/test" "-I$source_dir/include" "-I$build_dir/include")
IFS=';' read -ra eigen <<<"$6"
read -ra more <<<"$7"
for directory in "${eigen[@]}"; do flags+=(-isystem "$directory"); done
flags+=("${more[@]}")

check() { # NAME FLAGS...
  local name=$1
  shift
  "${compiler[@]}" "${flags[@]}" "$@" -c "$source_dir/test/fcl/standards.cpp" -o "$work/$name.o"
  "$cxx" "${more[@]}" "$work/$name.o" "$tables" "$library" -lfcl -lccd -loctomap -loctomath -o "$work/$name" \
    "-Wl,-rpath,${library%/*}"
  echo "== $name"
  "$work/$name"
}

status=0
for standard in 17 20 23; do
  flag=-std=c++$standard
  if ! "$cxx" "$flag" -fsyntax-only -x c++ /dev/null 2>/dev/null; then flag=-std=c++2b; fi
  check "plain$standard" "$flag" || status=1
  check "forced$standard" "$flag" -fvisibility=hidden -include fcl_kios/overloads.h || status=1
done
check own_tables -std=c++17 -DOWN_FLOAT_TABLES || status=1
exit "$status"
