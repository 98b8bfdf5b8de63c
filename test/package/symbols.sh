#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: symbols.sh LIBRARY MAP HEADERS. The shared library exports all that its map lists and nothing
# else: a weak symbol of FCL or Eigen would replace libfcl's in the whole process, a
# unique one would keep dlclose() from unloading the library, and a name of ours that no public
# header knows is internal.
set -euo pipefail

library=$1 map=$2 headers=$3
mapfile -t symbols < <(nm -D --defined-only "$library" | awk '{ print $NF }')
mapfile -t patterns < <(sed -n '/global:/,/local:/s/^ *\(_[^ ]*\);$/\1/p' "$map")
if ((${#symbols[@]} == 0 || ${#patterns[@]} == 0)); then
  echo "${#symbols[@]} symbols exported, ${#patterns[@]} patterns listed"
  exit 1
fi

status=0
declare -A met=()
for symbol in "${symbols[@]}"; do
  listed=
  for pattern in "${patterns[@]}"; do
    # shellcheck disable=SC2053 # the patterns are the shell's
    if [[ $symbol == $pattern ]]; then listed=1 met[$pattern]=1; fi
  done
  if [[ -z $listed ]]; then
    echo "exported, but not listed: $(c++filt "$symbol")"
    status=1
  fi
done
while read -r symbol; do
  echo "exported as unique: $(c++filt "$symbol")"
  status=1
done < <(nm -D --defined-only "$library" | awk '$2 == "u" { print $3 }')
for pattern in "${patterns[@]}"; do
  if [[ -z ${met[$pattern]:-} ]]; then
    echo "listed, but not exported: $pattern"
    status=1
  fi
done

# The types in the signatures too: an internal overload of a public name shows by them.
while read -r name; do
  if ! grep -rqw "${name##*::}" "$headers"; then
    echo "exported, but in no public header: $name"
    status=1
  fi
done < <(printf '%s\n' "${symbols[@]}" | c++filt | grep -oE 'kios(_overloads)?::[A-Za-z_]\w*' |
  sort -u)
echo "${#symbols[@]} symbols exported, by ${#patterns[@]} patterns"
exit "$status"
