#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: plugin.sh INTERPOSER WORK_FILE HOST PLUGIN
# The program as a plug-in that brings libfcl into a process, for itself alone: its queries are
# answered nevertheless.
set -euo pipefail

interposer=$1 work=$2 host=$3 plugin=$4
parts=(obbrss reuse threads)
"$host" "$plugin" write "$work.answers" "${parts[@]}"
for mode in on trust verify; do
  echo "== $mode"
  FCL_KIOS_PRELOAD=$mode LD_PRELOAD=$interposer \
    "$host" "$plugin" check "$work.answers" "${parts[@]}" 2>"$work.log" || {
    cat "$work.log"
    exit 1
  }
  cat "$work.log"
done
grep -qE 'distance: [0-9]{3,} by k-IOS, .* 0 differences' "$work.log"
rm -f "$work.answers" "$work.log"
