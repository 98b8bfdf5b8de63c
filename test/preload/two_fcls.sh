#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: two_fcls.sh INTERPOSER PROGRAM PLUGIN OTHER_PLUGIN
# Each plug-in's calls go to its own FCL, all 20 functions, whichever asks first; libfcl's queries
# are answered by k-IOS.
set -euo pipefail

interposer=$1 program=$2 one=$3 other=$4
for plugins in "$one $other" "$other $one"; do
  read -ra order <<<"$plugins"
  "$program" "${order[@]}"
  for mode in off on trust; do
    FCL_KIOS_PRELOAD=$mode LD_PRELOAD=$interposer "$program" "${order[@]}"
  done
  said=$(FCL_KIOS_PRELOAD=stats LD_PRELOAD=$interposer "$program" "${order[@]}" 2>&1)
  if ! grep -qE 'distance: [1-9][0-9]* by k-IOS' <<<"$said"; then
    echo "libfcl's plug-in isn't reached: $said"
    exit 1
  fi
done
