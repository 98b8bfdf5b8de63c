#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: flags.sh SOURCE_DIR PREFIX WORK_DIR CXX CXXFLAGS
# Consumers of the package in PREFIX with flags that widen Eigen's alignment, take it away, or
# change how Eigen allocates, as sanitizers do: a file that would misread FCL's structs is refused
# in words, no type of ours depends on it, and answers that own memory are freed as allocated.
set -euo pipefail

source_dir=$1 prefix=$2 work=$3 cxx=$4
read -ra flags <<<"$5"
here=$source_dir/test/consumer
pc_file=$(find "$prefix" -name fcl_kios.pc -print -quit)
export PKG_CONFIG_PATH=${pc_file%/*}${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}
read -ra cflags <<<"$(pkg-config --cflags fcl_kios)"
read -ra libs <<<"$(pkg-config --libs fcl_kios_clearance)"
fail() {
  echo "$*"
  exit 1
}
compile() { "$cxx" -std=c++17 -O1 "-I$work" "${flags[@]}" "${cflags[@]}" "$@"; }

headers=("$source_dir"/include/fcl_kios/*.h "$source_dir"/include/fcl_kios/detail/*.h)
if [[ -f $(pkg-config --variable=includedir fcl_kios)/fcl_kios/robot/robot.h ]]; then
  headers+=("$source_dir"/addons/robot/include/fcl_kios/robot/*.h)
  libs=(-lfcl_kios_robot "${libs[@]}")
fi
# Every struct and class of ours is printed: heads with < are specialisations of FCL's.
awk '/^template <typename S_?>$/ { both = "_BOTH"; next }
  /^(struct|class) [^;<]*\{$/ { print "PRINT" both "(" $2 ");" }
  { both = "" }' "${headers[@]}" >"$work/types.inc"
(($(wc -l <"$work/types.inc") > 35)) || fail "few types were found: $(<"$work/types.inc")"

# No member is of an Eigen type whose alignment or allocation depends on flags: UnalignedPose and
# UnalignedVector are there instead.
aligned='(Eigen::(Vector([24X]|Xd)|RowVector|Matrix[24X]|Array|Quaternion|Isometry|Affine)\w*'
aligned+='|fcl::(Transform3|Quaternion)(d|f|<S>))[[:space:]]+[a-zA-Z_]+( =[^()]*|\{.*)?;'
if grep -nE "^[[:space:]]+(mutable )?$aligned" "${headers[@]}"; then
  fail "these members depend on the flags of the file that includes them"
fi

cat >"$work/r.urdf" <<'END'
<robot name='r'>
  <link name='base'><collision><geometry><box size='1 1 0.5'/></geometry></collision></link>
  <link name='arm'><collision><origin xyz='0.75 0 0'/>
    <geometry><box size='1 0.25 0.25'/></geometry></collision></link>
  <link name='hand'><collision><geometry><sphere radius='0.25'/></geometry></collision></link>
  <joint name='j' type='revolute'><parent link='base'/><child link='arm'/><axis xyz='0 0 1'/>
    <origin xyz='0 0 0.5'/><limit lower='-3' upper='3'/></joint>
  <joint name='k' type='revolute'><parent link='arm'/><child link='hand'/><axis xyz='0 1 0'/>
    <origin xyz='1.5 0 0'/><limit lower='-1' upper='1'/></joint>
</robot>
END
cat >"$work/r.srdf" <<'END'
<robot name='r'><group_state name='bent' group='all'>
  <joint name='j' value='0.5'/><joint name='k' value='-0.25'/></group_state>
  <disable_collisions link1='base' link2='arm'/><disable_collisions link1='arm' link2='hand'/>
</robot>
END
robot=("$work/r.urdf" "$work/r.srdf")

echo "== the package's own flags"
compile "$here/flags.cpp" "${libs[@]}" -o "$work/flags"
"$work/flags" "${robot[@]}" >"$work/flags.expected"
"$work/flags" >"$work/layout.expected"

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
"$work/flags" | diff "$work/layout.expected" - || fail "EIGEN_DONT_ALIGN changes our types"

# The library has no sanitizer, and Eigen's inline code in the consumer allocates otherwise.
if "$cxx" -fsanitize=address -x c++ - -o "$work/sanitized" <<<'int main() {}' 2>/dev/null; then
  echo "== -fsanitize=address"
  compile -g1 -fsanitize=address,undefined -fno-sanitize-recover=all "$here/flags.cpp" \
    "${libs[@]}" -o "$work/sanitized"
  "$work/sanitized" "${robot[@]}" | diff "$work/flags.expected" - ||
    fail "a consumer with sanitizers stops, or gets other answers"
else
  echo "-fsanitize=address is left out: $cxx can't link it"
fi

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
    run=() expected=$work/layout.expected
    if grep -qsw avx /proc/cpuinfo; then run=("${robot[@]}") expected=$work/flags.expected; fi
    "$work/flags" "${run[@]}" | diff "$expected" - || fail "$option $kept: other types or answers"
  done
done
