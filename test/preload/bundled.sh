#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: bundled.sh INTERPOSER WORK_DIR HOST PLUGIN TWO_FCLS OWN_FCL USES_LIBFCL LIBFCL
# The program as a plug-in that brings libfcl into a process, for itself alone: its queries are
# answered nevertheless. So are they if its libfcl is a copy under another name, as tools make it
# that bundle libraries into a package. What only bears such a name isn't, and is left as it is.
set -euo pipefail

interposer=$1 work=$2 host=$3 plugin=$4 two_fcls=$5 own_fcl=$6 uses_libfcl=$7 libfcl=$8
rm -rf "$work"
mkdir -p "$work"

# ask MODE PLUGIN: its answers compared with those without us; what is said lies in log.
parts=(obbrss reuse threads)
ask() {
  FCL_KIOS_PRELOAD=$1 LD_PRELOAD=$interposer \
    "$host" "$2" check "$work/answers" "${parts[@]}" >/dev/null 2>"$work/log" || {
    echo "$2, $1:"
    cat "$work/log"
    exit 1
  }
}
expect() {
  grep -qE "$1" "$work/log" && return
  echo "not '$1' in:"
  cat "$work/log"
  exit 1
}
answers() {
  "$host" "$1" write "$work/answers" "${parts[@]}"
  for mode in off on trust stats verify; do ask "$mode" "$1"; done
  expect 'distance: [0-9]{3,} by k-IOS, .* 0 differences'
}

answers "$plugin"
if ! command -v patchelf >/dev/null; then
  echo "bundled: patchelf isn't there, by which such copies are made (Debian: patchelf)"
  exit 77
fi

# bundle NAME: the plug-in, its libfcl a copy of that name.
bundle() {
  mkdir -p "$work/$1"
  cp -L "$libfcl" "$work/$1/$1"
  cp "$plugin" "$work/$1/plugin.so"
  chmod u+w "$work/$1"/*
  patchelf --set-soname "$1" "$work/$1/$1"
  patchelf --set-rpath "\$ORIGIN" "$work/$1/plugin.so"
  patchelf --replace-needed libfcl.so.0.7 "$1" "$work/$1/plugin.so"
  if readelf -d "$work/$1/plugin.so" | grep -F '[libfcl.so.0.7]' >/dev/null; then
    echo "$1: patchelf failed"
    exit 1
  fi
}

copy=libfcl-1a2b3c4d.so.0.7.0
bundle "$copy"
answers "$work/$copy/plugin.so"

for other in libmyfcl.so.0.7 libfcl-1a2b3c4d.so.0.6 libfcl-hashes.so.0.7 libfcl-12.so.0.7; do
  bundle "$other"
  ask stats "$work/$other/plugin.so"
  if grep -qE '[1-9][0-9]* by k-IOS' "$work/log"; then
    echo "$other is answered:"
    cat "$work/log"
    exit 1
  fi
done

# Other functions under such a name: they are found to be no libfcl, and called all the same.
false=$work/libfcl-0badf00d.so.0.7
cp "$own_fcl" "$false"
chmod u+w "$false"
patchelf --set-soname "${false##*/}" "$false"
FCL_KIOS_PRELOAD=stats LD_PRELOAD=$interposer "$two_fcls" "$false" 2>"$work/log" || {
  cat "$work/log"
  exit 1
}
expect 'nothing is done: .*libfcl-0badf00d.so.0.7 is no copy .* differ in virtual functions'

# Beside libfcl itself, whichever is asked first.
for order in "$false $uses_libfcl" "$uses_libfcl $false"; do
  read -ra plugins <<<"$order"
  FCL_KIOS_PRELOAD=on LD_PRELOAD=$interposer "$two_fcls" "${plugins[@]}" 2>"$work/log" || {
    cat "$work/log"
    exit 1
  }
done
rm -rf "$work"
echo "bundled: answered"
