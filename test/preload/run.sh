#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: run.sh INTERPOSER WORK_FILE PROGRAM
# The program writes FCL's answers, and compares those that it gets with the library preloaded, in
# each mode. Copies must have answered a good part, or nothing was tested.
set -euo pipefail

interposer=$1 answers=$2.answers log=$2.log program=$3
fail() {
  echo "$*"
  cat "$log"
  exit 1
}
# preloaded MODE ARGUMENTS: what the program writes on stderr goes to the log.
preloaded() {
  FCL_KIOS_PRELOAD=$1 LD_PRELOAD=$interposer "$program" "${@:2}" 2>"$log"
}
# count WORDS QUESTION: of the report's line about collide or distance.
count() { sed -nE "s/^fcl_kios_preload: $2: .*[^0-9]?\b([0-9]+) $1.*/\1/p" "$log"; }
# at_least N WORDS QUESTION
at_least() {
  local found
  found=$(count "$2" "$3")
  ((${found:-0} >= $1)) || fail "$3: ${found:-no} $2, not $1"
}

"$program" write "$answers" 2>"$log" || fail "the program without the library"
for mode in off on; do
  echo "== $mode"
  preloaded "$mode" check "$answers" || fail "other answers in mode $mode"
done

echo "== stats"
preloaded stats check "$answers" || fail "other answers in mode stats"
grep 'fcl_kios_preload: [cd]' "$log"
at_least 1000 'by k-IOS' collide
at_least 2000 'by k-IOS' distance

echo "== stats, 1 MiB for copies"
FCL_KIOS_PRELOAD_MIB=1 preloaded stats check "$answers" || fail "other answers with little memory"
grep -E 'copies of (0\.[0-9]|1\.0) MiB' "$log" || fail "more than 1 MiB of copies"
at_least 300 'by k-IOS' distance

echo "== verify"
preloaded verify check "$answers" || fail "verify changes the program's answers"
grep 'fcl_kios_preload: [cd]' "$log"
at_least 2500 'by k-IOS' collide
at_least 5000 'by k-IOS' distance
if grep differs "$log" || ! grep -q ' 0 differences' "$log"; then fail "differences"; fi

# It may miss what is written in place, and nothing else.
echo "== trust"
parts=(obbrss obb rss kios poses others changes reuse fcl threads)
"$program" write "$answers" "${parts[@]}" 2>"$log" || fail "the program without the library"
preloaded trust check "$answers" "${parts[@]}" || fail "other answers in mode trust"
rm -f "$answers" "$log"
