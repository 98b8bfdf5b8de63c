#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: flags.sh SOURCE_DIR PREFIX WORK_DIR CXX CXXFLAGS
# Consumers of the package in PREFIX with flags that widen Eigen's alignment, or take it away: a file
# that would misread FCL's structs is refused in words, and no type of ours depends on it.
set -euo pipefail

source_dir=$1 prefix=$2 work=$3 cxx=$4
read -ra flags <<<"$5"
here=$source_dir/test/consumer
pc_file=$(find "$prefix" -name fcl_kios.pc -print -quit)
export PKG_CONFIG_PATH=${pc_file%/*}${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}
read -ra cflags <<<"$(pkg-config --cflags fcl_kios)"
read -ra libs <<<"$(pkg-config --libs fcl_kios)"
fail() {
  echo "$*"
  exit 1
}
compile() { "$cxx" -std=c++17 -O1 "${flags[@]}" "${cflags[@]}" "$@"; }

# Every struct and class of ours is printed, but for those of FCL's, with FCL's own members.
mapfile -t types < <(sed -nE 's/^(struct|class) (\w+)[^;<]*\{$/\2/p' \
  "$source_dir"/include/fcl_kios/*/*.h | sort -u)
((${#types[@]} > 25)) || fail "only ${#types[@]} types were found: ${types[*]}"
for type in "${types[@]}"; do
  case $type in
    # FCL's templates for our volume, and nodes that derive from FCL's.
    BVFitter | BVSplitter | ConvertBVImpl | Fitter | GetOrientationImpl | *TraversalNode) ;;
    MakeParentRelativeRecurseImpl | TBVMotionBoundVisitorVisitImpl) ;;
    *) grep -qw "$type" "$here/flags.cpp" || fail "flags.cpp doesn't print $type" ;;
  esac
done

echo "== the package's own flags"
compile "$here/flags.cpp" "${libs[@]}" -o "$work/flags"
"$work/flags" >"$work/flags.expected"
"$work/flags" layout >"$work/layout.expected"

# refused WORDS FLAGS...: the first header says so.
refused() {
  local said status=0
  said=$(compile -fsyntax-only -Wfatal-errors "${@:2}" "$here/flags.cpp" 2>&1) || status=$?
  ((status != 0)) || fail "not refused: ${*:2}"
  grep -q "fcl_kios.*$1" <<<"$said" || fail "${*:2}: $said"
}
refused 'C++17' -std=c++14
refused 'C++17' -std=c++14 -include fcl_kios/overloads.h
refused 'EIGEN_DONT_ALIGN' -DEIGEN_DONT_ALIGN
compile -DFCL_KIOS_ANY_ALIGNMENT -DEIGEN_DONT_ALIGN "$here/flags.cpp" "${libs[@]}" -o "$work/flags"
"$work/flags" layout | diff "$work/layout.expected" - || fail "EIGEN_DONT_ALIGN changes our types"

for option in -mavx -march=native; do
  aligned=$("$cxx" "$option" "${flags[@]}" -dM -E -x c++ - </dev/null 2>/dev/null) || continue
  grep -q __AVX__ <<<"$aligned" || continue # Eigen aligns as ever
  echo "== $option"
  refused 'libfcl aligns' "$option"
  refused 'libfcl aligns' "$option" -include fcl_kios/overloads.h
  refused 'EIGEN_MALLOC_ALREADY_ALIGNED' "$option" -DEIGEN_MAX_ALIGN_BYTES=16
  for kept in -DFCL_KIOS_ANY_ALIGNMENT \
    '-DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MALLOC_ALREADY_ALIGNED=1'; do
    read -ra definitions <<<"$kept"
    compile "$option" -ffp-contract=off "${definitions[@]}" "$here/flags.cpp" "${libs[@]}" \
      -o "$work/flags"
    run=layout expected=$work/layout.expected
    if grep -qsw avx /proc/cpuinfo; then run=all expected=$work/flags.expected; fi
    "$work/flags" $run | diff "$expected" - || fail "$option $kept: other types or answers"
  done
done
