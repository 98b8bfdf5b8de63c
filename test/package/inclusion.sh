#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: inclusion.sh CXX SOURCE_DIR BUILD_DIR EIGEN_DIRS
# Whichever headers a file includes and in whichever order, FCL's templates over our volume mean one
# thing: our code, or the file doesn't compile. Otherwise files of one program would disagree.
set -euo pipefail

cxx=$1 source_dir=$2 build_dir=$3
flags=(-std=c++17 -O1 "-I$source_dir/include" "-I$build_dir/include")
IFS=';' read -ra eigen <<<"$4"
for directory in "${eigen[@]}"; do flags+=(-isystem "$directory"); done
work=$build_dir/inclusion
mkdir -p "$work"
compile() { # FLAGS...
  "$cxx" "${flags[@]}" "$@" -c "$source_dir/test/package/inclusion.cpp" -o "$work/object.o"
}
fail() {
  echo "$*"
  exit 1
}

uses=(FITTER SPLITTER FIT AABB OBB ORIENTATION PARENT_RELATIVE MOTION)
for order in -DFCL_FIRST -DKIOS_FIRST; do
  compile "$order" -DUSE_MEMBERS
  generic=$(nm -C --defined-only "$work/object.o" | grep '[A-Z] fcl::BVHModel<kios::' || true)
  [[ -z $generic ]] || fail "FCL's code for our volume with $order: $generic"
  nm -uC "$work/object.o" | grep 'fcl::BVHModel<kios::kIOS<double> >::beginModel' >/dev/null ||
    fail "the file doesn't ask for our beginModel()"
  compile "$order" -DKIOS_MODEL -DUSE_MEMBERS "${uses[@]/#/-DUSE_}"
done
for use in "${uses[@]}"; do
  if compile "-DUSE_$use" 2>"$work/errors"; then fail "$use compiles without our header"; fi
  grep -qE 'incomplete|undefined template' "$work/errors" || fail "$use: $(<"$work/errors")"
done
echo "members are ours; ${#uses[@]} uses compile with our headers only"
