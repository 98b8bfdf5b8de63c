#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: short.sh INTERPOSER WORK_FILE PROGRAM
# A program takes at no moment of its life much longer with the library preloaded: 1.3 times as
# long, the same again for the machine's noise, and a few milliseconds once for opening it. In the
# end it has gained. Least CPU times of several runs by turns.
set -euo pipefail

interposer=$1 work=$2 program=$3
arguments=(4 100 2048)
: >"$work.plain"
: >"$work.preloaded"
for _ in 1 2 3; do
  "$program" "${arguments[@]}" >>"$work.plain"
  FCL_KIOS_PRELOAD=on LD_PRELOAD=$interposer "$program" "${arguments[@]}" >>"$work.preloaded"
done
least() { sort -k1,1n -k2,2n "$1" | awk '$1 != last { print; last = $1 }'; }
join <(least "$work.plain" | sort) <(least "$work.preloaded" | sort) | sort -n | awk '
  { printf "%d queries: %d us, preloaded %d us (%.2f)\n", $1, $2, $3, $3 / $2; ratio = $3 / $2 }
  $3 > 1.6 * $2 + 10000 { print "it takes too long"; failed = 1 }
  END {
    if (!(ratio < 0.9)) { print "nothing is gained"; failed = 1 }
    exit failed
  }'
rm -f "$work.plain" "$work.preloaded"
