#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: reach.sh INTERPOSER PROGRAM STATIC_PROGRAM
# Where the library can't answer it says so in one line, and leaves the program as it is.
set -euo pipefail

interposer=$1 program=$2 static=$3

# says MODE WANTED COMMAND...: the lines on stderr are one that has these words, or none.
says() {
  local mode=$1 wanted=$2 said status=0
  shift 2
  said=$(FCL_KIOS_PRELOAD=$mode LD_PRELOAD=$interposer "$@" 2>&1 >/dev/null) || status=$?
  if ((status != 0)); then
    echo "$* ended with $status: $said"
    exit 1
  fi
  if [[ -z $wanted && -n $said ]] || [[ $said != *"$wanted"* || $said == *$'\n'* ]]; then
    echo "$*, FCL_KIOS_PRELOAD=$mode: '$said', not '$wanted'"
    exit 1
  fi
}

says on '' /bin/true
says stats "libfcl.so.0.7 isn't loaded yet" /bin/true
says off '' /bin/true
says sometimes '"sometimes", but must be off, on, trust, verify or stats: nothing is done.' /bin/true
says on 'before this library (FCL is linked statically?)' "$static"
says off '' "$static"
says on '' "$program" write /dev/null none
FCL_KIOS_PRELOAD_MIB=lots says on '"lots", but must be a number of MiB' "$program" write /dev/null \
  threads
says fast '"fast", but must be' "$program" write /dev/null none

# Another FCL: the same functions from a library of another name.
other=$(mktemp -d)
trap 'rm -rf "$other"' EXIT
cp "$interposer" "$other/libanother.so"
said=$(FCL_KIOS_PRELOAD=on LD_PRELOAD="$interposer $other/libanother.so" /bin/true 2>&1) || true
if ! grep -q 'libanother.so, and this library stands in for libfcl.so.0.7 only' <<<"$said"; then
  echo "another FCL: '$said'"
  exit 1
fi

# The library without its other half: FCL's answers, and a line that says why.
cp "$interposer" "$other/libalone.so"
says_alone=$(LD_PRELOAD="$other/libalone.so" "$program" write /dev/null threads 2>&1 >/dev/null) || true
if [[ $(grep -c . <<<"$says_alone") != 1 || $says_alone != *"nothing is done: "*preload_implementation* ]]; then
  echo "without its other half: '$says_alone'"
  exit 1
fi
echo "reach: right"
