#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: symbols.sh INTERPOSER IMPLEMENTATION PROGRAM
# The interposer defines what libfcl defines under these names, and nothing else; among it all that
# the program imports of FCL's four queries and of its fits. It needs no library but C's. The
# implementation exports its entry alone.
set -euo pipefail

interposer=$1 implementation=$2 program=$3
status=0
fault() {
  echo "$*"
  status=1
}
exports() { nm -D --defined-only "$1" | awk '{ print $NF }'; }
libfcl=$(ldd "$program" | awk '/libfcl\.so\.0\.7/ { print $3 }')

mapfile -t defined < <(exports "$interposer")
((${#defined[@]} == 20)) || fault "the interposer defines ${#defined[@]} symbols"
declare -A in_libfcl=() counted=()
while read -r symbol; do in_libfcl[$symbol]=1; done < <(exports "$libfcl")
for symbol in "${defined[@]}"; do
  counted[$symbol]=1
  [[ -n ${in_libfcl[$symbol]:-} ]] || fault "not in libfcl: $(c++filt "$symbol")"
done
while read -r symbol; do
  [[ -n ${counted[$symbol]:-} ]] || fault "not counted: $(c++filt "$symbol")"
done < <(nm -D --undefined-only "$program" | awk '{ print $NF }' |
  grep -E '^_ZN3fcl(13getCovarianceId|6detail[0-9]+[A-Za-z]+_fit_functions4fit[36n]Id|6detail6FitterId|17CollisionGeometryIdED)')
[[ $(exports "$implementation") == fcl_kios_preload_open ]] || fault "the implementation exports: $(exports "$implementation")"
if readelf -dW "$interposer" | grep NEEDED | grep -vE 'lib(c|dl|pthread)\.so|ld-linux'; then
  fault "the interposer needs these libraries"
fi
if nm -DC --undefined-only "$interposer" | grep -E 'fcl|kios|std::'; then
  fault "the interposer asks for these symbols"
fi
exit "$status"
