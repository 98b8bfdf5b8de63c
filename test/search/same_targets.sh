#!/bin/sh
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Queries give bitwise the same answers whatever instruction set searches, and whatever the machine,
# but for the last bits of distances to shapes: a checksum of the answers is written down in
# same_targets.txt. With --write it is written anew, which needs a reason in the changelog.
#   same_targets.sh [--write] [what runs programs of another machine] <program of same_targets.cpp>
set -eu
write=
if [ "$1" = --write ]; then
  write=1
  shift
fi
written=$(dirname "$0")/same_targets.txt
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

env -u FCL_KIOS_SIMD "$@" > "$work/expected" 2> "$work/best"
echo "$(cat "$work/best"): the best of this machine, $(wc -l < "$work/expected") lines"
sum=$(grep -Ev '^(depths|points)' "$work/expected" | cksum)
if [ -n "$write" ]; then echo "$sum" > "$written"; fi
if [ "$sum" != "$(cat "$written")" ]; then
  echo "the answers' checksum is $sum, that in same_targets.txt $(cat "$written")"
  failed=1
fi
compared=0
for target in AVX3 AVX2 SSE4 NEON EMU128 SCALAR; do
  if FCL_KIOS_SIMD=$target "$@" > "$work/answers" 2> "$work/target"; then
    if [ "$(cat "$work/target")" != "$target" ]; then
      echo "$target was asked for, $(cat "$work/target") answered"
      failed=1
    elif cmp -s "$work/expected" "$work/answers"; then
      echo "$target: the same"
      compared=$((compared + 1))
    else
      echo "$target: differs"
      diff "$work/expected" "$work/answers" | head -n 6 || true
      failed=1
    fi
  elif grep -q "FCL_KIOS_SIMD=$target is not available" "$work/target"; then
    echo "$target: skipped, this machine or build lacks it"
  else
    echo "$target: failed"
    cat "$work/target"
    failed=1
  fi
done
if [ "$compared" -lt 2 ]; then
  echo "fewer than two targets were compared"
  failed=1
fi

status=0
FCL_KIOS_SIMD=NONSENSE "$@" > "$work/answers" 2> "$work/target" || status=$?
if [ "$status" -ne 2 ] || ! grep -q "^fcl_kios: FCL_KIOS_SIMD=NONSENSE .*: .*$(cat "$work/best")" "$work/target"; then
  echo "an unknown name must be refused by std::invalid_argument, naming what there is; got:"
  cat "$work/target"
  failed=1
fi
exit $failed
